//! What hangs on walls; backs at -z.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::super::color::{Hue, Palette};
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

/// A framed picture of a size.
pub(in super::super) fn picture(dice: &mut Dice, palette: &Palette, size: [f64; 2]) -> Model {
    let mut model = Model::new("picture");
    let pattern =
        dice.pick([Pattern::PictureHills, Pattern::PictureShapes, Pattern::PictureStem, Pattern::PictureHills]);
    let [width, height] = size;
    let frame = if dice.chance(0.5) {
        Paint::plain(palette.dark.linear)
    } else {
        Paint::wood(palette.wood.linear, dice.seed())
    };
    let bar = 0.028;
    for side in [-1.0, 1.0] {
        model
            .block([side * (width / 2.0 - bar / 2.0), height / 2.0, 0.0], [bar, height, 0.03], 0.004, frame)
            .cells(0.6);
        model
            .block(
                [0.0, height / 2.0 + side * (height / 2.0 - bar / 2.0), 0.0],
                [width - 2.0 * bar, bar, 0.03],
                0.004,
                frame,
            )
            .cells(0.6);
    }
    let mat = Paint::plain(Vec3::new(0.8, 0.77, 0.7));
    model.block([0.0, height / 2.0, -0.004], [width - 0.02, height - 0.02, 0.02], 0.0, mat).only(0b10_0000);
    let margin = if dice.chance(0.6) { 0.16 * width.min(height) } else { bar };
    let inks = Paint::patterned(pattern, palette.main.linear, palette.accent.linear, 0.1).seeded(dice.seed());
    let face = [width - 2.0 * margin, height - 2.0 * margin, 0.024];
    model.block([0.0, height / 2.0, -0.004], face, 0.0, inks).only(0b10_0000).cells(0.5);
    model.fine(0.8).centered()
}

/// A wall clock.
pub(in super::super) fn clock(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("clock");
    let r = dice.range(0.15, 0.2);
    let rim = if dice.chance(0.5) {
        Paint::metal(Vec3::new(0.5, 0.36, 0.16))
    } else {
        Paint::plain(palette.dark.linear).gloss(0.4)
    };
    let profile = [[r, 0.0], [r, 0.03], [r * 0.97, 0.036], [r * 0.92, 0.03]];
    model.lathe([0.0, r, -0.02], &profile, rim).turn(DVec3::X, TAU / 4.0).cells(0.5).airy();
    let face = Paint::patterned(Pattern::Clock, Vec3::splat(0.82), Vec3::splat(0.02), 0.1);
    let disc = move |u: f64, v: f64| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        // The square onto the disc by elliptical mapping, which keeps both axes.
        let at = DVec3::new(x * (1.0 - y * y / 2.0).sqrt(), y * (1.0 - x * x / 2.0).sqrt(), 0.0);
        DVec3::new(at.x * r * 0.95, r + at.y * r * 0.95, 0.0)
    };
    model.sheet([2.0 * r, 2.0 * r], face, disc).cells(0.4);
    model.fine(0.9).centered()
}

/// A mirror with a round brass rim: bright where it reflects the room.
pub(in super::super) fn mirror(dice: &mut Dice) -> Model {
    let mut model = Model::new("mirror");
    let r = dice.range(0.3, 0.38);
    let brass = Paint::metal(Vec3::new(0.52, 0.38, 0.16));
    model
        .lathe([0.0, r, -0.012], &[[r, 0.0], [r, 0.024], [r * 0.95, 0.024]], brass)
        .turn(DVec3::X, TAU / 4.0)
        .cells(0.6)
        .airy();
    let glass = Paint::plain(Vec3::new(0.42, 0.45, 0.47)).gloss(1.0);
    model.lathe([0.0, r, 0.0], &[[r * 0.97, 0.0], [0.0, 0.0]], glass).turn(DVec3::X, TAU / 4.0);
    model.centered()
}

/// A panel with tools hanging from it.
pub(in super::super) fn tool_wall(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::new("tool wall");
    let (width, height) = (1.4, 0.8);
    let board = Paint::plain(hue.linear * 0.8);
    model.block([0.0, height / 2.0, 0.0], [width, height, 0.02], 0.004, board);
    let (steel, grip) = (Paint::metal(Vec3::splat(0.35)), Paint::plain(Vec3::new(0.5, 0.1, 0.03)).gloss(0.3));
    let wood = Paint::wood(Vec3::new(0.4, 0.22, 0.09), 4);
    for i in 0..8 {
        let x = -0.58 + 0.165 * f64::from(i);
        let y = 0.62 + dice.range(-0.04, 0.04);
        match i % 4 {
            0 => {
                model.rod([x, y, 0.03], [x, y - 0.3, 0.03], [0.012, 0.015], wood);
                model.block([x, y, 0.035], [0.12, 0.035, 0.035], 0.006, steel);
            }
            1 => {
                model.rod([x, y, 0.025], [x, y - 0.12, 0.025], [0.016, 0.014], grip);
                model.rod([x, y - 0.12, 0.025], [x, y - 0.28, 0.025], [0.005, 0.004], steel);
            }
            2 => {
                model.block([x, y - 0.14, 0.022], [0.1, 0.3, 0.004], 0.0, steel).turn(DVec3::Z, 0.1);
                model.block([x, y + 0.04, 0.024], [0.09, 0.07, 0.025], 0.01, wood);
            }
            _ => {
                model.pipe(&[[x - 0.02, y - 0.25, 0.025], [x, y - 0.08, 0.025], [x + 0.03, y, 0.025]], 0.009, grip);
                model.pipe(&[[x + 0.02, y - 0.25, 0.03], [x, y - 0.08, 0.03], [x - 0.03, y, 0.03]], 0.009, grip);
            }
        }
    }
    model.fine(0.7).centered()
}
