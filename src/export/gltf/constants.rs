//! Constants of the format that reader and writer share.

/// The extension that animates the field of view. No other extension is written or read.
pub(super) const POINTER: &str = "KHR_animation_pointer";
/// Largest time between the key that holds a pose and the cut after it, seconds.
pub(super) const CUT_SECS: f64 = 1e-4;
pub(super) const GLB_MAGIC: &[u8; 4] = b"glTF";
pub(super) const JSON_CHUNK: &[u8; 4] = b"JSON";
pub(super) const BINARY_CHUNK: &[u8; 4] = b"BIN\0";
