use glam::DVec2;

use super::furnishing::{chairs_around, decorate_walls, fill_floor, trinket, window_side};
use crate::assets::{decor, lamps, plants, storage, tables, tableware, textiles};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// A set table under two pendant lamps at the back, a sideboard and a bookshelf at the walls.
pub(super) fn furnish(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let back = -builder.shell.half.y;
    let middle = DVec2::new(-window * 0.15, f64::midpoint(back, aisle[0]) + 0.02);
    let rug = textiles::rug(&mut builder.rng, &palette, [2.7, 1.9]);
    builder.place_on_floor(rug, middle, 0.0);
    let table = tables::dining_table(&mut builder.rng, &palette);
    let table = builder.place_on_floor(table, middle, 0.0);
    chairs_around(builder, table, true);
    let drop = builder.shell.height - 1.5;
    let color = if builder.rng.chance(0.5) { palette.dark } else { palette.accent };
    for x in [-0.36, 0.36] {
        let pendant = lamps::pendant(&mut builder.rng, &color, drop);
        builder.hang_from_ceiling(pendant, middle + DVec2::new(x, 0.0));
    }
    set_table(builder, table);
    let board = storage::sideboard(&mut builder.rng, &palette);
    let host = builder.place_at_wall(board, Wall::Front, window * -0.6);
    for _ in 0..4 {
        let piece = trinket(builder);
        builder.place_on(host, &piece);
    }
    let shelf = storage::bookshelf(&mut builder.rng, &palette);
    builder.place_at_any_wall(&shelf);
    let plant = plants::potted_plant(&mut builder.rng, &palette.second);
    builder.place_at_any_wall(&plant);
    fill_floor(builder, 3);
    decorate_walls(builder, 7);
}

/// Sets the table: plates, glasses, a bottle, a vase and a bowl.
fn set_table(builder: &mut SceneBuilder, table: Option<usize>) {
    let palette = builder.palette;
    let vase = decor::vase(&mut builder.rng, &palette.second, &palette);
    builder.place_on_at(table, vase, [0.0, 0.0], 0.0);
    let color = muted_color(builder.rng.index(NUM_MUTED_COLORS));
    for (x, z) in [(-0.52, 0.7), (0.52, 0.7), (-0.52, -0.7), (0.52, -0.7)] {
        let plate = tableware::plate(&mut builder.rng, &color);
        builder.place_on_at(table, plate, [x, z], 0.0);
        let glass = tableware::wine_glass(&mut builder.rng);
        builder.place_on_at(table, glass, [x + 0.24, z * 0.5], 0.0);
    }
    let bottle = tableware::bottle(&mut builder.rng, &muted_color(2));
    builder.place_on_at(table, bottle, [-0.2, 0.0], 0.0);
    let bowl = tableware::fruit_bowl(&mut builder.rng, &muted_color(1));
    builder.place_on_at(table, bowl, [-0.75, 0.0], 0.0);
}
