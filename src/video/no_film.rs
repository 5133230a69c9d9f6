//! Replaces `film` if this crate is built without FFmpeg: rejects every film file.

use std::path::{Path, PathBuf};

use super::{AlphaPlanes, Planes420, VideoError, VideoFormat, VideoSettings};

/// Cannot be constructed: there is no encoder.
pub(crate) enum FilmEncoder {}

impl FilmEncoder {
    pub(crate) fn create(path: &Path, _format: &VideoFormat, _settings: &VideoSettings) -> Result<Self, VideoError> {
        Err(no_ffmpeg(path))
    }

    pub(crate) fn write_planes(&mut self, _planes: &Planes420) -> Result<(), VideoError> {
        match *self {}
    }

    pub(crate) fn write_alpha_planes(&mut self, _planes: &AlphaPlanes) -> Result<(), VideoError> {
        match *self {}
    }

    pub(crate) fn finish(self) -> Result<PathBuf, VideoError> {
        match self {}
    }
}

pub(crate) fn encode_and_discard(
    path: &Path,
    _format: &VideoFormat,
    _settings: &VideoSettings,
    _frames: &[&[u8]],
) -> Result<(), VideoError> {
    Err(no_ffmpeg(path))
}

pub(crate) fn read_film(path: &Path, _visit: &mut dyn FnMut(Planes420)) -> Result<(), VideoError> {
    Err(no_ffmpeg(path))
}

pub(crate) fn has_encoder(_name: &str) -> bool {
    false
}

fn no_ffmpeg(path: &Path) -> VideoError {
    VideoError::Missing { missing: "encoder (this program was built without FFmpeg)".to_owned(), path: path.to_owned() }
}
