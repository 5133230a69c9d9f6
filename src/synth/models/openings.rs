//! Windows and doors; backs at -z, which lies in the plane of the wall.

use glam::Vec3;

use super::super::color::Hue;
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::Paint;

/// Frame, bars and sill of a window of a size.
pub(in super::super) fn window(size: [f64; 2], bars: [u32; 2]) -> Model {
    let mut model = Model::new("window");
    let [width, height] = size;
    let paint = Paint::plain(Vec3::new(0.8, 0.78, 0.74)).gloss(0.2);
    let (rim, deep) = (0.055, 0.05);
    for side in [-1.0, 1.0] {
        model.block([side * (width / 2.0), height / 2.0, 0.0], [rim, height + rim, deep], 0.006, paint);
        let y = height / 2.0 + side * height / 2.0;
        model.block([0.0, y, 0.0], [width - rim, rim, deep], 0.006, paint);
    }
    for i in 1..bars[0] {
        let x = -width / 2.0 + width * f64::from(i) / f64::from(bars[0]);
        model.block([x, height / 2.0, -0.005], [0.03, height - rim, 0.03], 0.004, paint);
    }
    for i in 1..bars[1] {
        let y = height * f64::from(i) / f64::from(bars[1]);
        model.block([0.0, y, -0.005], [width - rim, 0.026, 0.03], 0.004, paint);
    }
    model.block([0.0, -0.04, 0.02], [width + 0.12, 0.03, 0.09], 0.008, paint);
    model.fine(0.8).centered()
}

/// A paneled door in its casing.
pub(in super::super) fn door(dice: &mut Dice, hue: &Hue) -> Model {
    let mut model = Model::colored("door", hue);
    let (width, height) = (dice.range(0.82, 0.9), 2.05);
    let paint = Paint::plain(hue.linear).gloss(0.25);
    let casing = Paint::plain(Vec3::new(0.76, 0.73, 0.68)).gloss(0.2);
    for side in [-1.0, 1.0] {
        model.block([side * (width / 2.0 + 0.045), height / 2.0, 0.0], [0.09, height, 0.05], 0.008, casing);
    }
    model.block([0.0, height + 0.045, 0.0], [width + 0.18, 0.09, 0.05], 0.008, casing);
    model.block([0.0, height / 2.0, -0.008], [width, height, 0.03], 0.003, paint);
    let inset = Paint::plain(hue.linear * 0.82).gloss(0.25);
    for x in [-0.24, 0.24] {
        for (y, tall) in [(0.52, 0.66), (1.42, 0.88)] {
            model.block([x * width, y, -0.004], [width * 0.36, tall, 0.03], 0.008, inset);
            model.block([x * width, y, -0.001], [width * 0.36 - 0.07, tall - 0.07, 0.03], 0.008, paint);
        }
    }
    let brass = Paint::metal(Vec3::new(0.55, 0.4, 0.17));
    let knob = width / 2.0 - 0.07;
    model.block([knob, 1.02, 0.008], [0.04, 0.16, 0.008], 0.003, brass).cells(0.4);
    model.rod([knob, 1.04, 0.01], [knob, 1.04, 0.05], [0.009, 0.009], brass).cells(0.4);
    model.rod([knob + 0.01, 1.04, 0.05], [knob - 0.1, 1.04, 0.05], [0.009, 0.008], brass).cells(0.4);
    model.centered()
}
