use cinesplat::map::MapError;

use super::exit::Exit;
use super::message::Failure;

impl From<MapError> for Failure {
    fn from(error: MapError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        match error {
            MapError::Trajectory(error) => error.into(),
            MapError::Geometry(error) => error.into(),
            MapError::Render(error) => error.into(),
            MapError::Picture { .. } => {
                Self::new(code, message, "leave out the map, or report the shot that it fails on", Exit::Fault)
            }
        }
    }
}
