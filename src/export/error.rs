use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

use cinesplat_trajectory::TrajectoryError;

/// What can go wrong between a shot and another program's file. Indices and lines: keyframes and frames count from 0,
/// lines from 1.
#[derive(Debug, Error)]
pub enum ExportError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file over the cap on what is read into memory.
    #[error("{path}: the file has {found} bytes, expected at most {expected}")]
    TooLarge {
        /// Its size.
        found: u64,
        /// The cap.
        expected: u64,
        /// The file.
        path: PathBuf,
    },
    /// Text that is not JSON: cut off, too deeply nested, numbers beyond f64 and so on.
    #[error("not JSON: {reason}")]
    NotJson {
        /// What the parser found, with line and column.
        reason: String,
    },
    /// Another kind of file than the one asked for.
    #[error("found {found}, expected {expected}")]
    WrongFormat {
        /// What it is or seems to be.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A version that this reader does not know.
    #[error("{format} version {found}, expected {expected}")]
    WrongVersion {
        /// The format's name.
        format: &'static str,
        /// The version in the file.
        found: String,
        /// Versions that are read.
        expected: &'static str,
    },
    /// A JSON field that is missing or holds something else than it should.
    #[error("{place}: found {found}, expected {expected}")]
    BadField {
        /// Path to the field: `keyframes[3].position`.
        place: String,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A line of a text format that does not parse.
    #[error("line {line}: found {found}, expected {expected}")]
    BadLine {
        /// Counting from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A binary file that ends early or holds impossible counts.
    #[error("byte {offset}: found {found}, expected {expected}")]
    BadBytes {
        /// Where, from the start of the file.
        offset: usize,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// Numbers that make no shot.
    #[error("{0}")]
    BadShot(#[from] TrajectoryError),
    /// No camera in the file.
    #[error("no camera poses in the file, expected at least one")]
    NoPoses,
    /// A format that cannot be read back, or not in this variant.
    #[error("{format}: {reason}")]
    NotReadable {
        /// The format's name.
        format: &'static str,
        /// Why.
        reason: String,
    },
}

impl ExportError {
    /// A short stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::TooLarge { .. } => "EXCHANGE-SIZE",
            Self::NotJson { .. } => "EXCHANGE-JSON",
            Self::WrongFormat { .. } => "EXCHANGE-FORMAT",
            Self::WrongVersion { .. } => "EXCHANGE-VERSION",
            Self::BadField { .. } => "EXCHANGE-FIELD",
            Self::BadLine { .. } => "EXCHANGE-LINE",
            Self::BadBytes { .. } => "EXCHANGE-BYTES",
            Self::BadShot(_) => "EXCHANGE-SHOT",
            Self::NoPoses => "EXCHANGE-EMPTY",
            Self::NotReadable { .. } => "EXCHANGE-UNREADABLE",
        }
    }
}
