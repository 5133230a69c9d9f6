//! Replaces `dino` if this crate is built without networks: refuses every folder.

use std::path::Path;

use crate::error::VisionError;
use crate::grid::PatchGrid;

/// Cannot be constructed: there are no networks in this build.
pub enum Dino {}

impl Dino {
    /// Refuses the folder.
    ///
    /// # Errors
    /// [`VisionError::NotBuilt`], always.
    pub fn load(folder: &Path) -> Result<Self, VisionError> {
        Err(VisionError::NotBuilt { path: folder.to_owned() })
    }

    /// Side of a patch.
    pub fn patch_px(&self) -> usize {
        match *self {}
    }

    /// The features of a picture.
    ///
    /// # Errors
    /// None: there is no network.
    pub fn patches(&self, _rgb8: &[u8], _size_px: [usize; 2]) -> Result<PatchGrid, VisionError> {
        match *self {}
    }
}
