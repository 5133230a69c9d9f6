use glam::{DVec2, DVec3};

/// A point of a primitive's surface, as textures need it.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfacePoint {
    /// Distances along the surface's two directions, m.
    pub(super) along: DVec2,
    /// The same as fractions of the surface's extent, 0..=1.
    pub(super) frac: DVec2,
    /// Position in the primitive's frame, m.
    pub(super) local: DVec3,
}
