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

    /// How to mend it, one line.
    pub fn help(&self) -> String {
        match self {
            Self::File(error) => error.help(),
            Self::NotJson { .. } | Self::WrongKind { .. } => {
                "`cinesplat objects SCENE -o objects.json` writes a file to start from".to_owned()
            }
            Self::BadField { .. } => {
                "an object needs `id` (1..65535) and `center` with `half_extents`, or Gaussians in `labels`".to_owned()
            }
            Self::DuplicateId { id, .. } => format!("give one of the two another id than {id}"),
            Self::BadLabels { .. } => {
                "labels are a little-endian .npy of u8, u16 or u32 with one id a Gaussian, in the scene's order"
                    .to_owned()
            }
            Self::Picture { .. } => "leave the sheet out, or report the scene that it fails on".to_owned(),
        }
    }

    /// Exit code of the program: 65 bad data, 66 no such input, 70 a fault of ours, 74 I/O, 77 permission.
    pub fn exit_code(&self) -> i32 {
        match self {
            Self::File(error) => error.exit_code(),
            Self::Picture { .. } => 70,
            _ => 65,
        }
    }
}
