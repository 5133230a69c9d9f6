use cinesplat_files::Limits;
use glam::DVec3;

/// Limits for reading a scene, and the up direction if the caller knows it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadOptions {
    /// World up, of any length above 0; overrides the file and the estimate.
    pub up: Option<DVec3>,
    /// Limits on the file, its Gaussians, and the memory that they take.
    pub limits: Limits,
}
