use thiserror::Error;

use cinesplat_director::DirectorError;
use cinesplat_export::ExportError;
use cinesplat_geometry::GeometryError;
use cinesplat_language::LanguageError;
use cinesplat_objects::ObjectsError;
use cinesplat_render::RenderError;
use cinesplat_scene::SceneError;
use cinesplat_trajectory::TrajectoryError;
use cinesplat_video::VideoError;

/// Why a stage of the pipeline stopped: the stage's own error, or settings that do not fit together.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The objects cannot be read or made.
    #[error(transparent)]
    Objects(#[from] ObjectsError),
    /// The words cannot be understood.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// The director cannot direct.
    #[error(transparent)]
    Director(#[from] DirectorError),
    /// The keyframes make no path.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// Numbers that are no pose, camera or direction.
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
    /// A name of a generated scene that says nothing.
    #[error("{found}: no generated scene, expected synth:demo, synth:room:SEED or synth:tabletop:SEED")]
    UnknownSynth {
        /// The name.
        found: String,
    },
    /// Frames that the film does not have.
    #[error("frames {start}..{end} were asked for, the film has {num_frames}, expected a part of 0..{num_frames}")]
    NoSuchFrames {
        /// First frame asked for.
        start: usize,
        /// One after the last.
        end: usize,
        /// Frames of the film.
        num_frames: usize,
    },
    /// No quality holds what is wished for.
    #[error("no quality gives {wanted}; predicted: {reachable}")]
    Unreachable {
        /// Time and accuracy wished for.
        wanted: String,
        /// What each quality would give.
        reachable: String,
    },
}

impl PipelineError {
    /// Stable code for people and scripts: the stage's own where a stage failed.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Scene(error) => error.code(),
            Self::Objects(error) => error.code(),
            Self::Language(error) => error.code(),
            Self::Director(error) => error.code(),
            Self::Trajectory(error) => error.code(),
            Self::Geometry(error) => error.code(),
            Self::Export(error) => error.code(),
            Self::Render(error) => error.code(),
            Self::Video(error) => error.code(),
            Self::UnknownSynth { .. } => "SCENE-SYNTH",
            Self::NoSuchFrames { .. } => "SHOT-FRAMES",
            Self::Unreachable { .. } => "COST-BUDGET",
        }
    }
}
