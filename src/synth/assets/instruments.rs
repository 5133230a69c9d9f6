//! Musical instruments.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::Palette;
use crate::faces;
use crate::material::Material;
use crate::placement::Placement;
use crate::rng::SceneRng;

/// Half width of a guitar's body, m, at the height `t` in 0..=1 from the lower to the upper bout.
fn outline(t: f64) -> f64 {
    let lower = 0.185 * (1.0 - ((t - 0.3) / 0.34).powi(2)).max(0.0).sqrt();
    let upper = 0.138 * (1.0 - ((t - 0.78) / 0.225).powi(2)).max(0.0).sqrt();
    let waist = if (0.4..0.75).contains(&t) { 0.115 + 0.2 * (t - 0.575).powi(2) } else { 0.0 };
    lower.max(upper).max(waist) * (t / 0.02).min(1.0).sqrt() * ((1.0 - t) / 0.02).min(1.0).sqrt()
}

/// An acoustic guitar on a stand.
pub(crate) fn guitar(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut body = Asset::new("guitar");
    let (tall, deep) = (0.5, 0.1);
    let top = Material::wood(Vec3::new(0.55, 0.3, 0.11), rng.seed()).gloss(0.7);
    let side = Material::wood(Vec3::new(0.16, 0.06, 0.03), rng.seed()).gloss(0.6);
    for (z, material, flip) in [(deep / 2.0, top, 1.0), (-deep / 2.0, side, -1.0)] {
        body.sheet([0.34, tall], material, move |u, v| DVec3::new(flip * (u - 0.5) * 2.0 * outline(v), tall * v, z));
    }
    for hand in [-1.0, 1.0] {
        body.sheet([0.7, deep], side, move |u, v| DVec3::new(hand * outline(u), tall * u, (v - 0.5) * deep))
            .cell_scale(0.7);
    }
    let black = Material::plain(Vec3::splat(0.01));
    let ring = Material::plain(Vec3::new(0.1, 0.05, 0.03));
    body.lathe([0.0, 0.33, deep / 2.0 + 0.001], &[[0.062, 0.0], [0.05, 0.001]], ring)
        .rotate(DVec3::X, TAU / 4.0)
        .cell_scale(0.5)
        .no_shadow();
    body.lathe([0.0, 0.33, deep / 2.0 + 0.001], &[[0.05, 0.001], [0.0, 0.001]], black)
        .rotate(DVec3::X, TAU / 4.0)
        .no_shadow();
    body.block([0.0, 0.13, deep / 2.0 + 0.006], [0.15, 0.022, 0.012], 0.004, side);
    body.block([0.0, 0.66, deep / 2.0 - 0.002], [0.05, 0.66, 0.022], 0.006, side).cell_scale(0.7);
    body.block(
        [0.0, 0.67, deep / 2.0 + 0.01],
        [0.048, 0.62, 0.006],
        0.0,
        Material::plain(Vec3::new(0.03, 0.02, 0.015)),
    )
    .only(faces::FRONT)
    .cell_scale(0.6);
    for fret in 0..14 {
        let y = 0.98 - 0.6 * (1.0 - 0.5_f64.powf(f64::from(fret) / 12.0));
        body.rod(
            [-0.023, y, deep / 2.0 + 0.014],
            [0.023, y, deep / 2.0 + 0.014],
            [0.001, 0.001],
            Material::metal(Vec3::splat(0.6)),
        );
    }
    body.block([0.0, 1.06, deep / 2.0 - 0.012], [0.07, 0.17, 0.02], 0.005, side).rotate(DVec3::X, -0.2);
    for y in [1.02, 1.06, 1.1] {
        for x in [-0.046, 0.046] {
            body.superellipsoid(
                [x, y, deep / 2.0 - 0.012],
                [0.022, 0.014, 0.014],
                2.0,
                Material::metal(Vec3::splat(0.55)),
            )
            .cell_scale(0.5);
        }
    }
    for string in 0..6 {
        let x = -0.019 + 0.0076 * f64::from(string);
        body.rod(
            [x * 1.2, 0.13, deep / 2.0 + 0.016],
            [x, 0.98, deep / 2.0 + 0.017],
            [0.0007, 0.0007],
            Material::metal(Vec3::splat(0.65)),
        );
    }
    let mut asset = Asset::new("guitar");
    let lean = glam::DQuat::from_rotation_x(-0.2);
    asset.attach(&body, &Placement { rotation: lean, translation: DVec3::new(0.0, 0.13, 0.04) });
    stand(&mut asset, palette);
    asset.scale_cells(0.62).centered()
}

/// Adds the stand.
fn stand(asset: &mut Asset, palette: &Palette) {
    let metal = Material::metal(palette.dark.linear);
    for x in [-1.0, 1.0] {
        asset.rod([x * 0.19, 0.0, 0.2], [x * 0.03, 0.36, -0.09], [0.009, 0.009], metal);
        asset.pipe(&[[x * 0.13, 0.12, 0.1], [x * 0.13, 0.105, 0.16], [x * 0.13, 0.16, 0.19]], 0.009, metal);
    }
    asset.rod([0.0, 0.0, -0.28], [0.0, 0.36, -0.09], [0.009, 0.009], metal);
    asset.rod([-0.13, 0.12, 0.1], [0.13, 0.12, 0.1], [0.008, 0.008], metal);
}
