//! Rugs and curtains.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A rug of a given size (x, z) with fringes at its ends.
pub(crate) fn rug(rng: &mut SceneRng, palette: &Palette, size: [f64; 2]) -> Asset {
    let color = if rng.chance(0.6) { palette.accent } else { palette.second };
    let mut asset = Asset::colored("rug", &color);
    let pattern = rng.pick(&[Pattern::RugClassic, Pattern::RugClassic, Pattern::RugModern, Pattern::RugStriped]);
    let other = if pattern == Pattern::RugClassic { Vec3::new(0.035, 0.05, 0.085) } else { palette.main.linear };
    let pile = Material::patterned(pattern, color.linear * 0.9, other, 0.1).seeded(rng.seed());
    let edge = Material::cloth(color.linear * 0.6, rng.seed());
    asset
        .block([0.0, 0.005, 0.0], [size[0], 0.01, size[1]], 0.003, edge)
        .only(faces::FRONT | faces::BACK | faces::RIGHT | faces::LEFT);
    asset
        .sheet(size, pile, move |u, v| DVec3::new((u - 0.5) * size[0], 0.01, (0.5 - v) * size[1]))
        .cell_scale(0.72)
        .no_shadow();
    let fringe = Material::plain(palette.light.linear).two_sided();
    for side in [-1.0, 1.0] {
        let x = side * size[0] / 2.0;
        let wide = size[1];
        let comb = move |u: f64, v: f64| DVec3::new(x + side * 0.05 * u, 0.006, (v - 0.5) * wide * side);
        asset.sheet([0.05, wide], fringe, comb).no_shadow();
    }
    asset.centered()
}

/// A pair of curtains, `drop` m long, on a rod for a window `width` m wide.
pub(crate) fn curtains(rng: &mut SceneRng, color: &NamedColor, width: f64, drop: f64) -> Asset {
    let mut asset = Asset::colored("curtains", color);
    let rod = Material::metal(Vec3::new(0.45, 0.32, 0.14));
    let cloth = Material::cloth(color.linear, rng.seed()).two_sided();
    let reach = width / 2.0 + 0.3;
    asset.rod([-reach, drop + 0.02, 0.0], [reach, drop + 0.02, 0.0], [0.012, 0.012], rod);
    for side in [-1.0, 1.0] {
        asset.superellipsoid([side * (reach + 0.02), drop + 0.02, 0.0], [0.05, 0.05, 0.05], 2.0, rod).cell_scale(0.5);
        let spread = rng.range(0.36, 0.44);
        let folds = 7.0;
        let (middle, phase) = (side * (width / 2.0 + 0.26 - spread / 2.0 + 0.02), rng.range(0.0, 1.0));
        let fall = move |u: f64, v: f64| {
            // The folds are shallow at the top and deeper toward the floor.
            let deep = 0.026 + 0.014 * (1.0 - v);
            let swing = TAU * (folds * u + phase) + 0.7 * (1.0 - v);
            let x = middle + (u - 0.5) * spread * (1.0 - 0.1 * v) + 0.008 * (swing * 2.0).sin();
            DVec3::new(x, drop * v, deep * swing.sin())
        };
        asset.sheet([spread * 2.4, drop], cloth, fall).cell_scale(0.9);
    }
    asset.centered()
}
