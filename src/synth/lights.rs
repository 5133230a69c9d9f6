//! Light sources of a room. Linear radiometric units relative to the exposure, world frame, m.

use glam::Vec3;

/// A window as a light portal: a rectangle that emits the light of the sky into the room.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portal {
    /// Center.
    pub(super) center: Vec3,
    /// Half of the width as a vector.
    pub(super) half_width: Vec3,
    /// Half of the height as a vector.
    pub(super) half_height: Vec3,
    /// Unit direction into the room.
    pub(super) inward: Vec3,
    /// Radiance.
    pub(super) radiance: Vec3,
}

/// Direct sunlight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sun {
    /// Unit direction to the sun.
    pub(super) toward: Vec3,
    /// Irradiance on a surface that faces the sun.
    pub(super) irradiance: Vec3,
}

/// A spherical light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lamp {
    /// Center.
    pub(super) center: Vec3,
    /// Radius, m.
    pub(super) radius: f32,
    /// Radiant intensity.
    pub(super) intensity: Vec3,
}

/// All lights of a scene.
#[derive(Debug, Clone, Default)]
pub(super) struct Lights {
    /// Windows.
    pub(super) portals: Vec<Portal>,
    /// The sun; `None` at night.
    pub(super) sun: Option<Sun>,
    /// Lamps.
    pub(super) lamps: Vec<Lamp>,
    /// Uniform ambient radiance, scaled by the openness of the surroundings.
    pub(super) ambient: Vec3,
}
