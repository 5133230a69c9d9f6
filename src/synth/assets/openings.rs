//! Windows and doors. The back is at -z, in the plane of the wall.

use glam::Vec3;

use crate::asset::Asset;
use crate::color::NamedColor;
use crate::material::Material;
use crate::rng::SceneRng;

/// A window of a given size: frame, bars and sill.
pub(crate) fn window(size: [f64; 2], bars: [u32; 2]) -> Asset {
    let mut asset = Asset::new("window");
    let [width, height] = size;
    let material = Material::plain(Vec3::new(0.8, 0.78, 0.74)).gloss(0.2);
    let (rim, deep) = (0.055, 0.05);
    for side in [-1.0, 1.0] {
        asset.block([side * (width / 2.0), height / 2.0, 0.0], [rim, height + rim, deep], 0.006, material);
        let y = height / 2.0 + side * height / 2.0;
        asset.block([0.0, y, 0.0], [width - rim, rim, deep], 0.006, material);
    }
    for i in 1..bars[0] {
        let x = -width / 2.0 + width * f64::from(i) / f64::from(bars[0]);
        asset.block([x, height / 2.0, -0.005], [0.03, height - rim, 0.03], 0.004, material);
    }
    for i in 1..bars[1] {
        let y = height * f64::from(i) / f64::from(bars[1]);
        asset.block([0.0, y, -0.005], [width - rim, 0.026, 0.03], 0.004, material);
    }
    asset.block([0.0, -0.04, 0.02], [width + 0.12, 0.03, 0.09], 0.008, material);
    asset.scale_cells(0.8).centered()
}

/// A paneled door in its casing.
pub(crate) fn door(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("door", color);
    let (width, height) = (rng.range(0.82, 0.9), 2.05);
    let material = Material::plain(color.linear).gloss(0.25);
    let casing = Material::plain(Vec3::new(0.76, 0.73, 0.68)).gloss(0.2);
    for side in [-1.0, 1.0] {
        asset.block([side * (width / 2.0 + 0.045), height / 2.0, 0.0], [0.09, height, 0.05], 0.008, casing);
    }
    asset.block([0.0, height + 0.045, 0.0], [width + 0.18, 0.09, 0.05], 0.008, casing);
    asset.block([0.0, height / 2.0, -0.008], [width, height, 0.03], 0.003, material);
    let inset = Material::plain(color.linear * 0.82).gloss(0.25);
    for x in [-0.24, 0.24] {
        for (y, tall) in [(0.52, 0.66), (1.42, 0.88)] {
            asset.block([x * width, y, -0.004], [width * 0.36, tall, 0.03], 0.008, inset);
            asset.block([x * width, y, -0.001], [width * 0.36 - 0.07, tall - 0.07, 0.03], 0.008, material);
        }
    }
    let brass = Material::metal(Vec3::new(0.55, 0.4, 0.17));
    let knob = width / 2.0 - 0.07;
    asset.block([knob, 1.02, 0.008], [0.04, 0.16, 0.008], 0.003, brass).cell_scale(0.4);
    asset.rod([knob, 1.04, 0.01], [knob, 1.04, 0.05], [0.009, 0.009], brass).cell_scale(0.4);
    asset.rod([knob + 0.01, 1.04, 0.05], [knob - 0.1, 1.04, 0.05], [0.009, 0.008], brass).cell_scale(0.4);
    asset.centered()
}
