use std::f64::consts::PI;

use glam::DVec2;

use super::super::color::{SMALL_HUES, small_hue};
use super::super::models::{decor, devices, lamps, plants, seats, storage, tables, tableware, textiles};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{fill_floor, hang_things, side_table_with_lamp, trinket, window_side};

/// A desk before the back wall, shelves of books, a corner to read.
pub(super) fn furnish(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let half = stage.shell.half;
    let middle = DVec2::new(window * 0.4, -half.y + 1.3);
    let rug = textiles::rug(&mut stage.dice, &palette, [2.4, 1.7]);
    stage.stand(rug, middle, 0.0);
    // The desk faces the room: whoever sits there has the shelves behind.
    let desk = tables::desk(&mut stage.dice, &palette);
    let host = stage.stand(desk, middle + DVec2::new(0.0, 0.35), PI);
    let chair = seats::office_chair(&mut stage.dice, &palette.accent);
    let turn = stage.dice.range(-0.3, 0.3);
    stage.stand(chair, middle + DVec2::new(0.0, -0.4), turn);
    work_place(stage, host);
    for along in [-half.x + 0.75, half.x - 0.75, -0.3] {
        let shelf = storage::bookshelf(&mut stage.dice, &palette);
        let host = stage.against(shelf, Wall::Back, along);
        let piece = trinket(stage);
        stage.on(host, &piece);
    }
    let seat = DVec2::new(-window * (half.x - 0.9), half.y - 0.75);
    let chair = seats::armchair(&mut stage.dice, &palette.main, &palette);
    stage.stand(chair, seat, window * 2.5);
    side_table_with_lamp(stage, seat + DVec2::new(window * 0.75, 0.25));
    let lamp = lamps::floor_lamp(&mut stage.dice, &palette);
    stage.anywhere(&lamp);
    let globe = decor::telescope(&palette);
    stage.stand(globe, DVec2::new(window * (half.x - 0.9), aisle[1] + 0.55), window);
    let plant = plants::potted_plant(&mut stage.dice, &palette.light);
    stage.anywhere(&plant);
    let board = storage::sideboard(&mut stage.dice, &palette);
    let host = stage.anywhere(&board);
    for _ in 0..3 {
        let piece = trinket(stage);
        stage.on(host, &piece);
    }
    fill_floor(stage, 3);
    hang_things(stage, 6);
}

fn work_place(stage: &mut Stage, host: Option<usize>) {
    let palette = stage.palette;
    if stage.dice.chance(0.5) {
        let monitor = devices::monitor(&mut stage.dice);
        // Screens look at the chair, which stands behind the desk's front.
        stage.on_at(host, monitor, [0.0, -0.55], 0.0);
        stage.on_at(host, devices::keyboard(), [0.0, 0.45], 0.0);
    } else {
        let laptop = devices::laptop(&mut stage.dice);
        stage.on_at(host, laptop, [0.0, 0.1], 0.1);
    }
    let lamp = lamps::desk_lamp(&mut stage.dice, &palette.second);
    stage.on_at(host, lamp, [-0.72, -0.4], 0.3);
    let hue = small_hue(stage.dice.index(SMALL_HUES));
    let mug = tableware::mug(&mut stage.dice, &hue);
    stage.on_at(host, mug, [0.55, 0.3], 0.6);
    let stack = storage::book_stack(&mut stage.dice, &palette);
    stage.on_at(host, stack, [0.8, -0.4], 0.1);
    let globe = decor::globe(&mut stage.dice, &palette);
    stage.on(host, &globe);
}
