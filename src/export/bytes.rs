//! Numbers and texts of binary files.

use crate::ExportError;

/// Reads numbers and texts from bytes, front to back.
#[derive(Debug, Clone)]
pub(crate) struct Bytes<'a> {
    data: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(data: &'a [u8]) -> Self {
        Self { data, at: 0 }
    }

    /// Begins at an offset; one behind the end leaves nothing to read.
    pub(crate) fn at(data: &'a [u8], offset: usize) -> Self {
        Self { data, at: offset.min(data.len()) }
    }

    /// Where the next byte is.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.at >= self.data.len()
    }

    /// The next `num` bytes.
    pub(crate) fn take(&mut self, num: u64) -> Result<&'a [u8], ExportError> {
        let left = &self.data[self.at..];
        let found = usize::try_from(num).ok().and_then(|num| left.get(..num)).ok_or_else(|| ExportError::BadBytes {
            offset: self.at,
            found: format!("{} bytes before the end", left.len()),
            expected: format!("{num} bytes"),
        })?;
        self.at += found.len();
        Ok(found)
    }

    /// All bytes that are left.
    pub(crate) fn rest(&self) -> &'a [u8] {
        &self.data[self.at..]
    }

    /// Goes on at the next multiple of `size` behind `start`.
    pub(crate) fn align(&mut self, start: usize, size: usize) -> Result<(), ExportError> {
        let over = (self.at - start) % size;
        self.take(if over > 0 { (size - over) as u64 } else { 0 }).map(|_| ())
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], ExportError> {
        let mut out = [0; N];
        out.copy_from_slice(self.take(N as u64)?);
        Ok(out)
    }

    pub(crate) fn u16(&mut self) -> Result<u16, ExportError> {
        Ok(u16::from_le_bytes(self.array()?))
    }

    pub(crate) fn u32(&mut self) -> Result<u32, ExportError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn u64(&mut self) -> Result<u64, ExportError> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    /// Bytes behind their number.
    pub(crate) fn counted(&mut self) -> Result<&'a [u8], ExportError> {
        let num = self.u32()?;
        self.take(num.into())
    }

    /// A text behind its number of bytes.
    pub(crate) fn text(&mut self) -> Result<String, ExportError> {
        let offset = self.at;
        text(self.counted()?, offset)
    }
}

/// The text of bytes that begin at an offset of the file.
pub(crate) fn text(bytes: &[u8], offset: usize) -> Result<String, ExportError> {
    let text = std::str::from_utf8(bytes).map(str::to_owned);
    text.map_err(|error| ExportError::BadBytes {
        offset: offset + error.valid_up_to(),
        found: "bytes that are not UTF-8".into(),
        expected: "a name".into(),
    })
}
