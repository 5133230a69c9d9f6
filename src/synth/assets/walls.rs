//! Objects that hang on walls. The back is at -z.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A framed picture of a given size.
pub(crate) fn picture(rng: &mut SceneRng, palette: &Palette, size: [f64; 2]) -> Asset {
    let mut asset = Asset::new("picture");
    let pattern =
        rng.pick(&[Pattern::PictureHills, Pattern::PictureShapes, Pattern::PictureStem, Pattern::PictureHills]);
    let [width, height] = size;
    let frame = if rng.chance(0.5) {
        Material::plain(palette.dark.linear)
    } else {
        Material::wood(palette.wood.linear, rng.seed())
    };
    let bar = 0.028;
    for side in [-1.0, 1.0] {
        asset
            .block([side * (width / 2.0 - bar / 2.0), height / 2.0, 0.0], [bar, height, 0.03], 0.004, frame)
            .cell_scale(0.6);
        asset
            .block(
                [0.0, height / 2.0 + side * (height / 2.0 - bar / 2.0), 0.0],
                [width - 2.0 * bar, bar, 0.03],
                0.004,
                frame,
            )
            .cell_scale(0.6);
    }
    let mat = Material::plain(Vec3::new(0.8, 0.77, 0.7));
    asset.block([0.0, height / 2.0, -0.004], [width - 0.02, height - 0.02, 0.02], 0.0, mat).only(faces::FRONT);
    let margin = if rng.chance(0.6) { 0.16 * width.min(height) } else { bar };
    let inks = Material::patterned(pattern, palette.main.linear, palette.accent.linear, 0.1).seeded(rng.seed());
    let face = [width - 2.0 * margin, height - 2.0 * margin, 0.024];
    asset.block([0.0, height / 2.0, -0.004], face, 0.0, inks).only(faces::FRONT).cell_scale(0.5);
    asset.scale_cells(0.8).centered()
}

/// A wall clock.
pub(crate) fn clock(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("clock");
    let r = rng.range(0.15, 0.2);
    let rim = if rng.chance(0.5) {
        Material::metal(Vec3::new(0.5, 0.36, 0.16))
    } else {
        Material::plain(palette.dark.linear).gloss(0.4)
    };
    let profile = [[r, 0.0], [r, 0.03], [r * 0.97, 0.036], [r * 0.92, 0.03]];
    asset.lathe([0.0, r, -0.02], &profile, rim).rotate(DVec3::X, TAU / 4.0).cell_scale(0.5).no_shadow();
    let face = Material::patterned(Pattern::Clock, Vec3::splat(0.82), Vec3::splat(0.02), 0.1);
    let disc = move |u: f64, v: f64| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        // Elliptical mapping of the square onto the disc, which preserves both axes.
        let at = DVec3::new(x * (1.0 - y * y / 2.0).sqrt(), y * (1.0 - x * x / 2.0).sqrt(), 0.0);
        DVec3::new(at.x * r * 0.95, r + at.y * r * 0.95, 0.0)
    };
    asset.sheet([2.0 * r, 2.0 * r], face, disc).cell_scale(0.4);
    asset.scale_cells(0.9).centered()
}

/// A round mirror with a brass rim, rendered as gray glass.
pub(crate) fn mirror(rng: &mut SceneRng) -> Asset {
    let mut asset = Asset::new("mirror");
    let r = rng.range(0.3, 0.38);
    let brass = Material::metal(Vec3::new(0.52, 0.38, 0.16));
    asset
        .lathe([0.0, r, -0.012], &[[r, 0.0], [r, 0.024], [r * 0.95, 0.024]], brass)
        .rotate(DVec3::X, TAU / 4.0)
        .cell_scale(0.6)
        .no_shadow();
    let glass = Material::plain(Vec3::new(0.42, 0.45, 0.47)).gloss(1.0);
    asset.lathe([0.0, r, 0.0], &[[r * 0.97, 0.0], [0.0, 0.0]], glass).rotate(DVec3::X, TAU / 4.0);
    asset.centered()
}

/// A panel with hanging tools.
pub(crate) fn tool_wall(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::new("tool wall");
    let (width, height) = (1.4, 0.8);
    let board = Material::plain(color.linear * 0.8);
    asset.block([0.0, height / 2.0, 0.0], [width, height, 0.02], 0.004, board);
    let (steel, grip) = (Material::metal(Vec3::splat(0.35)), Material::plain(Vec3::new(0.5, 0.1, 0.03)).gloss(0.3));
    let wood = Material::wood(Vec3::new(0.4, 0.22, 0.09), 4);
    for i in 0..8 {
        let x = -0.58 + 0.165 * f64::from(i);
        let y = 0.62 + rng.range(-0.04, 0.04);
        match i % 4 {
            0 => {
                asset.rod([x, y, 0.03], [x, y - 0.3, 0.03], [0.012, 0.015], wood);
                asset.block([x, y, 0.035], [0.12, 0.035, 0.035], 0.006, steel);
            }
            1 => {
                asset.rod([x, y, 0.025], [x, y - 0.12, 0.025], [0.016, 0.014], grip);
                asset.rod([x, y - 0.12, 0.025], [x, y - 0.28, 0.025], [0.005, 0.004], steel);
            }
            2 => {
                asset.block([x, y - 0.14, 0.022], [0.1, 0.3, 0.004], 0.0, steel).rotate(DVec3::Z, 0.1);
                asset.block([x, y + 0.04, 0.024], [0.09, 0.07, 0.025], 0.01, wood);
            }
            _ => {
                asset.pipe(&[[x - 0.02, y - 0.25, 0.025], [x, y - 0.08, 0.025], [x + 0.03, y, 0.025]], 0.009, grip);
                asset.pipe(&[[x + 0.02, y - 0.25, 0.03], [x, y - 0.08, 0.03], [x - 0.03, y, 0.03]], 0.009, grip);
            }
        }
    }
    asset.scale_cells(0.7).centered()
}
