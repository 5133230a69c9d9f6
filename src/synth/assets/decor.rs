//! Decoration.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};

use super::plants;
use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A vase, often with branches or flowers in it.
pub(crate) fn vase(rng: &mut SceneRng, color: &NamedColor, palette: &Palette) -> Asset {
    let mut asset = Asset::colored("vase", color);
    let height = rng.range(0.2, 0.3);
    let w = rng.range(0.06, 0.085);
    let profile = match rng.index(3) {
        0 => vec![
            [w * 0.6, 0.0],
            [w, height * 0.4],
            [w * 0.75, height * 0.7],
            [w * 0.36, height * 0.86],
            [w * 0.5, height],
        ],
        1 => vec![
            [w * 0.45, 0.0],
            [w * 0.7, height * 0.3],
            [w, height * 0.72],
            [w * 0.7, height * 0.93],
            [w * 0.74, height],
        ],
        _ => vec![
            [w * 0.8, 0.0],
            [w * 0.9, height * 0.2],
            [w * 0.4, height * 0.55],
            [w * 0.3, height * 0.8],
            [w * 0.6, height],
        ],
    };
    asset.smooth_lathe([0.0; 3], &profile, Material::plain(color.linear).gloss(0.7));
    let base = [0.0, height * 0.9, 0.0];
    match rng.index(3) {
        0 => plants::flowers(&mut asset, base, palette, rng),
        1 => plants::branches(&mut asset, base, rng),
        _ => {}
    }
    asset.scale_cells(0.5).centered()
}

/// A sculpture on a plinth, called by what it looks like: a knot, stacked stones, or a head.
pub(crate) fn sculpture(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let shape = rng.index(3);
    let mut asset =
        Asset::new(["wooden knot sculpture", "white stacked stone sculpture", "white bust sculpture"][shape]);
    let stone = Material::patterned(Pattern::Marble, Vec3::splat(0.78), Vec3::splat(0.45), 0.2).gloss(0.4);
    let bronze = Material::metal(Vec3::new(0.3, 0.18, 0.08));
    let base = Material::plain(palette.dark.linear * 1.5).gloss(0.3);
    asset.block([0.0, 0.02, 0.0], [0.16, 0.04, 0.16], 0.004, base);
    match shape {
        0 => loops(&mut asset, bronze),
        1 => {
            let mut y = 0.04;
            for i in 0..4 {
                let size = 0.15 - 0.026 * f64::from(i);
                let at = [rng.range(-0.012, 0.012), y + size * 0.3, rng.range(-0.012, 0.012)];
                asset.superellipsoid(at, [size * 1.25, size * 0.6, size], 2.3, stone.seeded(rng.seed()));
                y += size * 0.58;
            }
        }
        _ => head(&mut asset, stone),
    }
    asset.scale_cells(0.4).centered()
}

/// Adds a trefoil knot.
fn loops(asset: &mut Asset, material: Material) {
    let point = |k: u32| {
        let t = TAU * f64::from(k) / 36.0;
        let flat = [t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos()];
        [flat[0] * 0.045, 0.19 + flat[1] * 0.045, -(3.0 * t).sin() * 0.04]
    };
    let points: Vec<[f64; 3]> = (0..=36).map(point).collect();
    asset.pipe(&points, 0.016, material);
    asset.rod([0.0, 0.04, 0.0], [0.0, 0.1, 0.0], [0.01, 0.01], material);
}

/// Adds a bust: shoulders, neck, head.
fn head(asset: &mut Asset, material: Material) {
    let shoulders = [[0.05, 0.04], [0.1, 0.09], [0.09, 0.13], [0.04, 0.16], [0.036, 0.2]];
    asset.smooth_lathe([0.0; 3], &shoulders, material);
    asset.superellipsoid([0.0, 0.275, 0.005], [0.125, 0.18, 0.15], 2.2, material);
    asset.superellipsoid([0.0, 0.265, 0.082], [0.024, 0.05, 0.03], 2.0, material);
    asset.superellipsoid([0.0, 0.215, 0.06], [0.06, 0.04, 0.05], 2.0, material);
    asset.superellipsoid([0.0, 0.315, -0.015], [0.14, 0.12, 0.15], 2.4, material.seeded(3));
    for x in [-0.063, 0.063] {
        asset.superellipsoid([x, 0.27, 0.0], [0.014, 0.05, 0.03], 2.0, material);
    }
}

/// A terrestrial globe on a foot.
pub(crate) fn globe(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("globe");
    let brass = Material::metal(Vec3::new(0.52, 0.37, 0.15));
    let radius = rng.range(0.11, 0.14);
    let middle = radius + 0.1;
    asset.smooth_lathe(
        [0.0; 3],
        &[[0.09, 0.0], [0.085, 0.015], [0.02, 0.03], [0.014, 0.07]],
        Material::wood(palette.wood.linear, 3),
    );
    let sea =
        Material::patterned(Pattern::Globe, Vec3::new(0.09, 0.22, 0.3), Vec3::new(0.5, 0.42, 0.22), 0.07).gloss(0.4);
    asset.superellipsoid([0.0, middle, 0.0], [radius * 2.0, radius * 2.0, radius * 2.0], 2.0, sea.seeded(rng.seed()));
    let arc: Vec<[f64; 3]> = (0..=12)
        .map(|k| {
            let t = PI * f64::from(k) / 12.0 - 0.4;
            [(radius + 0.014) * t.sin(), middle + (radius + 0.014) * -t.cos(), 0.0]
        })
        .collect();
    asset.pipe(&arc, 0.005, brass);
    asset.scale_cells(0.5).centered()
}

/// An easel with a painting on it.
pub(crate) fn easel(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("easel");
    let wood = Material::wood(palette.wood.linear * 1.1, rng.seed());
    let lean = 0.16;
    for x in [-1.0, 1.0] {
        asset.rod([x * 0.34, 0.0, 0.22], [x * 0.07, 1.7, 0.22 - 1.7 * lean], [0.017, 0.015], wood);
    }
    asset.rod([0.0, 0.0, -0.5], [0.0, 1.6, -0.04], [0.016, 0.014], wood);
    asset.rod([-0.24, 0.72, 0.13], [0.24, 0.72, 0.13], [0.016, 0.016], wood);
    let (width, height) = (rng.range(0.6, 0.75), rng.range(0.7, 0.85));
    let pattern = rng.pick(&[Pattern::PictureHills, Pattern::PictureShapes, Pattern::PictureStem]);
    let canvas = Material::patterned(pattern, palette.main.linear, palette.accent.linear, 0.1).seeded(rng.seed());
    let y = 0.76 + height / 2.0;
    let side = Material::plain(Vec3::splat(0.7));
    asset
        .block([0.0, y, 0.13 - (y - 0.72) * lean], [width, height, 0.028], 0.002, side)
        .only(faces::BACK | faces::SIDES)
        .rotate(DVec3::X, -lean);
    asset
        .block([0.0, y, 0.132 - (y - 0.72) * lean], [width, height, 0.028], 0.0, canvas)
        .only(faces::FRONT)
        .cell_scale(0.6)
        .rotate(DVec3::X, -lean);
    asset.centered()
}

/// A small telescope on a tripod.
pub(crate) fn telescope(palette: &Palette) -> Asset {
    let mut asset = Asset::new("telescope");
    let wood = Material::wood(palette.wood.linear, 8);
    let brass = Material::metal(Vec3::new(0.55, 0.4, 0.17));
    for i in 0..3 {
        let (sin, cos) = (TAU * f64::from(i) / 3.0 + 0.5).sin_cos();
        asset.rod([0.38 * cos, 0.0, 0.38 * sin], [0.03 * cos, 1.08, 0.03 * sin], [0.014, 0.018], wood);
    }
    asset.rod([0.0, 1.04, 0.0], [0.0, 1.18, 0.0], [0.03, 0.03], brass);
    asset.rod(
        [-0.02, 1.04, -0.42],
        [0.02, 1.38, 0.42],
        [0.035, 0.045],
        Material::plain(palette.light.linear).gloss(0.5),
    );
    for (t, radius) in [(0.0, 0.038), (0.5, 0.045), (1.0, 0.052)] {
        let at = |s: f64| [-0.02 + 0.04 * s, 1.04 + 0.34 * s, -0.42 + 0.84 * s];
        asset.rod(at(t - 0.03), at(t + 0.03), [radius, radius], brass);
    }
    asset.rod([-0.025, 1.0, -0.52], [-0.02, 1.04, -0.42], [0.018, 0.02], brass);
    asset.scale_cells(0.7).centered()
}
