use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

/// Error of an objects file, its labels, or pictures of objects. The message begins with the file.
#[derive(Debug, Error)]
pub enum ObjectsError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Text that is not JSON.
    #[error("{}: not JSON: {reason}, expected an objects file", path.display())]
    NotJson {
        /// The file.
        path: PathBuf,
        /// The parser's message with line and column.
        reason: String,
    },
    /// JSON of another format or version.
    #[error("{}: found {key} {found}, expected {expected}", path.display())]
    WrongKind {
        /// The file.
        path: PathBuf,
        /// `format` or `version`.
        key: &'static str,
        /// The value found.
        found: String,
        /// The value expected.
        expected: &'static str,
    },
    /// A field of an entry is missing or has a wrong value.
    #[error("{}: {entry}: field `{field}` is {found}, expected {expected}", path.display())]
    BadField {
        /// The file.
        path: PathBuf,
        /// The entry, such as `object 3 (id 7)`; `file` for the top level.
        entry: String,
        /// Name of the field.
        field: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Two entries have the same id.
    #[error("{}: object {first} and object {second} both have id {id}, expected one object per id", path.display())]
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
    /// The label file is not an array of one integer per Gaussian.
    #[error("{}: labels: found {found}, expected {expected}", path.display())]
    BadLabels {
        /// The label file.
        path: PathBuf,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The clouds file is no `safetensors` file, or a cloud in it is no list of points.
    #[error("{}: clouds: found {found}, expected tensors ID.points of N x 3 finite numbers (F32 or F64), and ID.dino of N rows (F32)", path.display())]
    BadClouds {
        /// The clouds file.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// Masks cannot be lifted to the Gaussians.
    #[error("masks cannot be lifted: {reason}")]
    Lift {
        /// Message of the renderer.
        reason: String,
    },
    /// A mask is not a gray PNG.
    #[error("{}: mask: found {found}, expected a gray PNG of 8 or 16 bits whose values are ids", path.display())]
    BadMask {
        /// The mask.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A picture cannot be rendered or encoded.
    #[error("picture of the objects failed: {reason}")]
    Picture {
        /// Message of the renderer or encoder.
        reason: String,
    },
}

impl ObjectsError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::NotJson { .. } => "OBJ-JSON",
            Self::WrongKind { .. } => "OBJ-VERSION",
            Self::BadField { .. } => "OBJ-FIELD",
            Self::DuplicateId { .. } => "OBJ-DUPLICATE",
            Self::BadLabels { .. } => "OBJ-LABELS",
            Self::BadClouds { .. } => "OBJ-CLOUDS",
            Self::BadMask { .. } => "OBJ-MASK",
            Self::Lift { .. } => "OBJ-LIFT",
            Self::Picture { .. } => "OBJ-PICTURE",
        }
    }
}
