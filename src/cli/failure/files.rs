use std::io::ErrorKind;

use cinesplat::files::FileError;

use super::exit::Exit;
use super::message::Failure;

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        let is_denied = error.io_error().is_some_and(|error| error.kind() == ErrorKind::PermissionDenied);
        let (exit, help) = match &error {
            FileError::Exists { .. } => (Exit::CannotCreate, "choose another name, or pass --overwrite"),
            FileError::Create { source, .. } if source.kind() == ErrorKind::IsADirectory => {
                (Exit::CannotCreate, "name a file in it")
            }
            FileError::Create { source, .. } | FileError::Write { source, .. } if is_disk_full(source) => {
                (Exit::Io, room_for(source))
            }
            FileError::Create { source, .. } if source.kind() == ErrorKind::InvalidFilename => {
                (Exit::CannotCreate, "choose a shorter name")
            }
            FileError::Create { source, .. } if is_loop(source) => {
                (Exit::CannotCreate, "mend the links of that folder, or choose another one")
            }
            FileError::Create { .. } => (Exit::CannotCreate, "create the folder, or choose one that you may write to"),
            FileError::Read { source, .. } if source.kind() == ErrorKind::NotFound => (Exit::NoInput, "check the path"),
            FileError::Read { .. } => (Exit::Io, "check the path and its permissions"),
            FileError::NotAFile { .. } => (Exit::BadData, "save the data to a file, and name that file"),
            FileError::TooLarge { .. } => (Exit::OverCap, "is this the right file?"),
            FileError::Write { .. } => (Exit::Io, "check free space and permissions of the folder"),
        };
        Self::new(error.code(), error.to_string(), help, if is_denied { Exit::Permission } else { exit })
    }
}

/// Whether an error says that there is no room: on the disk, in the user's share of it, or under the limit on file sizes.
fn is_disk_full(error: &std::io::Error) -> bool {
    matches!(error.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge)
}

/// What makes room where [`is_disk_full`].
fn room_for(error: &std::io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::FileTooLarge => {
            "raise the limit on file sizes (ulimit -f), or write to a disk that takes larger files"
        }
        ErrorKind::QuotaExceeded => "free space in your share of the disk",
        _ => "free space on the disk",
    }
}

/// Whether an error says that links lead to each other.
fn is_loop(error: &std::io::Error) -> bool {
    #[cfg(unix)]
    {
        error.raw_os_error() == Some(nix::errno::Errno::ELOOP as i32)
    }
    #[cfg(not(unix))]
    {
        let _ = error;
        false
    }
}
