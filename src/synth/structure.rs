//! The structure of a room as primitives: floor, walls with window openings, ceiling, trims and the view outside.

use glam::{DVec3, Vec3};

use super::asset::Asset;
use super::color::Palette;
use super::faces;
use super::flooring::{self, LAP, tinted};
use super::material::{Material, Pattern};
use super::noise;
use super::rng::SceneRng;
use super::shell::{Finish, Opening, Shell, Wall};
use strum::VariantArray;

impl Shell {
    /// The whole structure as one asset in the world's frame, with the object id 0.
    pub(super) fn asset(&self, rng: &mut SceneRng, palette: &Palette) -> Asset {
        let mut asset = Asset::new("room");
        flooring::lay(&mut asset, self, rng, palette);
        for &wall in Wall::VARIANTS {
            let mut side = Asset::new("wall");
            self.add_wall(&mut side, wall, rng, palette);
            asset.attach(&side, &self.world_from_wall(wall));
        }
        let (x, z) = (2.0 * self.half.x + LAP, 2.0 * self.half.y + LAP);
        let white = Material::plain(Vec3::new(0.8, 0.79, 0.76));
        asset.block([0.0, self.height + 0.05, 0.0], [x, 0.1, z], 0.0, white).only(faces::BOTTOM).cell_scale(2.2);
        for opening in &self.openings {
            self.add_view(&mut asset, opening, rng);
        }
        asset
    }

    /// Adds a wall in its own frame.
    fn add_wall(&self, side: &mut Asset, wall: Wall, rng: &mut SceneRng, palette: &Palette) {
        let half = self.half_length(wall);
        let finish = if wall == Wall::Back { self.finish } else { Finish::Painted };
        let color = if wall == Wall::Back { palette.feature } else { palette.wall };
        let material = match finish {
            Finish::Striped => Material::patterned(Pattern::Stripes, color.linear, color.linear * 0.82 + 0.03, 0.12),
            Finish::Brick => Material::plain(Vec3::splat(0.3)),
            _ => Material { scale: 0.6, ..Material::plain(color.linear) },
        };
        let coarse = if finish == Finish::Striped { 1.0 } else { 1.6 };
        let own: Vec<&Opening> = self.openings.iter().filter(|o| o.wall == wall).collect();
        let mut piece = |low: [f64; 2], high: [f64; 2]| {
            let center = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1]), -0.05];
            side.block(center, [high[0] - low[0], high[1] - low[1], 0.1], 0.0, material)
                .only(faces::FRONT)
                .cell_scale(coarse);
        };
        let mut from = -half - LAP;
        let mut sorted = own.clone();
        sorted.sort_by(|a, b| a.at.total_cmp(&b.at));
        for opening in &sorted {
            let (left, right) = (opening.at - opening.size[0] / 2.0, opening.at + opening.size[0] / 2.0);
            piece([from, -LAP], [left, self.height + LAP]);
            piece([left - 0.03, -LAP], [right + 0.03, opening.sill]);
            piece([left - 0.03, opening.sill + opening.size[1]], [right + 0.03, self.height + LAP]);
            from = right;
        }
        piece([from, -LAP], [half + LAP, self.height + LAP]);
        if finish == Finish::Brick {
            brickwork(side, half, self.height, rng.seed());
        }
        self.add_trims(side, half, finish, &own);
        for opening in own {
            add_reveal(side, opening);
        }
    }

    /// Adds skirting board, cornice and, on a paneled wall without windows, the panels.
    fn add_trims(&self, side: &mut Asset, half: f64, finish: Finish, openings: &[&Opening]) {
        let material = Material::plain(Vec3::new(0.76, 0.74, 0.7)).gloss(0.2);
        let length = 2.0 * half;
        side.block([0.0, 0.05, 0.004], [length, 0.1, 0.02], 0.005, material)
            .only(faces::FRONT | faces::TOP)
            .stretched(2.0);
        side.block([0.0, self.height - 0.03, 0.01], [length, 0.06, 0.03], 0.012, material)
            .only(faces::FRONT | faces::BOTTOM)
            .stretched(2.0);
        if finish == Finish::Paneled && openings.is_empty() {
            side.block([0.0, 0.98, 0.006], [length, 0.045, 0.03], 0.01, material)
                .only(faces::FRONT | faces::TOP | faces::BOTTOM)
                .stretched(2.0);
            side.block([0.0, 0.53, -0.046], [length, 0.86, 0.1], 0.0, material).only(faces::FRONT).cell_scale(1.5);
            let count = (length / 0.62).round();
            for i in 0..count as u32 {
                let x = (f64::from(i) + 0.5) * length / count - half;
                let [w, h] = [length / count - 0.14, 0.62];
                for s in [-1.0, 1.0] {
                    side.block([x + s * w / 2.0, 0.54, 0.006], [0.02, h + 0.02, 0.014], 0.004, material)
                        .only(faces::FRONT | faces::SIDES)
                        .cell_scale(0.8)
                        .no_shadow();
                    side.block([x, 0.54 + s * h / 2.0, 0.006], [w, 0.02, 0.014], 0.004, material)
                        .only(faces::FRONT | faces::SIDES)
                        .cell_scale(0.8)
                        .no_shadow();
                }
            }
        }
    }

    /// Adds the view behind a window.
    fn add_view(&self, asset: &mut Asset, opening: &Opening, rng: &mut SceneRng) {
        let world_from_wall = self.world_from_wall(opening.wall);
        let (width, height) = (opening.size[0] + 8.0, opening.size[1] + 5.0);
        let sky = Vec3::new(0.62, 0.78, 0.98) * self.outside;
        let trees = Vec3::new(0.13, 0.2, 0.06) * self.outside;
        let material = Material::patterned(Pattern::Outside, sky, trees, 0.3).emission(1.0).seeded(rng.seed());
        let (x, y) = (opening.at - width / 2.0, opening.sill + opening.size[1] / 2.0 - height / 2.0);
        let far = move |u: f64, v: f64| world_from_wall.apply(DVec3::new(x + u * width, y + v * height, -1.4));
        asset.sheet([width, height], material, far).cell_scale(2.6).no_shadow();
    }
}

/// Adds the four inner sides of an opening.
fn add_reveal(side: &mut Asset, opening: &Opening) {
    let material = Material::plain(Vec3::splat(0.76));
    let ([width, height], deep) = (opening.size, 0.14);
    let (x, y) = (opening.at, opening.sill + height / 2.0);
    let z = -deep / 2.0;
    side.block([x - width / 2.0 - 0.02, y, z], [0.04, height, deep], 0.0, material).only(faces::RIGHT);
    side.block([x + width / 2.0 + 0.02, y, z], [0.04, height, deep], 0.0, material).only(faces::LEFT);
    side.block([x, y - height / 2.0 - 0.02, z], [width, 0.04, deep], 0.0, material).only(faces::TOP);
    side.block([x, y + height / 2.0 + 0.02, z], [width, 0.04, deep], 0.0, material).only(faces::BOTTOM);
}

/// Adds rows of single bricks over a wall.
fn brickwork(side: &mut Asset, half: f64, height: f64, seed: u32) {
    let (long, tall) = (0.25, 0.078);
    let base = if seed & 1 == 0 { Vec3::new(0.36, 0.14, 0.09) } else { Vec3::new(0.62, 0.58, 0.53) };
    let spread = if seed & 1 == 0 { 0.3 } else { 0.1 };
    let mortar = [(2.0 * half / long).ceil() as i32 + 1, (height / tall).ceil() as i32];
    for row in 0..mortar[1] {
        for column in 0..mortar[0] {
            let shift = f64::from(row % 2) * 0.5 * long;
            let low = (-half + long * f64::from(column) - shift).max(-half);
            let high = (-half + long * f64::from(column + 1) - shift).min(half);
            let (bottom, top) = (tall * f64::from(row), (tall * f64::from(row + 1)).min(height));
            if high - low < 0.03 || top - bottom < 0.02 {
                continue;
            }
            let color = tinted(base, spread, noise::unit_hash(row, column, seed));
            let material = Material::patterned(Pattern::Speckle, color, color * 0.75, 0.04)
                .seeded(seed ^ (row * 67 + column) as u32);
            let center = [f64::midpoint(low, high), f64::midpoint(bottom, top), -0.004];
            side.block(center, [high - low - 0.012, top - bottom - 0.011, 0.02], 0.0, material)
                .only(faces::FRONT)
                .cell_scale(1.25)
                .stretched(1.6)
                .no_shadow();
        }
    }
}
