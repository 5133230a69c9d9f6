use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

/// What can go wrong with an objects file, its labels, or the pictures of objects. `Display` begins with the file.
#[derive(Debug, Error)]
pub enum ObjectsError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is not JSON at all.
    #[error("{}: not JSON: {reason}, expected an objects file", path.display())]
    NotJson {
        /// The file.
        path: PathBuf,
        /// What the parser said, with line and column.
        reason: String,
    },
    /// The JSON is of another kind, or of a version that this program does not know.
    #[error("{}: found {key} {found}, expected {expected}", path.display())]
    WrongKind {
        /// The file.
        path: PathBuf,
        /// `format` or `version`.
        key: &'static str,
        /// What it says.
        found: String,
        /// What it should say.
        expected: &'static str,
    },
    /// A field of one entry is missing or has a value that it cannot have.
    #[error("{}: {entry}: field `{field}` is {found}, expected {expected}", path.display())]
    BadField {
        /// The file.
        path: PathBuf,
        /// Which entry, such as `object 3 (id 7)`; `file` for the top level.
        entry: String,
        /// Name of the field.
        field: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Two entries have the same id.
    #[error("{}: object {first} and object {second} both have id {id}, expected one object an id", path.display())]
    DuplicateId {
        /// The file.
        path: PathBuf,
        /// The id.
        id: u32,
        /// Position of the first entry that has it, from 1.
        first: usize,
        /// Position of the second, from 1.
        second: usize,
    },
    /// The label file is no array of one integer a Gaussian.
    #[error("{}: labels: found {found}, expected {expected}", path.display())]
    BadLabels {
        /// The label file.
        path: PathBuf,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A picture cannot be made.
    #[error("picture of the objects failed: {reason}")]
    Picture {
        /// What the renderer or the encoder said.
        reason: String,
    },
}

impl ObjectsError {
    /// Stable name for scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::NotJson { .. } => "OBJ-JSON",
            Self::WrongKind { .. } => "OBJ-VERSION",
            Self::BadField { .. } => "OBJ-FIELD",
            Self::DuplicateId { .. } => "OBJ-DUPLICATE",
            Self::BadLabels { .. } => "OBJ-LABELS",
            Self::Picture { .. } => "OBJ-PICTURE",
        }
    }
}
