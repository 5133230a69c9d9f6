//! What an encoder will cost, learned from a few frames.

use std::path::Path;

use super::film;
use super::sequence::png_bytes;
use super::settings::NUM_THREADS;
use super::{Preset, VideoError, VideoFormat, VideoSettings};

/// Frames that libvpx looks ahead unless told otherwise (`lag-in-frames`).
const VP9_AHEAD: usize = 25;

/// Encodes frames (`width * height * 3` bytes each) as [`super::VideoWriter`] would for an output of that name, and keeps
/// nothing: to learn how long that takes.
///
/// # Errors
/// [`VideoError`]: an unknown format, a frame of another size, a missing encoder, what the encoder refused.
pub fn rehearse(path: &Path, settings: &VideoSettings, frames: &[&[u8]]) -> Result<(), VideoError> {
    let expected = settings.frame_bytes();
    if let Some(wrong) = frames.iter().find(|frame| frame.len() != expected) {
        return Err(VideoError::FrameSize { found: wrong.len(), expected });
    }
    match VideoFormat::from_path(path)? {
        VideoFormat::Sequence(_) => {
            frames.iter().try_for_each(|rgb8| png_bytes(path, rgb8, settings.width, settings.height).map(|_bytes| ()))
        }
        format => film::encode_to_nothing(path, &format, settings, frames),
    }
}

/// Frames that an encoder takes in before it gives its first one out: about that many are still in work when the last
/// frame comes.
///
/// x264: `rc-lookahead` or, where smaller, the B-frames, then one more than those for the thread that looks ahead, and
/// its threads less one; the presets as `x264 --fullhelp` lists them.
pub fn num_ahead(format: &VideoFormat, settings: &VideoSettings) -> usize {
    let (lookahead, num_b_frames) = match settings.preset {
        Preset::Ultrafast => (0, 0),
        Preset::Veryfast => (10, 3),
        Preset::Fast => (30, 3),
        Preset::Medium => (40, 3),
        Preset::Slow => (50, 3),
        Preset::Veryslow => (60, 8),
    };
    match format {
        VideoFormat::Sequence(_) => 0,
        VideoFormat::WebM => VP9_AHEAD,
        VideoFormat::Mp4 | VideoFormat::Mkv | VideoFormat::Mov => {
            let num_synced = if lookahead > 0 { num_b_frames + 1 } else { 0 };
            lookahead + num_synced + NUM_THREADS - 1
        }
    }
}
