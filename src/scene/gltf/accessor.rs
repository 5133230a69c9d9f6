//! Columns of numbers in the buffers of a file.

use std::borrow::Cow;

use serde_json::Value;

/// The numbers of an accessor: elements of a fixed width, decoded on access.
pub(super) struct Numbers {
    /// Elements.
    pub(super) count: usize,
    width: usize,
    values: Vec<f32>,
}

/// Type of the components of an accessor.
#[derive(Clone, Copy)]
struct Component {
    size: usize,
    decode: fn(&[u8]) -> f32,
    /// Value that stands for 1 where numbers are normalized.
    peak: f32,
}

fn component(code: u64) -> Option<Component> {
    let of = |size, peak, decode| Some(Component { size, decode, peak });
    match code {
        5120 => of(1, 127.0, |b| f32::from(b[0].cast_signed())),
        5121 => of(1, 255.0, |b| f32::from(b[0])),
        5122 => of(2, 32767.0, |b| f32::from(i16::from_le_bytes([b[0], b[1]]))),
        5123 => of(2, 65535.0, |b| f32::from(u16::from_le_bytes([b[0], b[1]]))),
        5126 => of(4, 1.0, |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        _ => None,
    }
}

impl Numbers {
    /// The numbers of accessor `idx`, whose elements have `width` components. The error says what is wrong with it.
    pub(super) fn new(json: &Value, buffers: &[Cow<[u8]>], idx: u64, width: usize) -> Result<Self, String> {
        let accessor = json.pointer(&format!("/accessors/{idx}")).ok_or("an accessor that does not exist")?;
        let number = |value: &Value, name: &str| value.get(name).and_then(Value::as_u64).map(|found| found as usize);
        let kind = accessor.get("type").and_then(Value::as_str).unwrap_or_default();
        if kind != ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1] {
            return Err(format!("elements of type {kind}"));
        }
        if accessor.get("sparse").is_some() {
            return Err("a sparse accessor".to_owned());
        }
        let code = accessor.get("componentType").and_then(Value::as_u64).unwrap_or(0);
        let part = component(code).ok_or_else(|| format!("components of type {code}"))?;
        let is_normalized = accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false);
        let view = number(accessor, "bufferView").and_then(|view| json.pointer(&format!("/bufferViews/{view}")));
        let view = view.ok_or("no buffer view")?;
        let buffer = number(view, "buffer").and_then(|buffer| buffers.get(buffer)).ok_or("no buffer")?;
        let count = number(accessor, "count").ok_or("no count")?;
        let stride = number(view, "byteStride").unwrap_or(part.size * width);
        let start = number(view, "byteOffset").unwrap_or(0).saturating_add(number(accessor, "byteOffset").unwrap_or(0));
        let element_len = part.size * width;
        let last = count.saturating_sub(1).checked_mul(stride);
        let end = last.and_then(|len| len.checked_add(start.checked_add(element_len)?));
        if count == 0 || stride < element_len || end.is_none_or(|end| end > buffer.len()) {
            return Err(format!("{count} elements, expected as many as the buffer has room for"));
        }
        let factor = if is_normalized { part.peak.recip() } else { 1.0 };
        let value = |at: usize| {
            let decoded = (part.decode)(&buffer[at..at + part.size]) * factor;
            if is_normalized { decoded.max(-1.0) } else { decoded }
        };
        let element = |idx: usize| (0..width).map(move |k| start + idx * stride + k * part.size);
        Ok(Self { count, width, values: (0..count).flat_map(element).map(value).collect() })
    }

    /// Component `k` of an element.
    pub(super) fn at(&self, idx: usize, k: usize) -> f64 {
        f64::from(self.values[idx * self.width + k])
    }
}
