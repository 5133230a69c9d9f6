//! The elements of accessors, and their values in buffers.

use super::super::ExportError;
use super::super::json_read::Node;

/// Component type of f32, the only one that camera animations need.
pub(super) const FLOAT: u64 = 5126;

/// Type of an accessor's elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "UPPERCASE")]
pub(super) enum ElementType {
    Scalar,
    Vec3,
    Vec4,
}

impl ElementType {
    /// Number of components.
    pub(super) fn width(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Vec3 => 3,
            Self::Vec4 => 4,
        }
    }
}

/// The values of accessor `idx`, one list per element.
pub(super) fn values(root: &Node, buffers: &[Vec<u8>], idx: usize) -> Result<Vec<Vec<f64>>, ExportError> {
    let accessor = item(root, "accessors", idx)?;
    let element_type = accessor.field("type", "an element type")?.text()?.parse::<ElementType>();
    let width = element_type.map_err(|_| accessor.error("an accessor of scalars, VEC3 or VEC4"))?.width();
    if accessor.field("componentType", "5126")?.whole(u64::MAX)? != FLOAT {
        return Err(accessor.error("an accessor of f32 (componentType 5126)"));
    }
    let count = size(&accessor, "count", None)?;
    let view = item(root, "bufferViews", size(&accessor, "bufferView", None)?)?;
    let buffer = buffers.get(size(&view, "buffer", None)?).ok_or_else(|| view.error("a buffer that exists"))?;
    let stride = size(&view, "byteStride", Some(4 * width))?;
    let start = size(&view, "byteOffset", Some(0))?.saturating_add(size(&accessor, "byteOffset", Some(0))?);
    if stride < 4 * width {
        return Err(view.error("a byteStride of at least one element"));
    }
    let element = |element_idx: usize| -> Option<Vec<f64>> {
        let from = start.checked_add(element_idx.checked_mul(stride)?)?;
        let bytes = buffer.get(from..from.checked_add(4 * width)?)?;
        Some(bytes.chunks_exact(4).filter_map(|b| b.first_chunk()).map(|b| f64::from(f32::from_le_bytes(*b))).collect())
    };
    // The last element is checked first: no count beyond the buffer's bytes allocates anything.
    let last = count.checked_sub(1).ok_or_else(|| accessor.error("a count above 0"))?;
    element(last).ok_or_else(|| accessor.error("values inside the buffer"))?;
    (0..count).map(|idx| element(idx).ok_or_else(|| accessor.error("values inside the buffer"))).collect()
}

/// Entry `idx` of a list at the top level.
pub(super) fn item<'a>(root: &Node<'a>, list: &str, idx: usize) -> Result<Node<'a>, ExportError> {
    let node = root.field(list, "a list")?;
    let items = node.items()?;
    items.into_iter().nth(idx).ok_or_else(|| node.error(format!("at least {} entries", idx + 1)))
}

/// A whole number by name; `default` if it is absent, or an error without a default.
pub(super) fn size(node: &Node, name: &str, default: Option<usize>) -> Result<usize, ExportError> {
    match (node.optional(name), default) {
        (Some(value), _) => Ok(value.whole(u64::from(u32::MAX))? as usize),
        (None, Some(default)) => Ok(default),
        (None, None) => Ok(node.field(name, "a whole number")?.whole(u64::from(u32::MAX))? as usize),
    }
}
