use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use image::{ImageReader, Limits};
use zip::ZipArchive;

use crate::error::SceneError;
use crate::source_file::{SourceFile, read_file};

/// Maximum size of `meta.json` in a bundle.
const MAX_META_BYTES: u64 = 4 << 20;

/// Texels that a picture may have beyond twice the required number: a palette of 65536 entries has 960 x 1024 texels, and
/// rows may be padded.
const EXTRA_AREA: u64 = 1 << 20;

/// The pictures of a SOG.
pub(super) struct PictureFiles<'a> {
    place: Place<'a>,
    /// Bytes of the pictures read so far, and bytes that they unpack to.
    packed: usize,
    unpacked: u64,
    /// SHA-256 of each file read from a folder.
    sha256: Vec<String>,
}

enum Place<'a> {
    /// A zip archive.
    Zip(Box<ZipArchive<Cursor<&'a [u8]>>>),
    /// A folder.
    Folder(PathBuf),
}

/// A decoded picture.
pub(super) struct Picture {
    /// Width in texels.
    pub(super) width: usize,
    /// Height in texels.
    pub(super) height: usize,
    /// Texels, row by row.
    pub(super) rgba: Vec<[u8; 4]>,
}

impl<'a> PictureFiles<'a> {
    /// The pictures of a bundle.
    ///
    /// # Errors
    /// [`SceneError::SogPicture`] when the zip directory is damaged.
    pub(super) fn in_zip(source: &SourceFile<'a>) -> Result<Self, SceneError> {
        let archive = ZipArchive::new(Cursor::new(source.bytes));
        archive
            .map(|archive| Self::at(Place::Zip(Box::new(archive))))
            .map_err(|fault| picture_fault(source, "zip directory", fault.to_string()))
    }

    /// The pictures in a folder.
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self::at(Place::Folder(folder.to_path_buf()))
    }

    fn at(place: Place<'a>) -> Self {
        Self { place, packed: 0, unpacked: 0, sha256: Vec::new() }
    }

    /// SHA-256 of each file read from a folder, in the order of reading; none for a bundle.
    pub(super) fn into_sha256(self) -> Vec<String> {
        self.sha256
    }

    /// Content of `meta.json`, which may be in a folder inside the bundle.
    ///
    /// # Errors
    /// [`SceneError::SogPicture`] when it is missing or damaged.
    pub(super) fn meta(&mut self, source: &SourceFile) -> Result<Vec<u8>, SceneError> {
        self.bytes(source, "meta.json", MAX_META_BYTES)
    }

    /// Decodes a picture that must have at least `least` texels.
    ///
    /// # Errors
    /// [`SceneError::SogPicture`] when it is missing, damaged, too small or implausibly large.
    pub(super) fn picture(&mut self, source: &SourceFile, name: &str, least: usize) -> Result<Picture, SceneError> {
        let fault = |reason: String| picture_fault(source, name, reason);
        let bytes = self.bytes(source, name, source.options.limits.scene_bytes)?;
        let open =
            || ImageReader::new(Cursor::new(&bytes)).with_guessed_format().map_err(|error| fault(error.to_string()));
        let (width, height) = open()?.into_dimensions().map_err(|error| fault(error.to_string()))?;
        let area = u64::from(width) * u64::from(height);
        let most = 2 * least as u64 + EXTRA_AREA;
        if area < least as u64 || area > most {
            return Err(fault(format!("{width} x {height} texels, expected {least} to {most}")));
        }
        let unpacked = 4 * area;
        self.packed += bytes.len();
        self.unpacked += unpacked;
        let cap = source.options.limits.unpacked(bytes.len());
        // A plane of one value takes few bytes; the positions, which are read first, take many.
        if unpacked > cap && self.unpacked > source.options.limits.unpacked(self.packed) {
            return Err(fault(format!(
                "{width} x {height} texels in {} bytes, expected at most {}",
                bytes.len(),
                cap / 4
            )));
        }
        // The decoder holds the picture about four times.
        source.check_memory(least, 0, unpacked.saturating_mul(4))?;
        let mut reader = open()?;
        let mut limits = Limits::default();
        limits.max_alloc = Some(64 * most);
        reader.limits(limits);
        let decoded = reader.decode().map_err(|error| fault(error.to_string()))?;
        let rgba = decoded.into_rgba8().into_raw();
        Ok(Picture { width: width as usize, height: height as usize, rgba: rgba.as_chunks::<4>().0.to_vec() })
    }

    /// Content of a file of at most `cap` bytes.
    fn bytes(&mut self, source: &SourceFile, name: &str, cap: u64) -> Result<Vec<u8>, SceneError> {
        match &mut self.place {
            Place::Folder(folder) => {
                let bytes = read_file(&folder.join(name), cap)?;
                self.sha256.push(cinesplat_files::sha256_hex(&bytes));
                Ok(bytes)
            }
            Place::Zip(archive) => zip_bytes(source, archive, name, cap),
        }
    }
}

fn zip_bytes(
    source: &SourceFile,
    archive: &mut ZipArchive<Cursor<&[u8]>>,
    name: &str,
    cap: u64,
) -> Result<Vec<u8>, SceneError> {
    let fault = |reason: String| picture_fault(source, name, reason);
    // Some programs zip the folder instead of its content.
    let nested =
        || archive.file_names().flatten().find(|entry| entry.rsplit('/').next() == Some(name)).map(String::from);
    let found = if archive.index_for_name(name).is_some() { Some(name.to_owned()) } else { nested() };
    let Some(found) = found else {
        return Err(fault("missing in the bundle".to_owned()));
    };
    let entry = archive.by_name(&found).map_err(|error| fault(error.to_string()))?;
    // Pictures are compressed already, so an entry that unpacks to many times the bundle's size is not a picture.
    let cap = cap.min(source.options.limits.unpacked(source.bytes.len()));
    let mut bytes = Vec::new();
    entry.take(cap + 1).read_to_end(&mut bytes).map_err(|error| fault(error.to_string()))?;
    if bytes.len() as u64 > cap {
        return Err(SceneError::TooManyBytes { path: source.path.to_path_buf(), found: bytes.len() as u64, cap });
    }
    Ok(bytes)
}

fn picture_fault(source: &SourceFile, file: &str, reason: String) -> SceneError {
    SceneError::SogPicture { path: source.path.to_path_buf(), file: file.to_owned(), reason }
}
