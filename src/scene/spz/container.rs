//! The SPZ container.
//!
//! Enters: a file of any version. Leaves: its header and one byte slice per attribute, decompressed. Invariant: no
//! allocation is larger than the compressed bytes can fill.

use std::borrow::Cow;
use std::io::Read;

use flate2::bufread::GzDecoder;
use ruzstd::decoding::StreamingDecoder;

use super::flags::{HAS_EXTENSIONS, LOD_TREE};
use crate::error::SceneError;
use crate::source_file::SourceFile;

/// Bytes of the header of versions 1-3, and of version 4.
const SHORT_HEADER: usize = 16;
const LONG_HEADER: usize = 32;

/// Maximum number of bytes after the attributes of a gzip file.
const MAX_TRAILER: u64 = 1 << 20;

/// Number of coefficients above degree 0 in the file, for degrees 0..=4.
const STORED_SH: [usize; 5] = [0, 3, 8, 15, 24];

/// A validated header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SpzHeader {
    /// Version, 1..=4.
    pub(super) version: u32,
    /// Number of Gaussians.
    pub(super) count: usize,
    /// Degree of the spherical harmonics, 0..=4.
    pub(super) sh_degree: u8,
    /// Fractional bits of a coordinate.
    pub(super) fractional_bits: u8,
    /// Flags, see `flags`.
    pub(super) flags: u8,
}

impl SpzHeader {
    /// Bytes per attribute, in file order: positions, alphas, colors, scales, rotations, spherical harmonics.
    fn sizes(&self) -> [usize; 6] {
        let position = if self.version == 1 { 6 } else { 9 };
        let rotation = if self.version < 3 { 3 } else { 4 };
        [position, 1, 3, 3, rotation, 3 * self.stored_sh()].map(|bytes| bytes * self.count)
    }

    /// Number of coefficients above degree 0 in the file.
    pub(super) fn stored_sh(&self) -> usize {
        STORED_SH[usize::from(self.sh_degree.min(4))]
    }
}

/// A decompressed file.
pub(super) struct Container<'a> {
    /// Header.
    pub(super) header: SpzHeader,
    /// Content of each attribute, in file order.
    pub(super) attributes: [Cow<'a, [u8]>; 6],
    /// Extension records, undecoded.
    pub(super) extensions: Vec<u8>,
    /// Notes for [`Scene::notes`](crate::Scene::notes).
    pub(super) notes: Vec<String>,
}

impl<'a> Container<'a> {
    /// Opens a file of any version.
    ///
    /// # Errors
    /// [`SceneError::SpzHeader`] for an invalid header, [`SceneError::SpzCorrupt`] for damaged or missing data,
    /// [`SceneError::SpzBomb`] for an implausible compression ratio, [`SceneError::NotReadYet`] for a level-of-detail
    /// tree, [`SceneError::TooManyGaussians`].
    pub(super) fn open(source: &'a SourceFile) -> Result<Self, SceneError> {
        let bytes = source.bytes;
        if bytes.starts_with(&[0x1f, 0x8b]) {
            return open_gzip(source);
        }
        let version = word(bytes, 4).ok_or_else(|| short_header(source, bytes.len()))?;
        if version == 4 { open_v4(source) } else { open_plain(source) }
    }
}

fn header_fault(source: &SourceFile, reason: String) -> SceneError {
    SceneError::SpzHeader { path: source.path.to_path_buf(), reason }
}

fn corrupt(source: &SourceFile, reason: String) -> SceneError {
    SceneError::SpzCorrupt { path: source.path.to_path_buf(), reason }
}

fn short_header(source: &SourceFile, found: usize) -> SceneError {
    corrupt(source, format!("{found} bytes, expected at least {SHORT_HEADER} of the header"))
}

/// The little-endian word at a byte position.
fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at + 4).and_then(<[u8]>::first_chunk).map(|chunk| u32::from_le_bytes(*chunk))
}

/// Parses and validates the fields that all versions share: magic, version, count, degree, fractional bits, flags.
fn parse_header(source: &SourceFile, bytes: &[u8]) -> Result<SpzHeader, SceneError> {
    let (Some(magic), Some(version), Some(count), Some(&[sh_degree, fractional_bits, flags, _])) =
        (word(bytes, 0), word(bytes, 4), word(bytes, 8), bytes.get(12..16).and_then(<[u8]>::first_chunk))
    else {
        return Err(short_header(source, bytes.len()));
    };
    if magic != u32::from_le_bytes(*b"NGSP") {
        return Err(header_fault(source, format!("gzipped data begins with {magic:#010x}, expected an SPZ (NGSP)")));
    }
    if !(1..=4).contains(&version) {
        return Err(header_fault(source, format!("SPZ version {version}, expected 1 to 4")));
    }
    if sh_degree > 4 {
        return Err(header_fault(source, format!("spherical harmonics of degree {sh_degree}, expected 0 to 4")));
    }
    if fractional_bits > 24 {
        return Err(header_fault(source, format!("{fractional_bits} fractional bits, expected at most 24")));
    }
    if flags & LOD_TREE != 0 {
        return Err(SceneError::NotReadYet {
            path: source.path.to_path_buf(),
            format: "an SPZ level-of-detail tree (Spark)",
        });
    }
    let count = source.check_count(u64::from(count))?;
    Ok(SpzHeader { version, count, sh_degree, fractional_bits, flags })
}

/// Rejects a decompressed size that is implausible for the compressed size, or takes too much memory.
fn check_unpacked(source: &SourceFile, header: SpzHeader, unpacked: u64) -> Result<(), SceneError> {
    // Deflate compresses at most 1032 : 1. Run-length blocks of Zstandard have no bound of their own.
    let cap = source.options.limits.unpacked(source.bytes.len());
    if unpacked > cap {
        return Err(SceneError::SpzBomb { path: source.path.to_path_buf(), found: unpacked, cap });
    }
    // The attributes of a gzip file are held twice while they are split.
    source.check_memory(header.count, header.sh_degree, unpacked.saturating_mul(2))
}

/// Opens versions 1-3 without gzip.
fn open_plain<'a>(source: &'a SourceFile) -> Result<Container<'a>, SceneError> {
    let header = parse_header(source, source.bytes)?;
    let sizes = header.sizes();
    let needed = SHORT_HEADER + sizes.iter().sum::<usize>();
    if source.bytes.len() < needed {
        return Err(corrupt(
            source,
            format!("{} bytes, expected {needed} for {} Gaussians", source.bytes.len(), header.count),
        ));
    }
    let (body, rest) = source.bytes[SHORT_HEADER..].split_at(needed - SHORT_HEADER);
    let (extensions, notes) = trailer(header, rest);
    Ok(Container { header, attributes: split(&sizes, |from, to| Cow::Borrowed(&body[from..to])), extensions, notes })
}

/// Opens versions 1-3 in gzip: reads the header, then the attributes it announces, then the trailer with the checksum.
fn open_gzip<'a>(source: &SourceFile) -> Result<Container<'a>, SceneError> {
    let mut decoder = GzDecoder::new(source.bytes);
    let mut first = Vec::new();
    read_up_to(source, &mut decoder, SHORT_HEADER as u64, &mut first)?;
    let header = parse_header(source, &first)?;
    if header.version == 4 {
        return Err(header_fault(source, "SPZ version 4 in gzip, expected 1 to 3".to_owned()));
    }
    let sizes = header.sizes();
    let needed = sizes.iter().sum::<usize>();
    check_unpacked(source, header, needed as u64)?;
    // A gzip byte expands to at most 1032 bytes, which bounds the allocation.
    let possible = source.bytes.len().saturating_mul(1032);
    let mut body = Vec::new();
    if needed > possible || body.try_reserve_exact(needed).is_err() {
        return Err(corrupt(
            source,
            format!("{} bytes cannot hold the {} Gaussians of the header", source.bytes.len(), header.count),
        ));
    }
    read_up_to(source, &mut decoder, needed as u64, &mut body)?;
    if body.len() < needed {
        let (found, expected) = (SHORT_HEADER + body.len(), SHORT_HEADER + needed);
        return Err(corrupt(
            source,
            format!("unpacks to {found} bytes, expected {expected} for {} Gaussians", header.count),
        ));
    }
    let mut rest = Vec::new();
    // One byte above the limit: within the limit this reads to the end, which verifies the checksum.
    read_up_to(source, &mut decoder, MAX_TRAILER + 1, &mut rest)?;
    let unpacked = (SHORT_HEADER + needed + rest.len()) as u64;
    if rest.len() as u64 > MAX_TRAILER {
        let cap = (SHORT_HEADER + needed) as u64 + MAX_TRAILER;
        return Err(SceneError::SpzBomb { path: source.path.to_path_buf(), found: unpacked, cap });
    }
    let (extensions, mut notes) = trailer(header, &rest);
    let after = decoder.into_inner().len();
    if after > 0 {
        notes.push(format!("{after} bytes after the compressed data are ignored"));
    }
    let attributes = split(&sizes, |from, to| Cow::Owned(body[from..to].to_vec()));
    Ok(Container { header, attributes, extensions, notes })
}

/// Opens version 4: a plain header, extension records, a table of sizes, and one Zstandard frame per non-empty attribute.
fn open_v4<'a>(source: &SourceFile) -> Result<Container<'a>, SceneError> {
    let bytes = source.bytes;
    let header = parse_header(source, bytes)?;
    let (Some(&[_, _, _, num_streams]), Some(table_at)) =
        (bytes.get(12..16).and_then(<[u8]>::first_chunk), word(bytes, 16))
    else {
        return Err(short_header(source, bytes.len()));
    };
    let (num_streams, table_at) = (usize::from(num_streams), table_at as usize);
    let sizes = header.sizes();
    let stored: Vec<usize> = (0..sizes.len()).filter(|&idx| sizes[idx] > 0).collect();
    if num_streams != stored.len() {
        return Err(header_fault(source, format!("{num_streams} streams, expected {}", stored.len())));
    }
    let table_end = table_at.saturating_add(16 * num_streams);
    if table_at < LONG_HEADER || table_end > bytes.len() {
        let reason = format!("table of streams at byte {table_at}, expected {LONG_HEADER} to {}", bytes.len());
        return Err(header_fault(source, reason));
    }
    check_unpacked(source, header, sizes.iter().map(|size| *size as u64).sum())?;
    let mut attributes: [Cow<'a, [u8]>; 6] = Default::default();
    let mut at = table_end;
    for (entry, idx) in bytes[table_at..table_end].as_chunks::<16>().0.iter().zip(stored) {
        let (packed, unpacked) = entry.split_at(8);
        let size = |half: &[u8]| half.first_chunk().map_or(0, |chunk| u64::from_le_bytes(*chunk));
        let (packed, unpacked) = (size(packed), size(unpacked));
        if unpacked != sizes[idx] as u64 {
            return Err(header_fault(source, format!("stream {idx} of {unpacked} bytes, expected {}", sizes[idx])));
        }
        let left = bytes.len() - at;
        if packed > left as u64 {
            return Err(corrupt(
                source,
                format!("stream {idx} of {packed} packed bytes at byte {at}, expected at most {left}"),
            ));
        }
        let end = at + packed as usize;
        attributes[idx] = Cow::Owned(unpack_frame(source, &bytes[at..end], sizes[idx])?);
        at = end;
    }
    let extensions =
        if header.flags & HAS_EXTENSIONS != 0 { bytes[LONG_HEADER..table_at].to_vec() } else { Vec::new() };
    let left = bytes.len() - at;
    let notes = if left > 0 { vec![format!("{left} bytes after the last stream are ignored")] } else { Vec::new() };
    Ok(Container { header, attributes, extensions, notes })
}

/// Decompresses a Zstandard frame, which must give exactly `size` bytes.
fn unpack_frame(source: &SourceFile, packed: &[u8], size: usize) -> Result<Vec<u8>, SceneError> {
    let damaged = |what: &dyn std::fmt::Display| corrupt(source, format!("Zstandard data is damaged ({what})"));
    // The window is limited to the output's size, so the frame header cannot request more memory than the output.
    let window = (size as u64).next_power_of_two().max(8 << 20);
    let mut decoder = StreamingDecoder::new_with_max_window_size(packed, window).map_err(|fault| damaged(&fault))?;
    let mut out = Vec::new();
    if out.try_reserve_exact(size).is_err() {
        return Err(source.no_memory(0, size as u64));
    }
    decoder.by_ref().take(size as u64 + 1).read_to_end(&mut out).map_err(|fault| damaged(&fault))?;
    if out.len() != size {
        return Err(corrupt(source, format!("a stream unpacks to {} bytes or more, expected {size}", out.len())));
    }
    let frame = decoder.into_frame_decoder();
    let sums = (frame.get_checksum_from_data(), frame.get_calculated_checksum());
    if let (Some(stored), Some(found)) = sums
        && stored != found
    {
        return Err(damaged(&"checksum"));
    }
    Ok(out)
}

/// Reads at most `most` bytes of a stream and appends them.
fn read_up_to(source: &SourceFile, decoder: &mut impl Read, most: u64, out: &mut Vec<u8>) -> Result<(), SceneError> {
    let read = decoder.by_ref().take(most).read_to_end(out);
    read.map(drop).map_err(|fault| corrupt(source, format!("gzip data is damaged or cut ({fault})")))
}

/// Splits a body into attributes.
fn split<'a>(sizes: &[usize; 6], piece: impl Fn(usize, usize) -> Cow<'a, [u8]>) -> [Cow<'a, [u8]>; 6] {
    let mut from = 0;
    sizes.map(|size| {
        let start = from;
        from += size;
        piece(start, from)
    })
}

/// Extension records after the attributes of versions 1-3, or a note on other bytes there.
fn trailer(header: SpzHeader, rest: &[u8]) -> (Vec<u8>, Vec<String>) {
    if header.flags & HAS_EXTENSIONS != 0 {
        (rest.to_vec(), Vec::new())
    } else if rest.is_empty() {
        (Vec::new(), Vec::new())
    } else {
        (Vec::new(), vec![format!("{} bytes after the last attribute are ignored", rest.len())])
    }
}
