use thiserror::Error;

/// Error of drawing.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PlotError {
    /// A picture cannot be encoded.
    #[error("a picture cannot be encoded: {reason}")]
    Picture {
        /// What is wrong with it.
        reason: String,
    },
}

impl PlotError {
    /// Code for the user.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Picture { .. } => "PLOT-PICTURE",
        }
    }
}
