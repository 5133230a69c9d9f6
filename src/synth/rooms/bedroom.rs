use glam::DVec2;

use super::furnishing::{decorate_walls, fill_floor, lamp_on, trinket, window_side};
use crate::assets::{beds, lamps, plants, seats, storage, tables, textiles, walls};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// A bed between nightstands at the back wall; a wardrobe and a chest of drawers at the front wall.
pub(super) fn furnish(builder: &mut SceneBuilder, aisle: [f64; 2]) {
    let palette = builder.palette;
    let window = window_side(builder);
    let back = -builder.shell.half.y;
    let bed = beds::bed(&mut builder.rng, &palette);
    let size = bed.size();
    let center = -window * 0.1;
    let rug = textiles::rug(&mut builder.rng, &palette, [size.x + 1.0, 1.5]);
    builder.place_on_floor(rug, DVec2::new(center, aisle[0] - 0.5), 0.0);
    builder.place_at_wall(bed, Wall::Back, center);
    for side in [-1.0, 1.0] {
        let stand = tables::nightstand(&mut builder.rng, &palette);
        let along = center + side * (size.x / 2.0 + stand.size().x / 2.0 + 0.06);
        let host = builder.place_at_wall(stand, Wall::Back, along);
        lamp_on(builder, host, [0.0, -0.1]);
        let piece = storage::book_stack(&mut builder.rng, &palette);
        builder.place_on(host, &piece);
    }
    let wide = walls::picture(&mut builder.rng, &palette, [1.1, 0.7]);
    builder.hang_on_wall(wide, Wall::Back, [center, 1.4]);
    let bench = seats::bench(&mut builder.rng, &palette);
    builder.place_on_floor(bench, DVec2::new(center, back + size.z + 0.3), 0.0);
    let wardrobe = storage::wardrobe(&mut builder.rng, &palette.light);
    let half = builder.shell.half.x - 0.9;
    builder.place_along_wall(&wardrobe, Wall::Front, [-half, half]);
    let dresser = storage::dresser(&mut builder.rng, &palette);
    let host = builder.place_along_wall(&dresser, Wall::Front, [-half, half]);
    for _ in 0..3 {
        let piece = trinket(builder);
        builder.place_on(host, &piece);
    }
    let chair = seats::armchair(&mut builder.rng, &palette.accent, &palette);
    builder.place_on_floor(
        chair,
        DVec2::new(window * (builder.shell.half.x - 0.85), builder.shell.half.y - 0.7),
        -window * 2.4,
    );
    let lamp = lamps::floor_lamp(&mut builder.rng, &palette);
    builder.place_at_any_wall(&lamp);
    let plant = plants::potted_plant(&mut builder.rng, &palette.light);
    builder.place_at_any_wall(&plant);
    fill_floor(builder, 3);
    decorate_walls(builder, 5);
}
