use thiserror::Error;

use cinesplat_geometry::GeometryError;
use cinesplat_render::RenderError;
use cinesplat_trajectory::TrajectoryError;

/// Error of drawing a map.
#[derive(Debug, Error)]
pub enum MapError {
    /// The keyframes make no path.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// There is no up direction.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The matter around the path cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A picture cannot be encoded.
    #[error("the picture of the map cannot be encoded: {reason}")]
    Picture {
        /// What is wrong with it.
        reason: String,
    },
}

impl MapError {
    /// Code for the user.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Trajectory(error) => error.code(),
            Self::Geometry(error) => error.code(),
            Self::Render(error) => error.code(),
            Self::Picture { .. } => "MAP-PICTURE",
        }
    }
}
