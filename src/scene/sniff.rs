//! Format detection by content.
//!
//! Enters: a file. Leaves: its format, or an error that names the known format without a reader. Only a `.splat`, which
//! has no magic number, may be decided by its extension.

use std::collections::BTreeMap;

use cinesplat_files::json_excess;
use serde::de::IgnoredAny;

use super::error::SceneError;
use super::source_file::SourceFile;

/// Formats that have a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SceneFormat {
    /// PLY, INRIA's or compressed.
    Ply,
    /// `.splat`: records of 32 bytes without a header.
    Splat,
    /// SPZ of any version, plain or in gzip.
    Spz,
    /// SOG in a zip archive.
    SogBundle,
    /// The `meta.json` of a SOG in a folder.
    SogMeta,
    /// The `lod-meta.json` of a streamed SOG.
    SogStreamed,
    /// `.ksplat` of GaussianSplats3D.
    Ksplat,
    /// glTF with Gaussians, text or binary.
    Gltf,
    /// A PCD point cloud.
    Pcd,
}

/// The format of a file.
///
/// # Errors
/// [`SceneError::NotReadYet`] for a known format without a reader, [`SceneError::UnknownFormat`] for any other content,
/// [`SceneError::Damaged`] for JSON beyond the limits, [`SceneError::SplatSize`] for a `.splat` whose size is not a multiple of its record size.
pub(super) fn format_of(source: &SourceFile) -> Result<SceneFormat, SceneError> {
    let bytes = source.bytes;
    let is_named_splat = source.path.extension().is_some_and(|e| e.eq_ignore_ascii_case("splat"));
    match bytes {
        [b'p', b'l', b'y', b'\n' | b'\r' | b' ', ..] => Ok(SceneFormat::Ply),
        [b'N', b'G', b'S', b'P', ..] | [0x1f, 0x8b, ..] => Ok(SceneFormat::Spz),
        [b'P', b'K', 3 | 5, 4 | 6, ..] => Ok(SceneFormat::SogBundle),
        [b'g', b'l', b'T', b'F', ..] => Ok(SceneFormat::Gltf),
        _ if is_pcd(bytes) => Ok(SceneFormat::Pcd),
        _ if is_ksplat(bytes) => Ok(SceneFormat::Ksplat),
        _ if starts_json(bytes) => json_format(source),
        _ if !bytes.is_empty() && bytes.len().is_multiple_of(32) && (is_named_splat || plausible_splat(bytes)) => {
            Ok(SceneFormat::Splat)
        }
        _ if is_named_splat => {
            Err(SceneError::SplatSize { path: source.path.to_path_buf(), found: bytes.len() as u64 })
        }
        _ => Err(unknown(source)),
    }
}

/// The error for unknown content, with its first bytes.
fn unknown(source: &SourceFile) -> SceneError {
    let first: Vec<String> = source.bytes.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    let found = if first.is_empty() { "an empty file".to_owned() } else { format!("begins with {}", first.join(" ")) };
    SceneError::UnknownFormat { path: source.path.to_path_buf(), found }
}

fn is_pcd(bytes: &[u8]) -> bool {
    bytes.starts_with(b"# .PCD") || bytes.starts_with(b"VERSION .7") || bytes.starts_with(b"VERSION 0.7")
}

/// Whether the header reads as `.ksplat`, which has no magic number: version 0.1 to 0.9, compression level 0 to 2, and
/// space for the section headers that it claims.
fn is_ksplat(bytes: &[u8]) -> bool {
    let Some(header) = bytes.first_chunk::<24>() else { return false };
    let word = |at: usize| u32::from_le_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]);
    let (max_sections, sections) = (u64::from(word(4)), u64::from(word(8)));
    let level = u16::from_le_bytes([header[20], header[21]]);
    let version = header[0] == 0 && (1..10).contains(&header[1]) && header[2] == 0 && header[3] == 0;
    version
        && level <= 2
        && sections <= max_sections
        && max_sections > 0
        && bytes.len() as u64 >= 4096 + 1024 * max_sections
}

fn starts_json(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    text.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{')
}

fn json_format(source: &SourceFile) -> Result<SceneFormat, SceneError> {
    let bytes = source.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(source.bytes);
    // Binary data may begin like JSON; one in 256 .splat files does.
    let is_splat = || source.bytes.len().is_multiple_of(32) && plausible_splat(source.bytes);
    if let Some(reason) = json_excess(bytes, &source.options.limits) {
        let excess = || SceneError::Damaged { path: source.path.to_path_buf(), byte: 0, reason };
        return if is_splat() { Ok(SceneFormat::Splat) } else { Err(excess()) };
    }
    #[expect(
        clippy::zero_sized_map_values,
        reason = "serde reads JSON objects into maps; the values are of no interest"
    )]
    let Ok(keys) = serde_json::from_slice::<BTreeMap<String, IgnoredAny>>(bytes) else {
        return if is_splat() { Ok(SceneFormat::Splat) } else { Err(unknown(source)) };
    };
    let has = |key: &str| keys.contains_key(key);
    if has("lodLevels") || has("tree") && has("filenames") {
        Ok(SceneFormat::SogStreamed)
    } else if has("means") {
        Ok(SceneFormat::SogMeta)
    } else if has("asset") {
        Ok(SceneFormat::Gltf)
    } else {
        Err(SceneError::UnknownFormat { path: source.path.to_path_buf(), found: "JSON without `means`".to_owned() })
    }
}

/// Whether at least 9 of 10 of the first records are plausible Gaussians, by the magnitude of positions and scales.
fn plausible_splat(bytes: &[u8]) -> bool {
    let records = bytes.chunks_exact(32).take(64);
    let total = records.len();
    let good = records.filter(|record| {
        let value = |idx: usize| {
            f32::from_le_bytes([record[4 * idx], record[4 * idx + 1], record[4 * idx + 2], record[4 * idx + 3]])
        };
        let position = (0..3).all(|idx| value(idx) == 0.0 || (1e-9..1e7).contains(&value(idx).abs()));
        let something = record.iter().any(|byte| *byte != 0);
        something && position && (3..6).all(|idx| value(idx) == 0.0 || (1e-12..1e5).contains(&value(idx)))
    });
    good.count() * 10 >= total * 9
}
