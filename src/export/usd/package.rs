//! USDZ packages: archives whose first file is the layer to open.

use std::io::Read as _;

use cinesplat_files::Limits;

use super::super::ExportError;

/// Where the first file's name starts in an archive, and its length is stated.
const NAME_START: usize = 30;
const NAME_LEN: usize = 26;

/// Whether the first file of an archive is a layer.
pub(crate) fn is_package(bytes: &[u8]) -> bool {
    let len = bytes.get(NAME_LEN..).and_then(|rest| rest.first_chunk()).map_or(0, |len| u16::from_le_bytes(*len));
    let name = bytes.get(NAME_START..).and_then(|rest| rest.get(..usize::from(len))).unwrap_or_default();
    [&b".usda"[..], b".usdc", b".usd"].iter().any(|ending| name.ends_with(ending))
}

/// The first file of a package.
pub(super) fn layer(bytes: &[u8]) -> Result<Vec<u8>, ExportError> {
    let unreadable = |reason: String| ExportError::NotReadable { format: "usd", reason };
    let mut archive =
        zip::ZipArchive::new(std::io::Cursor::new(bytes)).map_err(|error| unreadable(error.to_string()))?;
    let file = archive.by_index(0).map_err(|error| unreadable(error.to_string()))?;
    let (mut out, most) = (Vec::new(), Limits::DEFAULT.unpacked(bytes.len()));
    let read = file.take(most + 1).read_to_end(&mut out);
    read.map_err(|error| unreadable(error.to_string()))?;
    if out.len() as u64 > most {
        return Err(unreadable(format!("the layer has over {most} bytes")));
    }
    Ok(out)
}
