use cinesplat::files::FileError;
use cinesplat::pipeline::JobError;

use super::exit::Exit;
use super::message::Failure;

impl From<JobError> for Failure {
    fn from(error: JobError) -> Self {
        use JobError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::File(error) => return error.into(),
            E::Video(error) => return (*error).into(),
            E::Locked { .. } => (Exit::Stopped, "wait until it ends, or give this film another name"),
            E::Lost { .. } => (Exit::Stopped, "type the same line again: finished frames that are there are kept"),
            E::Mismatch { .. } => {
                (Exit::BadData, "type the line of that film to go on with it, or pass --fresh to throw its frames away")
            }
            E::Unreadable { .. } => (Exit::BadData, "pass --fresh to throw the folder's frames away"),
            E::NoSpace { .. } => {
                (Exit::Io, "free space, name an output on another disk, or pass --no-job to keep no frames")
            }
            E::NotPlaced { error: FileError::Exists { .. }, .. } => {
                (Exit::CannotCreate, "give it a name yourself, or type the same line with --overwrite")
            }
            E::NotPlaced { .. } => (Exit::Io, "give it a name yourself, or type the same line again"),
            E::Flushing { .. } => (Exit::Fault, "type the same line again: finished frames are kept"),
        };
        Self::new(code, message, help, exit)
    }
}
