//! The `lens` of a keyframe of a `shot.json`: `model` and the values of [`LensModel`] under their names.

use super::ExportError;
use super::json_read::Node;
use super::json_write::Json;
use cinesplat_trajectory::{LensModel, LensProjection};

/// Keys of a lens.
pub(super) const KEYS: [&str; 12] =
    ["model", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "center_x", "center_y", "stretch"];

/// Reads a lens; what it does not state is that of a pinhole.
pub(super) fn read(node: &Node) -> Result<LensModel, ExportError> {
    let projection = node.optional("model").map_or(Ok(LensProjection::default()), |model| model.choice())?;
    let mut values = Vec::new();
    for name in &KEYS[1..] {
        values.extend(node.optional(name).map(|value| value.number()).transpose()?.map(|value| (*name, value)));
    }
    let stated = |name: &str| values.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
    Ok(LensModel { projection, ..LensModel::of_values(stated) })
}

/// A lens as JSON: its model, and what is not that of a pinhole.
pub(super) fn write(lens: &LensModel) -> Json {
    let mut fields = vec![("model".to_owned(), lens.projection.as_ref().into())];
    let values = lens.own_values().into_iter().filter(|(name, _)| KEYS.contains(name));
    fields.extend(values.map(|(name, value)| (name.to_owned(), value.into())));
    Json::Object(fields)
}
