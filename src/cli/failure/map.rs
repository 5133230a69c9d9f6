use cinesplat::map::MapError;

use super::message::Failure;

impl From<MapError> for Failure {
    fn from(error: MapError) -> Self {
        match error {
            MapError::Trajectory(error) => error.into(),
            MapError::Geometry(error) => error.into(),
            MapError::Render(error) => error.into(),
            MapError::Plot(error) => error.into(),
        }
    }
}
