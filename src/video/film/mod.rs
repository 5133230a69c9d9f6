//! Film files, written with FFmpeg. The only folder that uses FFmpeg.
//!
//! Enters: 8-bit RGB frames in order. Leaves: one container file with one video stream. The invariant: a file gets its
//! name only after it has been read back and holds every frame.

mod decode;
mod encoder;
mod marks;
mod rate;
mod read_back;
mod watched_file;

pub(crate) use decode::read_film;
pub(crate) use encoder::{FilmEncoder, encode_and_discard};

/// Whether FFmpeg on this machine has the encoder named `name`.
pub(crate) fn has_encoder(name: &str) -> bool {
    ffmpeg_next::encoder::find_by_name(name).is_some()
}
