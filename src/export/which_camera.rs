//! The camera that is read of a file that holds several.

use super::ExportError;
use super::json_read::quoted;

/// Index of the camera with a name, or of the first without one, and a line that names the others where none was asked for.
///
/// # Errors
/// [`ExportError::NoPoses`] without cameras, [`ExportError::WrongFormat`] for a name that none of them has.
pub(super) fn which(names: &[&str], wanted: Option<&str>) -> Result<(usize, Option<String>), ExportError> {
    let Some(first) = names.first() else { return Err(ExportError::NoPoses) };
    if let Some(wanted) = wanted {
        let found = names.iter().position(|name| *name == wanted);
        let expected = || format!("one of the cameras {}", names.join(", "));
        let unknown = || ExportError::WrongFormat { found: quoted(wanted), expected: expected() };
        return Ok((found.ok_or_else(unknown)?, None));
    }
    let others = || format!("the file holds {} cameras: {first} is read, of {}", names.len(), names.join(", "));
    Ok((0, (names.len() > 1).then(others)))
}
