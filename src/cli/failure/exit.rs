use std::io::{self, ErrorKind};

use strum::FromRepr;

/// Exit code of a command that fails. The numbers above 63 are those of `sysexits.h`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, FromRepr)]
#[repr(u8)]
pub(crate) enum Exit {
    /// Wrong arguments.
    Usage = 2,
    /// The input's content is wrong.
    BadData = 65,
    /// The input does not exist.
    NoInput = 66,
    /// A codec or a device is missing.
    Unavailable = 69,
    /// A fault of cinesplat itself.
    Fault = 70,
    /// A memory or cost cap is exceeded.
    OverCap = 71,
    /// The output cannot be created.
    CannotCreate = 73,
    /// Reading or writing failed.
    Io = 74,
    /// Stopped early; the work can be resumed.
    Stopped = 75,
    /// The system denies access.
    Permission = 77,
}

impl Exit {
    /// The exit code for a failed read.
    pub(super) fn of_read(error: &io::Error) -> Self {
        match error.kind() {
            ErrorKind::NotFound => Self::NoInput,
            ErrorKind::PermissionDenied => Self::Permission,
            _ => Self::Io,
        }
    }
}
