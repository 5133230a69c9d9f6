use glam::DVec2;

use super::furnishing::{chairs_around, decorate_walls, fill_floor, tableware_piece, window_side};
use crate::assets::{kitchen, lamps, plants, seats, tables, tableware, walls};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// Kitchen units at the back wall, a table with chairs at the front.
pub(super) fn furnish(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let color = if builder.rng.chance(0.5) { palette.main } else { palette.feature };
    units(builder, &color);
    let middle = DVec2::new(-window * 0.3, f64::midpoint(aisle[1], builder.shell.half.y) + 0.1);
    let table = tables::dining_table(&mut builder.rng, &palette);
    let table = builder.place_on_floor(table, middle, 0.0);
    chairs_around(builder, table, builder.shell.half.x > 3.1);
    let pendant = lamps::pendant(&mut builder.rng, &palette.accent, builder.shell.height - 1.55);
    builder.hang_from_ceiling(pendant, middle);
    let bowl = tableware::fruit_bowl(&mut builder.rng, &palette.second);
    builder.place_on_at(table, bowl, [0.0, 0.0], 0.0);
    for _ in 0..6 {
        let piece = tableware_piece(builder);
        builder.place_on(table, &piece);
    }
    let plant = plants::potted_plant(&mut builder.rng, &palette.second);
    builder.place_at_any_wall(&plant);
    for _ in 0..2 {
        let stool = seats::stool(&mut builder.rng, &palette);
        builder.place_at_any_wall(&stool);
    }
    fill_floor(builder, 2);
    decorate_walls(builder, 4);
}

/// Places refrigerator, counters, stove and wall cabinets.
fn units(builder: &mut SceneBuilder, color: &crate::color::NamedColor) {
    let palette = builder.palette;
    let half = builder.shell.half.x;
    let fridge = kitchen::fridge(&mut builder.rng, &palette.light);
    builder.place_at_wall(fridge, Wall::Back, -half + 0.42);
    let stove_at = half - 1.35;
    let left = -half + 0.82;
    let width = stove_at - 0.34 - left;
    let counter = kitchen::counter(&mut builder.rng, color, width);
    let host = builder.place_at_wall(counter, Wall::Back, left + width / 2.0);
    let stove = kitchen::stove(&palette.light);
    let stove = builder.place_at_wall(stove, Wall::Back, stove_at);
    let rest = half - 0.06 - (stove_at + 0.34);
    let corner = kitchen::counter(&mut builder.rng, color, rest);
    let corner = builder.place_at_wall(corner, Wall::Back, stove_at + 0.34 + rest / 2.0);
    for (at, wide) in [(left + width * 0.27, width * 0.48), (left + width * 0.76, width * 0.44)] {
        builder.hang_on_wall(kitchen::wall_cabinet(color, wide), Wall::Back, [at, 1.5]);
    }
    let clock = walls::clock(&mut builder.rng, &palette);
    builder.hang_on_wall(clock, Wall::Back, [stove_at, 1.7]);
    let pot = kitchen::cooking_pot(&mut builder.rng, &palette.accent);
    builder.place_on(stove, &pot);
    for host in [host, host, host, corner] {
        let small = muted_color(builder.rng.index(NUM_MUTED_COLORS));
        let piece = if builder.rng.chance(0.3) {
            plants::small_plant(&mut builder.rng, &small)
        } else {
            tableware_piece(builder)
        };
        builder.place_on(host, &piece);
    }
}
