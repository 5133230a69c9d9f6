//! Sofas, chairs and stools.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

/// A sofa of two or three seats with cushions.
pub(crate) fn sofa(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::colored("sofa", &palette.main);
    let cloth = Material::cloth(palette.main.linear, rng.seed());
    let seats = if rng.chance(0.6) { 3_u32 } else { 2 };
    let (seat_width, arm) = (rng.range(0.6, 0.7), rng.range(0.14, 0.22));
    let width = f64::from(seats) * seat_width + 2.0 * arm;
    let (depth, seat_height) = (rng.range(0.88, 0.98), rng.range(0.4, 0.45));
    let arm_height = rng.range(0.56, 0.66);
    let leg = 0.12;
    asset.legs(
        [width / 2.0 - 0.09, depth / 2.0 - 0.09],
        leg + 0.02,
        [0.014, 0.024],
        0.015,
        Material::wood(palette.wood.linear, 1),
    );
    asset.block([0.0, leg + 0.1, 0.0], [width - 0.02, 0.2, depth], 0.03, cloth);
    let back_z = -depth / 2.0 + 0.11;
    asset.block([0.0, leg + 0.38, back_z], [width - 0.04, 0.62, 0.2], 0.08, cloth).rotate(DVec3::X, -0.1);
    for side in [-1.0, 1.0] {
        let x = side * (width / 2.0 - arm / 2.0);
        asset.block([x, f64::midpoint(leg, arm_height), 0.0], [arm, arm_height - leg, depth], 0.06, cloth);
    }
    for i in 0..seats {
        let x = (f64::from(i) - f64::from(seats - 1) / 2.0) * seat_width;
        let soft = cloth.seeded(rng.seed());
        asset.block([x, seat_height - 0.06, 0.09], [seat_width - 0.012, 0.18, depth - 0.22], 0.065, soft);
        let lean =
            asset.superellipsoid([x, seat_height + 0.25, back_z + 0.17], [seat_width - 0.02, 0.46, 0.22], 3.6, soft);
        lean.rotate(DVec3::X, -0.2);
    }
    let inside = width / 2.0 - arm - 0.2;
    throw_pillow(&mut asset, [-inside, seat_height + 0.22, 0.05], &palette.accent, rng);
    throw_pillow(&mut asset, [inside, seat_height + 0.22, 0.04], &palette.second, rng);
    if rng.chance(0.5) {
        throw_pillow(&mut asset, [-inside + 0.26, seat_height + 0.19, 0.12], &palette.light, rng);
    }
    if rng.chance(0.6) {
        blanket(&mut asset, [width / 2.0 - arm / 2.0, arm_height, arm], depth, &palette.light);
    }
    asset.centered()
}

/// Adds a throw pillow against a backrest.
fn throw_pillow(asset: &mut Asset, center: [f64; 3], color: &NamedColor, rng: &mut SceneRng) {
    let size = rng.range(0.36, 0.44);
    let material = if rng.chance(0.35) {
        Material::patterned(Pattern::Stripes, color.linear, color.linear * 0.45 + 0.25, 0.045)
    } else {
        Material::cloth(color.linear, rng.seed())
    };
    let tilt = rng.range(-0.25, 0.25);
    let primitive = asset.superellipsoid(center, [size, size, 0.16], 3.0, material);
    primitive.rotate(DVec3::Z, tilt).rotate(DVec3::X, -0.42).rotate(DVec3::Y, -tilt).cell_scale(0.8);
}

/// Adds a blanket over an armrest, given by its center x, height and width.
fn blanket(asset: &mut Asset, [x, height, arm]: [f64; 3], depth: f64, color: &NamedColor) {
    let material = Material::patterned(Pattern::Stripes, color.linear, color.linear * 0.62, 0.11).two_sided();
    let (wide, drop) = (0.42, 0.3);
    let half = arm / 2.0 + 0.012;
    let total = 2.0 * drop + 2.0 * half;
    let sheet = asset.sheet([wide, total], material, move |u, v| {
        let s = v * total;
        let wave = 0.006 * (u * 17.0 + v * 3.0).sin();
        let z = (u - 0.5) * wide * (1.0 + 0.04 * (v * PI).sin()) + 0.05 * depth;
        if s < drop {
            DVec3::new(x - half - wave.abs(), height + 0.012 - (drop - s), z)
        } else if s < drop + 2.0 * half {
            DVec3::new(x - half + (s - drop), height + 0.014 + wave.abs(), z)
        } else {
            DVec3::new(x + half + wave.abs(), height + 0.012 - (s - drop - 2.0 * half), z)
        }
    });
    sheet.no_shadow();
}

/// An armchair: upholstered, or with wooden armrests.
pub(crate) fn armchair(rng: &mut SceneRng, color: &NamedColor, palette: &Palette) -> Asset {
    let mut asset = Asset::colored("armchair", color);
    let cloth = Material::cloth(color.linear, rng.seed());
    let wood = Material::wood(palette.wood.linear, rng.seed());
    let width = rng.range(0.72, 0.84);
    let plump = rng.chance(0.5);
    let (depth, arm) = (0.8, if plump { 0.15 } else { 0.06 });
    let leg = if plump { 0.14 } else { 0.2 };
    asset.legs([width / 2.0 - 0.1, depth / 2.0 - 0.1], leg + 0.04, [0.013, 0.022], 0.05, wood);
    asset.block([0.0, leg + 0.07, 0.0], [width - 0.06, 0.13, depth - 0.06], 0.05, cloth);
    asset.block([0.0, leg + 0.2, 0.06], [width - 2.0 * arm, 0.16, depth - 0.2], 0.065, cloth.seeded(7));
    let back = asset.block([0.0, leg + 0.45, -depth / 2.0 + 0.11], [width - 0.04, 0.66, 0.15], 0.07, cloth);
    back.rotate(DVec3::X, -0.2);
    for side in [-1.0, 1.0] {
        let x = side * (width / 2.0 - arm / 2.0);
        if plump {
            asset.block([x, leg + 0.24, 0.02], [arm, 0.42, depth - 0.1], 0.07, cloth);
        } else {
            asset.block([x, leg + 0.42, 0.02], [arm, 0.035, depth - 0.18], 0.014, wood);
            asset.rod([x, leg + 0.02, 0.3], [x, leg + 0.42, 0.26], [0.016, 0.014], wood);
            asset.rod([x, leg + 0.02, -0.3], [x, leg + 0.42, -0.24], [0.016, 0.014], wood);
        }
    }
    if rng.chance(0.7) {
        throw_pillow(&mut asset, [0.0, leg + 0.45, -0.06], &palette.light, rng);
    }
    asset.centered()
}

/// A wooden chair with a slatted or upholstered back.
pub(crate) fn chair(style: u32, wood: Material, seat: Material) -> Asset {
    let mut asset = Asset::new("chair");
    let (half, height) = (0.2, 0.45);
    for x in [-half, half] {
        asset.rod([x * 1.08, 0.0, half * 1.05], [x, height, half], [0.013, 0.019], wood);
        asset.pipe(&[[x * 1.08, 0.0, -half * 1.2], [x, height, -half], [x * 0.98, 0.9, -half - 0.09]], 0.016, wood);
    }
    for z in [-half, half] {
        asset.block([0.0, height - 0.045, z], [2.0 * half, 0.05, 0.02], 0.004, wood);
    }
    asset.block([0.0, height + 0.015, 0.01], [0.45, 0.045, 0.44], 0.02, seat);
    match style % 3 {
        0 => {
            for i in 0..3 {
                let y = 0.58 + 0.115 * f64::from(i);
                let z = -half - 0.09 * (y - height) / 0.45;
                asset.block([0.0, y, z], [2.0 * half, 0.055, 0.016], 0.006, wood);
            }
        }
        1 => {
            asset.block([0.0, 0.74, -half - 0.058], [0.4, 0.3, 0.045], 0.02, seat).rotate(DVec3::X, -0.2);
        }
        _ => {
            for i in -2..=2 {
                let x = 0.075 * f64::from(i);
                asset.rod([x, height, -half], [x * 0.98, 0.88, -half - 0.086], [0.008, 0.008], wood);
            }
            asset.block([0.0, 0.88, -half - 0.087], [0.43, 0.06, 0.022], 0.009, wood);
        }
    }
    asset.scale_cells(0.75).centered()
}

/// An office chair on five casters.
pub(crate) fn office_chair(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("office chair", color);
    let (metal, black) =
        (Material::metal(DVec3::splat(0.35).as_vec3()), Material::plain(DVec3::splat(0.03).as_vec3()).gloss(0.4));
    let cloth = Material::cloth(color.linear, rng.seed());
    for i in 0..5 {
        let (sin, cos) = (TAU * f64::from(i) / 5.0 + 0.3).sin_cos();
        asset.rod([0.0, 0.11, 0.0], [0.27 * cos, 0.075, 0.27 * sin], [0.024, 0.014], metal);
        asset.superellipsoid([0.27 * cos, 0.03, 0.27 * sin], [0.06, 0.06, 0.06], 2.0, black).cell_scale(0.6);
    }
    asset.rod([0.0, 0.1, 0.0], [0.0, 0.42, 0.0], [0.03, 0.022], metal);
    asset.block([0.0, 0.47, 0.0], [0.5, 0.09, 0.48], 0.04, cloth);
    asset.pipe(&[[0.0, 0.42, -0.1], [0.0, 0.44, -0.3], [0.0, 0.66, -0.29]], 0.02, black);
    let back = asset.block([0.0, 0.82, -0.25], [0.46, 0.56, 0.07], 0.034, cloth.seeded(3));
    back.rotate(DVec3::X, -0.12);
    for side in [-1.0, 1.0] {
        asset.pipe(&[[side * 0.22, 0.44, 0.02], [side * 0.29, 0.5, 0.0], [side * 0.28, 0.66, 0.0]], 0.013, black);
        asset.block([side * 0.28, 0.675, 0.02], [0.06, 0.03, 0.26], 0.014, black);
    }
    asset.scale_cells(0.8).centered()
}

/// A stool with a round seat.
pub(crate) fn stool(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("stool");
    let wood = Material::wood(palette.wood.linear, rng.seed());
    let (height, radius) = (rng.range(0.6, 0.7), rng.range(0.16, 0.19));
    asset.legs([radius * 0.6, radius * 0.6], height - 0.03, [0.014, 0.017], 0.07, wood);
    let (ring, at) = (radius * 0.6 + 0.05, 0.24);
    for (a, b) in [([-ring, at, ring], [ring, at, ring]), ([-ring, at, -ring], [ring, at, -ring])] {
        asset.rod(a, b, [0.009, 0.009], wood);
    }
    let y = height - 0.035;
    asset.smooth_lathe(
        [0.0, y, 0.0],
        &[[0.0, 0.0], [radius * 0.8, 0.0], [radius, 0.018], [radius * 0.95, 0.035], [0.0, 0.03]],
        wood,
    );
    asset.scale_cells(0.8).centered()
}

/// A round upholstered pouf.
pub(crate) fn pouf(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("pouf", color);
    let (radius, height) = (rng.range(0.24, 0.3), rng.range(0.34, 0.42));
    let cloth = Material::patterned(Pattern::Stripes, color.linear, color.linear * 0.8, radius * TAU / 24.0);
    let profile = [
        [radius * 0.86, 0.0],
        [radius * 0.98, height * 0.2],
        [radius, height * 0.5],
        [radius * 0.97, height * 0.82],
        [radius * 0.8, height * 0.97],
        [radius * 0.3, height],
        [0.0, height * 0.98],
    ];
    asset.smooth_lathe([0.0; 3], &profile, cloth);
    asset.centered()
}

/// A bench along a bed's foot or a table.
pub(crate) fn bench(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("bench");
    let length = rng.range(1.1, 1.4);
    let wood = Material::wood(palette.wood.linear, rng.seed());
    asset.legs([length / 2.0 - 0.1, 0.13], 0.4, [0.016, 0.022], 0.02, wood);
    asset.block([0.0, 0.4, 0.0], [length, 0.05, 0.38], 0.01, wood);
    asset.block(
        [0.0, 0.46, 0.0],
        [length - 0.02, 0.08, 0.37],
        0.035,
        Material::cloth(palette.second.linear, rng.seed()),
    );
    asset.centered()
}
