use std::path::PathBuf;

use thiserror::Error;

use cinesplat_director::DirectorError;
use cinesplat_files::FileError;
use cinesplat_geometry::GeometryError;
use cinesplat_language::LanguageError;
use cinesplat_objects::ObjectsError;

/// Error of writing or reading a dataset.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// A prompt cannot be sampled, or a stored prompt cannot be read.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// A scene without extent or up direction.
    #[error(transparent)]
    Director(#[from] Box<DirectorError>),
    /// A generated scene that the operator cannot use.
    #[error("the generated scene of seed {seed} is unusable: {source}")]
    Scene {
        /// Seed of the scene.
        seed: u64,
        /// The reason.
        source: GeometryError,
    },
    /// The clouds of a generated scene cannot be made.
    #[error(transparent)]
    Objects(#[from] Box<ObjectsError>),
    /// A setting is out of range.
    #[error("{setting} is {found}, expected {expected}")]
    BadSetting {
        /// Name of the setting.
        setting: &'static str,
        /// Its value.
        found: String,
        /// The allowed values.
        expected: String,
    },
    /// A malformed line of a shard.
    #[error("{}: line {line}: found {found}, expected {expected}", path.display())]
    BadLine {
        /// The shard.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// A shard that exists was made with other settings.
    #[error("{}: made with {found}, expected {expected}", path.display())]
    OtherSettings {
        /// The shard.
        path: PathBuf,
        /// The setting that differs, with its value in the shard.
        found: String,
        /// The same setting with its requested value.
        expected: String,
    },
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl DatasetError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Language(error) => error.code(),
            Self::Director(error) => error.code(),
            Self::Objects(error) => error.code(),
            Self::File(error) => error.code(),
            Self::Scene { .. } => "DATASET-SCENE",
            Self::BadSetting { .. } => "DATASET-SETTING",
            Self::BadLine { .. } => "DATASET-LINE",
            Self::OtherSettings { .. } => "DATASET-SETTINGS",
        }
    }
}
