use glam::DVec2;

use super::super::color::{SMALL_HUES, small_hue};
use super::super::models::{decor, lamps, plants, storage, tables, tableware, textiles};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{chairs_around, fill_floor, hang_things, trinket, window_side};

/// A laid table under a pendant at the back, sideboard and shelves around.
pub(super) fn furnish(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let back = -stage.shell.half.y;
    let middle = DVec2::new(-window * 0.15, f64::midpoint(back, aisle[0]) + 0.02);
    let rug = textiles::rug(&mut stage.dice, &palette, [2.7, 1.9]);
    stage.stand(rug, middle, 0.0);
    let table = tables::dining_table(&mut stage.dice, &palette);
    let table = stage.stand(table, middle, 0.0);
    chairs_around(stage, table, true);
    let drop = stage.shell.height - 1.5;
    let hue = if stage.dice.chance(0.5) { palette.dark } else { palette.accent };
    for x in [-0.36, 0.36] {
        let pendant = lamps::pendant(&mut stage.dice, &hue, drop);
        stage.suspend(pendant, middle + DVec2::new(x, 0.0));
    }
    lay(stage, table);
    let board = storage::sideboard(&mut stage.dice, &palette);
    let host = stage.against(board, Wall::Front, window * -0.6);
    for _ in 0..4 {
        let piece = trinket(stage);
        stage.on(host, &piece);
    }
    let shelf = storage::bookshelf(&mut stage.dice, &palette);
    stage.anywhere(&shelf);
    let plant = plants::potted_plant(&mut stage.dice, &palette.second);
    stage.anywhere(&plant);
    fill_floor(stage, 3);
    hang_things(stage, 7);
}

/// Plates, glasses, bottle and flowers.
fn lay(stage: &mut Stage, table: Option<usize>) {
    let palette = stage.palette;
    let vase = decor::vase(&mut stage.dice, &palette.second, &palette);
    stage.on_at(table, vase, [0.0, 0.0], 0.0);
    let hue = small_hue(stage.dice.index(SMALL_HUES));
    for (x, z) in [(-0.52, 0.7), (0.52, 0.7), (-0.52, -0.7), (0.52, -0.7)] {
        let plate = tableware::plate(&mut stage.dice, &hue);
        stage.on_at(table, plate, [x, z], 0.0);
        let glass = tableware::wine_glass(&mut stage.dice);
        stage.on_at(table, glass, [x + 0.24, z * 0.5], 0.0);
    }
    let bottle = tableware::bottle(&mut stage.dice, &small_hue(2));
    stage.on_at(table, bottle, [-0.2, 0.0], 0.0);
    let bowl = tableware::fruit_bowl(&mut stage.dice, &small_hue(1));
    stage.on_at(table, bowl, [-0.75, 0.0], 0.0);
}
