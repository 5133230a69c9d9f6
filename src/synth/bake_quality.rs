/// Minimum detail at which glossy surfaces get a view-dependent sheen (spherical harmonics of degree 1).
pub(super) const SHEEN_DETAIL: f64 = 0.5;

/// Ray counts per surfel and grid resolution of the light baking.
#[derive(Debug, Clone, Copy)]
pub(super) struct BakeQuality {
    /// Rays to all windows together.
    pub(super) portal_rays: u32,
    /// Rays to the sun and to each lamp.
    pub(super) point_rays: u32,
    /// Rays into the hemisphere for the first bounce.
    pub(super) gather_rays: u32,
    /// Edge of the radiance grid's cells relative to film quality.
    pub(super) grid_scale: f32,
}

impl BakeQuality {
    /// Quality for the detail of a scene.
    pub(super) fn for_detail(detail: f64) -> Self {
        if detail >= SHEEN_DETAIL {
            Self { portal_rays: 16, point_rays: 4, gather_rays: 18, grid_scale: 1.0 }
        } else if detail > 0.15 {
            Self { portal_rays: 8, point_rays: 2, gather_rays: 10, grid_scale: 1.4 }
        } else {
            Self { portal_rays: 2, point_rays: 1, gather_rays: 2, grid_scale: 2.2 }
        }
    }
}
