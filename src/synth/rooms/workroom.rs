use glam::DVec2;

use super::super::color::{SMALL_HUES, small_hue};
use super::super::models::{decor, devices, instruments, lamps, plants, seats, storage, tables, textiles, walls};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{fill_floor, hang_things, tableware_piece, trinket, window_side};

/// An artist's room: easels, sculptures, a guitar, plants.
pub(super) fn furnish_studio(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let half = stage.shell.half;
    let rug = textiles::rug(&mut stage.dice, &palette, [2.2, 1.5]);
    stage.stand(rug, DVec2::new(0.0, aisle[0] - 0.55), 0.0);
    for (x, turn) in [(-1.1, 0.35), (0.75, -0.3)] {
        let easel = decor::easel(&mut stage.dice, &palette);
        stage.stand(easel, DVec2::new(x, -half.y + 0.8), turn);
    }
    let stool = seats::stool(&mut stage.dice, &palette);
    stage.stand(stool, DVec2::new(-0.3, aisle[0] - 0.4), 0.3);
    let guitar = instruments::guitar(&mut stage.dice, &palette);
    stage.stand(guitar, DVec2::new(-window * (half.x - 0.45), aisle[0] - 0.45), window * 0.9);
    let table = tables::workbench(&mut stage.dice, &palette);
    let host = stage.against(table, Wall::Front, window * 0.5);
    for _ in 0..3 {
        let piece = trinket(stage);
        stage.on(host, &piece);
        let piece = tableware_piece(stage);
        stage.on(host, &piece);
    }
    let bust = decor::sculpture(&mut stage.dice, &palette);
    stage.on(host, &bust);
    let chair = seats::armchair(&mut stage.dice, &palette.accent, &palette);
    stage.stand(chair, DVec2::new(-window * (half.x - 0.6), half.y - 0.6), window * 2.4);
    let lamp = lamps::floor_lamp(&mut stage.dice, &palette);
    stage.anywhere(&lamp);
    for _ in 0..2 {
        let plant = plants::potted_plant(&mut stage.dice, &palette.second);
        stage.anywhere(&plant);
    }
    fill_floor(stage, 3);
    hang_things(stage, 8);
}

/// Workbench under a wall of tools, cabinets, boxes.
pub(super) fn furnish_workshop(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let half = stage.shell.half;
    let bench = tables::workbench(&mut stage.dice, &palette);
    let host = stage.against(bench, Wall::Back, -window * 0.3);
    let tools = walls::tool_wall(&mut stage.dice, &palette.second);
    stage.hang(tools, Wall::Back, [-window * 0.3, 1.3]);
    stage.on_at(host, devices::toolbox(&palette.accent), [0.3, 0.1], 0.2);
    let hue = small_hue(stage.dice.index(SMALL_HUES));
    let radio = devices::radio(&mut stage.dice, &hue);
    stage.on_at(host, radio, [-0.3, -0.5], 0.0);
    let lamp = lamps::desk_lamp(&mut stage.dice, &palette.accent);
    stage.on_at(host, lamp, [0.85, -0.4], 0.0);
    let stool = seats::stool(&mut stage.dice, &palette);
    stage.stand(stool, DVec2::new(-window * 0.5, -half.y + 1.3), 0.2);
    let shelf = storage::bookshelf(&mut stage.dice, &palette);
    stage.against(shelf, Wall::Back, window * (half.x - 0.8));
    let chest = storage::dresser(&mut stage.dice, &palette);
    let host = stage.anywhere(&chest);
    stage.on(host, &devices::toolbox(&palette.second));
    let table = tables::desk(&mut stage.dice, &palette);
    let host = stage.against(table, Wall::Front, 0.2);
    for _ in 0..3 {
        let piece = trinket(stage);
        stage.on(host, &piece);
    }
    let wood = super::super::paint::Paint::wood(palette.wood.linear, 3);
    let chair = seats::chair(stage.dice.seed(), wood, wood);
    stage.stand(chair, DVec2::new(0.0, aisle[1] + 0.3), 0.2);
    let pendant = lamps::pendant(&mut stage.dice, &palette.dark, 0.7);
    stage.suspend(pendant, DVec2::new(0.0, -half.y + 0.8));
    let basket = storage::basket(&mut stage.dice, &palette);
    stage.anywhere(&basket);
    let plant = plants::potted_plant(&mut stage.dice, &palette.accent);
    stage.anywhere(&plant);
    fill_floor(stage, 3);
    hang_things(stage, 7);
}
