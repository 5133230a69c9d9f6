//! Film files by FFmpeg: the only folder that knows it.

mod encoder;
mod rate;
mod read_back;
mod watched_file;

pub(crate) use encoder::{FilmEncoder, encode_to_nothing};

/// Whether FFmpeg on this machine has the encoder of that name.
pub(crate) fn has_encoder(name: &str) -> bool {
    ffmpeg_next::encoder::find_by_name(name).is_some()
}
