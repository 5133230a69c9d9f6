use thiserror::Error;

use cinesplat_geometry::GeometryError;

/// Why a picture could not be rendered.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RenderError {
    /// The camera's image or pose is not usable.
    #[error("camera: {0}")]
    Camera(#[from] GeometryError),
    /// A setting outside its range.
    #[error("{name} is {found}, expected {expected}")]
    Setting {
        /// Which setting.
        name: &'static str,
        /// Its value.
        found: f64,
        /// The values allowed.
        expected: &'static str,
    },
    /// A per-Gaussian or per-pixel input of the wrong length.
    #[error("{what}: {found} values, expected {expected}")]
    Length {
        /// Which input.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length wanted.
        expected: usize,
    },
    /// This picture would not fit into the memory allowed.
    #[error("with {what} the picture takes {found_bytes} bytes of memory, the cap is {limit_bytes}")]
    Memory {
        /// What did not fit.
        what: &'static str,
        /// Bytes needed up to and with it.
        found_bytes: u64,
        /// Bytes allowed.
        limit_bytes: u64,
    },
    /// The picture would take more work than allowed.
    #[error("{found} splat-tile pairs, the cap is {limit}")]
    Cost {
        /// Overlaps between splats and tiles.
        found: u64,
        /// Overlaps allowed.
        limit: u64,
    },
}

impl RenderError {
    /// Stable code for messages.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Camera(_) => "RENDER-CAMERA",
            Self::Setting { .. } => "RENDER-SETTING",
            Self::Length { .. } => "RENDER-LENGTH",
            Self::Memory { .. } => "RENDER-MEMORY",
            Self::Cost { .. } => "RENDER-COST",
        }
    }
}
