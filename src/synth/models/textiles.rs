//! Rugs and curtains.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::super::color::{Hue, Palette};
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

/// A rug of a size, its longer side along x.
pub(in super::super) fn rug(dice: &mut Dice, palette: &Palette, size: [f64; 2]) -> Model {
    let hue = if dice.chance(0.6) { palette.accent } else { palette.second };
    let mut model = Model::colored("rug", &hue);
    let pattern = dice.pick([Pattern::RugClassic, Pattern::RugClassic, Pattern::RugModern, Pattern::RugStriped]);
    let other = if pattern == Pattern::RugClassic { Vec3::new(0.035, 0.05, 0.085) } else { palette.main.linear };
    let pile = Paint::patterned(pattern, hue.linear * 0.9, other, 0.1).seeded(dice.seed());
    let edge = Paint::cloth(hue.linear * 0.6, dice.seed());
    model.block([0.0, 0.005, 0.0], [size[0], 0.01, size[1]], 0.003, edge).only(0b11_0011);
    model.sheet(size, pile, move |u, v| DVec3::new((u - 0.5) * size[0], 0.01, (0.5 - v) * size[1])).cells(0.72).airy();
    let fringe = Paint::plain(palette.light.linear).thin();
    for side in [-1.0, 1.0] {
        let x = side * size[0] / 2.0;
        let wide = size[1];
        let comb = move |u: f64, v: f64| DVec3::new(x + side * 0.05 * u, 0.006, (v - 0.5) * wide * side);
        model.sheet([0.05, wide], fringe, comb).airy();
    }
    model.centered()
}

/// A pair of curtains on a rod for a window `width` m wide; `drop` m long.
pub(in super::super) fn curtains(dice: &mut Dice, hue: &Hue, width: f64, drop: f64) -> Model {
    let mut model = Model::colored("curtains", hue);
    let rod = Paint::metal(Vec3::new(0.45, 0.32, 0.14));
    let cloth = Paint::cloth(hue.linear, dice.seed()).thin();
    let reach = width / 2.0 + 0.3;
    model.rod([-reach, drop + 0.02, 0.0], [reach, drop + 0.02, 0.0], [0.012, 0.012], rod);
    for side in [-1.0, 1.0] {
        model.pillow([side * (reach + 0.02), drop + 0.02, 0.0], [0.05, 0.05, 0.05], 2.0, rod).cells(0.5);
        let spread = dice.range(0.36, 0.44);
        let folds = 7.0;
        let (middle, phase) = (side * (width / 2.0 + 0.26 - spread / 2.0 + 0.02), dice.range(0.0, 1.0));
        let fall = move |u: f64, v: f64| {
            // Gathered at the top, fuller toward the floor.
            let deep = 0.026 + 0.014 * (1.0 - v);
            let swing = TAU * (folds * u + phase) + 0.7 * (1.0 - v);
            let x = middle + (u - 0.5) * spread * (1.0 - 0.1 * v) + 0.008 * (swing * 2.0).sin();
            DVec3::new(x, drop * v, deep * swing.sin())
        };
        model.sheet([spread * 2.4, drop], cloth, fall).cells(0.9);
    }
    model.centered()
}
