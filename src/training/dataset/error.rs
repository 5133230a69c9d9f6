use std::path::PathBuf;

use thiserror::Error;

use cinesplat_director::DirectorError;
use cinesplat_files::FileError;
use cinesplat_geometry::GeometryError;
use cinesplat_language::LanguageError;
use cinesplat_objects::ObjectsError;

/// What keeps a dataset from being written or read.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The phrasebook or a stored prompt.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// A scene that no frame fits.
    #[error(transparent)]
    Director(#[from] Box<DirectorError>),
    /// A scene that the operator cannot work in.
    #[error("the generated scene of seed {seed} cannot be planned in: {source}")]
    Scene {
        /// Seed of the scene.
        seed: u64,
        /// Why.
        source: GeometryError,
    },
    /// A generated scene whose objects get no clouds.
    #[error(transparent)]
    Objects(#[from] Box<ObjectsError>),
    /// A line of a shard is not what it should be.
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
        /// The same setting, as asked for.
        expected: String,
    },
    /// A file.
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
            Self::BadLine { .. } => "DATASET-LINE",
            Self::OtherSettings { .. } => "DATASET-SETTINGS",
        }
    }
}
