//! Writing `objects.json`, version 1, with its labels and clouds beside it.
//!
//! Enters: objects. Leaves: a text with one line per object, which people edit, and two arrays, which they do not.

use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, check_free, npy, relative_to};
use cinesplat_scene::Scene;
use serde_json::json;

use super::clouds_file;
use super::error::ObjectsError;
use super::file::{FORMAT, VERSION};
use super::object::{Object, ObjectSet};

/// Files beside an objects file, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sidecars<'a> {
    /// The label array.
    pub labels: Option<&'a str>,
    /// The clouds. Without them the points are in the text.
    pub clouds: Option<&'a str>,
}

/// The text of an objects file at `path`, which decides the relative path of the scene.
pub fn to_json(path: &Path, set: &ObjectSet, scene: &Scene, sidecars: Sidecars) -> String {
    let scene_entry = json!({ "path": relative_to(path, &scene.path), "sha256": scene.sha256 });
    let mut lines = vec![
        format!("\"format\": {}", json!(FORMAT)),
        format!("\"version\": {VERSION}"),
        format!("\"scene\": {scene_entry}"),
        format!("\"up\": {}", json!(scene.up.to_array())),
    ];
    let sidecar = |key: &str, name: Option<&str>| name.map(|name| format!("\"{key}\": {}", json!(name)));
    lines.extend(sidecar("labels", sidecars.labels));
    lines.extend(sidecar("clouds", sidecars.clouds));
    let entries: Vec<String> =
        set.objects.iter().map(|object| format!("    {}", entry(object, sidecars.clouds))).collect();
    lines.push(format!("\"objects\": [\n{}\n  ]", entries.join(",\n")));
    format!("{{\n  {}\n}}\n", lines.join(",\n  "))
}

/// Path of the label array that [`write()`] writes beside an objects file: `NAME.labels.npy`.
pub fn labels_path(path: &Path) -> PathBuf {
    path.with_extension("labels.npy")
}

/// Path of the clouds that [`write()`] writes beside an objects file: `NAME.clouds.safetensors`.
pub fn clouds_path(path: &Path) -> PathBuf {
    path.with_extension("clouds.safetensors")
}

/// Writes an objects file, its labels to [`labels_path`] where it has any, and its clouds to [`clouds_path`]. Writes none
/// of them where one exists and `existing` forbids replacing it.
///
/// # Errors
/// [`ObjectsError::File`] where a file exists already or cannot be written.
pub fn write(path: &Path, set: &ObjectSet, scene: &Scene, existing: Existing) -> Result<(), ObjectsError> {
    let labels = (!set.labels.is_empty()).then(|| labels_path(path));
    let has_clouds = set.objects.iter().any(|object| !object.points.is_empty());
    let clouds = has_clouds.then(|| clouds_path(path));
    let paths = [Some(path), labels.as_deref(), clouds.as_deref()];
    paths.into_iter().flatten().try_for_each(|path| check_free(path, existing))?;
    if let Some(labels) = &labels {
        let ids = in_file_order(&set.labels, scene);
        cinesplat_files::write(labels, &npy::encode_u16(&[ids.len()], &ids), existing)?;
    }
    if let Some(clouds) = &clouds {
        cinesplat_files::write(clouds, &clouds_file::encode(&set.objects)?, existing)?;
    }
    let name = |path: &Option<PathBuf>| Some(path.as_ref()?.file_name()?.to_string_lossy().into_owned());
    let (labels, clouds) = (name(&labels), name(&clouds));
    let sidecars = Sidecars { labels: labels.as_deref(), clouds: clouds.as_deref() };
    Ok(cinesplat_files::write(path, to_json(path, set, scene, sidecars).as_bytes(), existing)?)
}

/// An object as one line, the name first.
fn entry(object: &Object, clouds: Option<&str>) -> String {
    let mut fields = vec![
        ("id", json!(object.id)),
        ("label", json!(object.label)),
        ("parent", json!(object.parent)),
        ("center", json!(object.center.to_array())),
        ("half_extents", json!(object.half_extents.to_array())),
        ("rotation_xyzw", json!(object.rotation.to_array())),
        ("num_gaussians", json!(object.num_gaussians)),
    ];
    if !object.points.is_empty() {
        fields.push(("shape_radius", json!(object.shape_radius)));
        fields.push(("mask_iou", json!(object.mask_iou)));
    }
    if clouds.is_none() && !object.points.is_empty() {
        fields.push(("points", object.points.iter().map(|point| json!(point.to_array())).collect()));
    }
    let fields: Vec<String> = fields.into_iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
    format!("{{{}}}", fields.join(", "))
}

/// The ids, with a 0 for every Gaussian of the file that the scene's reader dropped.
fn in_file_order(labels: &[u16], scene: &Scene) -> Vec<u16> {
    let mut kept = labels.iter().copied();
    let id = |file_idx: usize| {
        let is_dropped = scene.dropped.binary_search(&(file_idx as u32)).is_ok();
        if is_dropped { 0 } else { kept.next().unwrap_or(0) }
    };
    (0..scene.num_in_file()).map(id).collect()
}
