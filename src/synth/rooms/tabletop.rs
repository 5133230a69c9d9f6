use glam::DVec2;

use super::furnishing::{decorate_walls, fill_floor, tableware_piece, trinket};
use crate::assets::{decor, devices, lamps, plants, tables, tableware, textiles};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::scene_builder::SceneBuilder;

/// A table in the middle of a room with a still life on it.
pub(super) fn furnish(builder: &mut SceneBuilder) {
    let palette = builder.palette;
    let middle = DVec2::new(0.0, -0.35);
    let rug = textiles::rug(&mut builder.rng, &palette, [2.4, 1.7]);
    builder.place_on_floor(rug, middle, 0.0);
    // Free space on all sides of the table, so that a camera can orbit it.
    builder.reserve(DVec2::new(0.0, middle.y), DVec2::new(1.9, 1.2));
    let around_table = builder.reserved.pop();
    let table = tables::still_life_table(&mut builder.rng, &palette);
    let table = builder.place_on_floor(table, middle, 0.0);
    builder.reserved.extend(around_table);
    let color = muted_color(builder.rng.index(NUM_MUTED_COLORS));
    let centerpiece = match builder.rng.index(4) {
        0 => decor::vase(&mut builder.rng, &palette.second, &palette),
        1 => tableware::fruit_bowl(&mut builder.rng, &color),
        2 => lamps::table_lamp(&mut builder.rng, &palette.accent, &palette),
        _ => decor::sculpture(&mut builder.rng, &palette),
    };
    still_life(builder, table, centerpiece);
    fill_floor(builder, 2);
    decorate_walls(builder, 4);
}

/// Places the centerpiece and small objects on the table.
fn still_life(builder: &mut SceneBuilder, table: Option<usize>, centerpiece: crate::asset::Asset) {
    let palette = builder.palette;
    // The reserved space applies to the floor; objects on the table stay within the table's footprint.
    let reserved = std::mem::take(&mut builder.reserved);
    builder.place_on_at(table, centerpiece, [0.0, -0.1], 0.3);
    for _ in 0..4 {
        let piece = tableware_piece(builder);
        builder.place_on(table, &piece);
        let piece = trinket(builder);
        builder.place_on(table, &piece);
    }
    let color = muted_color(builder.rng.index(NUM_MUTED_COLORS));
    let extra = match builder.rng.index(4) {
        0 => devices::laptop(&mut builder.rng),
        1 => plants::small_plant(&mut builder.rng, &color),
        2 => tableware::teapot(&mut builder.rng, &color),
        _ => lamps::desk_lamp(&mut builder.rng, &palette.accent),
    };
    builder.place_on(table, &extra);
    builder.reserved = reserved;
}
