//! Bags of ROS 1: records of a header of `name=value` fields and data. Chunks hold connections and messages,
//! plain or packed with LZ4.

use std::borrow::Cow;
use std::collections::BTreeMap;

use cinesplat_files::Limits;

use super::lz4;
use super::message::{Encoding, Kind, Topic, Visit};
use crate::ExportError;
use crate::bytes::{Bytes, text};

/// First bytes of a bag.
pub(super) const MAGIC: &[u8] = b"#ROSBAG V2.0\n";
/// The kinds of records that are read.
const MESSAGE: u8 = 2;
const CHUNK: u8 = 5;
const CONNECTION: u8 = 7;

/// Topics by the number of their connection, and bytes that further chunks may unpack to.
struct Connections {
    topics: BTreeMap<u32, Topic>,
    unpacked_left: u64,
}

/// Visits the messages of all topics with poses.
pub(super) fn visit(bytes: &[u8], visit: &mut Visit<'_>) -> Result<(), ExportError> {
    let mut connections = Connections { topics: BTreeMap::new(), unpacked_left: Limits::DEFAULT.unpacked(bytes.len()) };
    records(bytes.strip_prefix(MAGIC).unwrap_or_default(), &mut connections, visit, true)
}

fn records(
    data: &[u8],
    connections: &mut Connections,
    visit: &mut Visit<'_>,
    may_hold_chunks: bool,
) -> Result<(), ExportError> {
    let mut bytes = Bytes::new(data);
    while !bytes.is_empty() {
        let header = Fields::new(bytes.counted()?)?;
        let data = bytes.counted()?;
        // Chunks stand in the file itself, behind its first bytes.
        let offset = MAGIC.len() + bytes.position() - data.len();
        match header.op() {
            Some(CHUNK) if may_hold_chunks => {
                let chunk = unpacked(&header, (data, offset), connections.unpacked_left)?;
                connections.unpacked_left = connections.unpacked_left.saturating_sub(chunk.len() as u64);
                records(&chunk, connections, visit, false)?;
            }
            Some(CONNECTION) => connect(&header, data, connections)?,
            Some(MESSAGE) => {
                if let Some(topic) = header.number("conn").and_then(|number| connections.topics.get(&number)) {
                    visit(topic, data)?;
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// The records of a chunk at an offset of the file; packed ones may be of `left` bytes.
fn unpacked<'a>(
    header: &Fields<'_>,
    (packed, offset): (&'a [u8], usize),
    left: u64,
) -> Result<Cow<'a, [u8]>, ExportError> {
    let size = header.number("size").map_or(0, u64::from);
    let limit = Limits::DEFAULT.unpacked(packed.len()).min(left);
    match header.get("compression").unwrap_or_default() {
        b"none" => Ok(Cow::Borrowed(packed)),
        b"lz4" if size <= limit => lz4::unpacked(packed, size, offset).map(Cow::Owned),
        b"lz4" => Err(ExportError::BadBytes {
            offset,
            found: format!("a chunk of {size} bytes"),
            expected: format!("at most {limit} for {} packed bytes", packed.len()),
        }),
        other => {
            let name = String::from_utf8_lossy(other);
            Err(ExportError::NotReadable {
                format: "ros",
                reason: format!("a bag packed with {name}; `rosbag decompress BAG` (of ROS) unpacks it"),
            })
        }
    }
}

/// Notes the topic of a connection, if its messages hold poses.
fn connect(header: &Fields<'_>, data: &[u8], connections: &mut Connections) -> Result<(), ExportError> {
    // It holds the definition of the type, which is short for all types with poses.
    if data.len() > Limits::DEFAULT.header_bytes {
        return Ok(());
    }
    let own = Fields::new(data)?;
    let (Some(number), Some(topic), Some(kind)) = (header.number("conn"), header.get("topic"), own.get("type")) else {
        return Ok(());
    };
    if let Some(kind) = Kind::of(&text(kind, 0)?) {
        connections.topics.insert(number, Topic { name: text(topic, 0)?, kind, encoding: Encoding::Ros1 });
    }
    Ok(())
}

/// The fields of a header.
struct Fields<'a>(Vec<(&'a [u8], &'a [u8])>);

impl<'a> Fields<'a> {
    fn new(data: &'a [u8]) -> Result<Self, ExportError> {
        let limit = Limits::DEFAULT.header_bytes;
        if data.len() > limit {
            return Err(ExportError::BadBytes {
                offset: 0,
                found: format!("a header of {} bytes", data.len()),
                expected: format!("at most {limit}"),
            });
        }
        let (mut bytes, mut fields) = (Bytes::new(data), Vec::new());
        while !bytes.is_empty() {
            let field = bytes.counted()?;
            let end = field.iter().position(|byte| *byte == b'=').ok_or_else(|| ExportError::BadBytes {
                offset: bytes.position(),
                found: "a field without =".into(),
                expected: "name=value in the header of a record".into(),
            })?;
            fields.push((&field[..end], &field[end + 1..]));
        }
        Ok(Self(fields))
    }

    fn get(&self, name: &str) -> Option<&'a [u8]> {
        self.0.iter().find(|(key, _)| *key == name.as_bytes()).map(|(_, value)| *value)
    }

    fn op(&self) -> Option<u8> {
        self.get("op")?.first().copied()
    }

    fn number(&self, name: &str) -> Option<u32> {
        Some(u32::from_le_bytes(self.get(name)?.try_into().ok()?))
    }
}
