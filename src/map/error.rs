use thiserror::Error;

use cinesplat_geometry::GeometryError;
use cinesplat_plot::PlotError;
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
    /// The map cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl MapError {
    /// Code for the user.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Trajectory(error) => error.code(),
            Self::Geometry(error) => error.code(),
            Self::Render(error) => error.code(),
            Self::Plot(error) => error.code(),
        }
    }
}
