//! Shelves and cabinets with their contents.

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::{NUM_MUTED_COLORS, NamedColor, Palette, muted_color};
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// Faces of a book that are visible in a shelf.
const BOOK_FACES: u8 = faces::FRONT | faces::TOP | faces::RIGHT | faces::LEFT;

/// Space for a row of books.
struct BookRow {
    /// Left end.
    left: f64,
    /// Height of the shelf.
    floor: f64,
    /// Front edge of the shelf.
    front: f64,
    width: f64,
    /// Free height.
    headroom: f64,
}

/// Adds a row of books, their spines toward +z.
fn books(asset: &mut Asset, row: &BookRow, palette: &Palette, rng: &mut SceneRng) {
    let mut x = row.left;
    let family = rng.index(3);
    while x < row.left + row.width - 0.05 {
        let (thick, tall) = (rng.range(0.018, 0.045), row.headroom.min(rng.range(0.17, 0.27)));
        let color = match rng.index(6) {
            0 => palette.accent.linear * 0.7,
            1 => palette.dark.linear * 2.0,
            2 => palette.main.linear * 0.6,
            3 => palette.light.linear * 0.65,
            _ => muted_color(rng.index(NUM_MUTED_COLORS) + family).linear * 0.5,
        };
        let deep = rng.range(0.14, 0.19);
        let trim = if color.element_sum() > 1.0 { color * 0.25 } else { Vec3::new(0.62, 0.5, 0.28) };
        let material = Material::patterned(Pattern::Spine, color, trim, 0.05).seeded(rng.seed());
        let at = [x + thick / 2.0, row.floor + tall / 2.0, row.front - 0.02 - deep / 2.0 - rng.range(0.0, 0.02)];
        let book =
            asset.block(at, [thick - 0.002, tall, deep], 0.004, material).only(BOOK_FACES).cell_scale(0.62).no_shadow();
        if rng.chance(0.06) {
            book.rotate(DVec3::Z, 0.2);
            x += 0.05;
        }
        x += thick;
        if rng.chance(0.05) {
            x += rng.range(0.05, 0.14);
        }
    }
    let (tall, plain) = (row.headroom.min(0.21), Material::plain(Vec3::ONE));
    let middle = [row.left + row.width / 2.0, row.floor + tall / 2.0, row.front - 0.13];
    asset.block(middle, [row.width, tall, 0.16], 0.0, plain).shadow_only();
}

/// A bookshelf with books and a few objects between them.
pub(crate) fn bookshelf(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("bookshelf");
    let wood = Material::wood(palette.wood.linear, rng.seed());
    let (width, height, depth) = (rng.range(0.9, 1.25), rng.range(1.75, 2.1), 0.3);
    let shelves = 5_u32;
    let gap = (height - 0.1) / f64::from(shelves);
    for side in [-1.0, 1.0] {
        asset.block([side * (width / 2.0 - 0.0125), height / 2.0, 0.0], [0.025, height, depth], 0.004, wood);
    }
    asset
        .block([0.0, height / 2.0, -depth / 2.0 + 0.008], [width - 0.05, height - 0.02, 0.012], 0.0, wood)
        .only(faces::FRONT);
    for i in 0..=shelves {
        let y = 0.08 + gap * f64::from(i);
        asset.block([0.0, y, 0.005], [width - 0.05, 0.025, depth - 0.01], 0.004, wood);
    }
    asset.block([0.0, 0.035, 0.01], [width - 0.05, 0.07, depth - 0.03], 0.0, wood).only(faces::FRONT);
    for i in 0..shelves {
        let floor = 0.0925 + gap * f64::from(i);
        let inner = width - 0.07;
        let full = rng.range(0.55, 1.0);
        let left = if rng.chance(0.5) { -inner / 2.0 } else { inner / 2.0 - inner * full };
        let row = BookRow { left, floor, front: depth / 2.0, width: inner * full, headroom: gap - 0.06 };
        books(&mut asset, &row, palette, rng);
        if full < 0.84 {
            let x = if left > -inner / 2.0 + 0.01 { -inner / 2.0 + 0.1 } else { inner / 2.0 - 0.1 };
            ornament(&mut asset, [x, floor, 0.03], palette, rng);
        }
    }
    asset.support([0.0, height - 0.02 + 0.0125, 0.0], [width / 2.0 - 0.06, depth / 2.0 - 0.04], 0.5);
    asset.centered()
}

/// Adds a small ornament on a shelf.
fn ornament(asset: &mut Asset, [x, y, z]: [f64; 3], palette: &Palette, rng: &mut SceneRng) {
    let color = if rng.chance(0.5) { palette.accent } else { palette.light };
    let material = Material::plain(color.linear).gloss(0.4);
    match rng.index(3) {
        0 => {
            let profile = [[0.03, 0.0], [0.06, 0.05], [0.055, 0.11], [0.025, 0.15], [0.032, 0.18]];
            asset.smooth_lathe([x, y, z], &profile, material).cell_scale(0.5);
        }
        1 => {
            asset.superellipsoid([x, y + 0.055, z], [0.11, 0.11, 0.11], 2.0, material).cell_scale(0.5);
        }
        _ => {
            let foliage =
                Material::patterned(Pattern::Speckle, Vec3::new(0.06, 0.16, 0.05), Vec3::new(0.14, 0.3, 0.1), 0.03);
            asset.smooth_lathe([x, y, z], &[[0.035, 0.0], [0.05, 0.08], [0.0, 0.075]], material).cell_scale(0.5);
            asset.superellipsoid([x, y + 0.13, z], [0.13, 0.13, 0.13], 2.0, foliage).cell_scale(0.5);
        }
    }
}

/// A stack of books.
pub(crate) fn book_stack(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("stack of books");
    let mut y = 0.0;
    for i in 0..2 + rng.index(3) {
        let color =
            [palette.accent, palette.light, palette.second, muted_color(rng.index(NUM_MUTED_COLORS)), palette.main]
                [i % 5];
        let thick = rng.range(0.02, 0.04);
        let (long, wide) = (rng.range(0.2, 0.26), rng.range(0.14, 0.18));
        let yaw = rng.range(-0.25, 0.25);
        let pages = Material::patterned(Pattern::Stripes, Vec3::splat(0.7), Vec3::splat(0.5), 0.004);
        let cover = Material::plain(color.linear).gloss(0.2);
        asset
            .block([0.004, y + thick / 2.0, 0.0], [long - 0.012, thick - 0.006, wide - 0.01], 0.0, pages)
            .rotate(DVec3::Y, yaw);
        for at in [y + 0.0025, y + thick - 0.0025] {
            asset.block([0.0, at, 0.0], [long, 0.005, wide], 0.002, cover).rotate(DVec3::Y, yaw);
        }
        y += thick;
    }
    asset.support([0.0, y, 0.0], [0.06, 0.05], 0.3);
    asset.scale_cells(0.45).centered()
}

/// A sideboard with three or four doors.
pub(crate) fn sideboard(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("sideboard");
    let wood = Material::wood(palette.wood.linear, rng.seed()).gloss(0.45);
    let (width, height, depth) = (rng.range(1.5, 1.9), rng.range(0.6, 0.75), 0.42);
    asset.legs([width / 2.0 - 0.12, depth / 2.0 - 0.08], 0.17, [0.014, 0.022], 0.03, wood);
    asset.block([0.0, f64::midpoint(height, 0.15), 0.0], [width, height - 0.15, depth], 0.008, wood);
    let doors = 3 + rng.index(2);
    let each = (width - 0.06) / doors as f64;
    let front = if rng.chance(0.4) { Material::plain(palette.light.linear * 0.85).gloss(0.2) } else { wood.seeded(77) };
    for i in 0..doors {
        let x = (i as f64 - (doors - 1) as f64 / 2.0) * each;
        asset.block([x, f64::midpoint(height, 0.15), depth / 2.0], [each - 0.012, height - 0.21, 0.018], 0.005, front);
        let knob = [x + each * 0.36, f64::midpoint(height, 0.15), depth / 2.0 + 0.02];
        asset.superellipsoid(knob, [0.024, 0.07, 0.024], 3.0, Material::metal(palette.second.linear)).cell_scale(0.4);
    }
    asset.support([0.0, height, 0.0], [width / 2.0 - 0.06, depth / 2.0 - 0.05], 1.2);
    asset.centered()
}

/// A tall wardrobe with two or three doors.
pub(crate) fn wardrobe(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::new("wardrobe");
    let material = Material::plain(color.linear * 0.9).gloss(0.15);
    let doors = 2 + rng.index(2);
    let each = rng.range(0.46, 0.54);
    let (width, height, depth) = (each * doors as f64 + 0.06, rng.range(1.95, 2.15), 0.58);
    asset.block([0.0, height / 2.0, 0.0], [width, height, depth], 0.01, material);
    asset.block([0.0, height + 0.02, 0.01], [width + 0.05, 0.05, depth + 0.05], 0.012, material);
    for i in 0..doors {
        let x = (i as f64 - (doors - 1) as f64 / 2.0) * each;
        asset.block(
            [x, height / 2.0 + 0.03, depth / 2.0 + 0.008],
            [each - 0.014, height - 0.14, 0.02],
            0.006,
            material,
        );
        for (y, tall) in [(height * 0.72, height * 0.42), (height * 0.26, height * 0.36)] {
            let face = depth / 2.0 + 0.02;
            asset.block(
                [x, y, face],
                [each - 0.14, tall, 0.014],
                0.007,
                Material::plain(color.linear * 0.8).gloss(0.15),
            );
        }
        let knob = [x + each * if i % 2 == 0 { 0.4 } else { -0.4 }, height * 0.48, depth / 2.0 + 0.035];
        asset
            .superellipsoid(knob, [0.03, 0.09, 0.03], 3.0, Material::metal(Vec3::new(0.5, 0.36, 0.16)))
            .cell_scale(0.4);
    }
    asset.centered()
}

/// A chest of drawers.
pub(crate) fn dresser(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("chest of drawers");
    let wood = Material::wood(palette.wood.linear, rng.seed()).gloss(0.4);
    let (width, height, depth) = (rng.range(0.85, 1.1), rng.range(0.8, 0.95), 0.45);
    asset.block([0.0, height / 2.0 + 0.03, 0.0], [width, height - 0.06, depth], 0.008, wood);
    asset.legs([width / 2.0 - 0.06, depth / 2.0 - 0.06], 0.08, [0.02, 0.026], 0.0, wood);
    for row in 0..4_u32 {
        let tall = (height - 0.1) / 4.0;
        let y = 0.08 + tall * (f64::from(row) + 0.5);
        asset.block([0.0, y, depth / 2.0], [width - 0.05, tall - 0.016, 0.018], 0.006, wood.seeded(row + 31));
        for x in [-0.24, 0.24] {
            let knob = [x * width, y, depth / 2.0 + 0.02];
            asset
                .superellipsoid(knob, [0.032, 0.032, 0.028], 2.0, Material::metal(palette.second.linear))
                .cell_scale(0.4);
        }
    }
    asset.support([0.0, height, 0.0], [width / 2.0 - 0.05, depth / 2.0 - 0.05], 1.0);
    asset.centered()
}

/// A wall shelf with books and ornaments; its back is at -z.
pub(crate) fn wall_shelf(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("wall shelf");
    let wood = Material::wood(palette.wood.linear, rng.seed());
    let (width, depth) = (rng.range(0.8, 1.1), 0.22);
    asset.block([0.0, 0.15, 0.0], [width, 0.03, depth], 0.005, wood);
    for x in [-0.36, 0.36] {
        asset
            .block([x * width, 0.07, -depth / 2.0 + 0.05], [0.02, 0.14, 0.1], 0.004, Material::metal(Vec3::splat(0.04)))
            .cell_scale(0.7);
    }
    let row =
        BookRow { left: -width / 2.0 + 0.04, floor: 0.165, front: depth / 2.0, width: width * 0.5, headroom: 0.3 };
    books(&mut asset, &row, palette, rng);
    ornament(&mut asset, [width * 0.2, 0.165, 0.0], palette, rng);
    ornament(&mut asset, [width * 0.4, 0.165, 0.0], palette, rng);
    asset.centered()
}

/// A woven basket.
pub(crate) fn basket(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("basket");
    let (radius, height) = (rng.range(0.17, 0.22), rng.range(0.28, 0.36));
    let straw = Material::patterned(Pattern::Weave, Vec3::new(0.42, 0.27, 0.12), Vec3::new(0.2, 0.11, 0.04), 0.022);
    let profile = [[radius * 0.8, 0.0], [radius * 1.04, height * 0.45], [radius, height], [radius * 0.94, height]];
    asset.smooth_lathe([0.0; 3], &profile, straw);
    asset.lathe([0.0; 3], &[[radius * 0.94, height], [radius * 0.9, height * 0.6], [0.0, height * 0.62]], straw);
    let cloth = Material::cloth(palette.light.linear, rng.seed());
    asset.superellipsoid([0.02, height * 0.78, 0.0], [radius * 1.5, 0.2, radius * 1.4], 2.4, cloth);
    for side in [-1.0, 1.0] {
        let x = side * radius;
        asset.pipe(&[[x, height * 0.9, -0.06], [x * 1.08, height * 1.12, 0.0], [x, height * 0.9, 0.06]], 0.01, straw);
    }
    asset.scale_cells(0.8).centered()
}
