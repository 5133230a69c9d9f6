use cinesplat::geometry::GeometryError;
use cinesplat::pipeline::PipelineError;
use cinesplat::trajectory::TrajectoryError;

use super::exit::Exit;
use super::message::Failure;

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            PipelineError::Scene(error) => return error.into(),
            PipelineError::Objects(error) => return error.into(),
            PipelineError::Language(error) => return error.into(),
            PipelineError::Director(error) => return error.into(),
            PipelineError::Reader(error) => return error.into(),
            PipelineError::Trajectory(error) => return error.into(),
            PipelineError::Geometry(error) => return error.into(),
            PipelineError::Export(error) => return error.into(),
            PipelineError::Render(error) => return error.into(),
            PipelineError::Video(error) => return error.into(),
            PipelineError::Vision(error) => return error.into(),
            PipelineError::Job(error) => return error.into(),
            PipelineError::UnknownSynth { .. } => {
                (Exit::NoInput, "name one such as synth:room:7, or write ./ before the name of a file")
            }
            PipelineError::NoSuchFrames { .. } => (Exit::Usage, "give --frames A..B with B one after the last frame"),
            PipelineError::Unreachable { .. } => {
                (Exit::OverCap, "allow more time, lower --min-psnr, or reduce the film (--size, --fps, --frames)")
            }
        };
        Self::new(code, message, help, exit)
    }
}

impl From<TrajectoryError> for Failure {
    fn from(error: TrajectoryError) -> Self {
        let (exit, help) = match error {
            TrajectoryError::TooManyFrames { .. } => (Exit::OverCap, "make it shorter, or lower --fps"),
            _ => (Exit::BadData, "correct that value in the shot's keyframes"),
        };
        Self::new(error.code(), error.to_string(), help, exit)
    }
}

impl From<GeometryError> for Failure {
    fn from(error: GeometryError) -> Self {
        let help = "check the pose or direction that was given";
        Self::new(error.code(), error.to_string(), help, Exit::BadData)
    }
}
