//! Plants in pots, flowers and branches.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3, Vec3};

use super::super::color::{Hue, Palette};
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

/// A leaf to be: root, direction of growth, size, droop and paint.
struct Leaf {
    root: DVec3,
    yaw: f64,
    /// Angle above the horizontal at the root, rad.
    lift: f64,
    length: f64,
    width: f64,
    /// How far the tip bends down, rad.
    droop: f64,
}

fn leaf(model: &mut Model, shape: &Leaf, paint: Paint) {
    let Leaf { root, yaw, lift, length, width, droop } = *shape;
    let turn = DQuat::from_rotation_y(yaw);
    let sheet = model.sheet([width, length], paint, move |u, v| {
        // An arc whose slope falls from `lift` by `droop` toward the tip.
        let slope = lift - droop * v * 0.5;
        let along = length * v;
        let half = width / 2.0 * (PI * v.powf(0.8)).sin().max(0.03);
        let across = (u - 0.5) * 2.0 * half;
        let fold = 0.25 * across.abs();
        root + turn * DVec3::new(across, along * slope.sin() + fold * slope.cos(), along * slope.cos())
    });
    sheet.airy();
}

fn green(dice: &mut Dice) -> Paint {
    let tones = [Vec3::new(0.05, 0.17, 0.05), Vec3::new(0.09, 0.22, 0.07), Vec3::new(0.04, 0.13, 0.06)];
    let tone = dice.pick(tones) * dice.range(0.8, 1.25) as f32;
    Paint::patterned(Pattern::Leaf, tone, tone * 1.9 + Vec3::new(0.02, 0.03, 0.0), 0.05).thin().gloss(0.35)
}

/// A pot with soil; returns the height of the soil.
fn pot(model: &mut Model, radius: f64, height: f64, hue: &Hue) -> f64 {
    let clay = Paint::plain(hue.linear).gloss(0.25);
    let profile = [
        [radius * 0.72, 0.0],
        [radius * 0.96, height * 0.9],
        [radius * 1.04, height * 0.9],
        [radius * 1.04, height],
        [radius * 0.94, height],
        [radius * 0.9, height * 0.9],
    ];
    model.lathe([0.0; 3], &profile, clay).cells(0.7);
    let soil = Paint::patterned(Pattern::Speckle, Vec3::new(0.05, 0.035, 0.025), Vec3::new(0.12, 0.08, 0.05), 0.02);
    model.lathe([0.0, height * 0.9, 0.0], &[[radius * 0.9, 0.0], [0.0, 0.01]], soil).cells(0.8);
    height * 0.9
}

/// A tall plant in a pot on the floor: fig, palm or snake plant.
pub(in super::super) fn potted_plant(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::colored("potted plant", hue);
    let (radius, height) = (dice.range(0.16, 0.2), dice.range(0.28, 0.36));
    let soil = pot(&mut model, radius, height, hue);
    let crown = Paint::plain(Vec3::ONE);
    for y in [0.35, 0.65, 0.95] {
        model.pillow([0.0, soil + y * 0.8, 0.0], [0.26, 0.2, 0.26], 2.0, crown).ghost();
    }
    match dice.index(3) {
        0 => fig(&mut model, soil, dice),
        1 => palm(&mut model, soil, dice),
        _ => snake_plant(&mut model, [soil, radius, dice.range(0.6, 0.85)], dice),
    }
    model.centered()
}

fn fig(model: &mut Model, soil: f64, dice: &mut Dice) {
    let bark = Paint::patterned(Pattern::Speckle, Vec3::new(0.16, 0.1, 0.06), Vec3::new(0.28, 0.2, 0.13), 0.03);
    let tall = dice.range(0.85, 1.1);
    for stem in 0..3 {
        let angle = TAU * f64::from(stem) / 3.0 + dice.range(0.0, 1.0);
        let (sin, cos) = angle.sin_cos();
        let reach = tall * dice.range(0.75, 1.05);
        let at = |t: f64| DVec3::new(cos * (0.03 + 0.16 * t * t), soil + reach * t, sin * (0.03 + 0.16 * t * t));
        let points: Vec<[f64; 3]> = [0.0, 0.33, 0.66, 1.0].map(|t| at(t).to_array()).to_vec();
        model.pipe(&points, 0.011, bark).cells(0.8);
        for k in 0..13 {
            let t = 0.28 + 0.72 * f64::from(k) / 12.0;
            let length = dice.range(0.2, 0.28) * (1.15 - 0.3 * t);
            let yaw = angle + f64::from(k) * 2.4 + dice.range(-0.3, 0.3);
            let lift = dice.range(0.2, 0.9);
            let shape = Leaf { root: at(t), yaw, lift, length, width: length * 0.62, droop: dice.range(0.6, 1.4) };
            leaf(model, &shape, green(dice));
        }
    }
}

fn palm(model: &mut Model, soil: f64, dice: &mut Dice) {
    let stalk = Paint::plain(Vec3::new(0.1, 0.17, 0.06));
    for k in 0..11 {
        let yaw = TAU * f64::from(k) / 11.0 + dice.range(-0.2, 0.2);
        let (reach, rise) = (dice.range(0.3, 0.5), dice.range(0.65, 1.1));
        let (sin, cos) = yaw.sin_cos();
        let at =
            move |t: f64| DVec3::new(sin * reach * t * t, soil + rise * (t - 0.28 * t * t * t), cos * reach * t * t);
        let points: Vec<[f64; 3]> = [0.0, 0.3, 0.6, 1.0].map(|t| at(t).to_array()).to_vec();
        model.pipe(&points, 0.006, stalk);
        let paint = green(dice);
        for i in 0..9 {
            let t = 0.4 + 0.6 * f64::from(i) / 8.0;
            for side in [-1.0, 1.0] {
                let length = 0.26 * (1.2 - 0.75 * (t - 0.55).abs() * 2.0);
                let turn = yaw + side * dice.range(0.85, 1.15);
                let shape = Leaf { root: at(t), yaw: turn, lift: 0.25, length, width: 0.035, droop: 1.5 };
                leaf(model, &shape, paint);
            }
        }
    }
}

fn snake_plant(model: &mut Model, [soil, radius, tall]: [f64; 3], dice: &mut Dice) {
    let edge = Vec3::new(0.36, 0.4, 0.12);
    for k in 0..15 {
        let yaw = TAU * f64::from(k) * 0.382;
        let (sin, cos) = yaw.sin_cos();
        let r = radius * 0.62 * (f64::from(k) / 15.0).sqrt();
        let length = tall * dice.range(0.6, 1.05);
        let tone = Vec3::new(0.06, 0.16, 0.07) * dice.range(0.8, 1.3) as f32;
        let paint = Paint::patterned(Pattern::Leaf, tone, edge * 0.6 + tone * 0.4, 0.05).thin().gloss(0.3);
        let root = DVec3::new(sin * r, soil, cos * r);
        let lift = dice.range(1.22, 1.5);
        leaf(model, &Leaf { root, yaw, lift, length, width: 0.075, droop: dice.range(-0.1, 0.25) }, paint);
    }
}

/// A small plant for tables and sills.
pub(in super::super) fn small_plant(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::colored("small plant", hue);
    let soil = pot(&mut model, 0.06, 0.1, hue);
    let bush = dice.chance(0.5);
    for k in 0..26 {
        let yaw = f64::from(k) * 2.4;
        let lift = 1.35 - 1.1 * f64::from(k) / 26.0 + dice.range(-0.15, 0.15);
        let length = dice.range(0.09, 0.15);
        let width = if bush { length * 0.5 } else { 0.02 };
        let shape = Leaf { root: DVec3::new(0.0, soil, 0.0), yaw, lift, length, width, droop: dice.range(0.7, 1.6) };
        leaf(&mut model, &shape, green(dice));
    }
    model.fine(0.45).centered()
}

/// A cactus with arms.
pub(in super::super) fn cactus(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::new("cactus");
    let soil = pot(&mut model, 0.065, 0.1, hue);
    let tone = Vec3::new(0.08, 0.2, 0.1);
    let skin = Paint::patterned(Pattern::Stripes, tone, tone * 1.5, 0.009);
    let tall = dice.range(0.16, 0.24);
    let column = [[0.032, 0.0], [0.038, tall * 0.5], [0.034, tall * 0.85], [0.018, tall * 0.97], [0.0, tall]];
    model.turned([0.0, soil, 0.0], &column, skin);
    for (side, at) in [(-1.0, 0.4), (1.0, 0.55)] {
        let y = soil + tall * at;
        model.pipe(&[[side * 0.02, y, 0.0], [side * 0.07, y + 0.005, 0.0], [side * 0.08, y + 0.06, 0.0]], 0.017, skin);
        model.pillow([side * 0.08, y + 0.062, 0.0], [0.034, 0.03, 0.034], 2.0, skin);
    }
    model.fine(0.45).centered()
}

/// Round blossoms on stems out of a vase.
pub(super) fn flowers(model: &mut Model, base: [f64; 3], palette: &Palette, dice: &mut Dice) {
    let stem = Paint::plain(Vec3::new(0.08, 0.17, 0.05));
    let root = DVec3::from(base);
    for k in 0..9 {
        let yaw = f64::from(k) * 2.4;
        let (sin, cos) = yaw.sin_cos();
        let (spread, rise) = (dice.range(0.02, 0.12), dice.range(0.12, 0.24));
        let head = root + DVec3::new(sin * spread, rise, cos * spread);
        let bend = root.lerp(head, 0.5) - DVec3::new(sin, 0.0, cos) * spread * 0.25;
        model.pipe(&[base, bend.to_array(), head.to_array()], 0.0025, stem);
        let hue = if k % 3 == 0 { palette.second } else { palette.accent };
        let petal = Paint::plain(hue.linear * dice.range(0.9, 1.3) as f32).thin();
        for p in 0..7 {
            let turn = TAU * f64::from(p) / 7.0;
            let shape = Leaf { root: head, yaw: turn, lift: 0.7, length: 0.035, width: 0.024, droop: 0.9 };
            leaf(model, &shape, petal);
        }
        model.pillow(head.to_array(), [0.016, 0.014, 0.016], 2.0, Paint::plain(Vec3::new(0.6, 0.4, 0.08)));
        if k % 2 == 0 {
            let shape = Leaf { root: bend, yaw: yaw + 0.8, lift: 0.5, length: 0.09, width: 0.03, droop: 1.0 };
            leaf(model, &shape, green(dice));
        }
    }
}

/// Leafy branches out of a vase.
pub(super) fn branches(model: &mut Model, base: [f64; 3], dice: &mut Dice) {
    let bark = Paint::plain(Vec3::new(0.16, 0.11, 0.07));
    let root = DVec3::from(base);
    for k in 0..5 {
        let yaw = f64::from(k) * 2.4 + dice.range(-0.3, 0.3);
        let (sin, cos) = yaw.sin_cos();
        let (spread, rise) = (dice.range(0.08, 0.2), dice.range(0.22, 0.36));
        let at = |t: f64| root + DVec3::new(sin * spread * t * t, rise * t, cos * spread * t * t);
        model.pipe(&[base, at(0.5).to_array(), at(1.0).to_array()], 0.003, bark);
        for i in 0..9 {
            let t = 0.25 + 0.75 * f64::from(i) / 8.0;
            let shape =
                Leaf { root: at(t), yaw: yaw + f64::from(i) * 2.2, lift: 0.4, length: 0.07, width: 0.032, droop: 0.8 };
            leaf(model, &shape, green(dice));
        }
    }
}
