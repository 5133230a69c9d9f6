//! Lamps, each with its light.

use glam::Vec3;

use crate::asset::Asset;
use crate::color::{NamedColor, Palette};
use crate::material::Material;
use crate::rng::SceneRng;

/// Color of a warm bulb, linear.
const WARM: Vec3 = Vec3::new(1.0, 0.66, 0.36);

fn shade_material(color: Vec3) -> Material {
    Material::plain(color.lerp(Vec3::new(1.0, 0.78, 0.5), 0.65)).emission(0.95)
}

fn metal(palette: &Palette, rng: &mut SceneRng) -> Material {
    let brass = Vec3::new(0.56, 0.4, 0.17);
    Material::metal(if rng.chance(0.5) { brass } else { palette.dark.linear })
}

/// A floor lamp: a shade on a stem, on a tripod or on an arc.
pub(crate) fn floor_lamp(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("floor lamp");
    let height = rng.range(1.45, 1.65);
    let frame = metal(palette, rng);
    let shade = shade_material(palette.light.linear);
    let (low, high) = (rng.range(0.18, 0.22), rng.range(0.13, 0.2));
    match rng.index(3) {
        0 => {
            asset.lathe([0.0; 3], &[[0.15, 0.0], [0.15, 0.015], [0.03, 0.03]], frame);
            asset.rod([0.0, 0.02, 0.0], [0.0, height - 0.05, 0.0], [0.011, 0.011], frame);
        }
        1 => {
            let wood = Material::wood(palette.wood.linear, rng.seed());
            for i in 0..3 {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 3.0).sin_cos();
                asset.rod([0.27 * cos, 0.0, 0.27 * sin], [0.03 * cos, height - 0.22, 0.03 * sin], [0.014, 0.016], wood);
            }
            asset.rod([0.0, height - 0.25, 0.0], [0.0, height - 0.05, 0.0], [0.014, 0.012], frame);
        }
        _ => {
            asset.lathe([0.0; 3], &[[0.14, 0.0], [0.14, 0.04], [0.0, 0.045]], frame);
            let bend = [
                [0.0, 0.03, 0.0],
                [0.0, height * 0.7, 0.0],
                [0.1, height + 0.1, 0.0],
                [0.36, height + 0.1, 0.0],
                [0.45, height, 0.0],
            ];
            asset.pipe(&bend, 0.011, frame);
            asset.lathe([0.45, height - 0.16, 0.0], &[[0.15, 0.0], [0.12, 0.1], [0.02, 0.16]], frame).no_shadow();
            asset
                .superellipsoid([0.45, height - 0.13, 0.0], [0.13, 0.13, 0.13], 2.0, shade_material(Vec3::ONE))
                .cell_scale(0.6);
            asset.lamp([0.45, height - 0.14, 0.0], 0.06, WARM);
            return asset.centered();
        }
    }
    asset.lathe([0.0, height - 0.1, 0.0], &[[low, 0.0], [high, 0.3]], shade);
    asset
        .lathe([0.0, height - 0.1, 0.0], &[[low + 0.002, 0.0], [low + 0.001, 0.012]], frame)
        .cell_scale(0.6)
        .no_shadow();
    asset.lamp([0.0, height + 0.04, 0.0], 0.09, WARM);
    asset.centered()
}

/// A table lamp with a ceramic base.
pub(crate) fn table_lamp(rng: &mut SceneRng, color: &NamedColor, palette: &Palette) -> Asset {
    let mut asset = Asset::new("table lamp");
    let foot = Material::plain(color.linear).gloss(0.6);
    let body = rng.range(0.18, 0.26);
    let profile = match rng.index(3) {
        0 => vec![[0.05, 0.0], [0.085, body * 0.35], [0.07, body * 0.7], [0.02, body], [0.014, body + 0.05]],
        1 => vec![[0.075, 0.0], [0.078, 0.02], [0.03, body * 0.3], [0.026, body * 0.8], [0.014, body + 0.05]],
        _ => vec![[0.04, 0.0], [0.075, body * 0.6], [0.06, body * 0.92], [0.016, body], [0.014, body + 0.05]],
    };
    asset.smooth_lathe([0.0; 3], &profile, foot);
    asset.lathe([0.0, body + 0.02, 0.0], &[[0.15, 0.0], [0.1, 0.19]], shade_material(palette.light.linear));
    asset.lamp([0.0, body + 0.11, 0.0], 0.06, WARM * 0.6);
    asset.scale_cells(0.7).centered()
}

/// A pendant lamp; its highest point is the ceiling mount.
pub(crate) fn pendant(rng: &mut SceneRng, color: &NamedColor, drop: f64) -> Asset {
    let mut asset = Asset::colored("pendant lamp", color);
    let cord = Material::plain(Vec3::splat(0.03));
    let outside = Material::plain(color.linear).gloss(0.5);
    let radius = rng.range(0.17, 0.24);
    let profile = if rng.chance(0.5) {
        vec![[radius, 0.0], [radius * 0.95, 0.06], [radius * 0.6, 0.15], [0.03, 0.2]]
    } else {
        vec![[radius * 0.8, 0.0], [radius, 0.1], [radius * 0.85, 0.2], [0.03, 0.27]]
    };
    // The shade is hollow: only its crown casts a shadow, so that the bulb lights the room below.
    asset.smooth_lathe([0.0; 3], &profile, outside).no_shadow();
    asset.superellipsoid([0.0, 0.16, 0.0], [radius * 1.3, 0.05, radius * 1.3], 2.0, outside).shadow_only();
    asset.superellipsoid([0.0, 0.05, 0.0], [0.11, 0.11, 0.11], 2.0, shade_material(Vec3::ONE)).cell_scale(0.6);
    asset.rod([0.0, 0.18, 0.0], [0.0, drop - 0.02, 0.0], [0.005, 0.005], cord);
    asset.lathe([0.0, drop - 0.03, 0.0], &[[0.05, 0.0], [0.05, 0.03]], outside);
    asset.lamp([0.0, 0.02, 0.0], 0.05, WARM * 1.2);
    asset.scale_cells(0.8).centered()
}

/// A jointed desk lamp.
pub(crate) fn desk_lamp(rng: &mut SceneRng, color: &NamedColor) -> Asset {
    let mut asset = Asset::colored("desk lamp", color);
    let material = Material::plain(color.linear).gloss(0.6);
    let reach = rng.range(0.2, 0.26);
    asset.lathe([0.0; 3], &[[0.09, 0.0], [0.09, 0.02], [0.0, 0.024]], material);
    asset.rod([0.0, 0.02, 0.0], [-0.09, 0.3, 0.0], [0.008, 0.008], material);
    asset.rod([-0.09, 0.3, 0.0], [reach - 0.09, 0.44, 0.0], [0.008, 0.008], material);
    let profile = [[0.085, 0.0], [0.08, 0.03], [0.04, 0.09], [0.02, 0.13]];
    asset.smooth_lathe([reach - 0.07, 0.33, 0.0], &profile, material).no_shadow();
    asset.superellipsoid([reach - 0.07, 0.35, 0.0], [0.07, 0.07, 0.07], 2.0, shade_material(Vec3::ONE));
    asset.lamp([reach - 0.07, 0.33, 0.0], 0.03, WARM * 0.5);
    asset.scale_cells(0.6).centered()
}

/// A pillar candle on a plate.
pub(crate) fn candle(rng: &mut SceneRng, palette: &Palette) -> Asset {
    let mut asset = Asset::new("candle");
    let (radius, height) = (rng.range(0.028, 0.036), rng.range(0.09, 0.16));
    asset.smooth_lathe(
        [0.0; 3],
        &[[0.055, 0.0], [0.06, 0.008], [0.03, 0.008], [0.0, 0.008]],
        Material::metal(palette.dark.linear),
    );
    let wax = Material::plain(Vec3::new(0.85, 0.76, 0.6)).gloss(0.2);
    asset.lathe(
        [0.0, 0.008, 0.0],
        &[[radius, 0.0], [radius, height], [radius * 0.8, height], [0.0, height - 0.008]],
        wax,
    );
    let flame = Material::plain(Vec3::new(1.6, 1.0, 0.4)).emission(1.0);
    asset.superellipsoid([0.0, height + 0.032, 0.0], [0.013, 0.036, 0.013], 2.0, flame).cell_scale(0.5);
    asset.lamp([0.0, height + 0.04, 0.0], 0.01, WARM * 0.08);
    asset.scale_cells(0.35).centered()
}
