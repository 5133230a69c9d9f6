use glam::DVec3;

/// Limits for reading a scene, and the up direction if the caller knows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadOptions {
    /// World up, of any length above 0; overrides the file and the estimate.
    pub up: Option<DVec3>,
    /// Maximum size of the file and of its decompressed content, bytes.
    pub max_file_bytes: u64,
    /// Maximum number of Gaussians.
    pub max_gaussians: usize,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { up: None, max_file_bytes: 8 << 30, max_gaussians: 50_000_000 }
    }
}
