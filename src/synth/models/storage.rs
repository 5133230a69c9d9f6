//! Shelves, cabinets and what fills them.

use glam::{DVec3, Vec3};

use super::super::color::{Hue, Palette, SMALL_HUES, small_hue};
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

/// Faces of a book that can be seen in a shelf: front, left, right, top.
const BOOK_FACES: u8 = 0b10_1011;

/// Extent of a row of books: left end, floor, front, room to the right and above.
struct Row {
    left: f64,
    floor: f64,
    front: f64,
    width: f64,
    room: f64,
}

/// Books side by side, their spines toward +z.
fn books(model: &mut Model, row: &Row, palette: &Palette, dice: &mut Dice) {
    let mut x = row.left;
    let family = dice.index(3);
    while x < row.left + row.width - 0.05 {
        let (thick, tall) = (dice.range(0.018, 0.045), row.room.min(dice.range(0.17, 0.27)));
        let hue = match dice.index(6) {
            0 => palette.accent.linear * 0.7,
            1 => palette.dark.linear * 2.0,
            2 => palette.main.linear * 0.6,
            3 => palette.light.linear * 0.65,
            _ => small_hue(dice.index(SMALL_HUES) + family).linear * 0.5,
        };
        let deep = dice.range(0.14, 0.19);
        let trim = if hue.element_sum() > 1.0 { hue * 0.25 } else { Vec3::new(0.62, 0.5, 0.28) };
        let paint = Paint::patterned(Pattern::Spine, hue, trim, 0.05).seeded(dice.seed());
        let at = [x + thick / 2.0, row.floor + tall / 2.0, row.front - 0.02 - deep / 2.0 - dice.range(0.0, 0.02)];
        let book = model.block(at, [thick - 0.002, tall, deep], 0.004, paint).only(BOOK_FACES).cells(0.62).airy();
        if dice.chance(0.06) {
            book.turn(DVec3::Z, 0.2);
            x += 0.05;
        }
        x += thick;
        if dice.chance(0.05) {
            x += dice.range(0.05, 0.14);
        }
    }
    let (tall, plain) = (row.room.min(0.21), Paint::plain(Vec3::ONE));
    let middle = [row.left + row.width / 2.0, row.floor + tall / 2.0, row.front - 0.13];
    model.block(middle, [row.width, tall, 0.16], 0.0, plain).ghost();
}

/// A bookshelf with books and a few objects between them.
pub(in super::super) fn bookshelf(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("bookshelf");
    let wood = Paint::wood(palette.wood.linear, dice.seed());
    let (width, height, depth) = (dice.range(0.9, 1.25), dice.range(1.75, 2.1), 0.3);
    let shelves = 5_u32;
    let gap = (height - 0.1) / f64::from(shelves);
    for side in [-1.0, 1.0] {
        model.block([side * (width / 2.0 - 0.0125), height / 2.0, 0.0], [0.025, height, depth], 0.004, wood);
    }
    model
        .block([0.0, height / 2.0, -depth / 2.0 + 0.008], [width - 0.05, height - 0.02, 0.012], 0.0, wood)
        .only(0b10_0000);
    for i in 0..=shelves {
        let y = 0.08 + gap * f64::from(i);
        model.block([0.0, y, 0.005], [width - 0.05, 0.025, depth - 0.01], 0.004, wood);
    }
    model.block([0.0, 0.035, 0.01], [width - 0.05, 0.07, depth - 0.03], 0.0, wood).only(0b10_0000);
    for i in 0..shelves {
        let floor = 0.0925 + gap * f64::from(i);
        let inner = width - 0.07;
        let full = dice.range(0.55, 1.0);
        let left = if dice.chance(0.5) { -inner / 2.0 } else { inner / 2.0 - inner * full };
        let row = Row { left, floor, front: depth / 2.0, width: inner * full, room: gap - 0.06 };
        books(&mut model, &row, palette, dice);
        if full < 0.84 {
            let x = if left > -inner / 2.0 + 0.01 { -inner / 2.0 + 0.1 } else { inner / 2.0 - 0.1 };
            ornament(&mut model, [x, floor, 0.03], palette, dice);
        }
    }
    model.top([0.0, height - 0.02 + 0.0125, 0.0], [width / 2.0 - 0.06, depth / 2.0 - 0.04], 0.5);
    model.centered()
}

/// A small thing that belongs to the shelf.
fn ornament(model: &mut Model, [x, y, z]: [f64; 3], palette: &Palette, dice: &mut Dice) {
    let hue = if dice.chance(0.5) { palette.accent } else { palette.light };
    let paint = Paint::plain(hue.linear).gloss(0.4);
    match dice.index(3) {
        0 => {
            let profile = [[0.03, 0.0], [0.06, 0.05], [0.055, 0.11], [0.025, 0.15], [0.032, 0.18]];
            model.turned([x, y, z], &profile, paint).cells(0.5);
        }
        1 => {
            model.pillow([x, y + 0.055, z], [0.11, 0.11, 0.11], 2.0, paint).cells(0.5);
        }
        _ => {
            let foliage =
                Paint::patterned(Pattern::Speckle, Vec3::new(0.06, 0.16, 0.05), Vec3::new(0.14, 0.3, 0.1), 0.03);
            model.turned([x, y, z], &[[0.035, 0.0], [0.05, 0.08], [0.0, 0.075]], paint).cells(0.5);
            model.pillow([x, y + 0.13, z], [0.13, 0.13, 0.13], 2.0, foliage).cells(0.5);
        }
    }
}

/// Books lying on each other.
pub(in super::super) fn book_stack(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("stack of books");
    let mut y = 0.0;
    for i in 0..2 + dice.index(3) {
        let hue =
            [palette.accent, palette.light, palette.second, small_hue(dice.index(SMALL_HUES)), palette.main][i % 5];
        let thick = dice.range(0.02, 0.04);
        let (long, wide) = (dice.range(0.2, 0.26), dice.range(0.14, 0.18));
        let yaw = dice.range(-0.25, 0.25);
        let pages = Paint::patterned(Pattern::Stripes, Vec3::splat(0.7), Vec3::splat(0.5), 0.004);
        let cover = Paint::plain(hue.linear).gloss(0.2);
        model
            .block([0.004, y + thick / 2.0, 0.0], [long - 0.012, thick - 0.006, wide - 0.01], 0.0, pages)
            .turn(DVec3::Y, yaw);
        for at in [y + 0.0025, y + thick - 0.0025] {
            model.block([0.0, at, 0.0], [long, 0.005, wide], 0.002, cover).turn(DVec3::Y, yaw);
        }
        y += thick;
    }
    model.top([0.0, y, 0.0], [0.06, 0.05], 0.3);
    model.fine(0.45).centered()
}

/// A long low cabinet with doors.
pub(in super::super) fn sideboard(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("sideboard");
    let wood = Paint::wood(palette.wood.linear, dice.seed()).gloss(0.45);
    let (width, height, depth) = (dice.range(1.5, 1.9), dice.range(0.6, 0.75), 0.42);
    model.legs([width / 2.0 - 0.12, depth / 2.0 - 0.08], 0.17, [0.014, 0.022], 0.03, wood);
    model.block([0.0, f64::midpoint(height, 0.15), 0.0], [width, height - 0.15, depth], 0.008, wood);
    let doors = 3 + dice.index(2);
    let each = (width - 0.06) / doors as f64;
    let front = if dice.chance(0.4) { Paint::plain(palette.light.linear * 0.85).gloss(0.2) } else { wood.seeded(77) };
    for i in 0..doors {
        let x = (i as f64 - (doors - 1) as f64 / 2.0) * each;
        model.block([x, f64::midpoint(height, 0.15), depth / 2.0], [each - 0.012, height - 0.21, 0.018], 0.005, front);
        let knob = [x + each * 0.36, f64::midpoint(height, 0.15), depth / 2.0 + 0.02];
        model.pillow(knob, [0.024, 0.07, 0.024], 3.0, Paint::metal(palette.second.linear)).cells(0.4);
    }
    model.top([0.0, height, 0.0], [width / 2.0 - 0.06, depth / 2.0 - 0.05], 1.2);
    model.centered()
}

/// A tall wardrobe with two or three doors.
pub(in super::super) fn wardrobe(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::new("wardrobe");
    let paint = Paint::plain(hue.linear * 0.9).gloss(0.15);
    let doors = 2 + dice.index(2);
    let each = dice.range(0.46, 0.54);
    let (width, height, depth) = (each * doors as f64 + 0.06, dice.range(1.95, 2.15), 0.58);
    model.block([0.0, height / 2.0, 0.0], [width, height, depth], 0.01, paint);
    model.block([0.0, height + 0.02, 0.01], [width + 0.05, 0.05, depth + 0.05], 0.012, paint);
    for i in 0..doors {
        let x = (i as f64 - (doors - 1) as f64 / 2.0) * each;
        model.block([x, height / 2.0 + 0.03, depth / 2.0 + 0.008], [each - 0.014, height - 0.14, 0.02], 0.006, paint);
        for (y, tall) in [(height * 0.72, height * 0.42), (height * 0.26, height * 0.36)] {
            let face = depth / 2.0 + 0.02;
            model.block([x, y, face], [each - 0.14, tall, 0.014], 0.007, Paint::plain(hue.linear * 0.8).gloss(0.15));
        }
        let knob = [x + each * if i % 2 == 0 { 0.4 } else { -0.4 }, height * 0.48, depth / 2.0 + 0.035];
        model.pillow(knob, [0.03, 0.09, 0.03], 3.0, Paint::metal(Vec3::new(0.5, 0.36, 0.16))).cells(0.4);
    }
    model.centered()
}

/// A chest of drawers.
pub(in super::super) fn dresser(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("chest of drawers");
    let wood = Paint::wood(palette.wood.linear, dice.seed()).gloss(0.4);
    let (width, height, depth) = (dice.range(0.85, 1.1), dice.range(0.8, 0.95), 0.45);
    model.block([0.0, height / 2.0 + 0.03, 0.0], [width, height - 0.06, depth], 0.008, wood);
    model.legs([width / 2.0 - 0.06, depth / 2.0 - 0.06], 0.08, [0.02, 0.026], 0.0, wood);
    for row in 0..4_u32 {
        let tall = (height - 0.1) / 4.0;
        let y = 0.08 + tall * (f64::from(row) + 0.5);
        model.block([0.0, y, depth / 2.0], [width - 0.05, tall - 0.016, 0.018], 0.006, wood.seeded(row + 31));
        for x in [-0.24, 0.24] {
            let knob = [x * width, y, depth / 2.0 + 0.02];
            model.pillow(knob, [0.032, 0.032, 0.028], 2.0, Paint::metal(palette.second.linear)).cells(0.4);
        }
    }
    model.top([0.0, height, 0.0], [width / 2.0 - 0.05, depth / 2.0 - 0.05], 1.0);
    model.centered()
}

/// A board on the wall with things on it; its back is at -z.
pub(in super::super) fn wall_shelf(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("wall shelf");
    let wood = Paint::wood(palette.wood.linear, dice.seed());
    let (width, depth) = (dice.range(0.8, 1.1), 0.22);
    model.block([0.0, 0.15, 0.0], [width, 0.03, depth], 0.005, wood);
    for x in [-0.36, 0.36] {
        model
            .block([x * width, 0.07, -depth / 2.0 + 0.05], [0.02, 0.14, 0.1], 0.004, Paint::metal(Vec3::splat(0.04)))
            .cells(0.7);
    }
    let row = Row { left: -width / 2.0 + 0.04, floor: 0.165, front: depth / 2.0, width: width * 0.5, room: 0.3 };
    books(&mut model, &row, palette, dice);
    ornament(&mut model, [width * 0.2, 0.165, 0.0], palette, dice);
    ornament(&mut model, [width * 0.4, 0.165, 0.0], palette, dice);
    model.centered()
}

/// A woven basket.
pub(in super::super) fn basket(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("basket");
    let (radius, height) = (dice.range(0.17, 0.22), dice.range(0.28, 0.36));
    let straw = Paint::patterned(Pattern::Weave, Vec3::new(0.42, 0.27, 0.12), Vec3::new(0.2, 0.11, 0.04), 0.022);
    let profile = [[radius * 0.8, 0.0], [radius * 1.04, height * 0.45], [radius, height], [radius * 0.94, height]];
    model.turned([0.0; 3], &profile, straw);
    model.lathe([0.0; 3], &[[radius * 0.94, height], [radius * 0.9, height * 0.6], [0.0, height * 0.62]], straw);
    let cloth = Paint::cloth(palette.light.linear, dice.seed());
    model.pillow([0.02, height * 0.78, 0.0], [radius * 1.5, 0.2, radius * 1.4], 2.4, cloth);
    for side in [-1.0, 1.0] {
        let x = side * radius;
        model.pipe(&[[x, height * 0.9, -0.06], [x * 1.08, height * 1.12, 0.0], [x, height * 0.9, 0.06]], 0.01, straw);
    }
    model.fine(0.8).centered()
}
