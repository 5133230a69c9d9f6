use glam::{DVec2, DVec3, Vec3};

use super::asset::Asset;
use super::color::Palette;
use super::faces;
use super::material::{Material, Pattern};
use super::noise;
use super::rng::SceneRng;
use super::shell::{Flooring, Shell};

/// Overlap of floor, walls and ceiling beyond the corners, m: closes the corners against light.
pub(super) const LAP: f64 = 0.06;

/// Adds the floor of a room: the covering over a plane in the color of its gaps.
pub(super) fn lay(asset: &mut Asset, shell: &Shell, rng: &mut SceneRng, palette: &Palette) {
    let (x, z) = (2.0 * shell.half.x + LAP, 2.0 * shell.half.y + LAP);
    let gap = Material::plain(palette.floor.linear * if shell.flooring == Flooring::Tiles { 0.9 } else { 0.22 });
    asset.block([0.0, -0.054, 0.0], [x, 0.1, z], 0.0, gap).only(faces::TOP).cell_scale(2.0);
    match shell.flooring {
        Flooring::Boards => boards(asset, shell.half, palette, rng),
        Flooring::Tiles => tiles(asset, shell.half, palette, rng.seed()),
        Flooring::Herringbone => herringbone(asset, shell.half, palette, rng),
    }
}

/// The color with its brightness varied by up to `spread`, for `t` in 0..1.
pub(super) fn tinted(color: Vec3, spread: f32, t: f64) -> Vec3 {
    color * (1.0 + spread * (2.0 * t as f32 - 1.0))
}

/// Adds rows of boards along x.
fn boards(asset: &mut Asset, half: DVec2, palette: &Palette, rng: &mut SceneRng) {
    let rows = (2.0 * half.y / 0.15).round();
    let width = 2.0 * half.y / rows;
    for row in 0..rows as u32 {
        let z = -half.y + width * (f64::from(row) + 0.5);
        let mut x = -half.x - rng.range(0.0, 1.0);
        while x < half.x {
            let end = x + rng.range(1.0, 1.9);
            let (low, high) = (x.max(-half.x), end.min(half.x));
            x = end;
            if high - low < 0.02 {
                continue;
            }
            let material = Material::wood(tinted(palette.floor.linear, 0.12, rng.unit()), rng.seed()).gloss(0.55);
            let board = asset.block(
                [f64::midpoint(low, high), -0.01, z],
                [high - low - 0.003, 0.02, width - 0.004],
                0.0,
                material,
            );
            board.only(faces::TOP).stretched(1.8).no_shadow();
        }
    }
}

/// Adds columns of slanted boards.
fn herringbone(asset: &mut Asset, half: DVec2, palette: &Palette, rng: &mut SceneRng) {
    let (long, wide) = (0.6, 0.12);
    let columns = (2.0 * half.x / long).ceil() as i32 + 1;
    let rows = (2.0 * half.y / wide).ceil() as i32 + 6;
    for column in 0..columns {
        for row in -6..rows {
            // Boards slant up in one column and down in the next; the sides of the column cut them.
            let slant = if column % 2 == 0 { 1.0 } else { -1.0 };
            let (x0, z0) = (-half.x + long * f64::from(column), -half.y + wide * f64::from(row));
            let (x1, mid) = ((x0 + long).min(half.x), z0 + wide / 2.0);
            let rise = slant * 0.18;
            let (lowest, highest) = (mid - wide / 2.0 - 0.09, mid + wide / 2.0 + 0.09);
            if x1 - x0 < 0.02 || lowest < -half.y - 0.05 || highest > half.y + 0.05 {
                continue;
            }
            let material = Material::wood(tinted(palette.floor.linear, 0.1, rng.unit()), rng.seed()).gloss(0.55);
            let board = move |u: f64, v: f64| {
                let x = x0 + 0.002 + (x1 - x0 - 0.004) * u;
                DVec3::new(x, 0.0, mid + rise * ((x - x0) / long - 0.5) + wide * 0.97 * (0.5 - v))
            };
            asset.sheet([long, wide], material, board).no_shadow();
        }
    }
}

/// Adds square tiles.
fn tiles(asset: &mut Asset, half: DVec2, palette: &Palette, seed: u32) {
    let edge = 0.33;
    let count = (half * 2.0 / edge).ceil();
    for i in 0..count.x as i32 {
        for j in 0..count.y as i32 {
            let low = DVec2::new(f64::from(i), f64::from(j)) * edge - half;
            let high = (low + edge).min(half);
            let tone = if (i + j) % 2 == 0 {
                palette.light.linear * 0.95
            } else {
                palette.second.linear.lerp(palette.light.linear, 0.35) * 0.7
            };
            let color = tinted(tone, 0.05, noise::unit_hash(i, j, seed));
            let material = Material::patterned(Pattern::Marble, color, color * 0.8, 0.3)
                .seeded(seed ^ (i * 31 + j) as u32)
                .gloss(0.7);
            let (middle, size) = ((low + high) / 2.0, high - low - 0.006);
            asset
                .block([middle.x, -0.01, middle.y], [size.x, 0.02, size.y], 0.0, material)
                .only(faces::TOP)
                .cell_scale(1.15)
                .no_shadow();
        }
    }
}
