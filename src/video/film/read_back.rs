use cinesplat_files::FileError;
use std::fs::File;
use std::path::Path;

use ffmpeg_next::format::context::StreamIo;
use ffmpeg_next::{Rational, format, media};

use crate::VideoError;

/// Opens a finished file, counts its frames and checks its duration.
///
/// # Errors
/// [`VideoError::ReadBack`] unless `part` (called `path` in messages) holds one video stream of `num_frames` frames
/// that lasts `num_frames` ticks, to within one tick.
pub(crate) fn check(part: &Path, path: &Path, num_frames: usize, tick: Rational) -> Result<(), VideoError> {
    let fault = |found: String| VideoError::ReadBack {
        found,
        expected: format!("{num_frames} frames, {:.3} s", num_frames as f64 * f64::from(tick)),
        path: path.to_owned(),
    };
    let opened = File::open(part);
    let file = opened.map_err(|source| FileError::Read { path: path.to_owned(), source })?;
    let io = StreamIo::from_read_seek(file).map_err(|e| fault(format!("no file ({e})")))?;
    let mut input = format::input_from_stream(io, None, None).map_err(|e| fault(format!("no film ({e})")))?;
    let stream = input.streams().best(media::Type::Video).ok_or_else(|| fault("no video stream".to_owned()))?;
    let (index, stream_tick) = (stream.index(), f64::from(stream.time_base()));
    let (mut num_found, mut end_secs) = (0_usize, 0.0_f64);
    for (stream, packet) in input.packets() {
        if stream.index() == index {
            num_found += 1;
            let end = packet.pts().unwrap_or(0) + packet.duration();
            end_secs = end_secs.max(end as f64 * stream_tick);
        }
    }
    let wanted_secs = num_frames as f64 * f64::from(tick);
    // Up to one frame: Matroska rounds times to milliseconds. A little more, because the difference itself is rounded.
    if num_found != num_frames || !((end_secs - wanted_secs).abs() <= 1.001 * f64::from(tick)) {
        return Err(fault(format!("{num_found} frames, {end_secs:.3} s")));
    }
    Ok(())
}
