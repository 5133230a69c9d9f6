//! For estimates of encoding time: encodes frames without writing a file, and returns the delay of each encoder.

use std::path::Path;

use super::film;
use super::sequence::encode_png;
use super::settings::NUM_THREADS;
use super::{VideoError, VideoFormat, VideoSettings, X264Preset};

/// Default lookahead of libvpx in frames (`lag-in-frames`).
const VP9_LOOKAHEAD: usize = 25;

/// Encodes frames (`width * height * 3` bytes each) as [`super::VideoWriter`] would for the output `path`, and discards
/// the result. The caller measures how long it takes.
///
/// # Errors
/// [`VideoError::UnknownFormat`] or [`VideoError::BadPattern`] for the name, [`VideoError::FrameSize`] for a frame of
/// another size, [`VideoError::Missing`] without the encoder, [`VideoError::Ffmpeg`] if the encoder fails.
pub fn encode_and_discard(path: &Path, settings: &VideoSettings, frames: &[&[u8]]) -> Result<(), VideoError> {
    let expected = settings.frame_bytes();
    if let Some(wrong) = frames.iter().find(|frame| frame.len() != expected) {
        return Err(VideoError::FrameSize { found: wrong.len(), expected });
    }
    match VideoFormat::from_path(path)? {
        VideoFormat::Sequence(_) => {
            frames.iter().try_for_each(|rgb8| encode_png(rgb8, [settings.width, settings.height]).map(|_bytes| ()))
        }
        format => film::encode_and_discard(path, &format, settings, frames),
    }
}

/// Delay of the encoder in frames: the number of frames that it buffers before it returns the first packet. About as
/// many are still to be encoded after the last frame was sent.
///
/// For x264 it is the sum of `rc-lookahead` or the number of B-frames if that is greater, the number of threads minus one and, with a lookahead, the number of
/// B-frames plus one. `x264 --fullhelp` lists the values of the presets.
pub fn encoder_delay_frames(format: &VideoFormat, settings: &VideoSettings) -> usize {
    let (lookahead, num_b_frames) = match settings.preset.unwrap_or_default() {
        X264Preset::Ultrafast => (0, 0),
        X264Preset::Superfast => (0, 3),
        X264Preset::Veryfast => (10, 3),
        X264Preset::Faster => (20, 3),
        X264Preset::Fast => (30, 3),
        X264Preset::Medium => (40, 3),
        X264Preset::Slow => (50, 3),
        X264Preset::Veryslow => (60, 8),
    };
    match format {
        VideoFormat::Sequence(_) => 0,
        // Every picture of ProRes stands alone.
        VideoFormat::Mov if settings.has_alpha => 0,
        VideoFormat::WebM => VP9_LOOKAHEAD,
        VideoFormat::Mp4 | VideoFormat::Mkv | VideoFormat::Mov => {
            let num_synced = if lookahead > 0 { num_b_frames + 1 } else { 0 };
            lookahead.max(num_b_frames) + num_synced + NUM_THREADS - 1
        }
    }
}
