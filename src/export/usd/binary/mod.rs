//! The binary form of USD (`.usdc`), versions 0.4 to 0.13: tables of tokens, fields, paths and specs, packed with LZ4.
//!
//! Enters: the bytes of a layer. Leaves: its cameras and render settings with the prims above them, as from the text
//! form. Every number of entries is checked against the bytes that are present, and the values that are decoded are
//! counted: values may share their bytes. Reference: OpenUSD, `pxr/usd/sdf/crateFile.h`.

mod damage;
mod packing;
mod paths;
mod prims;
mod tables;
mod values;

use super::super::ExportError;
use super::layer::Prim;
use tables::Tables;

/// First bytes of a layer in the binary form.
pub(super) const MAGIC: &[u8] = b"PXR-USDC";

/// Parses a layer.
pub(super) fn parse(bytes: &[u8]) -> Result<Prim, ExportError> {
    prims::layer(&Tables::new(bytes)?)
}
