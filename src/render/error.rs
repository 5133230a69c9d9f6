use thiserror::Error;

use cinesplat_geometry::GeometryError;

/// Error of rendering a picture.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RenderError {
    /// An invalid camera.
    #[error("camera: {0}")]
    Camera(#[from] GeometryError),
    /// A setting outside its range.
    #[error("{name} is {found}, expected {expected}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        found: f64,
        /// The values allowed.
        expected: &'static str,
    },
    /// A lens that shows a direction twice.
    #[error(
        "the distortion of the lens folds the picture within {found_px:.0} px of its middle, expected no fold inside the frame"
    )]
    Fold {
        /// Distance from the middle of the picture, at or before which it folds.
        found_px: f64,
    },
    /// A per-Gaussian or per-pixel input of the wrong length.
    #[error("{what}: {found} values, expected {expected}")]
    Length {
        /// Name of the input.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length expected.
        expected: usize,
    },
    /// The picture needs more memory than allowed.
    #[error("the picture needs {found_bytes} bytes of memory with {what}, expected at most {limit_bytes}")]
    Memory {
        /// The data that exceeds the cap.
        what: &'static str,
        /// Bytes needed with these data.
        found_bytes: u64,
        /// Bytes allowed.
        limit_bytes: u64,
    },
    /// The picture needs more work than allowed.
    #[error("the picture has {found} splat-tile pairs, expected at most {limit}")]
    Cost {
        /// Number of overlaps between splats and tiles.
        found: u64,
        /// Largest number of overlaps.
        limit: u64,
    },
}

impl RenderError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Camera(_) => "RENDER-CAMERA",
            Self::Setting { .. } => "RENDER-SETTING",
            Self::Fold { .. } => "RENDER-FOLD",
            Self::Length { .. } => "RENDER-LENGTH",
            Self::Memory { .. } => "RENDER-MEMORY",
            Self::Cost { .. } => "RENDER-COST",
        }
    }
}

/// Checks the length of an input.
///
/// # Errors
/// [`RenderError::Length`].
pub(super) fn check_len(what: &'static str, found: usize, expected: usize) -> Result<(), RenderError> {
    if found == expected { Ok(()) } else { Err(RenderError::Length { what, found, expected }) }
}
