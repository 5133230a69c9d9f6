use std::fs;
use std::io::{Cursor, ErrorKind};
use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, FileError, create_folder};
use image::{ExtendedColorType, ImageEncoder, codecs::png};

use super::{FramePattern, VideoError, VideoSettings};

/// Writes one PNG per frame; each file is complete or absent.
pub(super) struct SequenceWriter {
    pattern: FramePattern,
    settings: VideoSettings,
    next_frame: usize,
}

impl SequenceWriter {
    /// Creates the folder if it does not exist.
    pub(super) fn create(pattern: &FramePattern, settings: &VideoSettings) -> Result<Self, VideoError> {
        let folder = pattern.folder();
        if !folder.as_os_str().is_empty() {
            create_folder(folder)?;
        }
        Ok(Self { pattern: pattern.clone(), settings: settings.clone(), next_frame: settings.first_frame })
    }

    pub(super) fn write_frame(&mut self, rgb8: &[u8]) -> Result<(), VideoError> {
        let path = self.pattern.path(self.next_frame);
        write_png(&path, rgb8, [self.settings.width, self.settings.height], self.settings.existing)?;
        self.next_frame += 1;
        Ok(())
    }

    /// Writes the next picture as it is.
    pub(super) fn write_file(&mut self, bytes: &[u8]) -> Result<(), VideoError> {
        cinesplat_files::write(&self.pattern.path(self.next_frame), bytes, self.settings.existing)?;
        self.next_frame += 1;
        Ok(())
    }

    /// The folder of the pictures.
    pub(super) fn finish(self) -> PathBuf {
        self.pattern.folder().to_owned()
    }
}

/// Removes the pictures of a sequence from number `first` up to the first gap, which a longer film left. Returns how many
/// there were. Pictures behind a gap may be those of another film.
///
/// # Errors
/// [`VideoError::File`] with the system's reason.
pub fn remove_frames_from(pattern: &FramePattern, first: usize) -> Result<usize, VideoError> {
    for number in first.. {
        let path = pattern.path(number);
        match fs::remove_file(&path) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(number - first),
            Err(source) => return Err(FileError::Write { path, source }.into()),
        }
    }
    Ok(0)
}

/// Writes one 8-bit RGB picture of `[width, height]` pixels as PNG. The file is complete or absent.
///
/// # Errors
/// [`VideoError::FrameSize`] unless `rgb8` holds `width * height * 3` bytes, [`VideoError::File`] with the system's
/// reason.
pub fn write_png(path: &Path, rgb8: &[u8], size_px: [u32; 2], existing: Existing) -> Result<(), VideoError> {
    Ok(cinesplat_files::write(path, &encode_png(rgb8, size_px)?, existing)?)
}

/// One 8-bit picture of `[width, height]` pixels with red, green, blue and opacity (not multiplied into the colors) as the
/// bytes of a PNG file.
///
/// # Errors
/// As [`encode_png`], for `width * height * 4` bytes.
pub fn encode_png_with_alpha(rgba8: &[u8], size_px: [u32; 2]) -> Result<Vec<u8>, VideoError> {
    encoded(rgba8, size_px, ExtendedColorType::Rgba8)
}

/// One 8-bit RGB picture of `[width, height]` pixels as the bytes of a PNG file.
///
/// # Errors
/// [`VideoError::FrameSize`] unless `rgb8` holds `width * height * 3` bytes, [`VideoError::Png`] if it cannot be encoded.
pub fn encode_png(rgb8: &[u8], size_px: [u32; 2]) -> Result<Vec<u8>, VideoError> {
    encoded(rgb8, size_px, ExtendedColorType::Rgb8)
}

fn encoded(pixels: &[u8], [width, height]: [u32; 2], color: ExtendedColorType) -> Result<Vec<u8>, VideoError> {
    let expected = width as usize * height as usize * usize::from(color.channel_count());
    if pixels.len() != expected {
        return Err(VideoError::FrameSize { found: pixels.len(), expected });
    }
    let mut bytes = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Fast, png::FilterType::Adaptive);
    let written = encoder.write_image(pixels, width, height, color);
    written.map_err(|error| VideoError::Png { message: error.to_string() })?;
    Ok(bytes.into_inner())
}

/// The pixels of a PNG that [`encode_png`] made; `None` for other bytes.
pub fn decode_png(bytes: &[u8]) -> Option<Vec<u8>> {
    let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::Png).ok()?;
    Some(picture.into_rgb8().into_raw())
}
