//! Bytes packed with LZ4, and lists of whole numbers stored as differences.

use super::super::super::bytes::Bytes;
use super::damage::damaged;
use crate::ExportError;

/// Most entries of a table: those of larger scenes are no path of a camera.
const MAX_ENTRIES: u64 = 1 << 23;

/// A number of entries, of which each unpacks to at least `entry_bytes`; at most `most_bytes` may be unpacked.
pub(super) fn count(bytes: &mut Bytes<'_>, entry_bytes: u64, most_bytes: u64) -> Result<usize, ExportError> {
    let offset = bytes.position();
    let found = bytes.u64()?;
    let most = MAX_ENTRIES.min(most_bytes / entry_bytes);
    if found > most {
        return Err(damaged(offset, format!("{found} entries"), format!("at most {most}")));
    }
    Ok(found as usize)
}

/// The packed bytes behind their number, unpacked to at most `most` bytes.
pub(super) fn unpacked(bytes: &mut Bytes<'_>, most: usize) -> Result<Vec<u8>, ExportError> {
    let length = bytes.u64()?;
    let offset = bytes.position();
    let mut packed = Bytes::new(bytes.take(length)?);
    let [num_chunks] = packed.array()?;
    let mut out = Vec::new();
    // Only blocks of over 2 GB come in chunks.
    if num_chunks == 0 {
        append(&mut out, packed.rest(), most, offset)?;
    }
    for _ in 0..num_chunks {
        let length = packed.u32()?;
        append(&mut out, packed.take(length.into())?, most, offset)?;
    }
    Ok(out)
}

fn append(out: &mut Vec<u8>, block: &[u8], most: usize, offset: usize) -> Result<(), ExportError> {
    // No byte of LZ4 unpacks to more than 255.
    let room = (most - out.len()).min(block.len().saturating_mul(255));
    let more = lz4_flex::block::decompress(block, room);
    out.extend(
        more.map_err(|error| damaged(offset, error.to_string(), format!("at most {room} bytes packed with LZ4")))?,
    );
    Ok(())
}

/// `count` whole numbers: the most common difference, two bits per number that say how many bytes its difference has,
/// and the differences.
pub(super) fn whole_numbers(bytes: &mut Bytes<'_>, count: usize) -> Result<Vec<u32>, ExportError> {
    let code_bytes = count.div_ceil(4);
    let offset = bytes.position();
    let data = unpacked(bytes, 4 + code_bytes + 4 * count)?;
    let short = |_| damaged(offset, "too few differences", format!("{count} of them"));
    let mut differences = Bytes::new(&data);
    let common = differences.u32().map_err(short)?;
    let codes = differences.take(code_bytes as u64).map_err(short)?;
    let mut last = 0_u32;
    let mut next = |idx: usize| {
        let difference = match codes[idx / 4] >> (idx % 4 * 2) & 3 {
            0 => common,
            1 => i32::from(i8::from_le_bytes(differences.array()?)).cast_unsigned(),
            2 => i32::from(i16::from_le_bytes(differences.array()?)).cast_unsigned(),
            _ => differences.u32()?,
        };
        last = last.wrapping_add(difference);
        Ok(last)
    };
    (0..count).map(&mut next).collect::<Result<_, ExportError>>().map_err(short)
}
