//! Screens and machines.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, Vec3};

use super::super::color::Hue;
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

const BLACK: Vec3 = Vec3::new(0.012, 0.012, 0.014);

/// A flat television on two feet.
pub(in super::super) fn television(dice: &mut Dice) -> Model {
    let mut model = Model::new("television");
    let width = dice.range(1.05, 1.25);
    let height = width * 0.5625 + 0.02;
    let frame = Paint::plain(BLACK * 1.5).gloss(0.5);
    model.block([0.0, height / 2.0 + 0.06, 0.0], [width, height, 0.04], 0.006, frame);
    let glass = Paint::plain(BLACK).gloss(1.0);
    model.block([0.0, height / 2.0 + 0.063, 0.002], [width - 0.02, height - 0.026, 0.04], 0.0, glass).only(0b10_0000);
    for x in [-0.3, 0.3] {
        model.block([x * width, 0.006, 0.0], [0.03, 0.012, 0.24], 0.004, frame);
        model.rod([x * width, 0.01, 0.0], [x * width, 0.07, 0.0], [0.01, 0.01], frame);
    }
    model.fine(0.9).centered()
}

/// An open laptop.
pub(in super::super) fn laptop(dice: &mut Dice) -> Model {
    let mut model = Model::new("laptop");
    let shell = Paint::metal(Vec3::splat(dice.range(0.25, 0.5) as f32));
    let (width, depth) = (0.33, 0.23);
    model.block([0.0, 0.009, 0.0], [width, 0.016, depth], 0.006, shell);
    let keys = Paint::patterned(Pattern::Keys, BLACK * 2.0, Vec3::splat(0.2), 0.019);
    model.block([0.0, 0.0115, -0.035], [width - 0.04, 0.012, 0.11], 0.0, keys).only(0b00_1000).cells(0.5);
    model.block([0.0, 0.0112, 0.07], [0.1, 0.012, 0.065], 0.0, Paint::plain(Vec3::splat(0.3))).only(0b00_1000);
    let open = 0.26;
    let (y, z) = (0.018 + 0.105 * f64::cos(open), -depth / 2.0 - 0.105 * f64::sin(open) + 0.004);
    model.block([0.0, y, z], [width, 0.215, 0.008], 0.003, shell).turn(DVec3::X, -open);
    let page = Paint::patterned(Pattern::Screen, Vec3::new(0.75, 0.8, 0.88), Vec3::new(0.12, 0.2, 0.34), 0.1);
    let screen = page.glow(0.8).seeded(dice.seed());
    model.block([0.0, y, z + 0.002], [width - 0.014, 0.2, 0.0075], 0.0, screen).only(0b10_0000).turn(DVec3::X, -open);
    model.fine(0.4).centered()
}

/// A computer monitor on a stand.
pub(in super::super) fn monitor(dice: &mut Dice) -> Model {
    let mut model = Model::new("monitor");
    let (width, height) = (dice.range(0.54, 0.64), 0.34);
    let frame = Paint::plain(BLACK * 1.6).gloss(0.4);
    model.block([0.0, 0.29, 0.0], [width, height, 0.03], 0.005, frame);
    let page = Paint::patterned(Pattern::Screen, Vec3::new(0.05, 0.07, 0.11), Vec3::new(0.3, 0.6, 0.75), 0.1);
    let screen = page.glow(0.9).seeded(dice.seed());
    model.block([0.0, 0.29, 0.0015], [width - 0.02, height - 0.02, 0.03], 0.0, screen).only(0b10_0000).cells(0.8);
    model.block([0.0, 0.1, -0.03], [0.06, 0.2, 0.018], 0.004, frame);
    model.block([0.0, 0.006, -0.01], [0.24, 0.012, 0.17], 0.004, frame);
    model.fine(0.55).centered()
}

/// A keyboard.
pub(in super::super) fn keyboard() -> Model {
    let mut model = Model::new("keyboard");
    model.block([0.0, 0.009, 0.0], [0.42, 0.018, 0.13], 0.005, Paint::plain(Vec3::splat(0.55)));
    let keys = Paint::patterned(Pattern::Keys, Vec3::splat(0.7), Vec3::splat(0.25), 0.019);
    model.block([0.0, 0.0105, 0.0], [0.4, 0.018, 0.11], 0.0, keys).only(0b00_1000).cells(0.6);
    model.fine(0.4).centered()
}

/// A table radio.
pub(in super::super) fn radio(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::colored("radio", hue);
    let body = Paint::plain(hue.linear).gloss(0.4);
    model.block([0.0, 0.1, 0.0], [0.3, 0.18, 0.12], 0.03, body);
    let cloth = Paint::patterned(Pattern::Stripes, Vec3::new(0.5, 0.42, 0.3), Vec3::new(0.25, 0.2, 0.14), 0.008);
    model.block([-0.05, 0.1, 0.058], [0.15, 0.13, 0.008], 0.003, cloth);
    let brass = Paint::metal(Vec3::new(0.55, 0.42, 0.2));
    model.lathe([0.09, 0.11, 0.06], &[[0.036, 0.0], [0.036, 0.012], [0.0, 0.014]], brass).turn(DVec3::X, FRAC_PI_2);
    model.lathe([0.09, 0.05, 0.06], &[[0.014, 0.0], [0.014, 0.014], [0.0, 0.015]], brass).turn(DVec3::X, FRAC_PI_2);
    model.pipe(&[[-0.1, 0.185, 0.0], [-0.09, 0.225, 0.0], [0.09, 0.225, 0.0], [0.1, 0.185, 0.0]], 0.007, brass);
    model.rod([0.12, 0.18, -0.04], [0.17 + dice.range(0.0, 0.05), 0.38, -0.04], [0.003, 0.002], brass);
    model.fine(0.45).centered()
}

/// A portable box of tools.
pub(in super::super) fn toolbox(hue: &Hue) -> Model {
    let mut model = Model::colored("toolbox", hue);
    let paint = Paint::plain(hue.linear).gloss(0.5);
    let steel = Paint::metal(Vec3::splat(0.4));
    model.block([0.0, 0.085, 0.0], [0.42, 0.17, 0.2], 0.01, paint);
    model.block([0.0, 0.19, 0.0], [0.43, 0.05, 0.21], 0.02, paint);
    for x in [-0.13, 0.13] {
        model.block([x, 0.165, 0.104], [0.03, 0.05, 0.012], 0.003, steel);
    }
    model.pipe(&[[-0.12, 0.21, 0.0], [-0.1, 0.26, 0.0], [0.1, 0.26, 0.0], [0.12, 0.21, 0.0]], 0.011, steel);
    model.fine(0.6).centered()
}
