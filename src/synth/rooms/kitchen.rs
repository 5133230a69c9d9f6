use glam::DVec2;

use super::super::color::{SMALL_HUES, small_hue};
use super::super::models::{kitchen, lamps, plants, seats, tables, tableware, walls};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{chairs_around, fill_floor, hang_things, tableware_piece, window_side};

/// Units along the back wall, aisle, a table with chairs in front.
pub(super) fn furnish(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let hue = if stage.dice.chance(0.5) { palette.main } else { palette.feature };
    units(stage, &hue);
    let middle = DVec2::new(-window * 0.3, f64::midpoint(aisle[1], stage.shell.half.y) + 0.1);
    let table = tables::dining_table(&mut stage.dice, &palette);
    let table = stage.stand(table, middle, 0.0);
    chairs_around(stage, table, stage.shell.half.x > 3.1);
    let pendant = lamps::pendant(&mut stage.dice, &palette.accent, stage.shell.height - 1.55);
    stage.suspend(pendant, middle);
    let bowl = tableware::fruit_bowl(&mut stage.dice, &palette.second);
    stage.on_at(table, bowl, [0.0, 0.0], 0.0);
    for _ in 0..6 {
        let piece = tableware_piece(stage);
        stage.on(table, &piece);
    }
    let plant = plants::potted_plant(&mut stage.dice, &palette.second);
    stage.anywhere(&plant);
    for _ in 0..2 {
        let stool = seats::stool(&mut stage.dice, &palette);
        stage.anywhere(&stool);
    }
    fill_floor(stage, 2);
    hang_things(stage, 4);
}

/// Refrigerator, counter, stove and what hangs above.
fn units(stage: &mut Stage, hue: &super::super::color::Hue) {
    let palette = stage.palette;
    let half = stage.shell.half.x;
    let fridge = kitchen::fridge(&mut stage.dice, &palette.light);
    stage.against(fridge, Wall::Back, -half + 0.42);
    let stove_at = half - 1.35;
    let left = -half + 0.82;
    let width = stove_at - 0.34 - left;
    let counter = kitchen::counter(&mut stage.dice, hue, width);
    let host = stage.against(counter, Wall::Back, left + width / 2.0);
    let stove = kitchen::stove(&palette.light);
    let stove = stage.against(stove, Wall::Back, stove_at);
    let rest = half - 0.06 - (stove_at + 0.34);
    let corner = kitchen::counter(&mut stage.dice, hue, rest);
    let corner = stage.against(corner, Wall::Back, stove_at + 0.34 + rest / 2.0);
    for (at, wide) in [(left + width * 0.27, width * 0.48), (left + width * 0.76, width * 0.44)] {
        stage.hang(kitchen::wall_cabinet(hue, wide), Wall::Back, [at, 1.5]);
    }
    let clock = walls::clock(&mut stage.dice, &palette);
    stage.hang(clock, Wall::Back, [stove_at, 1.7]);
    let pot = kitchen::cooking_pot(&mut stage.dice, &palette.accent);
    stage.on(stove, &pot);
    for host in [host, host, host, corner] {
        let small = small_hue(stage.dice.index(SMALL_HUES));
        let piece =
            if stage.dice.chance(0.3) { plants::small_plant(&mut stage.dice, &small) } else { tableware_piece(stage) };
        stage.on(host, &piece);
    }
}
