use std::io::Cursor;

use image::{ExtendedColorType, ImageEncoder, codecs::png};

use super::error::PlotError;

/// Pixels as the bytes of a PNG file: red, green and blue, row by row.
pub(super) fn encode([width, height]: [u32; 2], rgb8: &[u8]) -> Result<Vec<u8>, PlotError> {
    let mut bytes = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Best, png::FilterType::Adaptive);
    let expected = width as usize * height as usize * 3;
    if rgb8.len() != expected {
        return Err(PlotError::Picture { reason: format!("{} bytes, expected {expected}", rgb8.len()) });
    }
    let encoded = encoder.write_image(rgb8, width, height, ExtendedColorType::Rgb8);
    encoded.map_err(|error| PlotError::Picture { reason: error.to_string() })?;
    Ok(bytes.into_inner())
}
