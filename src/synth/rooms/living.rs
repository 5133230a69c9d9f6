use std::f64::consts::PI;

use glam::DVec2;

use super::super::color::small_hue;
use super::super::models::{devices, hearth, lamps, plants, seats, storage, tables, tableware, textiles, walls};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{fill_floor, hang_things, lamp_on, side_table_with_lamp, tableware_piece, trinket, window_side};

/// Sofa group at the back, aisle, sideboard with television or a fireplace at the front.
pub(super) fn furnish(stage: &mut Stage, aisle: [f64; 2]) {
    let window = window_side(stage);
    let center = -window * stage.dice.range(0.0, 0.35);
    seating(stage, center, aisle);
    above_sofa(stage, center);
    let corner = DVec2::new(-window * (stage.shell.half.x - 0.42), -stage.shell.half.y + 0.42);
    let palette = stage.palette;
    let shelf = storage::bookshelf(&mut stage.dice, &palette);
    let along = -window * (stage.shell.half.x - 0.75);
    if stage.dice.chance(0.65) {
        stage.against(shelf, Wall::Back, along);
    } else {
        let plant = plants::potted_plant(&mut stage.dice, &palette.light);
        stage.stand(plant, corner, 0.4);
    }
    let plant = plants::potted_plant(&mut stage.dice, &palette.light);
    let other = DVec2::new(window * (stage.shell.half.x - 0.75), -stage.shell.half.y + 0.5);
    stage.stand(plant, other, 1.0);
    front(stage);
    fill_floor(stage, 4);
    hang_things(stage, 8);
}

fn seating(stage: &mut Stage, center: f64, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let sofa = seats::sofa(&mut stage.dice, &palette);
    let size = sofa.size();
    let back = -stage.shell.half.y;
    let host = stage.against(sofa, Wall::Back, center);
    let front = stage.print_of(host).map_or(back + 1.0, |p| p.center.y + p.extent().y);
    let rug_size = [size.x + stage.dice.range(0.2, 0.5), aisle[0] - front + 0.45];
    let rug = textiles::rug(&mut stage.dice, &palette, rug_size);
    stage.stand(rug, DVec2::new(center, front - 0.2 + rug_size[1] / 2.0), 0.0);
    let table = tables::coffee_table(&mut stage.dice, &palette);
    let at = DVec2::new(center, front + 0.36 + table.size().z / 2.0);
    let table = stage.stand(table, at, 0.0);
    let books = storage::book_stack(&mut stage.dice, &palette);
    stage.on(table, &books);
    for _ in 0..3 {
        let piece = trinket(stage);
        stage.on(table, &piece);
        let piece = tableware_piece(stage);
        stage.on(table, &piece);
    }
    for side in [-window, window] {
        let hue = if side * window > 0.0 { palette.second } else { palette.accent };
        let chair = seats::armchair(&mut stage.dice, &hue, &palette);
        let turn = side * -stage.dice.range(1.25, 1.6);
        for out in [0.62, 0.78, 0.95] {
            let at = DVec2::new(center + side * (size.x / 2.0 + out), aisle[0] - 0.62);
            if stage.stand(chair.clone(), at, turn).is_some() {
                break;
            }
        }
    }
    let beside = size.x / 2.0 + 0.34;
    side_table_with_lamp(stage, DVec2::new(center - window * beside, back + 0.4));
    let lamp = lamps::floor_lamp(&mut stage.dice, &palette);
    stage.stand(lamp, DVec2::new(center + window * beside, back + 0.42), 0.0);
}

fn above_sofa(stage: &mut Stage, center: f64) {
    let palette = stage.palette;
    match stage.dice.index(3) {
        0 => {
            let wide = walls::picture(&mut stage.dice, &palette, [1.25, 0.8]);
            stage.hang(wide, Wall::Back, [center, 1.25]);
        }
        1 => {
            for i in -1..=1 {
                let one = walls::picture(&mut stage.dice, &palette, [0.5, 0.66]);
                stage.hang(one, Wall::Back, [center + 0.62 * f64::from(i), 1.28]);
            }
        }
        _ => {
            let large = walls::picture(&mut stage.dice, &palette, [0.7, 0.9]);
            stage.hang(large, Wall::Back, [center - 0.35, 1.2]);
            for (y, size) in [(1.2, [0.45, 0.42]), (1.66, [0.45, 0.42])] {
                let small = walls::picture(&mut stage.dice, &palette, size);
                stage.hang(small, Wall::Back, [center + 0.32, y]);
            }
        }
    }
}

fn front(stage: &mut Stage) {
    let palette = stage.palette;
    if stage.dice.chance(0.4) {
        let fire = hearth::fireplace(&mut stage.dice, &palette);
        let host = stage.against(fire, Wall::Front, 0.0);
        for frac in [-0.8, -0.4, 0.4, 0.8] {
            let piece = trinket(stage);
            stage.on_at(host, piece, [frac, 0.0], 0.0);
        }
        let mirror = walls::mirror(&mut stage.dice);
        stage.hang(mirror, Wall::Front, [0.0, 1.55]);
        let guitar = super::instruments::guitar(&mut stage.dice, &palette);
        stage.against(guitar, Wall::Front, 1.25);
    } else {
        let board = storage::sideboard(&mut stage.dice, &palette);
        let offset = stage.dice.range(-0.6, 0.6);
        let host = stage.against(board, Wall::Front, offset);
        if stage.dice.chance(0.6) {
            let television = devices::television(&mut stage.dice);
            stage.on_at(host, television, [0.0, -0.2], 0.0);
        } else {
            lamp_on(stage, host, [-0.8, 0.0]);
            let bowl = tableware::fruit_bowl(&mut stage.dice, &small_hue(1));
            stage.on(host, &bowl);
        }
        for _ in 0..3 {
            let piece = trinket(stage);
            stage.on(host, &piece);
        }
    }
    let pouf = seats::pouf(&mut stage.dice, &palette.second);
    let x = stage.dice.range(-1.8, 1.8);
    stage.stand(pouf, DVec2::new(x, stage.shell.half.y - 0.8), PI);
}
