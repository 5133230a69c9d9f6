//! Frames to a film file or a sequence of pictures: films need the feature `ffmpeg`, which is on by default.
//!
//! Enters: 8-bit RGB frames, in order. Leaves: H.264 (MP4, Matroska, QuickTime), VP9 (WebM) or PNG files with exact
//! times and BT.709 color tags. The invariant: a file that bears its name is whole and was read back.

mod bt709;
mod contact_sheet;
mod error;
#[cfg(feature = "ffmpeg")]
mod film;
#[cfg(not(feature = "ffmpeg"))]
#[path = "no_film.rs"]
mod film;
mod pattern;
mod rehearsal;
mod sequence;
mod settings;
mod writer;

pub use bt709::{Planes420, planes_from_rgb8};
pub use contact_sheet::ContactSheet;
pub use error::VideoError;
pub use pattern::FramePattern;
pub use rehearsal::{num_ahead, rehearse};
pub use sequence::write_png;
pub use settings::{Preset, VideoFormat, VideoSettings};
pub use writer::{VideoWriter, check_output, size_note};
