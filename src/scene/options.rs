use glam::DVec3;

/// What a scene may cost, and what the caller knows better than the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadOptions {
    /// World up, of any length; wins over the file and over the estimate.
    pub up: Option<DVec3>,
    /// Largest file, and largest size after decompression, in bytes.
    pub max_file_bytes: u64,
    /// Most Gaussians.
    pub max_gaussians: usize,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { up: None, max_file_bytes: 8 << 30, max_gaussians: 50_000_000 }
    }
}
