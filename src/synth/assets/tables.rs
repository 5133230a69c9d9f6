//! Tables and desks.

use glam::Vec3;

use crate::asset::Asset;
use crate::color::Palette;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

fn polished(palette: &Palette, rng: &mut SceneRng) -> Material {
    Material::wood(palette.wood.linear, rng.seed()).gloss(0.5)
}

fn black_metal() -> Material {
    Material::metal(Vec3::splat(0.035))
}

/// A low table: rectangular with a shelf, or round.
pub(crate) fn coffee_table(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("coffee table");
    let wood = polished(palette, rng);
    let height = rng.range(0.38, 0.44);
    if rng.chance(0.5) {
        let (length, depth) = (rng.range(1.0, 1.25), rng.range(0.55, 0.65));
        asset.block([0.0, height - 0.02, 0.0], [length, 0.04, depth], 0.008, wood).cell_scale(0.8);
        asset.block([0.0, 0.15, 0.0], [length - 0.14, 0.022, depth - 0.12], 0.006, wood);
        asset.legs([length / 2.0 - 0.07, depth / 2.0 - 0.07], height - 0.03, [0.018, 0.024], 0.02, wood);
        asset.support([0.0, height, 0.0], [length / 2.0 - 0.05, depth / 2.0 - 0.05], 1.0);
    } else {
        let radius = rng.range(0.4, 0.5);
        let stone = Material::patterned(Pattern::Marble, palette.light.linear * 0.9, palette.light.linear * 0.35, 0.3)
            .gloss(0.6);
        let material = if rng.chance(0.4) { stone } else { wood };
        disc_top(&mut asset, radius, height, material);
        asset.legs([radius * 0.5, radius * 0.5], height - 0.03, [0.016, 0.022], 0.07, wood);
        asset.support([0.0, height, 0.0], [radius * 0.7, radius * 0.7], 1.0);
    }
    asset.centered()
}

/// Adds a round table top, 4 cm thick, whose upper side is at `height`.
fn disc_top(asset: &mut Asset, radius: f64, height: f64, material: Material) {
    let profile =
        [[0.0, 0.0], [radius - 0.01, 0.0], [radius, 0.01], [radius, 0.03], [radius - 0.01, 0.04], [0.0, 0.04]];
    asset.lathe([0.0, height - 0.04, 0.0], &profile, material).cell_scale(0.8);
}

/// A small round table beside a seat.
pub(crate) fn side_table(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("side table");
    let (height, radius) = (rng.range(0.48, 0.56), rng.range(0.2, 0.25));
    let wood = polished(palette, rng);
    disc_top(&mut asset, radius, height, wood);
    if rng.chance(0.5) {
        asset.rod([0.0, 0.02, 0.0], [0.0, height - 0.03, 0.0], [0.018, 0.018], black_metal());
        asset.lathe([0.0; 3], &[[radius * 0.7, 0.0], [radius * 0.7, 0.014], [0.0, 0.022]], black_metal());
    } else {
        asset.legs([radius * 0.5, radius * 0.5], height - 0.03, [0.011, 0.016], 0.04, wood);
    }
    asset.support([0.0, height, 0.0], [radius * 0.7, radius * 0.7], 0.9);
    asset.scale_cells(0.85).centered()
}

/// A dining table for four or six.
pub(crate) fn dining_table(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("dining table");
    let wood = polished(palette, rng);
    let (length, depth, height) = (rng.range(1.5, 1.8), rng.range(0.85, 0.95), 0.75);
    asset.block([0.0, height - 0.02, 0.0], [length, 0.04, depth], 0.008, wood).cell_scale(0.8);
    for z in [-1.0, 1.0] {
        asset.block([0.0, height - 0.08, z * (depth / 2.0 - 0.09)], [length - 0.2, 0.09, 0.025], 0.004, wood);
    }
    if rng.chance(0.5) {
        asset.legs([length / 2.0 - 0.1, depth / 2.0 - 0.1], height - 0.03, [0.024, 0.034], 0.03, wood);
    } else {
        for x in [-1.0, 1.0] {
            for z in [-1.0, 1.0] {
                let at = [x * (length / 2.0 - 0.09), (height - 0.04) / 2.0, z * (depth / 2.0 - 0.09)];
                asset.block(at, [0.075, height - 0.04, 0.075], 0.008, wood);
            }
        }
    }
    asset.support([0.0, height, 0.0], [length / 2.0 - 0.1, depth / 2.0 - 0.1], 1.0);
    asset.centered()
}

/// A desk with drawers on one side.
pub(crate) fn desk(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("desk");
    let wood = polished(palette, rng);
    let (length, depth, height) = (rng.range(1.25, 1.5), rng.range(0.6, 0.7), 0.74);
    asset.block([0.0, height - 0.018, 0.0], [length, 0.036, depth], 0.007, wood).cell_scale(0.8);
    let front = Material::plain(palette.light.linear * 0.85).gloss(0.2);
    let (x, width) = (length / 2.0 - 0.24, 0.4);
    asset.block([x, 0.4, 0.0], [width, 0.6, depth - 0.1], 0.006, wood);
    for i in 0..3 {
        let y = 0.21 + 0.19 * f64::from(i);
        asset.block([x, y, depth / 2.0 - 0.045], [width - 0.03, 0.175, 0.02], 0.005, front).cell_scale(0.8);
        asset.block([x, y + 0.02, depth / 2.0 - 0.028], [0.12, 0.012, 0.016], 0.004, black_metal()).cell_scale(0.5);
    }
    for z in [-1.0, 1.0] {
        let foot = [-length / 2.0 + 0.05, 0.0, z * (depth / 2.0 - 0.05)];
        asset.rod(foot, [foot[0], height - 0.03, foot[2]], [0.02, 0.024], wood);
        asset.rod([x, 0.0, z * (depth / 2.0 - 0.12)], [x, 0.12, z * (depth / 2.0 - 0.12)], [0.02, 0.024], wood);
    }
    asset.support([-0.05, height, 0.0], [length / 2.0 - 0.12, depth / 2.0 - 0.06], 1.0);
    asset.centered()
}

/// A nightstand.
pub(crate) fn nightstand(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("nightstand");
    let wood = polished(palette, rng);
    let (width, height, depth) = (rng.range(0.42, 0.5), rng.range(0.48, 0.56), 0.38);
    asset.legs([width / 2.0 - 0.05, depth / 2.0 - 0.05], 0.15, [0.012, 0.018], 0.02, wood);
    asset.block([0.0, f64::midpoint(height, 0.13), 0.0], [width, height - 0.13, depth], 0.008, wood);
    for i in 0..2 {
        let tall = (height - 0.17) / 2.0;
        let y = 0.15 + tall * (f64::from(i) + 0.5);
        asset.block([0.0, y, depth / 2.0], [width - 0.04, tall - 0.015, 0.016], 0.005, wood.seeded(i as u32 + 9));
        asset
            .superellipsoid(
                [0.0, y, depth / 2.0 + 0.018],
                [0.03, 0.03, 0.026],
                2.0,
                Material::metal(palette.second.linear),
            )
            .cell_scale(0.4);
    }
    asset.support([0.0, height, 0.0], [width / 2.0 - 0.03, depth / 2.0 - 0.03], 0.8);
    asset.scale_cells(0.9).centered()
}

/// A workbench with a vise and boxes on a shelf below.
pub(crate) fn workbench(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("workbench");
    let wood = Material::wood(palette.floor.linear, rng.seed());
    let (length, depth, height) = (rng.range(1.6, 2.0), 0.66, 0.9);
    asset.block([0.0, height - 0.035, 0.0], [length, 0.07, depth], 0.006, wood).cell_scale(0.8);
    asset.block([0.0, 0.24, 0.0], [length - 0.12, 0.03, depth - 0.1], 0.004, wood);
    for x in [-1.0, 1.0] {
        for z in [-1.0, 1.0] {
            let at = [x * (length / 2.0 - 0.1), (height - 0.07) / 2.0, z * (depth / 2.0 - 0.07)];
            asset.block(at, [0.09, height - 0.07, 0.09], 0.005, wood);
        }
    }
    let vise = Material::plain(Vec3::new(0.05, 0.12, 0.2)).gloss(0.4);
    let x = -length / 2.0 + 0.25;
    asset.block([x, height - 0.1, depth / 2.0 + 0.03], [0.22, 0.14, 0.06], 0.012, vise);
    asset.rod(
        [x, height - 0.1, depth / 2.0],
        [x, height - 0.1, depth / 2.0 + 0.15],
        [0.014, 0.014],
        Material::metal(Vec3::splat(0.4)),
    );
    for i in 0..3 {
        let tint = [palette.accent, palette.second, palette.light][i].linear;
        let x = -0.5 + 0.45 * i as f64;
        asset.block([x, 0.255 + 0.11, 0.0], [0.32, 0.22, 0.36], 0.012, Material::plain(tint * 0.8));
    }
    asset.support([0.1, height, 0.0], [length / 2.0 - 0.25, depth / 2.0 - 0.06], 1.0);
    asset.centered()
}

/// The plain table of a tabletop scene.
pub(crate) fn still_life_table(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("table");
    let wood = polished(palette, rng);
    let (length, depth, height) = (rng.range(1.5, 1.8), rng.range(0.95, 1.15), 0.75);
    asset.block([0.0, height - 0.022, 0.0], [length, 0.044, depth], 0.01, wood).cell_scale(0.45);
    asset.legs([length / 2.0 - 0.1, depth / 2.0 - 0.1], height - 0.03, [0.026, 0.036], 0.03, wood);
    asset.support([0.0, height, 0.0], [length / 2.0 - 0.1, depth / 2.0 - 0.1], 1.0);
    asset.centered()
}
