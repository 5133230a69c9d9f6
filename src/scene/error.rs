use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Error of reading or writing a scene. The message is `FILE: found, expected`.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The path does not exist.
    #[error("{}: no such file or folder", shown(path))]
    NotFound {
        /// The path.
        path: PathBuf,
    },
    /// The path is a device, a pipe or a socket.
    #[error("{}: neither a file nor a folder, expected one of them", shown(path))]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The system denies access.
    #[error("{}: permission denied", shown(path))]
    Permission {
        /// The path.
        path: PathBuf,
    },
    /// Another error of the file system.
    #[error("{}: {source}", shown(path))]
    Io {
        /// The path.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// More bytes than the cap allows, in the file or after decompression.
    #[error("{}: {found} bytes or more, expected at most {cap}", shown(path))]
    TooManyBytes {
        /// The file.
        path: PathBuf,
        /// Size found.
        found: u64,
        /// Size allowed.
        cap: u64,
    },
    /// More Gaussians than the cap allows.
    #[error("{}: {found} Gaussians, expected at most {cap}", shown(path))]
    TooManyGaussians {
        /// The file.
        path: PathBuf,
        /// Number found.
        found: u64,
        /// Number allowed.
        cap: u64,
    },
    /// The scene does not fit into memory.
    #[error(
        "{}: {} {} MB of memory, expected at most {} MB",
        shown(path), taker(*found), needed_bytes.div_ceil(1 << 20), limit_bytes >> 20
    )]
    OutOfMemory {
        /// The file.
        path: PathBuf,
        /// Number found; 0 for the files of a scene before its Gaussians are counted.
        found: u64,
        /// Bytes that reading them takes.
        needed_bytes: u64,
        /// Bytes that it may take.
        limit_bytes: u64,
    },
    /// The system has not the memory that the limit allows.
    #[error(
        "{}: {} {} MB of memory, expected no more than the system has free",
        shown(path), taker(*found), needed_bytes.div_ceil(1 << 20)
    )]
    NoMemory {
        /// The file.
        path: PathBuf,
        /// Number found.
        found: u64,
        /// Bytes that reading them takes.
        needed_bytes: u64,
    },
    /// Content of an unknown format.
    #[error("{}: {found}, expected .ply, .splat, .spz, .sog, .ksplat, .glb or .pcd", shown(path))]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// Description of the content.
        found: String,
    },
    /// A known format without a reader.
    #[error("{}: {format} is not read yet, expected .ply, .splat, .spz, .sog, .ksplat, .glb or .pcd", shown(path))]
    NotReadYet {
        /// The file.
        path: PathBuf,
        /// Name of the format.
        format: &'static str,
    },
    /// A malformed PLY header, or one that lacks properties of a Gaussian.
    #[error("{}: header line {line}: {reason}", shown(path))]
    PlyHeader {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Found and expected.
        reason: String,
    },
    /// A PLY element count that the file has no room for.
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
    /// A truncated PLY.
    #[error("{}: {element} {row} of {rows} ends at byte {needed} or later, file has {found}", shown(path))]
    PlyTruncated {
        /// The file.
        path: PathBuf,
        /// The truncated element.
        element: String,
        /// First incomplete row, from 1.
        row: u64,
        /// Number of rows in the header.
        rows: u64,
        /// Least offset at which that row ends.
        needed: u64,
        /// Size of the file.
        found: u64,
    },
    /// A value in an ASCII PLY that is not a number of its type, or an impossible list length.
    #[error(
        "{}: {element} {row}, property {property}: `{found}` at byte {byte}, expected a number of its type",
        shown(path)
    )]
    PlyValue {
        /// The file.
        path: PathBuf,
        /// Its element.
        element: String,
        /// Its row, from 1.
        row: u64,
        /// Its property.
        property: String,
        /// The text found.
        found: String,
        /// Its offset in the file.
        byte: u64,
    },
    /// A `.splat` whose size is not a multiple of its record.
    #[error("{}: {found} bytes, expected a multiple of 32 above 0", shown(path))]
    SplatSize {
        /// The file.
        path: PathBuf,
        /// Size of the file.
        found: u64,
    },
    /// An SPZ header with invalid values.
    #[error("{}: {reason}", shown(path))]
    SpzHeader {
        /// The file.
        path: PathBuf,
        /// Found and expected.
        reason: String,
    },
    /// An SPZ whose compressed data is damaged or truncated.
    #[error("{}: {reason}", shown(path))]
    SpzCorrupt {
        /// The file.
        path: PathBuf,
        /// Found and expected.
        reason: String,
    },
    /// A compressed file that unpacks to more than its header states, or to far more than its size allows.
    #[error("{}: unpacks to {found} bytes or more, expected at most {cap}", shown(path))]
    SpzBomb {
        /// The file.
        path: PathBuf,
        /// Size found.
        found: u64,
        /// Size allowed.
        cap: u64,
    },
    /// A malformed SOG `meta.json`.
    #[error("{}: meta.json: {reason}", shown(path))]
    SogMeta {
        /// The file.
        path: PathBuf,
        /// Found and expected.
        reason: String,
    },
    /// A picture of a SOG that is missing, damaged or of the wrong size.
    #[error("{}: {file}: {reason}", shown(path))]
    SogPicture {
        /// The bundle or folder.
        path: PathBuf,
        /// Name of the picture.
        file: String,
        /// Found and expected.
        reason: String,
    },
    /// A `.ksplat`, glTF or PCD that is damaged or lacks what a scene needs.
    #[error("{}: byte {byte}: {reason}", shown(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Offset of the fault in the file.
        byte: u64,
        /// Found and expected.
        reason: String,
    },
    /// A file without a usable Gaussian.
    #[error("{}: no usable Gaussian among {found} ({reason}), expected at least 1", shown(path))]
    Empty {
        /// The file.
        path: PathBuf,
        /// Gaussians in the file.
        found: u64,
        /// Why none is usable.
        reason: String,
    },
    /// An up direction that is zero or not finite.
    #[error("{}: up direction {found:?}, expected a finite vector of nonzero length", shown(path))]
    BadUp {
        /// The scene.
        path: PathBuf,
        /// The direction given.
        found: [f64; 3],
    },
}

impl SceneError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotFound { .. } => "SCENE-NOT-FOUND",
            Self::NotAFile { .. } => "SCENE-NOT-A-FILE",
            Self::Permission { .. } => "IO-PERMISSION",
            Self::Io { .. } => "IO-FAILED",
            Self::TooManyBytes { .. } => "SCENE-BYTES-CAP",
            Self::TooManyGaussians { .. } => "SCENE-COUNT-CAP",
            Self::OutOfMemory { .. } | Self::NoMemory { .. } => "MEM-CAP",
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
            Self::Damaged { .. } => "SCENE-DAMAGED",
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

/// A path on one line. Control characters become `?`, so that a file name cannot forge output.
pub(super) fn shown(path: &Path) -> String {
    path.to_string_lossy().chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

/// What takes the memory, with its verb.
fn taker(num_gaussians: u64) -> String {
    if num_gaussians == 0 { "its content takes".to_owned() } else { format!("{num_gaussians} Gaussians take") }
}
