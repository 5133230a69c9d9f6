use thiserror::Error;

use super::job::JobError;
use cinesplat_director::DirectorError;
use cinesplat_export::ExportError;
use cinesplat_geometry::GeometryError;
use cinesplat_language::LanguageError;
use cinesplat_objects::ObjectsError;
use cinesplat_reader::ReaderError;
use cinesplat_render::RenderError;
use cinesplat_scene::SceneError;
use cinesplat_trajectory::TrajectoryError;
use cinesplat_video::VideoError;
use cinesplat_vision::VisionError;

/// Error of a stage, or of settings that do not fit together.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The objects cannot be read or made.
    #[error(transparent)]
    Objects(#[from] ObjectsError),
    /// The prompt cannot be linked to the scene.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// The director cannot turn the prompt into a program.
    #[error(transparent)]
    Director(#[from] DirectorError),
    /// The language model cannot turn the prompt into a program.
    #[error(transparent)]
    Reader(#[from] ReaderError),
    /// The keyframes make no path.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// Numbers that make no pose, camera or direction.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// A camera file cannot be read or written.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A picture cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The film cannot be written.
    #[error(transparent)]
    Video(#[from] VideoError),
    /// The network for pictures cannot describe one.
    #[error(transparent)]
    Vision(#[from] VisionError),
    /// The job folder of a film cannot be used.
    #[error(transparent)]
    Job(#[from] JobError),
    /// No generated scene has this name.
    #[error("{found}: unknown generated scene, expected synth:demo, synth:room:SEED or synth:tabletop:SEED")]
    UnknownSynth {
        /// The name given.
        found: String,
    },
    /// A range of frames that is empty or exceeds the film.
    #[error("frames {start}..{end} of a film of {num_frames}, expected a range within 0..{num_frames}")]
    NoSuchFrames {
        /// First frame of the range.
        start: usize,
        /// One past its last frame.
        end: usize,
        /// Frames of the film.
        num_frames: usize,
    },
    /// No quality meets the requirements.
    #[error("no quality gives {wanted}; predicted: {reachable}")]
    Unreachable {
        /// Time and accuracy required.
        wanted: String,
        /// Forecast of each quality.
        reachable: String,
    },
}

impl PipelineError {
    /// Stable code for people and scripts; that of the stage where a stage failed.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Scene(error) => error.code(),
            Self::Objects(error) => error.code(),
            Self::Language(error) => error.code(),
            Self::Director(error) => error.code(),
            Self::Reader(error) => error.code(),
            Self::Trajectory(error) => error.code(),
            Self::Geometry(error) => error.code(),
            Self::Export(error) => error.code(),
            Self::Render(error) => error.code(),
            Self::Video(error) => error.code(),
            Self::Vision(error) => error.code(),
            Self::Job(error) => error.code(),
            Self::UnknownSynth { .. } => "SCENE-SYNTH",
            Self::NoSuchFrames { .. } => "SHOT-FRAMES",
            Self::Unreachable { .. } => "COST-BUDGET",
        }
    }
}
