//! Lamps: each carries its light.

use glam::Vec3;

use super::super::color::{Hue, Palette};
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::Paint;

/// Color of a warm bulb, linear.
const WARM: Vec3 = Vec3::new(1.0, 0.66, 0.36);

fn shade_paint(hue: Vec3) -> Paint {
    Paint::plain(hue.lerp(Vec3::new(1.0, 0.78, 0.5), 0.65)).glow(0.95)
}

fn metal(palette: &Palette, dice: &mut Dice) -> Paint {
    let brass = Vec3::new(0.56, 0.4, 0.17);
    Paint::metal(if dice.chance(0.5) { brass } else { palette.dark.linear })
}

/// A lamp standing on the floor: drum shade on a stem, tripod, or an arc.
pub(in super::super) fn floor_lamp(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("floor lamp");
    let height = dice.range(1.45, 1.65);
    let frame = metal(palette, dice);
    let shade = shade_paint(palette.light.linear);
    let (low, high) = (dice.range(0.18, 0.22), dice.range(0.13, 0.2));
    match dice.index(3) {
        0 => {
            model.lathe([0.0; 3], &[[0.15, 0.0], [0.15, 0.015], [0.03, 0.03]], frame);
            model.rod([0.0, 0.02, 0.0], [0.0, height - 0.05, 0.0], [0.011, 0.011], frame);
        }
        1 => {
            let wood = Paint::wood(palette.wood.linear, dice.seed());
            for i in 0..3 {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 3.0).sin_cos();
                model.rod([0.27 * cos, 0.0, 0.27 * sin], [0.03 * cos, height - 0.22, 0.03 * sin], [0.014, 0.016], wood);
            }
            model.rod([0.0, height - 0.25, 0.0], [0.0, height - 0.05, 0.0], [0.014, 0.012], frame);
        }
        _ => {
            model.lathe([0.0; 3], &[[0.14, 0.0], [0.14, 0.04], [0.0, 0.045]], frame);
            let bend = [
                [0.0, 0.03, 0.0],
                [0.0, height * 0.7, 0.0],
                [0.1, height + 0.1, 0.0],
                [0.36, height + 0.1, 0.0],
                [0.45, height, 0.0],
            ];
            model.pipe(&bend, 0.011, frame);
            model.lathe([0.45, height - 0.16, 0.0], &[[0.15, 0.0], [0.12, 0.1], [0.02, 0.16]], frame).airy();
            model.pillow([0.45, height - 0.13, 0.0], [0.13, 0.13, 0.13], 2.0, shade_paint(Vec3::ONE)).cells(0.6);
            model.lamp([0.45, height - 0.14, 0.0], 0.06, WARM);
            return model.centered();
        }
    }
    model.lathe([0.0, height - 0.1, 0.0], &[[low, 0.0], [high, 0.3]], shade);
    model.lathe([0.0, height - 0.1, 0.0], &[[low + 0.002, 0.0], [low + 0.001, 0.012]], frame).cells(0.6).airy();
    model.lamp([0.0, height + 0.04, 0.0], 0.09, WARM);
    model.centered()
}

/// A lamp with a ceramic foot for tables.
pub(in super::super) fn table_lamp(dice: &mut Dice, hue: &Hue, palette: &Palette) -> Model {
    let mut model = Model::new("table lamp");
    let foot = Paint::plain(hue.linear).gloss(0.6);
    let body = dice.range(0.18, 0.26);
    let profile = match dice.index(3) {
        0 => vec![[0.05, 0.0], [0.085, body * 0.35], [0.07, body * 0.7], [0.02, body], [0.014, body + 0.05]],
        1 => vec![[0.075, 0.0], [0.078, 0.02], [0.03, body * 0.3], [0.026, body * 0.8], [0.014, body + 0.05]],
        _ => vec![[0.04, 0.0], [0.075, body * 0.6], [0.06, body * 0.92], [0.016, body], [0.014, body + 0.05]],
    };
    model.turned([0.0; 3], &profile, foot);
    model.lathe([0.0, body + 0.02, 0.0], &[[0.15, 0.0], [0.1, 0.19]], shade_paint(palette.light.linear));
    model.lamp([0.0, body + 0.11, 0.0], 0.06, WARM * 0.6);
    model.fine(0.7).centered()
}

/// A lamp hanging from the ceiling: its highest point is the mount.
pub(in super::super) fn pendant(dice: &mut Dice, hue: &Hue, drop: f64) -> Model {
    let mut model = Model::colored("pendant lamp", hue);
    let cord = Paint::plain(Vec3::splat(0.03));
    let outside = Paint::plain(hue.linear).gloss(0.5);
    let radius = dice.range(0.17, 0.24);
    let profile = if dice.chance(0.5) {
        vec![[radius, 0.0], [radius * 0.95, 0.06], [radius * 0.6, 0.15], [0.03, 0.2]]
    } else {
        vec![[radius * 0.8, 0.0], [radius, 0.1], [radius * 0.85, 0.2], [0.03, 0.27]]
    };
    // The shade is hollow: only its crown stops light, so that the bulb shines down and out.
    model.turned([0.0; 3], &profile, outside).airy();
    model.pillow([0.0, 0.16, 0.0], [radius * 1.3, 0.05, radius * 1.3], 2.0, outside).ghost();
    model.pillow([0.0, 0.05, 0.0], [0.11, 0.11, 0.11], 2.0, shade_paint(Vec3::ONE)).cells(0.6);
    model.rod([0.0, 0.18, 0.0], [0.0, drop - 0.02, 0.0], [0.005, 0.005], cord);
    model.lathe([0.0, drop - 0.03, 0.0], &[[0.05, 0.0], [0.05, 0.03]], outside);
    model.lamp([0.0, 0.02, 0.0], 0.05, WARM * 1.2);
    model.fine(0.8).centered()
}

/// A jointed lamp for desks.
pub(in super::super) fn desk_lamp(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::colored("desk lamp", hue);
    let paint = Paint::plain(hue.linear).gloss(0.6);
    let reach = dice.range(0.2, 0.26);
    model.lathe([0.0; 3], &[[0.09, 0.0], [0.09, 0.02], [0.0, 0.024]], paint);
    model.rod([0.0, 0.02, 0.0], [-0.09, 0.3, 0.0], [0.008, 0.008], paint);
    model.rod([-0.09, 0.3, 0.0], [reach - 0.09, 0.44, 0.0], [0.008, 0.008], paint);
    let profile = [[0.085, 0.0], [0.08, 0.03], [0.04, 0.09], [0.02, 0.13]];
    model.turned([reach - 0.07, 0.33, 0.0], &profile, paint).airy();
    model.pillow([reach - 0.07, 0.35, 0.0], [0.07, 0.07, 0.07], 2.0, shade_paint(Vec3::ONE));
    model.lamp([reach - 0.07, 0.33, 0.0], 0.03, WARM * 0.5);
    model.fine(0.6).centered()
}

/// A pillar candle on a plate.
pub(in super::super) fn candle(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("candle");
    let (radius, height) = (dice.range(0.028, 0.036), dice.range(0.09, 0.16));
    model.turned(
        [0.0; 3],
        &[[0.055, 0.0], [0.06, 0.008], [0.03, 0.008], [0.0, 0.008]],
        Paint::metal(palette.dark.linear),
    );
    let wax = Paint::plain(Vec3::new(0.85, 0.76, 0.6)).gloss(0.2);
    model.lathe(
        [0.0, 0.008, 0.0],
        &[[radius, 0.0], [radius, height], [radius * 0.8, height], [0.0, height - 0.008]],
        wax,
    );
    let flame = Paint::plain(Vec3::new(1.6, 1.0, 0.4)).glow(1.0);
    model.pillow([0.0, height + 0.032, 0.0], [0.013, 0.036, 0.013], 2.0, flame).cells(0.5);
    model.lamp([0.0, height + 0.04, 0.0], 0.01, WARM * 0.08);
    model.fine(0.35).centered()
}
