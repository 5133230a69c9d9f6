//! Replaces `reader` if this crate is built without language models: refuses every file.

use std::path::Path;

use cinesplat_trajectory::ModelRef;

use crate::error::ReaderError;
use crate::interpretation::Interpretation;
use crate::question::Question;

/// Cannot be constructed: there are no language models in this build.
pub enum Reader {}

impl Reader {
    /// Refuses the file.
    ///
    /// # Errors
    /// [`ReaderError::NotBuilt`], always.
    pub fn load(path: &Path) -> Result<Self, ReaderError> {
        Err(ReaderError::NotBuilt { path: path.to_owned() })
    }

    /// Name and hash of the file.
    pub fn model_ref(&self) -> ModelRef {
        match *self {}
    }

    /// What a question's prompt is understood as.
    ///
    /// # Errors
    /// None: there is no reader.
    pub fn read(&self, _question: &Question) -> Result<Interpretation, ReaderError> {
        match *self {}
    }
}
