//! Values: 48 bits that hold a small value or the place of a larger one, and its type.

use super::super::super::bytes::Bytes;
use super::super::layer::{MAX_DEPTH, Value};
use super::damage::damaged;
use super::tables::Tables;
use crate::ExportError;

const IS_ARRAY: u64 = 1 << 63;
const IS_INLINED: u64 = 1 << 62;
const IS_PACKED: u64 = 1 << 61;
const PAYLOAD: u64 = (1 << 48) - 1;

/// Numbers of the types that cameras need, other than numbers.
const STRING: u8 = 10;
const TOKEN: u8 = 11;
const ASSET: u8 = 12;
const DICTIONARY: u8 = 31;
const TOKENS: u8 = 41;
const TIME_SAMPLES: u8 = 46;
const DOUBLES: u8 = 48;
const NO_VALUE: u8 = 51;

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stored {
    U8,
    I32,
    U32,
    I64,
    U64,
    F16,
    F32,
    F64,
}

/// How the numbers of a type are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Single,
    /// Inlined with a byte per number.
    Vector(usize),
    /// Of `n` x `n` numbers; inlined with a byte per number of its diagonal.
    Matrix(usize),
    /// Never inlined; x, y, z, w.
    Quaternion,
}

/// The numbers of a type; `None` for types without.
fn numbers_of(kind: u8) -> Option<(Stored, Shape)> {
    use Stored::{F16, F32, F64, I32, I64, U8, U32, U64};
    let of_vector = |n: u8| (([F64, F32, F16, I32])[usize::from(n % 4)], Shape::Vector(2 + usize::from(n / 4)));
    Some(match kind {
        1 | 2 => (U8, Shape::Single),
        3 => (I32, Shape::Single),
        4 => (U32, Shape::Single),
        5 => (I64, Shape::Single),
        6 => (U64, Shape::Single),
        7 => (F16, Shape::Single),
        8 => (F32, Shape::Single),
        // A time code is a double.
        9 | 56 => (F64, Shape::Single),
        13..=15 => (F64, Shape::Matrix(usize::from(kind) - 11)),
        16 => (F64, Shape::Quaternion),
        17 => (F32, Shape::Quaternion),
        18 => (F16, Shape::Quaternion),
        19..=30 => of_vector(kind - 19),
        _ => return None,
    })
}

impl Stored {
    /// The next number.
    fn next(self, bytes: &mut Bytes<'_>) -> Result<f64, ExportError> {
        Ok(match self {
            Self::U8 => f64::from(bytes.array::<1>()?[0]),
            Self::I32 => f64::from(i32::from_le_bytes(bytes.array()?)),
            Self::U32 => f64::from(bytes.u32()?),
            Self::I64 => i64::from_le_bytes(bytes.array()?) as f64,
            Self::U64 => bytes.u64()? as f64,
            Self::F16 => half::f16::from_le_bytes(bytes.array()?).to_f64(),
            Self::F32 => f64::from(f32::from_le_bytes(bytes.array()?)),
            Self::F64 => f64::from_le_bytes(bytes.array()?),
        })
    }

    /// How a single number is stored within the value.
    fn inlined(self) -> Self {
        match self {
            Self::I64 => Self::I32,
            Self::U64 => Self::U32,
            Self::F64 => Self::F32,
            other => other,
        }
    }
}

/// The value behind 64 bits of a field; `None` for one of a type that cameras do not need.
pub(super) fn value(tables: &Tables<'_>, bits: u64) -> Result<Option<Value>, ExportError> {
    nested(tables, bits, 0)
}

fn nested(tables: &Tables<'_>, bits: u64, depth: usize) -> Result<Option<Value>, ExportError> {
    tables.spend(1)?;
    let payload = bits & PAYLOAD;
    if depth > MAX_DEPTH {
        return Err(damaged(payload as usize, "a value in a value", "less nesting"));
    }
    let kind = (bits >> 48) as u8;
    let mut at = Bytes::at(tables.bytes, payload as usize);
    if bits & IS_ARRAY != 0 {
        return if kind == TOKEN && bits & IS_PACKED == 0 {
            array_of_tokens(tables, payload).map(Some)
        } else {
            Ok(None)
        };
    }
    match kind {
        STRING => text(tables, tables.string(payload as u32)?).map(Some),
        TOKEN | ASSET => text(tables, tables.token(payload as u32)?).map(Some),
        TOKENS => {
            let num = at.u64()?;
            list_of_tokens(tables, &mut at, num).map(Some)
        }
        DICTIONARY => dictionary(tables, &mut at, depth).map(|entries| Some(Value::Map(entries))),
        TIME_SAMPLES => time_samples(tables, &mut at, depth).map(|samples| Some(Value::Map(samples))),
        // As the text form says it.
        NO_VALUE => Ok(Some(Value::Text("None".to_owned()))),
        _ => numbers_of(kind).map(|of| numbers(tables, bits, of)).transpose(),
    }
}

fn text(tables: &Tables<'_>, text: &str) -> Result<Value, ExportError> {
    tables.spend(1 + text.len() as u64 / 8)?;
    Ok(Value::Text(text.to_owned()))
}

fn numbers(tables: &Tables<'_>, bits: u64, (stored, shape): (Stored, Shape)) -> Result<Value, ExportError> {
    let inline = (bits & PAYLOAD).to_le_bytes();
    let is_inlined = bits & IS_INLINED != 0;
    let mut within = Bytes::new(&inline);
    let mut at = Bytes::at(tables.bytes, (bits & PAYLOAD) as usize);
    let signed = |byte: u8| f64::from(byte.cast_signed());
    let list = match shape {
        Shape::Single if is_inlined => return stored.inlined().next(&mut within).map(Value::Number),
        Shape::Single => return stored.next(&mut at).map(Value::Number),
        // Two halves take no more room than a byte each would.
        Shape::Vector(2) if is_inlined && stored == Stored::F16 => {
            vec![stored.next(&mut within)?, stored.next(&mut within)?]
        }
        Shape::Vector(num) if is_inlined => inline[..num].iter().copied().map(signed).collect(),
        Shape::Matrix(size) if is_inlined => {
            (0..size * size).map(|idx| if idx % (size + 1) == 0 { signed(inline[idx / size]) } else { 0.0 }).collect()
        }
        Shape::Vector(num) => read_numbers(stored, &mut at, num)?,
        Shape::Matrix(size) => read_numbers(stored, &mut at, size * size)?,
        Shape::Quaternion => {
            let mut xyzw = read_numbers(stored, &mut at, 4)?;
            // The text form has w first.
            xyzw.rotate_right(1);
            xyzw
        }
    };
    tables.spend(list.len() as u64)?;
    Ok(Value::List(list.into_iter().map(Value::Number).collect()))
}

fn read_numbers(stored: Stored, at: &mut Bytes<'_>, num: usize) -> Result<Vec<f64>, ExportError> {
    (0..num).map(|_| stored.next(at)).collect()
}

fn array_of_tokens(tables: &Tables<'_>, payload: u64) -> Result<Value, ExportError> {
    if payload == 0 {
        return Ok(Value::List(Vec::new()));
    }
    let mut at = Bytes::at(tables.bytes, payload as usize);
    if tables.minor < 5 {
        // The number of dimensions, which is 1.
        at.u32()?;
    }
    let num = if tables.minor < 7 { at.u32()?.into() } else { at.u64()? };
    list_of_tokens(tables, &mut at, num)
}

fn list_of_tokens(tables: &Tables<'_>, at: &mut Bytes<'_>, num: u64) -> Result<Value, ExportError> {
    (0..num).map(|_| text(tables, tables.token(at.u32()?)?)).collect::<Result<_, _>>().map(Value::List)
}

/// A value that stands elsewhere: the way to it from here. Behind its 64 bits the reading goes on.
fn elsewhere<'a>(tables: &Tables<'a>, at: &mut Bytes<'a>) -> Result<Bytes<'a>, ExportError> {
    let from = at.position() as u64;
    let way = at.u64()?;
    let to = from.wrapping_add(way);
    Ok(Bytes::at(tables.bytes, usize::try_from(to).unwrap_or(usize::MAX)))
}

fn dictionary<'a>(tables: &Tables<'a>, at: &mut Bytes<'a>, depth: usize) -> Result<Vec<(String, Value)>, ExportError> {
    let mut entries = Vec::new();
    for _ in 0..at.u64()? {
        let key = tables.string(at.u32()?)?.to_owned();
        tables.spend(key.len() as u64 / 8)?;
        *at = elsewhere(tables, at)?;
        let value = nested(tables, at.u64()?, depth + 1)?;
        entries.extend(value.map(|value| (key, value)));
    }
    Ok(entries)
}

/// Values by time code, with the codes as text, as in the text form.
fn time_samples<'a>(
    tables: &Tables<'a>,
    at: &mut Bytes<'a>,
    depth: usize,
) -> Result<Vec<(String, Value)>, ExportError> {
    *at = elsewhere(tables, at)?;
    let codes = time_codes(tables, at.u64()?)?;
    *at = elsewhere(tables, at)?;
    let offset = at.position();
    let num = at.u64()?;
    if num != codes.len() as u64 {
        return Err(damaged(offset, format!("{num} samples"), format!("{} of them", codes.len())));
    }
    let mut samples = Vec::new();
    for code in codes {
        let value = nested(tables, at.u64()?, depth + 1)?;
        samples.extend(value.map(|value| (code.to_string(), value)));
    }
    Ok(samples)
}

fn time_codes(tables: &Tables<'_>, bits: u64) -> Result<Vec<f64>, ExportError> {
    let offset = (bits & PAYLOAD) as usize;
    let mut at = Bytes::at(tables.bytes, offset);
    if (bits >> 48) as u8 != DOUBLES {
        return Err(damaged(offset, format!("time codes of type {}", (bits >> 48) as u8), "a list of doubles"));
    }
    let num = at.u64()?;
    tables.spend(num)?;
    (0..num).map(|_| Stored::F64.next(&mut at)).collect()
}
