//! Rows of an element as numbers, in any encoding.

use std::ops::Range;

use super::header::{Element, Encoding, Header, Scalar};
use crate::error::SceneError;
use crate::source_file::SourceFile;

/// Reads the rows of a PLY body sequentially, element by element.
pub(super) struct Rows<'a> {
    source: &'a SourceFile<'a>,
    encoding: Encoding,
    at: usize,
}

impl<'a> Rows<'a> {
    /// A reader at the first row of the first element.
    pub(super) fn new(source: &'a SourceFile<'a>, header: &Header) -> Self {
        Self { source, encoding: header.encoding, at: header.body_start.min(source.bytes.len()) }
    }

    /// Number of bytes after the rows read so far; in ASCII without surrounding whitespace.
    pub(super) fn num_left(&self) -> usize {
        let rest = &self.source.bytes[self.at..];
        match self.encoding {
            Encoding::Ascii => rest.trim_ascii().len(),
            _ => rest.len(),
        }
    }

    /// Checks that the remaining bytes can hold the rows that the element claims.
    ///
    /// # Errors
    /// [`SceneError::PlyTruncated`] with the first missing row.
    pub(super) fn check_room(&self, element: &Element) -> Result<(), SceneError> {
        let least = element.least_row_bytes(self.encoding).max(1) as u64;
        // The last value of an ASCII file may have no separator.
        let spare = u64::from(self.encoding == Encoding::Ascii);
        let rows = ((self.source.bytes.len() - self.at) as u64 + spare) / least;
        if rows < element.count {
            Err(self.truncated(element, rows, self.at as u64 + (rows + 1) * least))
        } else {
            Ok(())
        }
    }

    /// Reads all rows of `element`. Calls `visit` for each row with the values of the properties `wanted` (indices).
    ///
    /// # Errors
    /// [`SceneError::PlyTruncated`] when rows are missing, [`SceneError::PlyValue`] for an invalid value or list length.
    pub(super) fn read(
        &mut self,
        element: &Element,
        wanted: &[usize],
        mut visit: impl FnMut(&[f64]),
    ) -> Result<(), SceneError> {
        self.check_room(element)?;
        let mut row = vec![0.0; wanted.len()];
        match (self.encoding, element.row_bytes()) {
            (Encoding::Ascii, _) => self.read_ascii(element, wanted, &mut row, &mut visit),
            (_, Some(row_bytes)) => {
                self.read_fixed(element, wanted, row_bytes, &mut visit, &mut row);
                Ok(())
            }
            (_, None) => self.read_ragged(element, wanted, &mut row, &mut visit),
        }
    }

    /// Skips all rows of `element`.
    ///
    /// # Errors
    /// As [`Rows::read`].
    pub(super) fn skip(&mut self, element: &Element) -> Result<(), SceneError> {
        self.check_room(element)?;
        match element.row_bytes() {
            Some(row_bytes) if self.encoding != Encoding::Ascii => {
                self.at += row_bytes * element.count as usize;
                Ok(())
            }
            _ => self.read(element, &[], |_| ()),
        }
    }

    /// Reads binary rows of fixed size; [`Rows::check_room`] must have succeeded.
    fn read_fixed(
        &mut self,
        element: &Element,
        wanted: &[usize],
        row_bytes: usize,
        visit: &mut dyn FnMut(&[f64]),
        row: &mut [f64],
    ) {
        let offset = |idx: usize| element.properties[..idx].iter().map(|p| p.scalar.size()).sum::<usize>();
        let columns: Vec<(usize, Scalar)> =
            wanted.iter().map(|&idx| (offset(idx), element.properties[idx].scalar)).collect();
        let end = self.at + row_bytes * element.count as usize;
        for bytes in self.source.bytes[self.at..end].chunks_exact(row_bytes) {
            for (value, (offset, scalar)) in row.iter_mut().zip(&columns) {
                *value = number(&bytes[*offset..], *scalar, self.encoding);
            }
            visit(row);
        }
        self.at = end;
    }

    /// Reads binary rows with lists. The value of a list is its first item, or 0 if it is empty.
    fn read_ragged(
        &mut self,
        element: &Element,
        wanted: &[usize],
        row: &mut [f64],
        visit: &mut dyn FnMut(&[f64]),
    ) -> Result<(), SceneError> {
        let bytes = self.source.bytes;
        for row_idx in 0..element.count {
            let mut values: Vec<Range<usize>> = Vec::with_capacity(element.properties.len());
            for property in &element.properties {
                let mut items = 1;
                if let Some(length) = property.list_length {
                    let end = self.at + length.size();
                    let prefix = bytes.get(self.at..end).ok_or_else(|| self.truncated(element, row_idx, end as u64))?;
                    let claimed = number(prefix, length, self.encoding);
                    if claimed < 0.0 {
                        return Err(self.bad_value(element, row_idx, &property.name, &claimed.to_string(), self.at));
                    }
                    items = claimed as usize;
                    self.at = end;
                }
                // At most 2^32 items of 8 bytes: this cannot overflow.
                let end = self.at + items * property.scalar.size();
                if end > bytes.len() {
                    return Err(self.truncated(element, row_idx, end as u64));
                }
                values.push(self.at..end);
                self.at = end;
            }
            for (value, &idx) in row.iter_mut().zip(wanted) {
                let (range, scalar) = (&values[idx], element.properties[idx].scalar);
                *value = if range.is_empty() { 0.0 } else { number(&bytes[range.clone()], scalar, self.encoding) };
            }
            visit(row);
        }
        Ok(())
    }

    /// Reads ASCII rows. The value of a list is its first item, or 0 if it is empty.
    fn read_ascii(
        &mut self,
        element: &Element,
        wanted: &[usize],
        row: &mut [f64],
        visit: &mut dyn FnMut(&[f64]),
    ) -> Result<(), SceneError> {
        let mut all = vec![0.0; element.properties.len()];
        for row_idx in 0..element.count {
            for (value, property) in all.iter_mut().zip(&element.properties) {
                let mut items = 1.0;
                if property.list_length.is_some() {
                    items = self.ascii_number(element, row_idx, &property.name)?;
                }
                *value = 0.0;
                let mut item = 0.0;
                // Every iteration consumes a word, or ends in an error at the end of the file.
                while item < items {
                    let found = self.ascii_number(element, row_idx, &property.name)?;
                    *value = if item == 0.0 { found } else { *value };
                    item += 1.0;
                }
            }
            for (value, &idx) in row.iter_mut().zip(wanted) {
                *value = all[idx];
            }
            visit(row);
        }
        Ok(())
    }

    /// The next word as a number.
    fn ascii_number(&mut self, element: &Element, row_idx: u64, property: &str) -> Result<f64, SceneError> {
        let bytes = self.source.bytes;
        let num_blanks = bytes[self.at..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let start = self.at + num_blanks;
        let length = bytes[start..].iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
        if length == 0 {
            return Err(self.truncated(element, row_idx, bytes.len() as u64 + 1));
        }
        self.at = start + length;
        let word = &bytes[start..self.at];
        let number = std::str::from_utf8(word).ok().and_then(ascii_value);
        number.ok_or_else(|| self.bad_value(element, row_idx, property, &String::from_utf8_lossy(word), start))
    }

    fn truncated(&self, element: &Element, row_idx: u64, needed: u64) -> SceneError {
        SceneError::PlyTruncated {
            path: self.source.path.to_path_buf(),
            element: element.name.clone(),
            row: row_idx + 1,
            rows: element.count,
            needed,
            found: self.source.bytes.len() as u64,
        }
    }

    fn bad_value(&self, element: &Element, row_idx: u64, property: &str, found: &str, byte: usize) -> SceneError {
        let found = found.chars().take(40).map(|c| if c.is_control() { '?' } else { c }).collect();
        SceneError::PlyValue {
            path: self.source.path.to_path_buf(),
            element: element.name.clone(),
            row: row_idx + 1,
            property: property.to_owned(),
            found,
            byte: byte as u64,
        }
    }
}

/// A number as C's `printf` and Python write it, including `nan`, `-nan(ind)`, `inf` and `1.#INF`.
fn ascii_value(word: &str) -> Option<f64> {
    word.parse::<f64>().ok().or_else(|| {
        let lower = word.to_ascii_lowercase();
        let sign = if lower.starts_with('-') { -1.0 } else { 1.0 };
        if lower.contains("nan") || lower.contains("#ind") || lower.contains("#qnan") {
            Some(f64::NAN)
        } else {
            lower.contains("#inf").then_some(sign * f64::INFINITY)
        }
    })
}

/// The number at the start of `bytes`, which must hold at least one.
fn number(bytes: &[u8], scalar: Scalar, encoding: Encoding) -> f64 {
    if let (Scalar::F32, Encoding::LittleEndian, Some(word)) = (scalar, encoding, bytes.first_chunk()) {
        // The common case.
        return f64::from(f32::from_le_bytes(*word));
    }
    let raw = |size: usize| {
        let mut word = [0_u8; 8];
        match encoding {
            Encoding::BigEndian => (0..size).for_each(|idx| word[idx] = bytes[size - 1 - idx]),
            _ => word[..size].copy_from_slice(&bytes[..size]),
        }
        u64::from_le_bytes(word)
    };
    match scalar {
        Scalar::I8 => f64::from(bytes[0].cast_signed()),
        Scalar::U8 => f64::from(bytes[0]),
        Scalar::I16 => f64::from((raw(2) as u16).cast_signed()),
        Scalar::U16 => f64::from(raw(2) as u16),
        Scalar::I32 => f64::from((raw(4) as u32).cast_signed()),
        Scalar::U32 => f64::from(raw(4) as u32),
        Scalar::F32 => f64::from(f32::from_bits(raw(4) as u32)),
        Scalar::F64 => f64::from_bits(raw(8)),
    }
}
