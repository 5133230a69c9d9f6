//! Plants in pots, flowers and branches.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3, Vec3};

use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// Shape of a leaf.
struct Leaf {
    root: DVec3,
    yaw: f64,
    /// Elevation of the leaf at its root, rad.
    lift: f64,
    length: f64,
    width: f64,
    /// Bend of the tip below the direction at the root, rad.
    droop: f64,
}

fn leaf(asset: &mut Asset, shape: &Leaf, material: Material) {
    let Leaf { root, yaw, lift, length, width, droop } = *shape;
    let turn = DQuat::from_rotation_y(yaw);
    let sheet = asset.sheet([width, length], material, move |u, v| {
        // The slope decreases from `lift` by `droop` toward the tip.
        let slope = lift - droop * v * 0.5;
        let along = length * v;
        let half = width / 2.0 * (PI * v.powf(0.8)).sin().max(0.03);
        let across = (u - 0.5) * 2.0 * half;
        let fold = 0.25 * across.abs();
        root + turn * DVec3::new(across, along * slope.sin() + fold * slope.cos(), along * slope.cos())
    });
    sheet.no_shadow();
}

fn green(rng: &mut SceneRng) -> Material {
    let tones = [Vec3::new(0.05, 0.17, 0.05), Vec3::new(0.09, 0.22, 0.07), Vec3::new(0.04, 0.13, 0.06)];
    let tone = rng.pick(&tones) * rng.range(0.8, 1.25) as f32;
    Material::patterned(Pattern::Leaf, tone, tone * 1.9 + Vec3::new(0.02, 0.03, 0.0), 0.05).two_sided().gloss(0.35)
}

/// Adds a pot with soil; returns the height of the soil.
fn pot(asset: &mut Asset, radius: f64, height: f64, color: &NamedColor) -> f64 {
    let clay = Material::plain(color.linear).gloss(0.25);
    let profile = [
        [radius * 0.72, 0.0],
        [radius * 0.96, height * 0.9],
        [radius * 1.04, height * 0.9],
        [radius * 1.04, height],
        [radius * 0.94, height],
        [radius * 0.9, height * 0.9],
    ];
    asset.lathe([0.0; 3], &profile, clay).cell_scale(0.7);
    let soil = Material::patterned(Pattern::Speckle, Vec3::new(0.05, 0.035, 0.025), Vec3::new(0.12, 0.08, 0.05), 0.02);
    asset.lathe([0.0, height * 0.9, 0.0], &[[radius * 0.9, 0.0], [0.0, 0.01]], soil).cell_scale(0.8);
    height * 0.9
}

/// A tall potted plant for the floor: fig, palm or snake plant.
pub(crate) fn potted_plant(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("potted plant", color);
    let (radius, height) = (rng.range(0.16, 0.2), rng.range(0.28, 0.36));
    let soil = pot(&mut asset, radius, height, color);
    let crown = Material::plain(Vec3::ONE);
    for y in [0.35, 0.65, 0.95] {
        asset.superellipsoid([0.0, soil + y * 0.8, 0.0], [0.26, 0.2, 0.26], 2.0, crown).shadow_only();
    }
    match rng.index(3) {
        0 => fig(&mut asset, soil, rng),
        1 => palm(&mut asset, soil, rng),
        _ => snake_plant(&mut asset, [soil, radius, rng.range(0.6, 0.85)], rng),
    }
    asset.centered()
}

fn fig(asset: &mut Asset, soil: f64, rng: &mut SceneRng) {
    let bark = Material::patterned(Pattern::Speckle, Vec3::new(0.16, 0.1, 0.06), Vec3::new(0.28, 0.2, 0.13), 0.03);
    let tall = rng.range(0.85, 1.1);
    for stem in 0..3 {
        let angle = TAU * f64::from(stem) / 3.0 + rng.range(0.0, 1.0);
        let (sin, cos) = angle.sin_cos();
        let reach = tall * rng.range(0.75, 1.05);
        let at = |t: f64| DVec3::new(cos * (0.03 + 0.16 * t * t), soil + reach * t, sin * (0.03 + 0.16 * t * t));
        let points: Vec<[f64; 3]> = [0.0, 0.33, 0.66, 1.0].map(|t| at(t).to_array()).to_vec();
        asset.pipe(&points, 0.011, bark).cell_scale(0.8);
        for k in 0..13 {
            let t = 0.28 + 0.72 * f64::from(k) / 12.0;
            let length = rng.range(0.2, 0.28) * (1.15 - 0.3 * t);
            let yaw = angle + f64::from(k) * 2.4 + rng.range(-0.3, 0.3);
            let lift = rng.range(0.2, 0.9);
            let shape = Leaf { root: at(t), yaw, lift, length, width: length * 0.62, droop: rng.range(0.6, 1.4) };
            leaf(asset, &shape, green(rng));
        }
    }
}

fn palm(asset: &mut Asset, soil: f64, rng: &mut SceneRng) {
    let stalk = Material::plain(Vec3::new(0.1, 0.17, 0.06));
    for k in 0..11 {
        let yaw = TAU * f64::from(k) / 11.0 + rng.range(-0.2, 0.2);
        let (reach, rise) = (rng.range(0.3, 0.5), rng.range(0.65, 1.1));
        let (sin, cos) = yaw.sin_cos();
        let at =
            move |t: f64| DVec3::new(sin * reach * t * t, soil + rise * (t - 0.28 * t * t * t), cos * reach * t * t);
        let points: Vec<[f64; 3]> = [0.0, 0.3, 0.6, 1.0].map(|t| at(t).to_array()).to_vec();
        asset.pipe(&points, 0.006, stalk);
        let material = green(rng);
        for i in 0..9 {
            let t = 0.4 + 0.6 * f64::from(i) / 8.0;
            for side in [-1.0, 1.0] {
                let length = 0.26 * (1.2 - 0.75 * (t - 0.55).abs() * 2.0);
                let turn = yaw + side * rng.range(0.85, 1.15);
                let shape = Leaf { root: at(t), yaw: turn, lift: 0.25, length, width: 0.035, droop: 1.5 };
                leaf(asset, &shape, material);
            }
        }
    }
}

fn snake_plant(asset: &mut Asset, [soil, radius, tall]: [f64; 3], rng: &mut SceneRng) {
    let edge = Vec3::new(0.36, 0.4, 0.12);
    for k in 0..15 {
        let yaw = TAU * f64::from(k) * 0.382;
        let (sin, cos) = yaw.sin_cos();
        let r = radius * 0.62 * (f64::from(k) / 15.0).sqrt();
        let length = tall * rng.range(0.6, 1.05);
        let tone = Vec3::new(0.06, 0.16, 0.07) * rng.range(0.8, 1.3) as f32;
        let material = Material::patterned(Pattern::Leaf, tone, edge * 0.6 + tone * 0.4, 0.05).two_sided().gloss(0.3);
        let root = DVec3::new(sin * r, soil, cos * r);
        let lift = rng.range(1.22, 1.5);
        leaf(asset, &Leaf { root, yaw, lift, length, width: 0.075, droop: rng.range(-0.1, 0.25) }, material);
    }
}

/// A small potted plant.
pub(crate) fn small_plant(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("small plant", color);
    let soil = pot(&mut asset, 0.06, 0.1, color);
    let bush = rng.chance(0.5);
    for k in 0..26 {
        let yaw = f64::from(k) * 2.4;
        let lift = 1.35 - 1.1 * f64::from(k) / 26.0 + rng.range(-0.15, 0.15);
        let length = rng.range(0.09, 0.15);
        let width = if bush { length * 0.5 } else { 0.02 };
        let shape = Leaf { root: DVec3::new(0.0, soil, 0.0), yaw, lift, length, width, droop: rng.range(0.7, 1.6) };
        leaf(&mut asset, &shape, green(rng));
    }
    asset.scale_cells(0.45).centered()
}

/// A cactus with arms.
pub(crate) fn cactus(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::new("cactus");
    let soil = pot(&mut asset, 0.065, 0.1, color);
    let tone = Vec3::new(0.08, 0.2, 0.1);
    let skin = Material::patterned(Pattern::Stripes, tone, tone * 1.5, 0.009);
    let tall = rng.range(0.16, 0.24);
    let column = [[0.032, 0.0], [0.038, tall * 0.5], [0.034, tall * 0.85], [0.018, tall * 0.97], [0.0, tall]];
    asset.smooth_lathe([0.0, soil, 0.0], &column, skin);
    for (side, at) in [(-1.0, 0.4), (1.0, 0.55)] {
        let y = soil + tall * at;
        asset.pipe(&[[side * 0.02, y, 0.0], [side * 0.07, y + 0.005, 0.0], [side * 0.08, y + 0.06, 0.0]], 0.017, skin);
        asset.superellipsoid([side * 0.08, y + 0.062, 0.0], [0.034, 0.03, 0.034], 2.0, skin);
    }
    asset.scale_cells(0.45).centered()
}

/// Adds round flowers on stems in a vase.
pub(super) fn flowers(asset: &mut Asset, base: [f64; 3], palette: &Palette, rng: &mut SceneRng) {
    let stem = Material::plain(Vec3::new(0.08, 0.17, 0.05));
    let root = DVec3::from(base);
    for k in 0..9 {
        let yaw = f64::from(k) * 2.4;
        let (sin, cos) = yaw.sin_cos();
        let (spread, rise) = (rng.range(0.02, 0.12), rng.range(0.12, 0.24));
        let head = root + DVec3::new(sin * spread, rise, cos * spread);
        let bend = root.lerp(head, 0.5) - DVec3::new(sin, 0.0, cos) * spread * 0.25;
        asset.pipe(&[base, bend.to_array(), head.to_array()], 0.0025, stem);
        let color = if k % 3 == 0 { palette.second } else { palette.accent };
        let petal = Material::plain(color.linear * rng.range(0.9, 1.3) as f32).two_sided();
        for p in 0..7 {
            let turn = TAU * f64::from(p) / 7.0;
            let shape = Leaf { root: head, yaw: turn, lift: 0.7, length: 0.035, width: 0.024, droop: 0.9 };
            leaf(asset, &shape, petal);
        }
        asset.superellipsoid(head.to_array(), [0.016, 0.014, 0.016], 2.0, Material::plain(Vec3::new(0.6, 0.4, 0.08)));
        if k % 2 == 0 {
            let shape = Leaf { root: bend, yaw: yaw + 0.8, lift: 0.5, length: 0.09, width: 0.03, droop: 1.0 };
            leaf(asset, &shape, green(rng));
        }
    }
}

/// Adds branches with leaves in a vase.
pub(super) fn branches(asset: &mut Asset, base: [f64; 3], rng: &mut SceneRng) {
    let bark = Material::plain(Vec3::new(0.16, 0.11, 0.07));
    let root = DVec3::from(base);
    for k in 0..5 {
        let yaw = f64::from(k) * 2.4 + rng.range(-0.3, 0.3);
        let (sin, cos) = yaw.sin_cos();
        let (spread, rise) = (rng.range(0.08, 0.2), rng.range(0.22, 0.36));
        let at = |t: f64| root + DVec3::new(sin * spread * t * t, rise * t, cos * spread * t * t);
        asset.pipe(&[base, at(0.5).to_array(), at(1.0).to_array()], 0.003, bark);
        for i in 0..9 {
            let t = 0.25 + 0.75 * f64::from(i) / 8.0;
            let shape =
                Leaf { root: at(t), yaw: yaw + f64::from(i) * 2.2, lift: 0.4, length: 0.07, width: 0.032, droop: 0.8 };
            leaf(asset, &shape, green(rng));
        }
    }
}
