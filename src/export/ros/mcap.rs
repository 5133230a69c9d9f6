//! MCAP: records of a kind, a length and data. Chunks hold schemas, channels and messages, plain or packed with
//! Zstandard or LZ4.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Read;

use cinesplat_files::Limits;
use ruzstd::decoding::StreamingDecoder;

use super::lz4;
use super::message::{Encoding, Kind, Topic, Visit};
use crate::ExportError;
use crate::bytes::Bytes;

/// First bytes of an MCAP file.
pub(super) const MAGIC: &[u8] = b"\x89MCAP0\r\n";
/// The kinds of records that are read.
const FOOTER: u8 = 2;
const SCHEMA: u8 = 3;
const CHANNEL: u8 = 4;
const MESSAGE: u8 = 5;
const CHUNK: u8 = 6;

/// Types of messages by their number, and topics by the number of their channel.
#[derive(Default)]
struct Channels {
    kinds: BTreeMap<u16, Kind>,
    topics: BTreeMap<u16, Topic>,
    /// Bytes that further chunks may unpack to.
    unpacked_left: u64,
}

/// Visits the messages of all topics with poses.
pub(super) fn visit(bytes: &[u8], visit: &mut Visit<'_>) -> Result<(), ExportError> {
    let records_of_file = bytes.strip_prefix(MAGIC).unwrap_or_default();
    let mut channels = Channels { unpacked_left: Limits::DEFAULT.unpacked(bytes.len()), ..Channels::default() };
    records(records_of_file, &mut channels, visit, true)
}

fn records(
    data: &[u8],
    channels: &mut Channels,
    visit: &mut Visit<'_>,
    may_hold_chunks: bool,
) -> Result<(), ExportError> {
    let mut bytes = Bytes::new(data);
    while !bytes.is_empty() {
        let [kind] = bytes.array()?;
        let length = bytes.u64()?;
        let mut record = Bytes::new(bytes.take(length)?);
        match kind {
            // The end of the file follows, which is no record.
            FOOTER => return Ok(()),
            SCHEMA => {
                let number = record.u16()?;
                if let Some(kind) = Kind::of(&record.text()?) {
                    channels.kinds.insert(number, kind);
                }
            }
            CHANNEL => {
                let (number, schema, name, encoding) = (record.u16()?, record.u16()?, record.text()?, record.text()?);
                let encoding = match encoding.as_str() {
                    "cdr" => Some(Encoding::Cdr),
                    "ros1" => Some(Encoding::Ros1),
                    _ => None,
                };
                if let Some((&kind, encoding)) = channels.kinds.get(&schema).zip(encoding) {
                    channels.topics.insert(number, Topic { name, kind, encoding });
                }
            }
            MESSAGE => {
                let topic = channels.topics.get(&record.u16()?);
                // Its number, and the times of recording and sending.
                record.take(4 + 8 + 8)?;
                if let Some(topic) = topic {
                    visit(topic, record.rest())?;
                }
            }
            CHUNK if may_hold_chunks => {
                let chunk = unpacked(&mut record, channels.unpacked_left)?;
                channels.unpacked_left = channels.unpacked_left.saturating_sub(chunk.len() as u64);
                records(&chunk, channels, visit, false)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// The records of a chunk; packed ones may be of `left` bytes.
fn unpacked<'a>(chunk: &mut Bytes<'a>, left: u64) -> Result<Cow<'a, [u8]>, ExportError> {
    // The first and the last time.
    chunk.take(8 + 8)?;
    let size = chunk.u64()?;
    // A checksum.
    chunk.take(4)?;
    let packing = chunk.text()?;
    let length = chunk.u64()?;
    let offset = chunk.position();
    let packed = chunk.take(length)?;
    let limit = Limits::DEFAULT.unpacked(packed.len()).min(Limits::DEFAULT.array_bytes).min(left);
    match packing.as_str() {
        "" => Ok(Cow::Borrowed(packed)),
        "lz4" | "zstd" if size > limit => Err(ExportError::BadBytes {
            offset,
            found: format!("a chunk of {size} bytes"),
            expected: format!("at most {limit} for {length} packed bytes"),
        }),
        "lz4" => lz4::unpacked(packed, size, offset).map(Cow::Owned),
        "zstd" => {
            let damaged = |found: String| ExportError::BadBytes {
                offset,
                found,
                expected: format!("{size} bytes packed with zstd"),
            };
            let decoder = StreamingDecoder::new(packed).map_err(|error| damaged(error.to_string()))?;
            let mut out = Vec::new();
            decoder.take(size).read_to_end(&mut out).map_err(|error| damaged(error.to_string()))?;
            if out.len() as u64 == size { Ok(Cow::Owned(out)) } else { Err(damaged(format!("{} bytes", out.len()))) }
        }
        other => Err(ExportError::NotReadable {
            format: "ros",
            reason: format!("chunks packed with {other}; `mcap compress --compression zstd IN -o OUT` packs them anew"),
        }),
    }
}
