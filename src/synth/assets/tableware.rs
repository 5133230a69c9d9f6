//! Tableware.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::NamedColor;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A bottle of wine or a stoneware flask.
pub(crate) fn bottle(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("bottle", color);
    let (r, h) = (rng.range(0.034, 0.042), rng.range(0.25, 0.31));
    let glass = Material::plain(color.linear * 0.55).gloss(1.0);
    let profile = [
        [r * 0.9, 0.0],
        [r, 0.012],
        [r, h * 0.56],
        [r * 0.86, h * 0.66],
        [r * 0.4, h * 0.76],
        [r * 0.34, h * 0.96],
        [r * 0.4, h],
    ];
    asset.lathe([0.0; 3], &profile, glass);
    asset.lathe([0.0, h, 0.0], &[[r * 0.4, 0.0], [0.0, 0.0]], Material::plain(Vec3::new(0.3, 0.2, 0.1)));
    let label = Material::plain(Vec3::new(0.75, 0.7, 0.6));
    asset.lathe([0.0, h * 0.16, 0.0], &[[r * 1.015, 0.0], [r * 1.015, h * 0.28]], label);
    asset.lathe([0.0, h * 0.86, 0.0], &[[r * 0.4, 0.0], [r * 0.41, h * 0.13]], Material::plain(color.linear * 0.3));
    asset.scale_cells(0.34).centered()
}

/// A mug with a handle.
pub(crate) fn mug(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("mug", color);
    let (r, h) = (rng.range(0.038, 0.044), rng.range(0.088, 0.102));
    let glaze = Material::plain(color.linear).gloss(0.7);
    asset.lathe([0.0; 3], &[[r * 0.86, 0.0], [r, 0.012], [r, h], [r * 0.92, h]], glaze);
    asset.lathe([0.0; 3], &[[r * 0.92, h], [r * 0.9, h * 0.82]], Material::plain(Vec3::splat(0.75)).gloss(0.4));
    asset.lathe(
        [0.0, h * 0.82, 0.0],
        &[[r * 0.9, 0.0], [0.0, 0.0]],
        Material::plain(Vec3::new(0.08, 0.04, 0.02)).gloss(0.8),
    );
    let handle =
        [[r * 0.95, h * 0.82, 0.0], [r + 0.026, h * 0.78, 0.0], [r + 0.03, h * 0.45, 0.0], [r * 0.95, h * 0.24, 0.0]];
    asset.pipe(&handle, 0.0055, glaze);
    asset.scale_cells(0.3).centered()
}

/// A bowl of fruit.
pub(crate) fn fruit_bowl(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("bowl of fruit", color);
    let (r, h) = (rng.range(0.14, 0.17), rng.range(0.08, 0.1));
    let glaze = Material::plain(color.linear).gloss(0.6);
    asset.smooth_lathe([0.0; 3], &[[r * 0.42, 0.0], [r * 0.5, 0.012], [r * 0.86, h * 0.55], [r, h]], glaze);
    asset.smooth_lathe([0.0; 3], &[[r, h], [r * 0.84, h * 0.56], [r * 0.4, 0.02], [0.0, 0.016]], glaze);
    let skins = [
        Vec3::new(0.75, 0.32, 0.04),
        Vec3::new(0.55, 0.06, 0.04),
        Vec3::new(0.4, 0.5, 0.08),
        Vec3::new(0.8, 0.6, 0.08),
    ];
    for k in 0..6 {
        let (sin, cos) = (TAU * f64::from(k) / 6.0 + 0.2).sin_cos();
        let size = rng.range(0.068, 0.08);
        fruit(&mut asset, DVec3::new(cos * r * 0.56, h * 0.72, sin * r * 0.56), size, skins[k as usize % 4]);
    }
    for k in 0..3 {
        let (sin, cos) = (TAU * f64::from(k) / 3.0 + 0.6).sin_cos();
        fruit(
            &mut asset,
            DVec3::new(cos * 0.042, h * 1.28, sin * 0.042),
            0.076,
            skins[(k as usize + rng.index(4)) % 4],
        );
    }
    asset.scale_cells(0.38).centered()
}

/// Adds one fruit with its stem.
fn fruit(asset: &mut Asset, at: DVec3, size: f64, skin: Vec3) {
    let material =
        Material::patterned(Pattern::Speckle, skin, skin * 0.8 + 0.03, 0.02).gloss(0.5).seeded(at.x.to_bits() as u32);
    asset.superellipsoid(at.to_array(), [size, size * 0.94, size], 2.0, material);
    let top = at + DVec3::Y * size * 0.44;
    asset.rod(
        top.to_array(),
        (top + DVec3::new(0.004, 0.014, 0.0)).to_array(),
        [0.002, 0.0025],
        Material::plain(Vec3::new(0.1, 0.06, 0.03)),
    );
}

/// A teapot with spout, handle and lid.
pub(crate) fn teapot(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("teapot", color);
    let glaze = Material::plain(color.linear).gloss(0.8);
    let r = rng.range(0.075, 0.09);
    let h = r * 1.35;
    asset.smooth_lathe(
        [0.0; 3],
        &[[r * 0.6, 0.0], [r * 0.94, h * 0.28], [r, h * 0.52], [r * 0.8, h * 0.86], [r * 0.5, h]],
        glaze,
    );
    asset.smooth_lathe([0.0, h, 0.0], &[[r * 0.54, -0.002], [r * 0.4, r * 0.16], [r * 0.1, r * 0.26]], glaze);
    asset.superellipsoid([0.0, h + r * 0.36, 0.0], [r * 0.28, r * 0.24, r * 0.28], 2.0, glaze);
    let spout =
        [[r * 0.8, h * 0.32, 0.0], [r * 1.3, h * 0.5, 0.0], [r * 1.45, h * 0.85, 0.0], [r * 1.72, h * 1.0, 0.0]];
    asset.pipe(&spout, r * 0.15, glaze);
    let handle =
        [[-r * 0.8, h * 0.84, 0.0], [-r * 1.4, h * 0.92, 0.0], [-r * 1.6, h * 0.5, 0.0], [-r * 0.9, h * 0.24, 0.0]];
    asset.pipe(&handle, r * 0.09, glaze);
    asset.scale_cells(0.34).centered()
}

/// A plate with pastries.
pub(crate) fn plate(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("plate", color);
    let r = rng.range(0.11, 0.13);
    let glaze = Material::plain(color.linear).gloss(0.6);
    asset.smooth_lathe([0.0; 3], &[[r * 0.6, 0.0], [r * 0.75, 0.008], [r, 0.02]], glaze);
    asset.smooth_lathe([0.0; 3], &[[r, 0.021], [r * 0.75, 0.012], [r * 0.6, 0.008], [0.0, 0.007]], glaze);
    let crust = Material::patterned(Pattern::Speckle, Vec3::new(0.5, 0.26, 0.09), Vec3::new(0.3, 0.13, 0.04), 0.02);
    for k in 0..3 {
        let (sin, cos) = (TAU * f64::from(k) / 3.0).sin_cos();
        asset.superellipsoid([cos * r * 0.3, 0.03, sin * r * 0.3], [0.07, 0.046, 0.07], 2.2, crust.seeded(k as u32));
    }
    asset.scale_cells(0.36).centered()
}

/// A wine glass, partly filled.
pub(crate) fn wine_glass(rng: &mut SceneRng) -> Asset {
    let mut asset = Asset::new("wine glass");
    let glass = Material::plain(Vec3::splat(0.8)).gloss(1.0).opacity(0.22);
    let stem = Material::plain(Vec3::splat(0.7)).gloss(1.0).opacity(0.5);
    let h = rng.range(0.18, 0.21);
    asset.smooth_lathe([0.0; 3], &[[0.034, 0.0], [0.03, 0.004], [0.005, 0.012], [0.0045, h * 0.45]], stem);
    asset.smooth_lathe([0.0; 3], &[[0.006, h * 0.45], [0.034, h * 0.58], [0.038, h * 0.78], [0.03, h]], glass);
    let wine = Material::plain(Vec3::new(0.2, 0.015, 0.03)).gloss(0.8);
    asset.smooth_lathe([0.0; 3], &[[0.004, h * 0.46], [0.032, h * 0.58], [0.0345, h * 0.68], [0.0, h * 0.68]], wine);
    asset.scale_cells(0.3).centered()
}
