use cinesplat::video::VideoError;

use super::exit::Exit;
use super::message::{Failure, MORE_MEMORY};
use crate::cli::memory;

impl From<VideoError> for Failure {
    fn from(error: VideoError) -> Self {
        use VideoError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::File(error) => return error.into(),
            E::UnknownFormat { .. } => {
                (Exit::Usage, "name the output film.mp4, or frames/%05d.png for one picture per frame")
            }
            E::BadPattern { .. } => {
                (Exit::Usage, "write one %05d in the file name, such as frames/%05d.png; %% is a percent sign")
            }
            E::BadSetting { .. } => (Exit::Usage, "give a value in that range"),
            E::Missing { .. } => {
                (Exit::Unavailable, "install FFmpeg with x264 and VP9 (Debian's has both), or write frames/%05d.png")
            }
            // FFmpeg's libraries fail in many ways where memory runs out, and name few of them.
            E::Ffmpeg { .. } if memory::is_short() => (Exit::OverCap, MORE_MEMORY),
            E::Ffmpeg { .. } => (Exit::Fault, "try another size or container, or write frames/%05d.png"),
            E::Png { .. } | E::Exr { .. } | E::FrameSize { .. } => {
                (Exit::Fault, "this is a fault of cinesplat: please report the command")
            }
            E::ReadBack { .. } => (Exit::Io, "the disk or FFmpeg lost frames: render again, or write frames/%05d.png"),
        };
        Self::new(code, message, help, exit)
    }
}
