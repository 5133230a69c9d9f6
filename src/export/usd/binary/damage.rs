use crate::ExportError;

/// The error of a layer that is not as the format says.
pub(super) fn damaged(offset: usize, found: impl Into<String>, expected: impl Into<String>) -> ExportError {
    ExportError::BadBytes { offset, found: found.into(), expected: expected.into() }
}
