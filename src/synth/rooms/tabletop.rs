use glam::DVec2;

use super::super::color::{SMALL_HUES, small_hue};
use super::super::models::{decor, devices, lamps, plants, tables, tableware, textiles};
use super::super::stage::Stage;
use super::{fill_floor, hang_things, tableware_piece, trinket};

/// A table in the middle of a room with a still life on it.
pub(super) fn furnish(stage: &mut Stage) {
    let palette = stage.palette;
    let middle = DVec2::new(0.0, -0.35);
    let rug = textiles::rug(&mut stage.dice, &palette, [2.4, 1.7]);
    stage.stand(rug, middle, 0.0);
    // Free room at the sides and behind the table too, so that a camera can go around it.
    stage.reserve(DVec2::new(0.0, middle.y), DVec2::new(1.9, 1.2));
    let reserved = stage.reserved.pop();
    let table = tables::stage_table(&mut stage.dice, &palette);
    let table = stage.stand(table, middle, 0.0);
    stage.reserved.extend(reserved);
    let hue = small_hue(stage.dice.index(SMALL_HUES));
    let centerpiece = match stage.dice.index(4) {
        0 => decor::vase(&mut stage.dice, &palette.second, &palette),
        1 => tableware::fruit_bowl(&mut stage.dice, &hue),
        2 => lamps::table_lamp(&mut stage.dice, &palette.accent, &palette),
        _ => decor::sculpture(&mut stage.dice, &palette),
    };
    still_life(stage, table, centerpiece);
    fill_floor(stage, 2);
    hang_things(stage, 4);
}

fn still_life(stage: &mut Stage, table: Option<usize>, centerpiece: super::super::model::Model) {
    let palette = stage.palette;
    // The reserved ring is for the floor: what stands on the table stays inside the table's own plan.
    let ring = std::mem::take(&mut stage.reserved);
    stage.on_at(table, centerpiece, [0.0, -0.1], 0.3);
    for _ in 0..4 {
        let piece = tableware_piece(stage);
        stage.on(table, &piece);
        let piece = trinket(stage);
        stage.on(table, &piece);
    }
    let hue = small_hue(stage.dice.index(SMALL_HUES));
    let extra = match stage.dice.index(4) {
        0 => devices::laptop(&mut stage.dice),
        1 => plants::small_plant(&mut stage.dice, &hue),
        2 => tableware::teapot(&mut stage.dice, &hue),
        _ => lamps::desk_lamp(&mut stage.dice, &palette.accent),
    };
    stage.on(table, &extra);
    stage.reserved = ring;
}
