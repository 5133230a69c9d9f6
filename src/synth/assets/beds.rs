//! Beds.

use std::f64::consts::PI;

use glam::DVec3;

use crate::asset::Asset;
use crate::color::Palette;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A double bed with pillows and a blanket over its foot; the head is at -z.
pub(crate) fn bed(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::colored("bed", &palette.main);
    let (width, length) = (rng.range(1.5, 1.8), 2.05);
    let wood = Material::wood(palette.wood.linear, rng.seed());
    let linen = Material::cloth(palette.light.linear, rng.seed());
    let cover = Material::cloth(palette.main.linear, rng.seed());
    asset.legs([width / 2.0 - 0.08, length / 2.0 - 0.08], 0.2, [0.025, 0.03], 0.0, wood);
    asset.block([0.0, 0.25, 0.0], [width, 0.14, length], 0.02, wood);
    asset.block([0.0, 0.41, 0.02], [width - 0.04, 0.2, length - 0.06], 0.06, linen);
    let high = rng.range(0.95, 1.15);
    if rng.chance(0.6) {
        asset.block(
            [0.0, high / 2.0 + 0.05, -length / 2.0 - 0.04],
            [width + 0.06, high - 0.1, 0.1],
            0.045,
            cover.seeded(5),
        );
    } else {
        asset.block([0.0, high / 2.0 + 0.1, -length / 2.0 - 0.02], [width + 0.04, high - 0.2, 0.05], 0.012, wood);
    }
    asset.block([0.0, 0.475, 0.29], [width + 0.04, 0.13, length * 0.72], 0.055, cover);
    asset.block([0.0, 0.53, -0.42], [width + 0.03, 0.05, 0.3], 0.022, linen);
    throw_over(&mut asset, width, length, palette);
    for side in [-1.0, 1.0] {
        let x = side * width * 0.24;
        let z = -length / 2.0 + 0.32;
        let soft = linen.seeded(rng.seed());
        asset.superellipsoid([x, 0.6, z - 0.1], [width * 0.43, 0.44, 0.2], 3.2, soft).rotate(DVec3::X, -0.75);
        asset
            .superellipsoid(
                [x * 0.96, 0.62, z + 0.1],
                [width * 0.38, 0.36, 0.17],
                3.2,
                Material::cloth(palette.second.linear, rng.seed()),
            )
            .rotate(DVec3::X, -0.7);
    }
    asset
        .superellipsoid(
            [0.0, 0.63, -length / 2.0 + 0.58],
            [0.5, 0.28, 0.14],
            3.0,
            Material::cloth(palette.accent.linear, rng.seed()),
        )
        .rotate(DVec3::X, -0.65);
    asset.centered()
}

/// Adds a folded throw across the foot end.
fn throw_over(asset: &mut Asset, width: f64, length: f64, palette: &Palette) {
    let tone = palette.accent.linear;
    let material = Material::patterned(Pattern::Stripes, tone, tone * 0.6 + 0.15, 0.09).two_sided();
    let (deep, drop) = (0.55, 0.28);
    let half = width / 2.0 + 0.03;
    let total = 2.0 * (half + drop);
    let sheet = asset.sheet([deep, total], material, move |u, v| {
        let s = (v - 0.5) * total;
        let wave = 0.008 * (u * 19.0 + v * 5.0).sin().abs();
        let over = s.abs() - half;
        let z = length * 0.3 + (u - 0.5) * deep + 0.02 * (v * PI * 2.0).sin();
        if over <= 0.0 {
            DVec3::new(s, 0.548 + wave, z)
        } else {
            DVec3::new(s.signum() * (half + wave), 0.545 - over, z)
        }
    });
    sheet.no_shadow();
}
