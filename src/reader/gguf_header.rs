//! Limits on the header of a GGUF file, checked before anything in it is trusted.
//!
//! Enters: the file. Leaves: nothing, or the first count, length or size beyond its limit. The whole header is walked once
//! and nothing of it is kept; candle reads it afterwards. Layout: GGUF versions 2 and 3, little endian.

use std::fmt::Display;
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read};
use std::path::Path;

use cinesplat_files::FileError;

use crate::error::ReaderError;

/// Largest numbers of tensors and of keys. A model of 80 layers has fewer than 1,000.
const MAX_ENTRIES: u64 = 1 << 14;
/// Longest name of a key or tensor, bytes.
const MAX_NAME_BYTES: u64 = 1 << 12;
/// Longest text, bytes.
const MAX_TEXT_BYTES: u64 = 1 << 22;
/// Most elements of an array. The largest vocabularies have 256,000 tokens.
const MAX_ELEMENTS: u64 = 1 << 21;
/// Most elements of a tensor.
const MAX_TENSOR_ELEMENTS: u64 = 1 << 34;
/// Largest alignment of tensors, bytes.
const MAX_ALIGNMENT: u32 = 1 << 16;

const TYPE_STRING: u32 = 8;
const TYPE_ARRAY: u32 = 9;

/// Checks the header of a file.
///
/// # Errors
/// [`ReaderError::BadModel`] with the place of the first fault · [`ReaderError::File`] when reading fails.
pub(crate) fn check_header(path: &Path, file: &mut File) -> Result<(), ReaderError> {
    let mut header = Header { path, reader: BufReader::new(file), at: 0 };
    header.check()
}

struct Header<'a> {
    path: &'a Path,
    reader: BufReader<&'a mut File>,
    /// Bytes read so far.
    at: u64,
}

impl Header<'_> {
    fn check(&mut self) -> Result<(), ReaderError> {
        let magic = self.bytes::<4>()?;
        if magic != *b"GGUF" {
            return Err(self.bad(
                "the start of the file",
                &format!("{:?}", magic.escape_ascii().to_string()),
                &"\"GGUF\"",
            ));
        }
        let version = self.u32()?;
        if !(2..=3).contains(&version) {
            return Err(self.bad("the GGUF version", &version, &"2 or 3"));
        }
        let num_tensors = self.count("the number of tensors", MAX_ENTRIES)?;
        let num_keys = self.count("the number of keys", MAX_ENTRIES)?;
        (0..num_keys).try_for_each(|_| self.check_key())?;
        (0..num_tensors).try_for_each(|_| self.check_tensor())
    }

    fn check_key(&mut self) -> Result<(), ReaderError> {
        let name = self.name()?;
        let kind = self.u32()?;
        match kind {
            TYPE_STRING => self.skip_text(&name),
            TYPE_ARRAY => self.skip_array(&name),
            _ if name == "general.alignment" => self.check_alignment(kind),
            _ => {
                let bytes = self.scalar_bytes(&name, kind)?;
                self.skip(bytes)
            }
        }
    }

    /// Tensors lie at multiples of the alignment; 0 would divide by zero.
    fn check_alignment(&mut self, kind: u32) -> Result<(), ReaderError> {
        const TYPE_U32: u32 = 4;
        if kind != TYPE_U32 {
            return Err(self.bad("general.alignment", &format!("of type {kind}"), &"of type 4 (32 bits)"));
        }
        let alignment = self.u32()?;
        let is_good = alignment.is_power_of_two() && alignment <= MAX_ALIGNMENT;
        if is_good { Ok(()) } else { Err(self.bad("general.alignment", &alignment, &"a power of two up to 65536")) }
    }

    fn check_tensor(&mut self) -> Result<(), ReaderError> {
        let name = self.name()?;
        let num_dimensions = self.u32()?;
        if !(1..=4).contains(&num_dimensions) {
            return Err(self.bad(&format!("the number of dimensions of {name}"), &num_dimensions, &"1 to 4"));
        }
        let mut num_elements: u64 = 1;
        for _ in 0..num_dimensions {
            let size = self.u64()?;
            let product = num_elements.checked_mul(size).filter(|product| (1..=MAX_TENSOR_ELEMENTS).contains(product));
            num_elements = product.ok_or_else(|| {
                self.bad(&format!("the size of {name}"), &format!("{num_elements} times {size}"), &"1 to 2^34 elements")
            })?;
        }
        // Its type and its place in the file.
        self.skip(4 + 8)
    }

    fn name(&mut self) -> Result<String, ReaderError> {
        let num_bytes = self.count("the length of a name", MAX_NAME_BYTES)?;
        let mut bytes = vec![0; num_bytes as usize];
        self.fill(&mut bytes)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn skip_text(&mut self, name: &str) -> Result<(), ReaderError> {
        let num_bytes = self.count(&format!("the length of a text of {name}"), MAX_TEXT_BYTES)?;
        self.skip(num_bytes)
    }

    fn skip_array(&mut self, name: &str) -> Result<(), ReaderError> {
        let kind = self.u32()?;
        let num_elements = self.count(&format!("the number of elements of {name}"), MAX_ELEMENTS)?;
        match kind {
            TYPE_STRING => (0..num_elements).try_for_each(|_| self.skip_text(name)),
            TYPE_ARRAY => Err(self.bad(name, &"an array of arrays", &"an array of numbers or texts")),
            kind => {
                let bytes = self.scalar_bytes(name, kind)?;
                self.skip(bytes * num_elements)
            }
        }
    }

    /// Bytes of a number or truth value.
    fn scalar_bytes(&self, name: &str, kind: u32) -> Result<u64, ReaderError> {
        match kind {
            0 | 1 | 7 => Ok(1),
            2 | 3 => Ok(2),
            4..=6 => Ok(4),
            10..=12 => Ok(8),
            _ => Err(self.bad(&format!("the type of {name}"), &kind, &"0 to 12")),
        }
    }

    /// A count of at most `limit`.
    fn count(&mut self, part: &str, limit: u64) -> Result<u64, ReaderError> {
        let count = self.u64()?;
        if count <= limit { Ok(count) } else { Err(self.bad(part, &count, &format!("at most {limit}"))) }
    }

    fn u32(&mut self) -> Result<u32, ReaderError> {
        Ok(u32::from_le_bytes(self.bytes()?))
    }

    fn u64(&mut self) -> Result<u64, ReaderError> {
        Ok(u64::from_le_bytes(self.bytes()?))
    }

    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], ReaderError> {
        let mut bytes = [0; N];
        self.fill(&mut bytes)?;
        Ok(bytes)
    }

    fn fill(&mut self, bytes: &mut [u8]) -> Result<(), ReaderError> {
        self.reader.read_exact(bytes).map_err(|error| self.failed(error))?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    fn skip(&mut self, num_bytes: u64) -> Result<(), ReaderError> {
        // Seeking goes beyond the end without an error; the next read finds it.
        self.reader.seek_relative(num_bytes as i64).map_err(|error| self.failed(error))?;
        self.at += num_bytes;
        Ok(())
    }

    fn failed(&self, source: std::io::Error) -> ReaderError {
        if source.kind() == ErrorKind::UnexpectedEof {
            return self.bad(
                &format!("byte {} of the header", self.at),
                &"beyond the end of the file",
                &"a whole header",
            );
        }
        FileError::Read { path: self.path.to_owned(), source }.into()
    }

    fn bad(&self, part: &str, found: &dyn Display, expected: &dyn Display) -> ReaderError {
        ReaderError::bad_model(self.path, part, found, expected)
    }
}
