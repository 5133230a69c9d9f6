//! Chunks packed with LZ4 in its frame format.

use std::io::Read;

use lz4_flex::frame::FrameDecoder;

use crate::ExportError;

/// The `size` bytes that a chunk at an offset of the file unpacks to.
pub(super) fn unpacked(packed: &[u8], size: u64, offset: usize) -> Result<Vec<u8>, ExportError> {
    let damaged =
        |found: String| ExportError::BadBytes { offset, found, expected: format!("{size} bytes packed with lz4") };
    let mut out = Vec::new();
    FrameDecoder::new(packed).take(size + 1).read_to_end(&mut out).map_err(|error| damaged(error.to_string()))?;
    if out.len() as u64 == size { Ok(out) } else { Err(damaged(format!("{} bytes", out.len()))) }
}
