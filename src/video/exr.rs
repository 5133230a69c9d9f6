//! Scene-linear pictures for compositors: `OpenEXR` with half floats.
//!
//! One part of scan lines, channels in alphabetical order as the format demands, compressed with zlib in blocks of 16 lines
//! (`ZIP_COMPRESSION`). Reference: the `OpenEXR` file layout, <https://openexr.com/en/latest/OpenEXRFileLayout.html>.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};
use half::f16;

use super::VideoError;

/// Lines per compressed block.
const BLOCK_LINES: usize = 16;
/// Bytes of a half float.
const HALF_BYTES: usize = 2;

/// The bytes of an `OpenEXR` file. `channels` are names in alphabetical order with their values, row-major, `width * height`
/// each; they are rounded to half floats, which hold up to 65504.
///
/// # Errors
/// [`VideoError::FrameSize`] for a channel of another length, [`VideoError::Exr`] if the data cannot be compressed.
pub fn encode_exr(channels: &[(&str, &[f32])], [width, height]: [u32; 2]) -> Result<Vec<u8>, VideoError> {
    let expected = width as usize * height as usize;
    if let Some((_, values)) = channels.iter().find(|(_, values)| values.len() != expected) {
        return Err(VideoError::FrameSize { found: values.len(), expected });
    }
    let mut bytes = header(channels, [width, height]);
    let lines: Vec<usize> = (0..height as usize).step_by(BLOCK_LINES).collect();
    let blocks = lines.iter().map(|&first| {
        let end = (first + BLOCK_LINES).min(height as usize);
        compressed(&block(channels, width as usize, first..end))
    });
    let blocks: Vec<Vec<u8>> = blocks.collect::<Result<_, _>>()?;
    // A table with the place of each block, then the blocks, each with its first line and its size.
    let mut place = (bytes.len() + 8 * blocks.len()) as u64;
    for block in &blocks {
        bytes.extend(place.to_le_bytes());
        place += 8 + block.len() as u64;
    }
    for (&first, block) in lines.iter().zip(&blocks) {
        bytes.extend((first as i32).to_le_bytes());
        bytes.extend((block.len() as i32).to_le_bytes());
        bytes.extend(block);
    }
    Ok(bytes)
}

fn header(channels: &[(&str, &[f32])], [width, height]: [u32; 2]) -> Vec<u8> {
    let mut list = Vec::new();
    for (name, _) in channels {
        list.extend(name.bytes());
        // Ends the name; half floats; not perceptually linear and three reserved bytes; every column and line.
        list.extend([0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
    }
    list.push(0);
    let window: Vec<u8> =
        [0, 0, width as i32 - 1, height as i32 - 1].iter().flat_map(|side| side.to_le_bytes()).collect();
    // Rec. 709 primaries with a white of D65: red, green, blue, white as x and y.
    let primaries = [0.64_f32, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290];
    let primaries: Vec<u8> = primaries.iter().flat_map(|part| part.to_le_bytes()).collect();
    let attributes: [(&str, &str, &[u8]); 9] = [
        ("channels", "chlist", &list),
        ("chromaticities", "chromaticities", &primaries),
        ("compression", "compression", &[3]),
        ("dataWindow", "box2i", &window),
        ("displayWindow", "box2i", &window),
        ("lineOrder", "lineOrder", &[0]),
        ("pixelAspectRatio", "float", &1.0_f32.to_le_bytes()),
        ("screenWindowCenter", "v2f", &[0; 8]),
        ("screenWindowWidth", "float", &1.0_f32.to_le_bytes()),
    ];
    // The magic number, then version 2 without flags.
    let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    for (name, kind, value) in attributes {
        for text in [name, kind] {
            bytes.extend(text.bytes());
            bytes.push(0);
        }
        bytes.extend((value.len() as i32).to_le_bytes());
        bytes.extend(value);
    }
    bytes.push(0);
    bytes
}

/// Some lines: per line the values of each channel.
fn block(channels: &[(&str, &[f32])], width: usize, lines: std::ops::Range<usize>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(lines.len() * width * channels.len() * HALF_BYTES);
    for line in lines {
        for (_, values) in channels {
            let row = &values[line * width..(line + 1) * width];
            bytes.extend(row.iter().flat_map(|&value| f16::from_f32(value).to_le_bytes()));
        }
    }
    bytes
}

/// A block as the format compresses it: even bytes before odd ones, differences of neighbors, zlib. A block that does not
/// get smaller stays as it is.
fn compressed(bytes: &[u8]) -> Result<Vec<u8>, VideoError> {
    let halves = bytes.iter().step_by(2).chain(bytes.iter().skip(1).step_by(2));
    let mut before = None;
    let differences: Vec<u8> = halves
        .map(|&byte| {
            let difference = before.map_or(byte, |before: u8| byte.wrapping_sub(before).wrapping_add(128));
            before = Some(byte);
            difference
        })
        .collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(4));
    let packed = encoder.write_all(&differences).and_then(|()| encoder.finish());
    let packed = packed.map_err(|error| VideoError::Exr { message: error.to_string() })?;
    Ok(if packed.len() < bytes.len() { packed } else { bytes.to_vec() })
}
