use std::f64::consts::PI;

use glam::DVec2;

use super::furnishing::{
    decorate_walls, fill_floor, lamp_on, side_table_with_lamp, tableware_piece, trinket, window_side,
};
use crate::assets::{devices, hearth, instruments, lamps, plants, seats, storage, tables, tableware, textiles, walls};
use crate::color::muted_color;
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// A sofa group at the back; a sideboard or a fireplace at the front.
pub(super) fn furnish(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let window = window_side(builder);
    let center = -window * builder.rng.range(0.0, 0.35);
    seating(builder, center, aisle);
    above_sofa(builder, center);
    let corner = DVec2::new(-window * (builder.shell.half.x - 0.42), -builder.shell.half.y + 0.42);
    let palette = builder.palette;
    let shelf = storage::bookshelf(&mut builder.rng, &palette);
    let along = -window * (builder.shell.half.x - 0.75);
    if builder.rng.chance(0.65) {
        builder.place_at_wall(shelf, Wall::Back, along);
    } else {
        let plant = plants::potted_plant(&mut builder.rng, &palette.light);
        builder.place_on_floor(plant, corner, 0.4);
    }
    let plant = plants::potted_plant(&mut builder.rng, &palette.light);
    let other = DVec2::new(window * (builder.shell.half.x - 0.75), -builder.shell.half.y + 0.5);
    builder.place_on_floor(plant, other, 1.0);
    front(builder);
    fill_floor(builder, 4);
    decorate_walls(builder, 8);
}

/// Places sofa, rug, coffee table, armchairs and lamps.
fn seating(builder: &mut SceneBuilder, center: f64, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let sofa = seats::sofa(&mut builder.rng, &palette);
    let size = sofa.size();
    let back = -builder.shell.half.y;
    let host = builder.place_at_wall(sofa, Wall::Back, center);
    let front = builder.footprint_of(host).map_or(back + 1.0, |p| p.center.y + p.half_extents().y);
    let rug_size = [size.x + builder.rng.range(0.2, 0.5), aisle[0] - front + 0.45];
    let rug = textiles::rug(&mut builder.rng, &palette, rug_size);
    builder.place_on_floor(rug, DVec2::new(center, front - 0.2 + rug_size[1] / 2.0), 0.0);
    let table = tables::coffee_table(&mut builder.rng, &palette);
    let at = DVec2::new(center, front + 0.36 + table.size().z / 2.0);
    let table = builder.place_on_floor(table, at, 0.0);
    let books = storage::book_stack(&mut builder.rng, &palette);
    builder.place_on(table, &books);
    for _ in 0..3 {
        let piece = trinket(builder);
        builder.place_on(table, &piece);
        let piece = tableware_piece(builder);
        builder.place_on(table, &piece);
    }
    for side in [-window, window] {
        let color = if side * window > 0.0 { palette.second } else { palette.accent };
        let chair = seats::armchair(&mut builder.rng, &color, &palette);
        let turn = side * -builder.rng.range(1.25, 1.6);
        for out in [0.62, 0.78, 0.95] {
            let at = DVec2::new(center + side * (size.x / 2.0 + out), aisle[0] - 0.62);
            if builder.place_on_floor(chair.clone(), at, turn).is_some() {
                break;
            }
        }
    }
    let beside = size.x / 2.0 + 0.34;
    side_table_with_lamp(builder, DVec2::new(center - window * beside, back + 0.4));
    let lamp = lamps::floor_lamp(&mut builder.rng, &palette);
    builder.place_on_floor(lamp, DVec2::new(center + window * beside, back + 0.42), 0.0);
}

/// Hangs pictures above the sofa.
fn above_sofa(builder: &mut SceneBuilder, center: f64) {
    let palette = builder.palette;
    match builder.rng.index(3) {
        0 => {
            let wide = walls::picture(&mut builder.rng, &palette, [1.25, 0.8]);
            builder.hang_on_wall(wide, Wall::Back, [center, 1.25]);
        }
        1 => {
            for i in -1..=1 {
                let one = walls::picture(&mut builder.rng, &palette, [0.5, 0.66]);
                builder.hang_on_wall(one, Wall::Back, [center + 0.62 * f64::from(i), 1.28]);
            }
        }
        _ => {
            let large = walls::picture(&mut builder.rng, &palette, [0.7, 0.9]);
            builder.hang_on_wall(large, Wall::Back, [center - 0.35, 1.2]);
            for (y, size) in [(1.2, [0.45, 0.42]), (1.66, [0.45, 0.42])] {
                let small = walls::picture(&mut builder.rng, &palette, size);
                builder.hang_on_wall(small, Wall::Back, [center + 0.32, y]);
            }
        }
    }
}

/// Places a fireplace, or a sideboard, at the front wall.
fn front(builder: &mut SceneBuilder) {
    let palette = builder.palette;
    if builder.rng.chance(0.4) {
        let fire = hearth::fireplace(&mut builder.rng, &palette);
        let host = builder.place_at_wall(fire, Wall::Front, 0.0);
        for frac in [-0.8, -0.4, 0.4, 0.8] {
            let piece = trinket(builder);
            builder.place_on_at(host, piece, [frac, 0.0], 0.0);
        }
        let mirror = walls::mirror(&mut builder.rng);
        builder.hang_on_wall(mirror, Wall::Front, [0.0, 1.55]);
        let guitar = instruments::guitar(&mut builder.rng, &palette);
        builder.place_at_wall(guitar, Wall::Front, 1.25);
    } else {
        let board = storage::sideboard(&mut builder.rng, &palette);
        let offset = builder.rng.range(-0.6, 0.6);
        let host = builder.place_at_wall(board, Wall::Front, offset);
        if builder.rng.chance(0.6) {
            let television = devices::television(&mut builder.rng);
            builder.place_on_at(host, television, [0.0, -0.2], 0.0);
        } else {
            lamp_on(builder, host, [-0.8, 0.0]);
            let bowl = tableware::fruit_bowl(&mut builder.rng, &muted_color(1));
            builder.place_on(host, &bowl);
        }
        for _ in 0..3 {
            let piece = trinket(builder);
            builder.place_on(host, &piece);
        }
    }
    let pouf = seats::pouf(&mut builder.rng, &palette.second);
    let x = builder.rng.range(-1.8, 1.8);
    builder.place_on_floor(pouf, DVec2::new(x, builder.shell.half.y - 0.8), PI);
}
