//! Film files, written with FFmpeg. The only folder that uses FFmpeg.
//!
//! Enters: 8-bit RGB frames in order. Leaves: one container file with one video stream. The invariant: a file gets its
//! name only after it has been read back and holds every frame.

mod encoder;
mod rate;
mod read_back;
mod spherical;
mod watched_file;

pub(crate) use encoder::{FilmEncoder, encode_and_discard};

/// Whether FFmpeg on this machine has the encoder named `name`.
pub(crate) fn has_encoder(name: &str) -> bool {
    ffmpeg_next::encoder::find_by_name(name).is_some()
}
