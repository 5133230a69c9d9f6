//! Steps that the recipes of several room types share.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;
use strum::VariantArray;

use crate::asset::Asset;
use crate::assets::{decor, devices, instruments, lamps, plants, seats, storage, tables, tableware, walls};
use crate::color::{NUM_MUTED_COLORS, muted_color};
use crate::material::Material;
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// A random small object for a table or a sideboard.
pub(super) fn trinket(builder: &mut SceneBuilder) -> Asset {
    let (rng, palette) = (&mut builder.rng, builder.palette);
    let color = muted_color(rng.index(NUM_MUTED_COLORS));
    match rng.index(9) {
        0 => decor::vase(rng, &color, &palette),
        1 => storage::book_stack(rng, &palette),
        2 => lamps::candle(rng, &palette),
        3 => plants::small_plant(rng, &color),
        4 => decor::sculpture(rng, &palette),
        5 => decor::globe(rng, &palette),
        6 => devices::radio(rng, &color),
        7 => plants::cactus(rng, &color),
        _ => decor::vase(rng, &palette.accent, &palette),
    }
}

/// A random piece of tableware.
pub(super) fn tableware_piece(builder: &mut SceneBuilder) -> Asset {
    let rng = &mut builder.rng;
    let color = muted_color(rng.index(NUM_MUTED_COLORS));
    match rng.index(6) {
        0 => tableware::mug(rng, &color),
        1 => tableware::teapot(rng, &color),
        2 => tableware::fruit_bowl(rng, &color),
        3 => tableware::bottle(rng, &color),
        4 => tableware::wine_glass(rng),
        _ => tableware::plate(rng, &color),
    }
}

/// A random large object for the floor.
fn floor_piece(builder: &mut SceneBuilder) -> Asset {
    let (rng, palette) = (&mut builder.rng, builder.palette);
    match rng.index(9) {
        0 | 1 => plants::potted_plant(rng, &palette.light),
        2 => instruments::guitar(rng, &palette),
        3 => storage::basket(rng, &palette),
        4 => seats::pouf(rng, &palette.second),
        5 => decor::telescope(&palette),
        6 => storage::bookshelf(rng, &palette),
        7 => lamps::floor_lamp(rng, &palette),
        _ => decor::easel(rng, &palette),
    }
}

/// Hangs up to `count` pictures, mirrors, shelves and at most one clock at random positions of the walls.
pub(super) fn decorate_walls(builder: &mut SceneBuilder, count: usize) {
    for _ in 0..count {
        let wall = builder.rng.pick(Wall::VARIANTS);
        let palette = builder.palette;
        let has_clock = builder.placed.iter().any(|placed| placed.asset.kind == "clock");
        let (asset, height) = match builder.rng.index(6) {
            0 if !has_clock => (walls::clock(&mut builder.rng, &palette), 1.75),
            1 => (walls::mirror(&mut builder.rng), 1.25),
            2 => (storage::wall_shelf(&mut builder.rng, &palette), 1.45),
            _ => {
                let size = builder.rng.pick(&[[0.5, 0.7], [0.8, 0.6], [0.6, 0.6], [0.45, 0.6]]);
                (walls::picture(&mut builder.rng, &palette, size), 1.6 - size[1] / 2.0)
            }
        };
        builder.hang_along_wall(&asset, wall, height);
    }
}

/// Places up to `count` large objects at random positions of the walls.
pub(super) fn fill_floor(builder: &mut SceneBuilder, count: usize) {
    for _ in 0..count {
        let asset = floor_piece(builder);
        builder.place_at_any_wall(&asset);
    }
}

/// Places chairs at the long sides of a table that extends along x and, if `heads` is set, at its ends.
pub(super) fn chairs_around(builder: &mut SceneBuilder, table: Option<usize>, heads: bool) {
    let Some(footprint) = builder.footprint_of(table) else { return };
    let wood = Material::wood(builder.palette.wood.linear, 5);
    let seat = if builder.rng.chance(0.5) { Material::cloth(builder.palette.accent.linear, 6) } else { wood };
    let style = builder.rng.seed();
    let chair = seats::chair(style, wood, seat);
    let out = chair.size().z / 2.0 + 0.035;
    let half = footprint.half_extents();
    let quarter = half.x * 0.48;
    for (x, side) in [(-quarter, 1.0), (quarter, 1.0), (-quarter, -1.0), (quarter, -1.0)] {
        let wobble = builder.rng.range(-0.12, 0.12);
        let at = footprint.center + DVec2::new(x, side * (half.y + out + builder.rng.range(0.02, 0.07)));
        // The front faces the table.
        let yaw = if side > 0.0 { PI } else { 0.0 };
        builder.place_on_floor(chair.clone(), at, yaw + wobble);
    }
    if heads {
        for side in [-1.0, 1.0] {
            let at = footprint.center + DVec2::new(side * (half.x + out + 0.04), 0.0);
            builder.place_on_floor(chair.clone(), at, -side * FRAC_PI_2);
        }
    }
}

/// Places a lamp on a table, at fractions of its support surface.
pub(super) fn lamp_on(builder: &mut SceneBuilder, host: Option<usize>, frac: [f64; 2]) {
    let palette = builder.palette;
    let color = if builder.rng.chance(0.5) { palette.accent } else { palette.second };
    let lamp = lamps::table_lamp(&mut builder.rng, &color, &palette);
    builder.place_on_at(host, lamp, frac, 0.0);
}

/// Side of the windows: -1 at -x, +1 at +x.
pub(super) fn window_side(builder: &SceneBuilder) -> f64 {
    builder.shell.openings.first().map_or(-1.0, |o| if o.wall == Wall::Left { -1.0 } else { 1.0 })
}

/// Places a side table with a lamp.
pub(super) fn side_table_with_lamp(builder: &mut SceneBuilder, at: DVec2) {
    let palette = builder.palette;
    let table = tables::side_table(&mut builder.rng, &palette);
    let host = builder.place_on_floor(table, at, 0.0);
    lamp_on(builder, host, [0.0, 0.0]);
}
