//! Kitchen furniture.

use glam::Vec3;

use crate::asset::Asset;
use crate::color::NamedColor;
use crate::faces;
use crate::material::{Material, Pattern};
use crate::rng::SceneRng;

fn steel() -> Material {
    Material::metal(Vec3::splat(0.42))
}

/// A row of base units, `width` m long, with doors, a worktop and a sink with a tap.
pub(crate) fn counter(rng: &mut SceneRng, color: &NamedColor, width: f64) -> Asset {
    let mut asset = Asset::colored("kitchen counter", color);
    let (height, depth) = (0.9, 0.6);
    let front = Material::plain(color.linear).gloss(0.25);
    asset.block([0.0, 0.05, -0.03], [width - 0.02, 0.1, depth - 0.08], 0.0, Material::plain(Vec3::splat(0.05)));
    asset.block([0.0, 0.48, -0.01], [width, 0.76, depth - 0.03], 0.004, front);
    units(&mut asset, width, [0.11, 0.85, depth / 2.0 - 0.02], front);
    let stone =
        Material::patterned(Pattern::Marble, Vec3::splat(0.7), Vec3::splat(0.35), 0.35).seeded(rng.seed()).gloss(0.7);
    asset.block([0.0, height - 0.02, 0.0], [width, 0.04, depth], 0.008, stone).cell_scale(0.8);
    let sink = -width * 0.22;
    let rim = height + 0.001;
    asset.block([sink, rim, 0.02], [0.5, 0.006, 0.38], 0.003, steel());
    asset
        .block([sink, rim - 0.001, 0.02], [0.44, 0.01, 0.32], 0.0, Material::plain(Vec3::splat(0.12)).gloss(0.6))
        .only(faces::TOP);
    let tap = [
        [sink, height, -0.22],
        [sink, height + 0.26, -0.22],
        [sink, height + 0.3, -0.13],
        [sink, height + 0.22, -0.06],
    ];
    asset.pipe(&tap, 0.013, steel()).cell_scale(0.6);
    asset.support([width * 0.2, height, 0.0], [width * 0.24, depth / 2.0 - 0.08], 0.5);
    asset.centered()
}

/// Adds a row of doors between two heights.
fn units(asset: &mut Asset, width: f64, [low, high, face]: [f64; 3], material: Material) {
    let count = (width / 0.5).round().max(1.0) as u32;
    let each = width / f64::from(count);
    for i in 0..count {
        let x = (f64::from(i) - f64::from(count - 1) / 2.0) * each;
        asset.block([x, f64::midpoint(low, high), face], [each - 0.01, high - low, 0.02], 0.005, material);
        let inset = Material::plain(material.color * 0.9).gloss(0.25);
        asset.block([x, f64::midpoint(low, high), face + 0.004], [each - 0.11, high - low - 0.12, 0.016], 0.006, inset);
        let y = if low > 1.0 { low + 0.06 } else { high - 0.06 };
        asset.block([x, y, face + 0.022], [0.13, 0.012, 0.014], 0.005, steel()).cell_scale(0.5);
    }
}

/// Wall cabinets, `width` m long; the back is at -z.
pub(crate) fn wall_cabinet(color: &NamedColor, width: f64) -> Asset {
    let mut asset = Asset::colored("wall cabinet", color);
    let material = Material::plain(color.linear).gloss(0.25);
    asset.block([0.0, 0.35, 0.0], [width, 0.7, 0.34], 0.005, material);
    let mut doors = Asset::new("doors");
    units(&mut doors, width, [1.03, 1.67, 0.175], material);
    let down = crate::placement::Placement::at(glam::DVec3::NEG_Y);
    asset.attach(&doors, &down);
    asset.centered()
}

/// A refrigerator.
pub(crate) fn fridge(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::new("refrigerator");
    let material = if rng.chance(0.5) { steel() } else { Material::plain(color.linear).gloss(0.6) };
    let (width, height, depth) = (0.66, rng.range(1.7, 1.9), 0.66);
    asset.block([0.0, height / 2.0 + 0.02, -0.03], [width, height - 0.04, depth - 0.06], 0.03, material);
    let split = height * 0.34;
    for (low, high) in [(0.05, split - 0.006), (split + 0.006, height)] {
        asset.block([0.0, f64::midpoint(low, high), depth / 2.0 - 0.04], [width, high - low, 0.07], 0.028, material);
        let (y, tall) = if low < 0.1 { (high - 0.2, 0.26) } else { (low + 0.3, 0.4) };
        asset.rod(
            [-0.26, y - tall / 2.0, depth / 2.0 + 0.02],
            [-0.26, y + tall / 2.0, depth / 2.0 + 0.02],
            [0.012, 0.012],
            Material::metal(Vec3::splat(0.6)),
        );
    }
    asset.centered()
}

/// A stove with an oven and four hot plates.
pub(crate) fn stove(color: &NamedColor) -> Asset {
    let mut asset = Asset::new("stove");
    let (width, height, depth) = (0.6, 0.9, 0.6);
    let body = Material::plain(color.linear * 0.85).gloss(0.5);
    let black = Material::plain(Vec3::splat(0.015)).gloss(0.9);
    asset.block([0.0, height / 2.0, -0.02], [width, height, depth - 0.04], 0.01, body);
    asset.block([0.0, 0.4, depth / 2.0 - 0.03], [width - 0.03, 0.52, 0.03], 0.008, body);
    asset.block([0.0, 0.39, depth / 2.0 - 0.022], [width - 0.16, 0.28, 0.03], 0.006, black);
    asset.rod([-0.24, 0.61, depth / 2.0 + 0.02], [0.24, 0.61, depth / 2.0 + 0.02], [0.01, 0.01], steel());
    asset.block([0.0, height + 0.004, -0.02], [width, 0.012, depth - 0.05], 0.004, black);
    for (x, z, r) in [(-0.14, 0.11, 0.09), (0.14, 0.11, 0.07), (-0.14, -0.14, 0.07), (0.14, -0.14, 0.09)] {
        asset
            .lathe(
                [x, height + 0.01, z - 0.02],
                &[[r, 0.0], [r, 0.012], [r * 0.7, 0.014], [0.0, 0.012]],
                Material::plain(Vec3::splat(0.05)),
            )
            .cell_scale(0.5);
    }
    for i in 0..5 {
        let x = -0.2 + 0.1 * f64::from(i);
        asset.superellipsoid([x, 0.78, depth / 2.0 - 0.02], [0.04, 0.04, 0.04], 2.4, black).cell_scale(0.4);
    }
    asset.support([0.13, height + 0.024, -0.13], [0.16, 0.16], 0.5);
    asset.centered()
}

/// A cooking pot with a lid.
pub(crate) fn cooking_pot(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("cooking pot", color);
    let material = Material::plain(color.linear).gloss(0.7);
    let (radius, height) = (rng.range(0.09, 0.11), rng.range(0.1, 0.13));
    let profile = [[radius * 0.9, 0.0], [radius, 0.015], [radius, height], [radius * 0.95, height + 0.008]];
    asset.lathe([0.0; 3], &profile, material);
    asset.smooth_lathe(
        [0.0, height, 0.0],
        &[[radius * 0.99, 0.004], [radius * 0.7, 0.022], [0.014, 0.034], [0.016, 0.05], [0.0, 0.056]],
        material,
    );
    for side in [-1.0, 1.0] {
        let x = side * radius;
        asset.pipe(
            &[[x, height * 0.8, -0.035], [x + side * 0.035, height * 0.82, 0.0], [x, height * 0.8, 0.035]],
            0.008,
            material,
        );
    }
    asset.scale_cells(0.45).centered()
}
