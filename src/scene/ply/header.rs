use crate::error::SceneError;
use crate::source_file::SourceFile;

/// Number type of a PLY.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    /// Signed integer, 1 byte.
    I8,
    /// Unsigned integer, 1 byte.
    U8,
    /// Signed integer, 2 bytes.
    I16,
    /// Unsigned integer, 2 bytes.
    U16,
    /// Signed integer, 4 bytes.
    I32,
    /// Unsigned integer, 4 bytes.
    U32,
    /// Float, 4 bytes.
    F32,
    /// Float, 8 bytes.
    F64,
}

impl Scalar {
    /// The type of a name, as the header spells it.
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes per number in a binary PLY.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// A property of an element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    /// Name.
    pub(super) name: String,
    /// Type of the value, or of the list's items.
    pub(super) scalar: Scalar,
    /// Type of the length of a list; `None` for a single value.
    pub(super) list_length: Option<Scalar>,
}

/// An element: a table of rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    /// Name.
    pub(super) name: String,
    /// Number of rows that the header claims.
    pub(super) count: u64,
    /// Properties in file order.
    pub(super) properties: Vec<Property>,
    /// Header line of its declaration, from 1.
    pub(super) line: usize,
}

impl Element {
    /// Index of the property with a name.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }

    /// Bytes per row in a binary PLY; `None` if a row holds a list.
    pub(super) fn row_bytes(&self) -> Option<usize> {
        self.properties.iter().map(|p| p.list_length.is_none().then(|| p.scalar.size())).sum()
    }

    /// Minimum bytes per row: with empty lists; in ASCII one digit and one separator per value.
    pub(super) fn least_row_bytes(&self, encoding: Encoding) -> usize {
        let least = |p: &Property| match encoding {
            Encoding::Ascii => 2,
            _ => p.list_length.unwrap_or(p.scalar).size(),
        };
        self.properties.iter().map(least).sum()
    }
}

/// Encoding of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Text.
    Ascii,
    /// Binary, little-endian.
    LittleEndian,
    /// Binary, big-endian.
    BigEndian,
}

/// A parsed header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    /// Encoding of the rows.
    pub(super) encoding: Encoding,
    /// Elements in file order.
    pub(super) elements: Vec<Element>,
    /// Comments, without the keyword.
    pub(super) comments: Vec<String>,
    /// Byte position of the first row.
    pub(super) body_start: usize,
    /// Number of header lines.
    pub(super) num_lines: usize,
}

impl Header {
    /// The element with a name.
    pub(super) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }

    /// A [`SceneError::PlyHeader`] at the last header line.
    pub(super) fn fault(&self, source: &SourceFile, reason: String) -> SceneError {
        SceneError::PlyHeader { path: source.path.to_path_buf(), line: self.num_lines, reason }
    }
}

/// Parses the header. Lines end in LF, CR LF or CR; whitespace around words is ignored.
///
/// # Errors
/// [`SceneError::PlyHeader`] for an invalid line, [`SceneError::PlyCount`] for a count that is not a whole number below
/// 2^32.
pub(super) fn parse(source: &SourceFile) -> Result<Header, SceneError> {
    let mut parser = Parser { source, line: 0, encoding: None, elements: Vec::new(), comments: Vec::new() };
    let mut at = 0;
    loop {
        let (text, next) = parser.next_line(at)?;
        at = next;
        parser.line += 1;
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        if words == ["end_header"] {
            return parser.finish(at);
        }
        parser.take(&words, text)?;
    }
}

struct Parser<'a> {
    source: &'a SourceFile<'a>,
    line: usize,
    encoding: Option<Encoding>,
    elements: Vec<Element>,
    comments: Vec<String>,
}

impl<'a> Parser<'a> {
    fn fault(&self, reason: String) -> SceneError {
        SceneError::PlyHeader { path: self.source.path.to_path_buf(), line: self.line.max(1), reason }
    }

    /// The line that starts at `at`, without its line ending, and the start of the next line.
    fn next_line(&self, at: usize) -> Result<(&'a str, usize), SceneError> {
        let (bytes, most) = (self.source.bytes, self.source.options.limits.header_bytes);
        let window = &bytes[at.min(bytes.len().min(most))..bytes.len().min(most)];
        let Some(length) = window.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            let reason = if bytes.len() > most {
                format!("no end_header in the first {most} bytes")
            } else {
                format!("the file ends at byte {} without end_header", bytes.len())
            };
            return Err(self.fault(reason));
        };
        let line = &window[..length];
        let is_crlf = window[length] == b'\r' && bytes.get(at + length + 1) == Some(&b'\n');
        let next = at + length + if is_crlf { 2 } else { 1 };
        match std::str::from_utf8(line) {
            Ok(text) if !line.contains(&0) => Ok((text, next)),
            // Comments may have any encoding; those that are not UTF-8 are ignored.
            _ if line.starts_with(b"comment") || line.starts_with(b"obj_info") => Ok(("comment", next)),
            _ => Err(self.fault("bytes that are not UTF-8 text".to_owned())),
        }
    }

    /// Interprets one header line.
    fn take(&mut self, words: &[&str], text: &str) -> Result<(), SceneError> {
        match *words {
            ["ply"] if self.line == 1 => Ok(()),
            [] | ["obj_info", ..] if self.line > 1 => Ok(()),
            ["comment", ..] => {
                self.comments.push(text.trim().trim_start_matches("comment").trim().to_owned());
                Ok(())
            }
            ["format", name, version] => self.format(name, version),
            ["element", name, count] => self.element(name, count),
            ["property", "list", length, scalar, name] => self.property(name, scalar, Some(length)),
            ["property", scalar, name] => self.property(name, scalar, None),
            _ => Err(self.fault(format!("`{}`, expected a PLY header line", shortened(text)))),
        }
    }

    fn format(&mut self, name: &str, version: &str) -> Result<(), SceneError> {
        let encoding = match name {
            "ascii" => Encoding::Ascii,
            "binary_little_endian" => Encoding::LittleEndian,
            "binary_big_endian" => Encoding::BigEndian,
            _ => return Err(self.fault(format!("format `{}`, expected ascii or binary", shortened(name)))),
        };
        if version != "1.0" || self.encoding.is_some() {
            return Err(self.fault(format!("format version `{}`, expected one line with 1.0", shortened(version))));
        }
        self.encoding = Some(encoding);
        Ok(())
    }

    fn element(&mut self, name: &str, count: &str) -> Result<(), SceneError> {
        if self.elements.iter().any(|element| element.name == name) {
            return Err(self.fault(format!("element {} occurs twice", shortened(name))));
        }
        let Some(count) = count.parse::<u32>().ok().map(u64::from) else {
            let path = self.source.path.to_path_buf();
            return Err(SceneError::PlyCount { path, line: self.line, found: shortened(count) });
        };
        self.elements.push(Element { name: name.to_owned(), count, properties: Vec::new(), line: self.line });
        Ok(())
    }

    fn property(&mut self, name: &str, scalar: &str, length: Option<&str>) -> Result<(), SceneError> {
        let of_type = |word: &str| {
            Scalar::named(word).ok_or_else(|| self.fault(format!("type `{}`, expected a PLY type", shortened(word))))
        };
        let scalar = of_type(scalar)?;
        let list_length = length.map(of_type).transpose()?;
        if matches!(list_length, Some(Scalar::F32 | Scalar::F64)) {
            return Err(self.fault("a list length of floating type, expected an integer type".to_owned()));
        }
        let Some(element) = self.elements.last() else {
            return Err(self.fault("a property before the first element".to_owned()));
        };
        if element.find(name).is_some() {
            return Err(self.fault(format!(
                "property {} occurs twice in {}",
                shortened(name),
                shortened(&element.name)
            )));
        }
        if let Some(element) = self.elements.last_mut() {
            element.properties.push(Property { name: name.to_owned(), scalar, list_length });
        }
        Ok(())
    }

    fn finish(self, body_start: usize) -> Result<Header, SceneError> {
        let Some(encoding) = self.encoding else {
            return Err(self.fault("no format line before end_header".to_owned()));
        };
        if let Some(element) = self.elements.iter().find(|e| e.count > 0 && e.properties.is_empty()) {
            return Err(self.fault(format!("element {} has no properties", shortened(&element.name))));
        }
        Ok(Header { encoding, elements: self.elements, comments: self.comments, body_start, num_lines: self.line })
    }
}

/// The first 40 characters of text from a file, with control characters replaced.
fn shortened(text: &str) -> String {
    text.chars().take(40).map(|c| if c.is_control() { '?' } else { c }).collect()
}
