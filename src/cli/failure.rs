use std::fmt;
use std::io;
use std::path::Path;

use cinesplat::director::DirectorError;
use cinesplat::evaluation::EvaluationError;
use cinesplat::export::ExportError;
use cinesplat::files::FileError;
use cinesplat::geometry::GeometryError;
use cinesplat::language::LanguageError;
use cinesplat::objects::ObjectsError;
use cinesplat::pipeline::PipelineError;
use cinesplat::render::RenderError;
use cinesplat::scene::SceneError;
use cinesplat::training::{DatasetError, TrainError};
use cinesplat::trajectory::TrajectoryError;
use cinesplat::video::VideoError;

/// How a command ends badly: what a person reads and what a script sees.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Failure {
    code: String,
    message: String,
    help: String,
    exit_code: u8,
}

impl Failure {
    /// Any failure; `message` is `FILE: what was found, what was expected`, or the latter half where no file is at fault.
    pub(super) fn new(code: &str, message: impl Into<String>, help: impl Into<String>, exit_code: u8) -> Self {
        Self { code: code.to_owned(), message: message.into(), help: help.into(), exit_code }
    }

    /// Arguments that do not go together.
    pub(super) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new("USAGE", message, help, 2)
    }

    /// A fault of this program.
    pub(super) fn fault(place: &str) -> Self {
        let help = "this is a fault of cinesplat, not yours: please report it with the command and the file";
        Self::new("FAULT", format!("cinesplat itself failed: {place}"), help, 70)
    }

    /// An error of the file system.
    pub(super) fn io(file: &str, error: &io::Error) -> Self {
        let (code, exit_code, help) = match error.kind() {
            io::ErrorKind::NotFound => ("NOT-FOUND", 66, "check the path"),
            io::ErrorKind::PermissionDenied => ("PERMISSION", 77, "change the permissions, or choose another place"),
            _ => ("IO", 74, "check free space and the disk, then try again"),
        };
        Self::new(code, format!("{file}: {error}"), help, exit_code)
    }

    /// The same failure, about a file that the message does not name yet.
    pub(super) fn in_file(mut self, path: &Path) -> Self {
        let file = path.display().to_string();
        if !self.message.contains(&file) {
            self.message = format!("{file}: {}", self.message);
        }
        self
    }

    /// Exit code of the program.
    pub(super) fn exit_code(&self) -> u8 {
        self.exit_code
    }
}

impl fmt::Display for Failure {
    /// Two lines, whatever the texts hold.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let one_line = |text: &str| text.split('\n').map(str::trim).collect::<Vec<_>>().join(" ");
        write!(f, "error[{}]: {}\nhelp: {}", self.code, one_line(&self.message), one_line(&self.help))
    }
}

/// Failures from the errors of stages that know their code, help and exit code themselves.
macro_rules! from_stages {
    ($($error:ty)*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                let exit_code = u8::try_from(error.exit_code()).unwrap_or(70);
                Self::new(error.code(), error.to_string(), error.help(), exit_code)
            }
        })*
    };
}

from_stages! {
    FileError SceneError ObjectsError LanguageError DirectorError TrainError DatasetError ExportError RenderError VideoError
    PipelineError EvaluationError
}

impl From<TrajectoryError> for Failure {
    fn from(error: TrajectoryError) -> Self {
        PipelineError::from(error).into()
    }
}

impl From<GeometryError> for Failure {
    fn from(error: GeometryError) -> Self {
        PipelineError::from(error).into()
    }
}
