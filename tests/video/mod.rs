//! Films and picture sequences, read back with FFmpeg's decoders, and with `ffprobe` if this machine has it.

mod bt709;
mod contact_sheet;
mod dry_run;
mod exr;
mod film;
mod pattern;
mod sequence;

/// A picture with smooth ramps, hard edges and saturated patches, moving with `frame_idx`.
pub fn test_frame(width: usize, height: usize, frame_idx: usize) -> Vec<u8> {
    let mut rgb8 = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            let moved = x + 2 * frame_idx;
            let patch = (moved / 32 + y / 32) % 4;
            let ramp = (255 * x / width) as u8;
            let (r, g, b) = match patch {
                0 => (ramp, ramp, ramp),
                1 => (200, (255 * y / height) as u8, 40),
                2 => (30, 90, ramp),
                _ => (120, 160, 140),
            };
            rgb8.extend([r, g, b]);
        }
    }
    rgb8
}
