use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a scene could not be read or written. `Display` is `FILE: what was found, what was expected`.
#[derive(Debug, Error)]
pub enum SceneError {
    /// Nothing is at the path.
    #[error("{}: no such file or folder", shown(path))]
    NotFound {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path is a device, a pipe or a socket.
    #[error("{}: neither a file nor a folder, expected one of them", shown(path))]
    NotAFile {
        /// The path asked for.
        path: PathBuf,
    },
    /// The system does not let this user read or write there.
    #[error("{}: permission denied", shown(path))]
    Permission {
        /// The path asked for.
        path: PathBuf,
    },
    /// Any other fault of the file system.
    #[error("{}: {source}", shown(path))]
    Io {
        /// The path in work.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// More bytes than the cap allows, in the file or after decompression.
    #[error("{}: {found} bytes or more, the cap is {cap}", shown(path))]
    TooManyBytes {
        /// The file.
        path: PathBuf,
        /// Size found.
        found: u64,
        /// Size allowed.
        cap: u64,
    },
    /// More Gaussians than the cap allows.
    #[error("{}: {found} Gaussians, the cap is {cap}", shown(path))]
    TooManyGaussians {
        /// The file.
        path: PathBuf,
        /// Number found.
        found: u64,
        /// Number allowed.
        cap: u64,
    },
    /// Memory does not hold the scene.
    #[error("{}: {found} Gaussians, which is more than memory holds", shown(path))]
    OutOfMemory {
        /// The file.
        path: PathBuf,
        /// Number found.
        found: u64,
    },
    /// No format of ours begins like this.
    #[error("{}: {found}, expected .ply, .splat, .spz or .sog", shown(path))]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        found: String,
    },
    /// A format that is known but has no reader.
    #[error("{}: {format} is not read yet, expected .ply, .splat, .spz or .sog", shown(path))]
    NotReadYet {
        /// The file.
        path: PathBuf,
        /// Name of the format.
        format: &'static str,
    },
    /// A PLY header that is not one, or lacks what makes a point a Gaussian.
    #[error("{}: header line {line}: {reason}", shown(path))]
    PlyHeader {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What was found and what was expected.
        reason: String,
    },
    /// A PLY element count that no file can have.
    #[error(
        "{}: header line {line}: element count `{found}`, expected a whole number that the file has room for",
        shown(path)
    )]
    PlyCount {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// The count as written.
        found: String,
    },
    /// A PLY that ends before its rows do.
    #[error("{}: {element} {row} of {rows} ends at byte {needed} or later, file has {found}", shown(path))]
    PlyTruncated {
        /// The file.
        path: PathBuf,
        /// Element that is cut.
        element: String,
        /// First row that is not whole, from 1.
        row: u64,
        /// Rows that the header claims.
        rows: u64,
        /// Where that row ends at the earliest.
        needed: u64,
        /// Size of the file.
        found: u64,
    },
    /// A value in an ASCII PLY that is no number of its type, or a list length that cannot be.
    #[error(
        "{}: {element} {row}, property {property}: `{found}` at byte {byte}, expected a number of its type",
        shown(path)
    )]
    PlyValue {
        /// The file.
        path: PathBuf,
        /// Element it is in.
        element: String,
        /// Row it is in, from 1.
        row: u64,
        /// Property it is in.
        property: String,
        /// The text found.
        found: String,
        /// Where it begins.
        byte: u64,
    },
    /// A `.splat` that is not whole records.
    #[error("{}: {found} bytes, expected a multiple of 32 above 0", shown(path))]
    SplatSize {
        /// The file.
        path: PathBuf,
        /// Size of the file.
        found: u64,
    },
    /// An SPZ header with values that no SPZ has.
    #[error("{}: {reason}", shown(path))]
    SpzHeader {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        reason: String,
    },
    /// An SPZ whose compressed data is damaged or cut.
    #[error("{}: {reason}", shown(path))]
    SpzCorrupt {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        reason: String,
    },
    /// A compressed file that unpacks to more than its header says, or to absurdly more than it holds.
    #[error("{}: unpacks to {found} bytes or more, expected at most {cap}", shown(path))]
    SpzBomb {
        /// The file.
        path: PathBuf,
        /// Size asked for.
        found: u64,
        /// Size allowed.
        cap: u64,
    },
    /// A SOG `meta.json` that is not one.
    #[error("{}: meta.json: {reason}", shown(path))]
    SogMeta {
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        reason: String,
    },
    /// A picture of a SOG that is missing, damaged or of the wrong size.
    #[error("{}: {file}: {reason}", shown(path))]
    SogPicture {
        /// The bundle or folder.
        path: PathBuf,
        /// Name of the picture.
        file: String,
        /// What was found and what was expected.
        reason: String,
    },
    /// Nothing in the file can be drawn.
    #[error("{}: no usable Gaussian among {found} ({reason}), expected at least 1", shown(path))]
    Empty {
        /// The file.
        path: PathBuf,
        /// Gaussians in the file.
        found: u64,
        /// What happened to them.
        reason: String,
    },
    /// An up direction without length.
    #[error("{}: up direction {found:?}, expected a finite vector of some length", shown(path))]
    BadUp {
        /// The scene it was meant for.
        path: PathBuf,
        /// The direction given.
        found: [f64; 3],
    },
}

impl SceneError {
    /// Short stable name of the kind of fault.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotFound { .. } => "SCENE-NOT-FOUND",
            Self::NotAFile { .. } => "SCENE-NOT-A-FILE",
            Self::Permission { .. } => "IO-PERMISSION",
            Self::Io { .. } => "IO-FAILED",
            Self::TooManyBytes { .. } => "SCENE-BYTES-CAP",
            Self::TooManyGaussians { .. } => "SCENE-COUNT-CAP",
            Self::OutOfMemory { .. } => "MEM-CAP",
            Self::UnknownFormat { .. } => "SCENE-FORMAT",
            Self::NotReadYet { .. } => "SCENE-UNSUPPORTED",
            Self::PlyHeader { .. } => "PLY-HEADER",
            Self::PlyCount { .. } => "PLY-COUNT",
            Self::PlyTruncated { .. } => "PLY-TRUNCATED",
            Self::PlyValue { .. } => "PLY-VALUE",
            Self::SplatSize { .. } => "SPLAT-SIZE",
            Self::SpzHeader { .. } => "SPZ-HEADER",
            Self::SpzCorrupt { .. } => "SPZ-CORRUPT",
            Self::SpzBomb { .. } => "SPZ-BOMB",
            Self::SogMeta { .. } => "SOG-META",
            Self::SogPicture { .. } => "SOG-PICTURE",
            Self::Empty { .. } => "SCENE-EMPTY",
            Self::BadUp { .. } => "UP-DIRECTION",
        }
    }

    /// The error for a failed call on `path`.
    pub(super) fn from_io(path: &Path, source: io::Error) -> Self {
        let path = path.to_path_buf();
        match source.kind() {
            io::ErrorKind::NotFound => Self::NotFound { path },
            io::ErrorKind::PermissionDenied => Self::Permission { path },
            _ => Self::Io { path, source },
        }
    }
}

/// A path on one line: control characters become `?`, so that a name cannot forge output.
fn shown(path: &Path) -> String {
    path.to_string_lossy().chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}
