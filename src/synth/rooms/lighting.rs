use glam::{DQuat, DVec3, Vec3};

use super::structure::Daylight;
use crate::lights::{Lamp, Lights, Sun};
use crate::rng::SceneRng;
use crate::scene_builder::PlacedAsset;
use crate::shell::{Shell, Wall};

/// The lights of a furnished room: windows, sun, and the lamps of the objects. An evening room without lamps gets one under
/// the ceiling.
pub(super) fn lights(rng: &mut SceneRng, shell: &Shell, objects: &[PlacedAsset], daylight: Daylight) -> Lights {
    let (sky, sun, lamp_scale) = match daylight {
        Daylight::Noon => (Vec3::new(3.2, 3.4, 3.7), Vec3::new(15.0, 13.4, 11.0), 0.35),
        Daylight::Golden => (Vec3::new(2.9, 2.6, 2.4), Vec3::new(19.0, 12.0, 6.0), 0.6),
        Daylight::Evening => (Vec3::new(0.16, 0.24, 0.42), Vec3::ZERO, 0.9),
    };
    let portals = shell.openings.iter().map(|opening| shell.portal(opening, sky)).collect();
    let side = shell.openings.first().map_or(Wall::Left, |o| o.wall);
    let (yaw, elevation) = (rng.range(-0.6, 0.6), rng.range(0.45, 0.72));
    let outward = shell.world_from_wall(side).rotation * DVec3::NEG_Z;
    let level = DQuat::from_rotation_y(yaw) * outward;
    let toward = (level * elevation.cos() + DVec3::Y * elevation.sin()).as_vec3();
    let sun = (sun != Vec3::ZERO).then_some(Sun { toward, irradiance: sun });
    let mut lamps = Vec::new();
    for PlacedAsset { asset, world_from_object } in objects {
        for own in &asset.lamps {
            let center = world_from_object.apply(own.center.as_dvec3()).as_vec3();
            lamps.push(Lamp { center, intensity: own.intensity * lamp_scale, ..*own });
        }
    }
    if daylight == Daylight::Evening && lamps.is_empty() {
        let center = Vec3::new(0.0, shell.height as f32 - 0.25, 0.0);
        lamps.push(Lamp { center, radius: 0.15, intensity: Vec3::new(1.0, 0.75, 0.5) });
    }
    let ambient = sky * 0.012 + Vec3::splat(0.008);
    Lights { portals, sun, lamps, ambient }
}
