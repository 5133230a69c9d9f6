//! Fireplaces.

use glam::Vec3;

use crate::asset::Asset;
use crate::color::Palette;
use crate::faces;
use crate::material::{Material, Pattern};
use crate::noise;
use crate::rng::SceneRng;

/// A brick or plaster fireplace with logs and a fire; its back is at -z.
pub(crate) fn fireplace(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("fireplace");
    let (width, height, depth) = (1.36, 1.12, 0.36);
    let (open_width, open_height) = (0.78, 0.68);
    let soot = Material::plain(Vec3::splat(0.02));
    let side = (width - open_width) / 2.0;
    if rng.chance(0.6) {
        bricks(&mut asset, [width, height, depth], [open_width, open_height], rng.seed());
    } else {
        let plaster = Material::plain(palette.light.linear).gloss(0.15);
        for x in [-1.0, 1.0] {
            asset.block([x * (width - side) / 2.0, height / 2.0, 0.0], [side, height, depth], 0.01, plaster);
            asset.block([x * (width - side) / 2.0, 0.4, 0.02], [side - 0.1, 0.6, depth], 0.008, plaster);
        }
        let above = height - open_height;
        asset.block([0.0, height - above / 2.0, 0.0], [open_width, above, depth], 0.006, plaster);
    }
    asset.block([0.0, open_height / 2.0, -depth / 2.0 + 0.02], [open_width, open_height, 0.03], 0.0, soot);
    asset.block(
        [0.0, 0.02, 0.1],
        [width + 0.16, 0.04, depth + 0.24],
        0.008,
        Material::patterned(Pattern::Marble, Vec3::splat(0.14), Vec3::splat(0.3), 0.2).gloss(0.4),
    );
    asset.block(
        [0.0, height + 0.035, 0.02],
        [width + 0.16, 0.07, depth + 0.08],
        0.012,
        Material::wood(palette.wood.linear, rng.seed()),
    );
    logs(&mut asset, rng);
    asset.support([0.0, height + 0.07, 0.02], [width / 2.0 - 0.06, depth / 2.0 - 0.06], 0.5);
    asset.centered()
}

/// Adds rows of single bricks around an opening.
fn bricks(asset: &mut Asset, size: [f64; 3], open: [f64; 2], seed: u32) {
    let [width, height, depth] = size;
    let (long, tall) = (width / 6.0, height / 14.0);
    let mortar = Material::plain(Vec3::splat(0.34));
    let side = (width - open[0]) / 2.0;
    for x in [-1.0, 1.0] {
        asset.block(
            [x * (width - side) / 2.0, height / 2.0, -0.008],
            [side - 0.004, height, depth - 0.016],
            0.0,
            mortar,
        );
    }
    let above = height - open[1];
    asset.block([0.0, height - above / 2.0, -0.008], [open[0], above - 0.004, depth - 0.016], 0.0, mortar);
    for row in 0..14_i32 {
        let y = tall * (f64::from(row) + 0.5);
        let shift = f64::from(row.rem_euclid(2)) * 0.5;
        for column in 0..7_i32 {
            let low = (long * (f64::from(column) - shift)).max(0.0) - width / 2.0;
            let high = (long * (f64::from(column) + 1.0 - shift)).min(width) - width / 2.0;
            let (low, high) = if y < open[1] { outside(low, high, open[0] / 2.0) } else { (low, high) };
            if high - low < 0.03 {
                continue;
            }
            let t = noise::unit_hash(row, column, seed) as f32;
            let tone = Vec3::new(0.3, 0.11, 0.07).lerp(Vec3::new(0.42, 0.2, 0.13), t)
                * (0.75 + 0.5 * noise::unit_hash(column, row, seed) as f32);
            let material = Material::patterned(Pattern::Speckle, tone, tone * 0.75, 0.03).seeded(seed ^ row as u32);
            let brick = [high - low - 0.01, tall - 0.01, depth];
            asset
                .block([f64::midpoint(low, high), y, 0.0], brick, 0.004, material)
                .only(faces::FRONT | faces::RIGHT | faces::LEFT)
                .cell_scale(1.3);
        }
    }
}

/// The part of the interval `low..high` beside the opening `-half..half`; empty inside it.
fn outside(low: f64, high: f64, half: f64) -> (f64, f64) {
    if low < -half {
        (low, high.min(-half))
    } else if high > half {
        (low.max(half), high)
    } else {
        (0.0, 0.0)
    }
}

/// Adds logs, embers, flames and their light.
fn logs(asset: &mut Asset, rng: &mut SceneRng) {
    let bark = Material::patterned(Pattern::Speckle, Vec3::new(0.07, 0.045, 0.03), Vec3::new(0.16, 0.1, 0.06), 0.03);
    for (x, y, z, lean) in [(-0.02, 0.11, 0.02, 0.02), (0.03, 0.1, -0.08, -0.03), (0.0, 0.19, -0.03, 0.05)] {
        asset.rod([x - 0.24, y - lean, z], [x + 0.24, y + lean, z + 0.03], [0.05, 0.045], bark).cell_scale(0.8);
    }
    let ember = Material::plain(Vec3::new(1.5, 0.5, 0.12)).emission(0.9);
    let flame = Material::plain(Vec3::new(1.7, 0.85, 0.25)).emission(1.0).opacity(0.7);
    for k in 0..9 {
        let x = -0.18 + 0.045 * f64::from(k);
        let tall = rng.range(0.1, 0.28) * (1.2 - 2.6 * x.abs());
        let z = rng.range(-0.06, 0.03);
        asset
            .smooth_lathe([x, 0.19, z], &[[0.012, 0.0], [0.03, tall * 0.3], [0.018, tall * 0.65], [0.0, tall]], flame)
            .cell_scale(0.6);
    }
    asset.block([0.0, 0.075, -0.02], [0.5, 0.03, 0.2], 0.01, ember);
    asset.lamp([0.0, 0.32, 0.12], 0.08, Vec3::new(1.0, 0.42, 0.14) * 0.6);
}
