//! The camera paths that `eval` and `describe` read.

use std::path::Path;

use super::failure::Failure;
use super::{console, formats};
use cinesplat::export::{self, Format, PoseTrack};

/// The poses of a file: for a shot those of every frame of its film.
pub(super) fn read(path: &Path, from: Option<Format>) -> Result<PoseTrack, Failure> {
    let imported = export::read(path, from).map_err(|error| Failure::from(error).in_file(path))?;
    formats::note_doubt(path, imported.doubt.as_ref());
    console::file_warnings(path, &imported.notes);
    console::file_warnings(path, &imported.track.unread);
    match &imported.shot {
        Some(shot) => Ok(PoseTrack::sampled(shot, None)?),
        None => Ok(imported.track),
    }
}
