use glam::DVec2;

use super::furnishing::{decorate_walls, fill_floor, tableware_piece, trinket, window_side};
use crate::assets::{decor, devices, instruments, lamps, plants, seats, storage, tables, textiles, walls};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// An artist's studio: easels, sculptures, a guitar, plants.
pub(super) fn furnish_studio(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let half = builder.shell.half;
    let rug = textiles::rug(&mut builder.rng, &palette, [2.2, 1.5]);
    builder.place_on_floor(rug, DVec2::new(0.0, aisle[0] - 0.55), 0.0);
    for (x, turn) in [(-1.1, 0.35), (0.75, -0.3)] {
        let easel = decor::easel(&mut builder.rng, &palette);
        builder.place_on_floor(easel, DVec2::new(x, -half.y + 0.8), turn);
    }
    let stool = seats::stool(&mut builder.rng, &palette);
    builder.place_on_floor(stool, DVec2::new(-0.3, aisle[0] - 0.4), 0.3);
    let guitar = instruments::guitar(&mut builder.rng, &palette);
    builder.place_on_floor(guitar, DVec2::new(-window * (half.x - 0.45), aisle[0] - 0.45), window * 0.9);
    let table = tables::workbench(&mut builder.rng, &palette);
    let host = builder.place_at_wall(table, Wall::Front, window * 0.5);
    for _ in 0..3 {
        let piece = trinket(builder);
        builder.place_on(host, &piece);
        let piece = tableware_piece(builder);
        builder.place_on(host, &piece);
    }
    let bust = decor::sculpture(&mut builder.rng, &palette);
    builder.place_on(host, &bust);
    let chair = seats::armchair(&mut builder.rng, &palette.accent, &palette);
    builder.place_on_floor(chair, DVec2::new(-window * (half.x - 0.6), half.y - 0.6), window * 2.4);
    let lamp = lamps::floor_lamp(&mut builder.rng, &palette);
    builder.place_at_any_wall(&lamp);
    for _ in 0..2 {
        let plant = plants::potted_plant(&mut builder.rng, &palette.second);
        builder.place_at_any_wall(&plant);
    }
    fill_floor(builder, 3);
    decorate_walls(builder, 8);
}

/// A workbench under a tool wall, a chest of drawers, a desk.
pub(super) fn furnish_workshop(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let half = builder.shell.half;
    let bench = tables::workbench(&mut builder.rng, &palette);
    let host = builder.place_at_wall(bench, Wall::Back, -window * 0.3);
    let tools = walls::tool_wall(&mut builder.rng, &palette.second);
    builder.hang_on_wall(tools, Wall::Back, [-window * 0.3, 1.3]);
    builder.place_on_at(host, devices::toolbox(&palette.accent), [0.3, 0.1], 0.2);
    let color = muted_color(builder.rng.index(NUM_MUTED_COLORS));
    let radio = devices::radio(&mut builder.rng, &color);
    builder.place_on_at(host, radio, [-0.3, -0.5], 0.0);
    let lamp = lamps::desk_lamp(&mut builder.rng, &palette.accent);
    builder.place_on_at(host, lamp, [0.85, -0.4], 0.0);
    let stool = seats::stool(&mut builder.rng, &palette);
    builder.place_on_floor(stool, DVec2::new(-window * 0.5, -half.y + 1.3), 0.2);
    let shelf = storage::bookshelf(&mut builder.rng, &palette);
    builder.place_at_wall(shelf, Wall::Back, window * (half.x - 0.8));
    let chest = storage::dresser(&mut builder.rng, &palette);
    let host = builder.place_at_any_wall(&chest);
    builder.place_on(host, &devices::toolbox(&palette.second));
    let table = tables::desk(&mut builder.rng, &palette);
    let host = builder.place_at_wall(table, Wall::Front, 0.2);
    for _ in 0..3 {
        let piece = trinket(builder);
        builder.place_on(host, &piece);
    }
    let wood = crate::material::Material::wood(palette.wood.linear, 3);
    let chair = seats::chair(builder.rng.seed(), wood, wood);
    builder.place_on_floor(chair, DVec2::new(0.0, aisle[1] + 0.3), 0.2);
    let pendant = lamps::pendant(&mut builder.rng, &palette.dark, 0.7);
    builder.hang_from_ceiling(pendant, DVec2::new(0.0, -half.y + 0.8));
    let basket = storage::basket(&mut builder.rng, &palette);
    builder.place_at_any_wall(&basket);
    let plant = plants::potted_plant(&mut builder.rng, &palette.accent);
    builder.place_at_any_wall(&plant);
    fill_floor(builder, 3);
    decorate_walls(builder, 7);
}
