//! The one `NumPy` array this program exchanges: a vector of object ids.
//!
//! Enters: bytes of a `.npy` of `u8`, `u16` or `u32`, little-endian. Leaves: ids that fit 16 bits. Layout:
//! numpy's `lib/format.py`, versions 1 to 3.

const MAGIC: &[u8] = b"\x93NUMPY";

/// Bytes that the header and its prefix are padded to.
const ALIGNMENT: usize = 64;

/// The ids of a one-dimensional array (`[n]`, or `[n, 1]` and `[1, n]`), or what was found instead, in words.
pub(crate) fn decode_ids(bytes: &[u8]) -> Result<Vec<u16>, String> {
    let (header, data) = split_header(bytes)?;
    let size = element_size(&field(&header, "descr")?)?;
    let count = shape(&field(&header, "shape")?)?;
    if count.checked_mul(size) != Some(data.len()) {
        return Err(format!("{count} values of {size} bytes announced and {} bytes of data", data.len()));
    }
    let value = |chunk: &[u8]| chunk.iter().rev().fold(0_u32, |value, &byte| value << 8 | u32::from(byte));
    let narrow = |(i, chunk)| u16::try_from(value(chunk)).map_err(|_| format!("id {} at index {i}", value(chunk)));
    data.chunks_exact(size).enumerate().map(narrow).collect()
}

/// A version 1.0 `.npy` of `u16`, as `numpy.save` writes it.
pub(crate) fn encode_ids(ids: &[u16]) -> Vec<u8> {
    let mut header = format!("{{'descr': '<u2', 'fortran_order': False, 'shape': ({},), }}", ids.len());
    let prefix = MAGIC.len() + 4;
    let padded = (prefix + header.len() + 1).next_multiple_of(ALIGNMENT);
    header.extend(std::iter::repeat_n(' ', padded - prefix - header.len() - 1));
    header.push('\n');
    let mut bytes = [MAGIC, &[1, 0], &(header.len() as u16).to_le_bytes(), header.as_bytes()].concat();
    bytes.extend(ids.iter().flat_map(|id| id.to_le_bytes()));
    bytes
}

/// Header text and the data behind it.
fn split_header(bytes: &[u8]) -> Result<(String, &[u8]), String> {
    let rest = bytes.strip_prefix(MAGIC).ok_or("no .npy signature")?;
    let (&[major, _], rest) = rest.split_first_chunk().ok_or("a cut-off .npy header")?;
    let wide = u64::from(major >= 2);
    let (length, rest) = rest.split_at_checked(2 + 2 * wide as usize).ok_or("a cut-off .npy header")?;
    let length = length.iter().rev().fold(0_usize, |value, &byte| value << 8 | usize::from(byte));
    let (header, data) = rest.split_at_checked(length).ok_or("a cut-off .npy header")?;
    Ok((String::from_utf8_lossy(header).into_owned(), data))
}

/// Text of one value of the header's dictionary, up to the comma or bracket that ends it.
fn field(header: &str, key: &str) -> Result<String, String> {
    let missing = || format!("a .npy header without `{key}`");
    let (_, value) = header.split_once(&format!("'{key}'")).ok_or_else(missing)?;
    let value = value.trim_start().strip_prefix(':').ok_or_else(missing)?.trim_start();
    let end = if value.starts_with('(') { value.find(')') } else { value.find([',', '}']) };
    Ok(value[..end.ok_or_else(missing)?].trim_matches(['(', ' ', '\'', '"']).to_owned())
}

/// Bytes of an unsigned little-endian integer type.
fn element_size(descr: &str) -> Result<usize, String> {
    match descr {
        "|u1" | "<u1" | "u1" => Ok(1),
        "<u2" => Ok(2),
        "<u4" => Ok(4),
        other => Err(format!("values of type `{other}`")),
    }
}

/// Number of values of a vector's shape.
fn shape(text: &str) -> Result<usize, String> {
    let sizes: Result<Vec<usize>, _> =
        text.split(',').map(str::trim).filter(|s| !s.is_empty()).map(str::parse).collect();
    match sizes.map_err(|_| format!("shape ({text})"))?.as_slice() {
        [n] | [n, 1] | [1, n] => Ok(*n),
        _ => Err(format!("an array of shape ({text})")),
    }
}
