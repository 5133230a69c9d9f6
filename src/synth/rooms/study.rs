use std::f64::consts::PI;

use glam::DVec2;

use super::furnishing::{decorate_walls, fill_floor, side_table_with_lamp, trinket, window_side};
use crate::assets::{decor, devices, lamps, plants, seats, storage, tables, tableware, textiles};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// A desk in front of bookshelves at the back wall, an armchair at the front.
pub(super) fn furnish(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let half = builder.shell.half;
    let middle = DVec2::new(window * 0.4, -half.y + 1.3);
    let rug = textiles::rug(&mut builder.rng, &palette, [2.4, 1.7]);
    builder.place_on_floor(rug, middle, 0.0);
    // The desk faces the room, with the bookshelves behind its chair.
    let desk = tables::desk(&mut builder.rng, &palette);
    let host = builder.place_on_floor(desk, middle + DVec2::new(0.0, 0.35), PI);
    let chair = seats::office_chair(&mut builder.rng, &palette.accent);
    let turn = builder.rng.range(-0.3, 0.3);
    builder.place_on_floor(chair, middle + DVec2::new(0.0, -0.4), turn);
    work_place(builder, host);
    for along in [-half.x + 0.75, half.x - 0.75, -0.3] {
        let shelf = storage::bookshelf(&mut builder.rng, &palette);
        let host = builder.place_at_wall(shelf, Wall::Back, along);
        let piece = trinket(builder);
        builder.place_on(host, &piece);
    }
    let seat = DVec2::new(-window * (half.x - 0.9), half.y - 0.75);
    let chair = seats::armchair(&mut builder.rng, &palette.main, &palette);
    builder.place_on_floor(chair, seat, window * 2.5);
    side_table_with_lamp(builder, seat + DVec2::new(window * 0.75, 0.25));
    let lamp = lamps::floor_lamp(&mut builder.rng, &palette);
    builder.place_at_any_wall(&lamp);
    let globe = decor::telescope(&palette);
    builder.place_on_floor(globe, DVec2::new(window * (half.x - 0.9), aisle[1] + 0.55), window);
    let plant = plants::potted_plant(&mut builder.rng, &palette.light);
    builder.place_at_any_wall(&plant);
    let board = storage::sideboard(&mut builder.rng, &palette);
    let host = builder.place_at_any_wall(&board);
    for _ in 0..3 {
        let piece = trinket(builder);
        builder.place_on(host, &piece);
    }
    fill_floor(builder, 3);
    decorate_walls(builder, 6);
}

/// Places a computer and other objects on the desk.
fn work_place(builder: &mut SceneBuilder, host: Option<usize>) {
    let palette = builder.palette;
    if builder.rng.chance(0.5) {
        let monitor = devices::monitor(&mut builder.rng);
        // The screen faces the chair.
        builder.place_on_at(host, monitor, [0.0, -0.55], 0.0);
        builder.place_on_at(host, devices::keyboard(), [0.0, 0.45], 0.0);
    } else {
        let laptop = devices::laptop(&mut builder.rng);
        builder.place_on_at(host, laptop, [0.0, 0.1], 0.1);
    }
    let lamp = lamps::desk_lamp(&mut builder.rng, &palette.second);
    builder.place_on_at(host, lamp, [-0.72, -0.4], 0.3);
    let color = muted_color(builder.rng.index(NUM_MUTED_COLORS));
    let mug = tableware::mug(&mut builder.rng, &color);
    builder.place_on_at(host, mug, [0.55, 0.3], 0.6);
    let stack = storage::book_stack(&mut builder.rng, &palette);
    builder.place_on_at(host, stack, [0.8, -0.4], 0.1);
    let globe = decor::globe(&mut builder.rng, &palette);
    builder.place_on(host, &globe);
}
