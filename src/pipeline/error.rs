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
    /// The encoding thread ended without a word.
    #[error("the encoding thread stopped without an error")]
    EncoderStopped,
}

/// The same question to whichever error it is.
macro_rules! ask_stage {
    ($self:ident, $stage:ident => $answer:expr, $($own:tt)*) => {
        match $self {
            Self::Scene($stage) => $answer,
            Self::Objects($stage) => $answer,
            Self::Language($stage) => $answer,
            Self::Director($stage) => $answer,
            Self::Export($stage) => $answer,
            Self::Render($stage) => $answer,
            Self::Video($stage) => $answer,
            $($own)*
        }
    };
}

impl PipelineError {
    /// Short name of the case, for messages and searches.
    pub fn code(&self) -> &'static str {
        ask_stage!(self, stage => stage.code(),
            Self::Trajectory(_) => "SHOT-KEYS",
            Self::Geometry(_) => "GEOMETRY",
            Self::UnknownSynth { .. } => "SCENE-SYNTH",
            Self::NoSuchFrames { .. } => "SHOT-FRAMES",
            Self::Unreachable { .. } => "COST-BUDGET",
            Self::EncoderStopped => "VIDEO-STOPPED",
        )
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        ask_stage!(self, stage => stage.help(),
            Self::Trajectory(_) => "correct that value in the shot's keyframes".to_owned(),
            Self::Geometry(_) => "check the pose or direction that was given".to_owned(),
            Self::UnknownSynth { .. } => "for example synth:room:7, or a file with ./ before its name".to_owned(),
            Self::NoSuchFrames { .. } => "give --frames A..B with B one after the last frame".to_owned(),
            Self::Unreachable { .. } => {
                "allow more time, ask for fewer decibels, or film smaller (--size, --fps, --frames)".to_owned()
            }
            Self::EncoderStopped => "this is a fault of cinesplat: please report the command".to_owned(),
        )
    }

    /// Exit code of the program for this case, as in `sysexits.h`.
    pub fn exit_code(&self) -> i32 {
        ask_stage!(self, stage => stage.exit_code(),
            Self::Trajectory(_) | Self::Geometry(_) => 65,
            Self::UnknownSynth { .. } => 66,
            Self::NoSuchFrames { .. } => 2,
            Self::Unreachable { .. } => 71,
            Self::EncoderStopped => 70,
        )
    }
}
