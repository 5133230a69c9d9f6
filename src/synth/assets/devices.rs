//! Electronic devices and tools.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::NamedColor;
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

const BLACK: Vec3 = Vec3::new(0.012, 0.012, 0.014);

/// A flat television on two feet.
pub(crate) fn television(rng: &mut SceneRng) -> Asset {
    let mut asset = Asset::new("television");
    let width = rng.range(1.05, 1.25);
    let height = width * 0.5625 + 0.02;
    let frame = Material::plain(BLACK * 1.5).gloss(0.5);
    asset.block([0.0, height / 2.0 + 0.06, 0.0], [width, height, 0.04], 0.006, frame);
    let glass = Material::plain(BLACK).gloss(1.0);
    asset
        .block([0.0, height / 2.0 + 0.063, 0.002], [width - 0.02, height - 0.026, 0.04], 0.0, glass)
        .only(faces::FRONT);
    for x in [-0.3, 0.3] {
        asset.block([x * width, 0.006, 0.0], [0.03, 0.012, 0.24], 0.004, frame);
        asset.rod([x * width, 0.01, 0.0], [x * width, 0.07, 0.0], [0.01, 0.01], frame);
    }
    asset.scale_cells(0.9).centered()
}

/// An open laptop.
pub(crate) fn laptop(rng: &mut SceneRng) -> Asset {
    let mut asset = Asset::new("laptop");
    let shell = Material::metal(Vec3::splat(rng.range(0.25, 0.5) as f32));
    let (width, depth) = (0.33, 0.23);
    asset.block([0.0, 0.009, 0.0], [width, 0.016, depth], 0.006, shell);
    let keys = Material::patterned(Pattern::Keys, BLACK * 2.0, Vec3::splat(0.2), 0.019);
    asset.block([0.0, 0.0115, -0.035], [width - 0.04, 0.012, 0.11], 0.0, keys).only(faces::TOP).cell_scale(0.5);
    asset.block([0.0, 0.0112, 0.07], [0.1, 0.012, 0.065], 0.0, Material::plain(Vec3::splat(0.3))).only(faces::TOP);
    let open = 0.26;
    let (y, z) = (0.018 + 0.105 * f64::cos(open), -depth / 2.0 - 0.105 * f64::sin(open) + 0.004);
    asset.block([0.0, y, z], [width, 0.215, 0.008], 0.003, shell).rotate(DVec3::X, -open);
    let page = Material::patterned(Pattern::Screen, Vec3::new(0.75, 0.8, 0.88), Vec3::new(0.12, 0.2, 0.34), 0.1);
    let screen = page.emission(0.8).seeded(rng.seed());
    asset
        .block([0.0, y, z + 0.002], [width - 0.014, 0.2, 0.0075], 0.0, screen)
        .only(faces::FRONT)
        .rotate(DVec3::X, -open);
    asset.scale_cells(0.4).centered()
}

/// A computer monitor on a stand.
pub(crate) fn monitor(rng: &mut SceneRng) -> Asset {
    let mut asset = Asset::new("monitor");
    let (width, height) = (rng.range(0.54, 0.64), 0.34);
    let frame = Material::plain(BLACK * 1.6).gloss(0.4);
    asset.block([0.0, 0.29, 0.0], [width, height, 0.03], 0.005, frame);
    let page = Material::patterned(Pattern::Screen, Vec3::new(0.05, 0.07, 0.11), Vec3::new(0.3, 0.6, 0.75), 0.1);
    let screen = page.emission(0.9).seeded(rng.seed());
    asset
        .block([0.0, 0.29, 0.0015], [width - 0.02, height - 0.02, 0.03], 0.0, screen)
        .only(faces::FRONT)
        .cell_scale(0.8);
    asset.block([0.0, 0.1, -0.03], [0.06, 0.2, 0.018], 0.004, frame);
    asset.block([0.0, 0.006, -0.01], [0.24, 0.012, 0.17], 0.004, frame);
    asset.scale_cells(0.55).centered()
}

/// A keyboard.
pub(crate) fn keyboard() -> Asset {
    let mut asset = Asset::new("keyboard");
    asset.block([0.0, 0.009, 0.0], [0.42, 0.018, 0.13], 0.005, Material::plain(Vec3::splat(0.55)));
    let keys = Material::patterned(Pattern::Keys, Vec3::splat(0.7), Vec3::splat(0.25), 0.019);
    asset.block([0.0, 0.0105, 0.0], [0.4, 0.018, 0.11], 0.0, keys).only(faces::TOP).cell_scale(0.6);
    asset.scale_cells(0.4).centered()
}

/// A table radio.
pub(crate) fn radio(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("radio", color);
    let body = Material::plain(color.linear).gloss(0.4);
    asset.block([0.0, 0.1, 0.0], [0.3, 0.18, 0.12], 0.03, body);
    let cloth = Material::patterned(Pattern::Stripes, Vec3::new(0.5, 0.42, 0.3), Vec3::new(0.25, 0.2, 0.14), 0.008);
    asset.block([-0.05, 0.1, 0.058], [0.15, 0.13, 0.008], 0.003, cloth);
    let brass = Material::metal(Vec3::new(0.55, 0.42, 0.2));
    asset.lathe([0.09, 0.11, 0.06], &[[0.036, 0.0], [0.036, 0.012], [0.0, 0.014]], brass).rotate(DVec3::X, FRAC_PI_2);
    asset.lathe([0.09, 0.05, 0.06], &[[0.014, 0.0], [0.014, 0.014], [0.0, 0.015]], brass).rotate(DVec3::X, FRAC_PI_2);
    asset.pipe(&[[-0.1, 0.185, 0.0], [-0.09, 0.225, 0.0], [0.09, 0.225, 0.0], [0.1, 0.185, 0.0]], 0.007, brass);
    asset.rod([0.12, 0.18, -0.04], [0.17 + rng.range(0.0, 0.05), 0.38, -0.04], [0.003, 0.002], brass);
    asset.scale_cells(0.45).centered()
}

/// A toolbox with a handle.
pub(crate) fn toolbox(color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("toolbox", color);
    let material = Material::plain(color.linear).gloss(0.5);
    let steel = Material::metal(Vec3::splat(0.4));
    asset.block([0.0, 0.085, 0.0], [0.42, 0.17, 0.2], 0.01, material);
    asset.block([0.0, 0.19, 0.0], [0.43, 0.05, 0.21], 0.02, material);
    for x in [-0.13, 0.13] {
        asset.block([x, 0.165, 0.104], [0.03, 0.05, 0.012], 0.003, steel);
    }
    asset.pipe(&[[-0.12, 0.21, 0.0], [-0.1, 0.26, 0.0], [0.1, 0.26, 0.0], [0.12, 0.21, 0.0]], 0.011, steel);
    asset.scale_cells(0.6).centered()
}
