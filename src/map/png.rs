use std::io::Cursor;

use image::{ExtendedColorType, ImageEncoder, codecs::png};

use crate::drawing::Picture;
use crate::error::MapError;

/// A picture as the bytes of a PNG file.
pub(crate) fn encode(picture: &Picture) -> Result<Vec<u8>, MapError> {
    let [width, height] = picture.size;
    let mut bytes = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Best, png::FilterType::Adaptive);
    let expected = width as usize * height as usize * 3;
    if picture.rgb8.len() != expected {
        return Err(MapError::Picture { reason: format!("{} bytes, expected {expected}", picture.rgb8.len()) });
    }
    let encoded = encoder.write_image(&picture.rgb8, width, height, ExtendedColorType::Rgb8);
    encoded.map_err(|error| MapError::Picture { reason: error.to_string() })?;
    Ok(bytes.into_inner())
}
