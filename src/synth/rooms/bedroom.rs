use glam::DVec2;

use super::super::models::{beds, lamps, plants, seats, storage, tables, textiles, walls};
use super::super::shell::Wall;
use super::super::stage::Stage;
use super::{fill_floor, hang_things, lamp_on, trinket, window_side};

/// A bed at the back wall between nightstands, wardrobe and drawers along the others.
pub(super) fn furnish(stage: &mut Stage, aisle: [f64; 2]) {
    let palette = stage.palette;
    let window = window_side(stage);
    let back = -stage.shell.half.y;
    let bed = beds::bed(&mut stage.dice, &palette);
    let size = bed.size();
    let center = -window * 0.1;
    let rug = textiles::rug(&mut stage.dice, &palette, [size.x + 1.0, 1.5]);
    stage.stand(rug, DVec2::new(center, aisle[0] - 0.5), 0.0);
    stage.against(bed, Wall::Back, center);
    for side in [-1.0, 1.0] {
        let stand = tables::nightstand(&mut stage.dice, &palette);
        let along = center + side * (size.x / 2.0 + stand.size().x / 2.0 + 0.06);
        let host = stage.against(stand, Wall::Back, along);
        lamp_on(stage, host, [0.0, -0.1]);
        let piece = storage::book_stack(&mut stage.dice, &palette);
        stage.on(host, &piece);
    }
    let wide = walls::picture(&mut stage.dice, &palette, [1.1, 0.7]);
    stage.hang(wide, Wall::Back, [center, 1.4]);
    let bench = seats::bench(&mut stage.dice, &palette);
    stage.stand(bench, DVec2::new(center, back + size.z + 0.3), 0.0);
    let wardrobe = storage::wardrobe(&mut stage.dice, &palette.light);
    let half = stage.shell.half.x - 0.9;
    stage.along(&wardrobe, Wall::Front, [-half, half]);
    let dresser = storage::dresser(&mut stage.dice, &palette);
    let host = stage.along(&dresser, Wall::Front, [-half, half]);
    for _ in 0..3 {
        let piece = trinket(stage);
        stage.on(host, &piece);
    }
    let chair = seats::armchair(&mut stage.dice, &palette.accent, &palette);
    stage.stand(chair, DVec2::new(window * (stage.shell.half.x - 0.85), stage.shell.half.y - 0.7), -window * 2.4);
    let lamp = lamps::floor_lamp(&mut stage.dice, &palette);
    stage.anywhere(&lamp);
    let plant = plants::potted_plant(&mut stage.dice, &palette.light);
    stage.anywhere(&plant);
    fill_floor(stage, 3);
    hang_things(stage, 5);
}
