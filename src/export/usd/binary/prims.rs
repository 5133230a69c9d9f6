//! The cameras and render settings of a layer, with the prims above them.

use std::collections::BTreeMap;

use super::super::curves::{SAMPLES, SPLINE};
use super::super::layer::{MAX_DEPTH, Prim, Value};
use super::damage::damaged;
use super::tables::{Spec, Tables};
use super::values::value;
use crate::ExportError;

/// Types of the prims that are kept.
const KEPT: [&str; 2] = ["Camera", "RenderSettings"];
/// Attributes that are kept, besides operations of transforms.
const ATTRIBUTES: [&str; 9] = [
    "xformOpOrder",
    "focalLength",
    "horizontalAperture",
    "verticalAperture",
    "horizontalApertureOffset",
    "verticalApertureOffset",
    "focusDistance",
    "projection",
    "resolution",
];
const OPERATION: &str = "xformOp:";

/// The layer: its metadata, and the prims that are kept below it.
pub(super) fn layer(tables: &Tables<'_>) -> Result<Prim, ExportError> {
    let is_root = |spec: &&Option<Spec>| spec.is_some_and(|spec| spec.kind == Spec::LAYER);
    let no_layer = || damaged(0, "no layer", "one among the specs");
    let root = tables.specs.iter().position(|spec| is_root(&spec)).ok_or_else(no_layer)?;
    let below = kept(tables)?;
    prim(tables, root as u32, &below, 0)
}

/// The paths of the prims and attributes that are kept, by the path above them.
fn kept(tables: &Tables<'_>) -> Result<BTreeMap<u32, Vec<u32>>, ExportError> {
    let mut is_kept = vec![false; tables.paths.len()];
    for (idx, spec) in tables.specs.iter().enumerate() {
        let Some(spec) = spec.filter(|spec| spec.kind == Spec::PRIM) else { continue };
        let Some(kind) = tables.field(spec, "typeName")? else { continue };
        if !matches!(value(tables, kind)?, Some(Value::Text(name)) if KEPT.contains(&name.as_str())) {
            continue;
        }
        // With the prims above it, up to one that is kept.
        let mut at = Some(idx as u32);
        while let Some(idx) = at.filter(|idx| !is_kept[*idx as usize]) {
            is_kept[idx as usize] = true;
            at = tables.paths[idx as usize].and_then(|path| path.parent);
        }
    }
    let mut below = BTreeMap::<u32, Vec<u32>>::new();
    for (idx, path) in tables.paths.iter().enumerate() {
        let Some((path, parent)) = path.and_then(|path| Some((path, path.parent?))) else { continue };
        if is_kept[idx] || path.is_property && is_kept[parent as usize] {
            below.entry(parent).or_default().push(idx as u32);
        }
    }
    Ok(below)
}

fn prim(tables: &Tables<'_>, idx: u32, below: &BTreeMap<u32, Vec<u32>>, depth: usize) -> Result<Prim, ExportError> {
    if depth > MAX_DEPTH {
        return Err(damaged(0, "a prim in a prim", "less nesting"));
    }
    let mut prim = Prim::default();
    let fields = tables.specs[idx as usize].map_or(Ok(Vec::new()), |spec| tables.fields(spec))?;
    for (name, bits) in fields {
        if let Some(value) = value(tables, bits)? {
            prim.metadata.push((name.to_owned(), value));
        }
    }
    if let Some(Value::Text(kind)) = prim.meta("typeName").cloned() {
        prim.kind = kind;
    }
    let mut children = Vec::new();
    for &path in below.get(&idx).into_iter().flatten() {
        let (Some(entry), Some(spec)) = (tables.paths[path as usize], tables.specs[path as usize]) else { continue };
        let name = tables.token(entry.name)?;
        match spec.kind {
            Spec::ATTRIBUTE if name.starts_with(OPERATION) || ATTRIBUTES.contains(&name) => {
                add_attribute(tables, name, spec, &mut prim)?;
            }
            Spec::PRIM => children.push((name, path)),
            _ => {}
        }
    }
    sort_as_named(&mut children, prim.meta("primChildren"));
    let child = |(name, path): (&str, u32)| {
        Ok::<_, ExportError>(Prim { name: name.to_owned(), ..self::prim(tables, path, below, depth + 1)? })
    };
    prim.children = children.into_iter().map(child).collect::<Result<_, _>>()?;
    Ok(prim)
}

fn add_attribute(tables: &Tables<'_>, name: &str, spec: Spec, prim: &mut Prim) -> Result<(), ExportError> {
    for (field, bits) in tables.fields(spec)? {
        let name = match field {
            "default" => name.to_owned(),
            // Only its name counts.
            "spline" => {
                prim.attributes.push((format!("{name}{SPLINE}"), Value::List(Vec::new())));
                continue;
            }
            "timeSamples" => format!("{name}{SAMPLES}"),
            _ => continue,
        };
        prim.attributes.extend(value(tables, bits)?.map(|value| (name, value)));
    }
    Ok(())
}

/// Sorts prims as the list of their names does.
fn sort_as_named(children: &mut [(&str, u32)], names: Option<&Value>) {
    let Some(Value::List(names)) = names else { return };
    let places: BTreeMap<&str, usize> = names
        .iter()
        .enumerate()
        .filter_map(|(place, name)| if let Value::Text(name) = name { Some((name.as_str(), place)) } else { None })
        .collect();
    children.sort_by_key(|(name, _)| places.get(name).copied().unwrap_or(usize::MAX));
}
