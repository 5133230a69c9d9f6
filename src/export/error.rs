use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

use cinesplat_trajectory::TrajectoryError;

/// Error of reading or writing a camera path. Keyframes and frames count from 0, lines from 1.
#[derive(Debug, Error)]
pub enum ExportError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file above the cap on files that are read into memory.
    #[error("{path}: the file has {found} bytes, expected at most {expected}")]
    TooLarge {
        /// Its size.
        found: u64,
        /// The cap.
        expected: u64,
        /// The file.
        path: PathBuf,
    },
    /// Text that is not JSON: truncated, nested too deeply, numbers beyond f64.
    #[error("not JSON: {reason}")]
    NotJson {
        /// The parser's message with line and column.
        reason: String,
    },
    /// A file of another format than expected.
    #[error("found {found}, expected {expected}")]
    WrongFormat {
        /// The format found.
        found: String,
        /// The formats expected.
        expected: String,
    },
    /// A version without a reader.
    #[error("{format} version {found}, expected {expected}")]
    WrongVersion {
        /// The format's name.
        format: &'static str,
        /// The version in the file.
        found: String,
        /// Versions that are read.
        expected: &'static str,
    },
    /// A JSON field that is missing or has a wrong value.
    #[error("{place}: found {found}, expected {expected}")]
    BadField {
        /// Path to the field: `keyframes[3].position`.
        place: String,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: String,
    },
    /// A line of a text format that does not parse.
    #[error("line {line}: found {found}, expected {expected}")]
    BadLine {
        /// Line, from 1.
        line: usize,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: String,
    },
    /// A binary file that ends early or holds impossible counts.
    #[error("byte {offset}: found {found}, expected {expected}")]
    BadBytes {
        /// Offset from the start of the file.
        offset: usize,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: String,
    },
    /// A fault in one of a folder's files, or in a topic of a recording.
    #[error("{name}: {error}")]
    InFile {
        /// Name of the file or topic.
        name: String,
        /// The fault.
        error: Box<Self>,
    },
    /// Keyframes that make no shot.
    #[error("{0}")]
    BadShot(#[from] TrajectoryError),
    /// No camera in the file.
    #[error("no camera poses in the file, expected at least one")]
    NoPoses,
    /// A format that is only read.
    #[error("{format} is read and not written, expected one of {}", .expected.join(", "))]
    NotWritable {
        /// The format's name.
        format: &'static str,
        /// The formats that are written.
        expected: Vec<&'static str>,
    },
    /// A format, or a variant of it, without a reader.
    #[error("{format}: {reason}")]
    NotReadable {
        /// The format's name.
        format: &'static str,
        /// The reason.
        reason: String,
    },
}

impl ExportError {
    /// Stable code for people and scripts.
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
            Self::InFile { error, .. } => error.code(),
            Self::BadShot(_) => "EXCHANGE-SHOT",
            Self::NoPoses => "EXCHANGE-EMPTY",
            Self::NotWritable { .. } => "EXCHANGE-READ-ONLY",
            Self::NotReadable { .. } => "EXCHANGE-UNREADABLE",
        }
    }
}
