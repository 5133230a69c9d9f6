//! Tables and desks.

use glam::Vec3;

use super::super::color::Palette;
use super::super::dice::Dice;
use super::super::model::Model;
use super::super::paint::{Paint, Pattern};

fn polished(palette: &Palette, dice: &mut Dice) -> Paint {
    Paint::wood(palette.wood.linear, dice.seed()).gloss(0.5)
}

fn black_metal() -> Paint {
    Paint::metal(Vec3::splat(0.035))
}

/// A low table: rectangular with a shelf, or round.
pub(in super::super) fn coffee_table(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("coffee table");
    let wood = polished(palette, dice);
    let height = dice.range(0.38, 0.44);
    if dice.chance(0.5) {
        let (length, depth) = (dice.range(1.0, 1.25), dice.range(0.55, 0.65));
        model.block([0.0, height - 0.02, 0.0], [length, 0.04, depth], 0.008, wood).cells(0.8);
        model.block([0.0, 0.15, 0.0], [length - 0.14, 0.022, depth - 0.12], 0.006, wood);
        model.legs([length / 2.0 - 0.07, depth / 2.0 - 0.07], height - 0.03, [0.018, 0.024], 0.02, wood);
        model.top([0.0, height, 0.0], [length / 2.0 - 0.05, depth / 2.0 - 0.05], 1.0);
    } else {
        let radius = dice.range(0.4, 0.5);
        let stone =
            Paint::patterned(Pattern::Marble, palette.light.linear * 0.9, palette.light.linear * 0.35, 0.3).gloss(0.6);
        let paint = if dice.chance(0.4) { stone } else { wood };
        disc_top(&mut model, radius, height, paint);
        model.legs([radius * 0.5, radius * 0.5], height - 0.03, [0.016, 0.022], 0.07, wood);
        model.top([0.0, height, 0.0], [radius * 0.7, radius * 0.7], 1.0);
    }
    model.centered()
}

/// A round board of 4 cm whose upper side is at `height`.
fn disc_top(model: &mut Model, radius: f64, height: f64, paint: Paint) {
    let profile =
        [[0.0, 0.0], [radius - 0.01, 0.0], [radius, 0.01], [radius, 0.03], [radius - 0.01, 0.04], [0.0, 0.04]];
    model.lathe([0.0, height - 0.04, 0.0], &profile, paint).cells(0.8);
}

/// A small round table beside a seat.
pub(in super::super) fn side_table(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("side table");
    let (height, radius) = (dice.range(0.48, 0.56), dice.range(0.2, 0.25));
    let wood = polished(palette, dice);
    disc_top(&mut model, radius, height, wood);
    if dice.chance(0.5) {
        model.rod([0.0, 0.02, 0.0], [0.0, height - 0.03, 0.0], [0.018, 0.018], black_metal());
        model.lathe([0.0; 3], &[[radius * 0.7, 0.0], [radius * 0.7, 0.014], [0.0, 0.022]], black_metal());
    } else {
        model.legs([radius * 0.5, radius * 0.5], height - 0.03, [0.011, 0.016], 0.04, wood);
    }
    model.top([0.0, height, 0.0], [radius * 0.7, radius * 0.7], 0.9);
    model.fine(0.85).centered()
}

/// A dining table for four or six.
pub(in super::super) fn dining_table(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("dining table");
    let wood = polished(palette, dice);
    let (length, depth, height) = (dice.range(1.5, 1.8), dice.range(0.85, 0.95), 0.75);
    model.block([0.0, height - 0.02, 0.0], [length, 0.04, depth], 0.008, wood).cells(0.8);
    for z in [-1.0, 1.0] {
        model.block([0.0, height - 0.08, z * (depth / 2.0 - 0.09)], [length - 0.2, 0.09, 0.025], 0.004, wood);
    }
    if dice.chance(0.5) {
        model.legs([length / 2.0 - 0.1, depth / 2.0 - 0.1], height - 0.03, [0.024, 0.034], 0.03, wood);
    } else {
        for x in [-1.0, 1.0] {
            for z in [-1.0, 1.0] {
                let at = [x * (length / 2.0 - 0.09), (height - 0.04) / 2.0, z * (depth / 2.0 - 0.09)];
                model.block(at, [0.075, height - 0.04, 0.075], 0.008, wood);
            }
        }
    }
    model.top([0.0, height, 0.0], [length / 2.0 - 0.1, depth / 2.0 - 0.1], 1.0);
    model.centered()
}

/// A desk with drawers on one side.
pub(in super::super) fn desk(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("desk");
    let wood = polished(palette, dice);
    let (length, depth, height) = (dice.range(1.25, 1.5), dice.range(0.6, 0.7), 0.74);
    model.block([0.0, height - 0.018, 0.0], [length, 0.036, depth], 0.007, wood).cells(0.8);
    let front = Paint::plain(palette.light.linear * 0.85).gloss(0.2);
    let (x, width) = (length / 2.0 - 0.24, 0.4);
    model.block([x, 0.4, 0.0], [width, 0.6, depth - 0.1], 0.006, wood);
    for i in 0..3 {
        let y = 0.21 + 0.19 * f64::from(i);
        model.block([x, y, depth / 2.0 - 0.045], [width - 0.03, 0.175, 0.02], 0.005, front).cells(0.8);
        model.block([x, y + 0.02, depth / 2.0 - 0.028], [0.12, 0.012, 0.016], 0.004, black_metal()).cells(0.5);
    }
    for z in [-1.0, 1.0] {
        let foot = [-length / 2.0 + 0.05, 0.0, z * (depth / 2.0 - 0.05)];
        model.rod(foot, [foot[0], height - 0.03, foot[2]], [0.02, 0.024], wood);
        model.rod([x, 0.0, z * (depth / 2.0 - 0.12)], [x, 0.12, z * (depth / 2.0 - 0.12)], [0.02, 0.024], wood);
    }
    model.top([-0.05, height, 0.0], [length / 2.0 - 0.12, depth / 2.0 - 0.06], 1.0);
    model.centered()
}

/// A low cabinet beside a bed.
pub(in super::super) fn nightstand(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("nightstand");
    let wood = polished(palette, dice);
    let (width, height, depth) = (dice.range(0.42, 0.5), dice.range(0.48, 0.56), 0.38);
    model.legs([width / 2.0 - 0.05, depth / 2.0 - 0.05], 0.15, [0.012, 0.018], 0.02, wood);
    model.block([0.0, f64::midpoint(height, 0.13), 0.0], [width, height - 0.13, depth], 0.008, wood);
    for i in 0..2 {
        let tall = (height - 0.17) / 2.0;
        let y = 0.15 + tall * (f64::from(i) + 0.5);
        model.block([0.0, y, depth / 2.0], [width - 0.04, tall - 0.015, 0.016], 0.005, wood.seeded(i as u32 + 9));
        model
            .pillow([0.0, y, depth / 2.0 + 0.018], [0.03, 0.03, 0.026], 2.0, Paint::metal(palette.second.linear))
            .cells(0.4);
    }
    model.top([0.0, height, 0.0], [width / 2.0 - 0.03, depth / 2.0 - 0.03], 0.8);
    model.fine(0.9).centered()
}

/// A heavy bench for work, with a vise and a pegboard's worth of shelf below.
pub(in super::super) fn workbench(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("workbench");
    let wood = Paint::wood(palette.floor.linear, dice.seed());
    let (length, depth, height) = (dice.range(1.6, 2.0), 0.66, 0.9);
    model.block([0.0, height - 0.035, 0.0], [length, 0.07, depth], 0.006, wood).cells(0.8);
    model.block([0.0, 0.24, 0.0], [length - 0.12, 0.03, depth - 0.1], 0.004, wood);
    for x in [-1.0, 1.0] {
        for z in [-1.0, 1.0] {
            let at = [x * (length / 2.0 - 0.1), (height - 0.07) / 2.0, z * (depth / 2.0 - 0.07)];
            model.block(at, [0.09, height - 0.07, 0.09], 0.005, wood);
        }
    }
    let vise = Paint::plain(Vec3::new(0.05, 0.12, 0.2)).gloss(0.4);
    let x = -length / 2.0 + 0.25;
    model.block([x, height - 0.1, depth / 2.0 + 0.03], [0.22, 0.14, 0.06], 0.012, vise);
    model.rod(
        [x, height - 0.1, depth / 2.0],
        [x, height - 0.1, depth / 2.0 + 0.15],
        [0.014, 0.014],
        Paint::metal(Vec3::splat(0.4)),
    );
    for i in 0..3 {
        let tint = [palette.accent, palette.second, palette.light][i].linear;
        let x = -0.5 + 0.45 * i as f64;
        model.block([x, 0.255 + 0.11, 0.0], [0.32, 0.22, 0.36], 0.012, Paint::plain(tint * 0.8));
    }
    model.top([0.1, height, 0.0], [length / 2.0 - 0.25, depth / 2.0 - 0.06], 1.0);
    model.centered()
}

/// A plain board on legs that a tabletop scene stands on.
pub(in super::super) fn stage_table(dice: &mut Dice, palette: &Palette) -> Model {
    let mut model = Model::new("table");
    let wood = polished(palette, dice);
    let (length, depth, height) = (dice.range(1.5, 1.8), dice.range(0.95, 1.15), 0.75);
    model.block([0.0, height - 0.022, 0.0], [length, 0.044, depth], 0.01, wood).cells(0.45);
    model.legs([length / 2.0 - 0.1, depth / 2.0 - 0.1], height - 0.03, [0.026, 0.036], 0.03, wood);
    model.top([0.0, height, 0.0], [length / 2.0 - 0.1, depth / 2.0 - 0.1], 1.0);
    model.centered()
}
