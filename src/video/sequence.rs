use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, FileError, create_folder, folder_of};
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

/// Removes the pictures of a sequence from number `first` on, which a longer film left. Returns how many there were.
///
/// # Errors
/// [`VideoError::File`] with the system's reason.
pub fn remove_frames_from(pattern: &FramePattern, first: usize) -> Result<usize, VideoError> {
    let folder = folder_of(&pattern.path(first)).to_owned();
    let entries = fs::read_dir(&folder).map_err(|source| FileError::Read { path: folder, source })?;
    let is_older = |name: &str| pattern.number_of(name).is_some_and(|number| number >= first);
    let older = entries.flatten().filter(|entry| entry.file_name().to_str().is_some_and(is_older));
    let mut num_removed = 0;
    for path in older.map(|entry| entry.path()) {
        fs::remove_file(&path).map_err(|source| FileError::Write { path, source })?;
        num_removed += 1;
    }
    Ok(num_removed)
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
