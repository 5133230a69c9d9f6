use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::{ExtendedColorType, ImageEncoder, codecs::png};

use super::part_file::PartFile;
use super::{FramePattern, VideoError, VideoSettings};

/// One PNG a frame, each whole or absent.
pub(super) struct SequenceWriter {
    pattern: FramePattern,
    settings: VideoSettings,
    next_frame: usize,
}

impl SequenceWriter {
    /// Creates the folder where there is none.
    pub(super) fn create(pattern: &FramePattern, settings: &VideoSettings) -> Result<Self, VideoError> {
        let folder = pattern.folder();
        if !folder.as_os_str().is_empty() {
            let created = fs::create_dir_all(folder);
            created.map_err(|source| VideoError::Create { path: folder.to_owned(), source })?;
        }
        Ok(Self { pattern: pattern.clone(), settings: settings.clone(), next_frame: settings.first_frame })
    }

    pub(super) fn write_frame(&mut self, rgb8: &[u8]) -> Result<(), VideoError> {
        let path = self.pattern.path(self.next_frame);
        if !self.settings.overwrite && path.exists() {
            return Err(VideoError::Exists { path });
        }
        write_png(&path, rgb8, self.settings.width, self.settings.height)?;
        self.next_frame += 1;
        Ok(())
    }

    /// The folder with the pictures.
    pub(super) fn finish(self) -> PathBuf {
        self.pattern.folder().to_owned()
    }
}

/// Writes one 8-bit RGB picture, under a passing name until it is whole.
///
/// # Errors
/// [`VideoError::Create`] or [`VideoError::Io`] with the system's reason.
pub fn write_png(path: &Path, rgb8: &[u8], width: u32, height: u32) -> Result<(), VideoError> {
    let bytes = png_bytes(path, rgb8, width, height)?;
    let (part, mut file) = PartFile::create(path)?;
    std::io::Write::write_all(&mut file, &bytes).map_err(|source| writing(path, source))?;
    part.keep_as(None)?;
    Ok(())
}

/// One 8-bit RGB picture as the bytes of a PNG file; `path` is for messages.
pub(super) fn png_bytes(path: &Path, rgb8: &[u8], width: u32, height: u32) -> Result<Vec<u8>, VideoError> {
    let expected = width as usize * height as usize * 3;
    if rgb8.len() != expected {
        return Err(VideoError::FrameSize { found: rgb8.len(), expected });
    }
    let mut bytes = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Fast, png::FilterType::Adaptive);
    let encoded = encoder.write_image(rgb8, width, height, ExtendedColorType::Rgb8);
    encoded.map_err(|error| writing(path, std::io::Error::other(error)))?;
    Ok(bytes.into_inner())
}

fn writing(path: &Path, source: std::io::Error) -> VideoError {
    VideoError::Io { action: "writing", path: path.to_owned(), source }
}
