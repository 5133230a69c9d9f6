//! `NumPy` arrays: any shape of little-endian numbers.
//!
//! Enters: bytes of a `.npy` file, versions 1 to 3, C order. Leaves: its type, its shape and its data ([`Array`]).
//! The functions `encode*` do the reverse. Reference: numpy's `lib/format.py`. This project has its own reader because the
//! published crates depend on a parser generator for the single line of header.

use thiserror::Error;

const MAGIC: &[u8] = b"\x93NUMPY";

/// The data of a file starts at a multiple of this, in bytes.
const ALIGNMENT: usize = 64;

/// Error of reading an array; the text says what was found.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct NpyError(String);

/// An array as stored in its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Array<'a> {
    /// Type of the numbers in numpy's notation: `<f4`, `<u2`.
    pub descr: String,
    /// Length of every axis, the outermost first.
    pub shape: Vec<usize>,
    /// The values as bytes, in C order.
    pub data: &'a [u8],
}

impl<'a> Array<'a> {
    /// Parses the bytes of a `.npy` file.
    ///
    /// # Errors
    /// [`NpyError`] for another signature, a header that is cut off or incomplete, data in Fortran order.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, NpyError> {
        let (header, data) = split_header(bytes)?;
        if field(&header, "fortran_order")? != "False" {
            return Err(NpyError("an array in Fortran order".to_owned()));
        }
        let shape = field(&header, "shape")?;
        let axes = shape.split(',').map(str::trim).filter(|axis| !axis.is_empty());
        let axes: Result<Vec<usize>, _> = axes.map(str::parse).collect();
        let bad_shape = || NpyError(format!("an array of shape ({shape})"));
        Ok(Self { descr: field(&header, "descr")?, shape: axes.map_err(|_| bad_shape())?, data })
    }

    /// The values as `u32`, from unsigned integers of one, two or four bytes.
    ///
    /// # Errors
    /// [`NpyError`] for another type, or data whose length does not match the shape.
    pub fn to_u32(&self) -> Result<Vec<u32>, NpyError> {
        let size = match self.descr.as_str() {
            "|u1" | "<u1" | "u1" => 1,
            "<u2" => 2,
            "<u4" => 4,
            other => return Err(NpyError(format!("values of type `{other}`"))),
        };
        self.check_len(size)?;
        let value = |chunk: &[u8]| chunk.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte));
        Ok(self.data.chunks_exact(size).map(value).collect())
    }

    /// The values as `f32`.
    ///
    /// # Errors
    /// [`NpyError`] for another type, or data whose length does not match the shape.
    pub fn to_f32(&self) -> Result<Vec<f32>, NpyError> {
        if self.descr != "<f4" {
            return Err(NpyError(format!("values of type `{}`", self.descr)));
        }
        self.check_len(4)?;
        Ok(self.data.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
    }

    fn check_len(&self, size: usize) -> Result<(), NpyError> {
        let num_values = self.shape.iter().try_fold(1_usize, |num, axis| num.checked_mul(*axis));
        if num_values.and_then(|num| num.checked_mul(size)) == Some(self.data.len()) {
            return Ok(());
        }
        let (shape, num_bytes) = (&self.shape, self.data.len());
        Err(NpyError(format!("an array of shape {shape:?}, {size} bytes per value, with {num_bytes} bytes of data")))
    }
}

/// Bytes of a `.npy` file of `f32`.
pub fn encode_f32(shape: &[usize], values: &[f32]) -> Vec<u8> {
    encode("'<f4'", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// Bytes of a `.npy` file of `u16`.
pub fn encode_u16(shape: &[usize], values: &[u16]) -> Vec<u8> {
    encode("'<u2'", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// Bytes of a `.npy` file, version 1.0, of any type. `descr` is the type in numpy's notation, with its quotes or brackets.
pub fn encode(descr: &str, shape: &[usize], data: impl Iterator<Item = u8>) -> Vec<u8> {
    let axes: Vec<String> = shape.iter().map(usize::to_string).collect();
    // In Python a tuple of one element ends in a comma.
    let comma = if axes.len() == 1 { "," } else { "" };
    let axes = axes.join(", ");
    let mut header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': ({axes}{comma}), }}");
    let prefix = MAGIC.len() + 4;
    let padded = (prefix + header.len() + 1).next_multiple_of(ALIGNMENT);
    header.push_str(&" ".repeat(padded - prefix - header.len() - 1));
    header.push('\n');
    let mut bytes = [MAGIC, &[1, 0], &(header.len() as u16).to_le_bytes(), header.as_bytes()].concat();
    bytes.extend(data);
    bytes
}

/// Header text and the data behind it.
fn split_header(bytes: &[u8]) -> Result<(String, &[u8]), NpyError> {
    let cut_off = || NpyError("a cut-off .npy header".to_owned());
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(|| NpyError("no .npy signature".to_owned()))?;
    let (&[major, _minor], rest) = rest.split_first_chunk().ok_or_else(cut_off)?;
    let (length, rest) = rest.split_at_checked(if major >= 2 { 4 } else { 2 }).ok_or_else(cut_off)?;
    let length = length.iter().rev().fold(0_usize, |value, &byte| value << 8 | usize::from(byte));
    let (header, data) = rest.split_at_checked(length).ok_or_else(cut_off)?;
    Ok((String::from_utf8_lossy(header).into_owned(), data))
}

/// Text of one value of the header's dictionary, without quotes and brackets.
fn field(header: &str, key: &str) -> Result<String, NpyError> {
    let missing = || NpyError(format!("a .npy header without `{key}`"));
    let (_, value) = header.split_once(&format!("'{key}'")).ok_or_else(missing)?;
    let value = value.trim_start().strip_prefix(':').ok_or_else(missing)?.trim_start();
    let end = if value.starts_with('(') { value.find(')') } else { value.find([',', '}']) };
    Ok(value[..end.ok_or_else(missing)?].trim_matches(['(', ' ', '\'', '"']).to_owned())
}
