//! Reading and writing `objects.json`, version 1, and its label array.
//!
//! Enters: a file, possibly from another tool, in which an object needs only an `id` and a box or labels. Leaves: an
//! [`ObjectSet`] in which every object has a box and, where the scene has them, Gaussians. An unknown key becomes a note.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::{DQuat, DVec3};
use serde_json::{Map, Value, json};

use super::boxes;
use super::error::ObjectsError;
use super::object::{Object, ObjectSet};
use cinesplat_files::{
    Existing, FileError, MAX_ARRAY_BYTES, MAX_TEXT_BYTES, UnknownKeys, beside, check_free, npy, relative_to,
};
use cinesplat_scene::Scene;

/// Value of the key `format`.
const FORMAT: &str = "cinesplat.objects";

/// The only supported version.
const VERSION: u64 = 1;

/// The contents of an objects file.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectsFile {
    /// The objects, every one with a box.
    pub set: ObjectSet,
    /// World up, unit, where the file states it. It takes precedence over the scene's own up.
    pub up: Option<DVec3>,
    /// One line per key that the reader does not know.
    pub notes: Vec<String>,
}

/// Keys of the top level.
const TOP_KEYS: [&str; 7] = ["format", "version", "scene", "up", "objects", "labels", "clouds"];
/// Keys of `scene`.
const SCENE_KEYS: [&str; 2] = ["path", "sha256"];
/// Keys of an object.
const OBJECT_KEYS: [&str; 10] = [
    "id",
    "label",
    "center",
    "half_extents",
    "rotation_xyzw",
    "num_gaussians",
    "parent",
    "points",
    "shape_radius",
    "mask_iou",
];

/// Reads an objects file for a scene.
///
/// The membership of Gaussians comes from the file's labels, or else from the ids in the scene file, or else from the
/// boxes: a solid Gaussian then belongs to the smallest box that contains its mean. An object without a box gets the
/// box of its Gaussians.
///
/// # Errors
/// [`ObjectsError::File`] where a file cannot be read, [`ObjectsError::NotJson`], [`ObjectsError::WrongKind`] for
/// another format or version, [`ObjectsError::BadField`], [`ObjectsError::DuplicateId`], and
/// [`ObjectsError::BadLabels`]. Each names the file, the entry and the field.
pub fn read(path: &Path, scene: &Scene) -> Result<ObjectsFile, ObjectsError> {
    let root = json_of(path)?;
    let top = Entry { path, name: "file".to_owned(), fields: object_of(path, "file", &root)? };
    check_kind(&top)?;
    let up = top.vector("up")?.map(|up| top.unit("up", up)).transpose()?;
    let entries = entries(&top)?;
    check_ids(path, &entries)?;
    let labels = match top.text("labels")? {
        Some(name) => read_labels(&beside(path, name), scene)?,
        None => scene.gaussians.ids.clone(),
    };
    let set = complete(&top, entries, labels, (scene, up.unwrap_or(scene.up)))?;
    Ok(ObjectsFile { set, up, notes: unknown_keys(&root) })
}

/// Reads the objects of a file without its scene: ids, labels, and the boxes and points that the file states.
///
/// # Errors
/// As [`read()`], without those of labels.
pub fn read_boxes(path: &Path) -> Result<Vec<Object>, ObjectsError> {
    let root = json_of(path)?;
    let top = Entry { path, name: "file".to_owned(), fields: object_of(path, "file", &root)? };
    check_kind(&top)?;
    let entries = entries(&top)?;
    check_ids(path, &entries)?;
    Ok(entries.into_iter().map(|entry| entry.object).collect())
}

fn json_of(path: &Path) -> Result<Value, ObjectsError> {
    let bytes = cinesplat_files::read(path, MAX_TEXT_BYTES)?;
    serde_json::from_slice(&bytes)
        .map_err(|error| ObjectsError::NotJson { path: path.to_owned(), reason: error.to_string() })
}

/// Reads a label array of a scene: one id per Gaussian in file order, 0 for no object. The ids of Gaussians that the
/// scene's reader dropped are dropped too.
///
/// # Errors
/// [`ObjectsError::File`] where the file cannot be read, [`ObjectsError::BadLabels`] for another type, shape or count.
pub fn read_labels(path: &Path, scene: &Scene) -> Result<Vec<u16>, ObjectsError> {
    let expected = format!("one u8, u16 or u32 id (at most 65535) for each of {} Gaussians", scene.num_in_file());
    let bad = |found: String| ObjectsError::BadLabels { path: path.to_owned(), found, expected: expected.clone() };
    let ids = decode_ids(&cinesplat_files::read(path, MAX_ARRAY_BYTES)?).map_err(bad)?;
    scene.kept(&ids).ok_or_else(|| bad(format!("{} ids", ids.len())))
}

/// The ids of a vector: an array of one axis, or of two axes of which one has length 1.
fn decode_ids(bytes: &[u8]) -> Result<Vec<u16>, String> {
    let array = npy::Array::parse(bytes).map_err(|error| error.to_string())?;
    if !matches!(array.shape.as_slice(), [_] | [_, 1] | [1, _]) {
        return Err(format!("an array of shape {:?}", array.shape));
    }
    let values = array.to_u32().map_err(|error| error.to_string())?;
    let narrow = |(idx, value)| u16::try_from(value).map_err(|_| format!("id {value} at index {idx}"));
    values.into_iter().enumerate().map(narrow).collect()
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

/// The text of an objects file at `path`, which decides the relative path of the scene. `labels` is the file name of
/// the label array, where there is one.
pub fn to_json(path: &Path, set: &ObjectSet, scene: &Scene, labels: Option<&str>) -> String {
    let mut root = json!({
        "format": FORMAT,
        "version": VERSION,
        "scene": { "path": relative_to(path, &scene.path), "sha256": scene.sha256 },
        "up": scene.up.to_array(),
        "objects": set.objects.iter().map(entry_json).collect::<Vec<_>>(),
    });
    if let Some(labels) = labels {
        root["labels"] = json!(labels);
    }
    format!("{root:#}\n")
}

/// Path of the label array that [`write()`] writes beside an objects file: `NAME.labels.npy`.
pub fn labels_path(path: &Path) -> PathBuf {
    path.with_extension("labels.npy")
}

/// Writes an objects file, and its labels to [`labels_path`] where it has any. Writes neither where one of them exists
/// and `existing` forbids replacing it.
///
/// # Errors
/// [`FileError`] where a file exists already or cannot be written.
pub fn write(path: &Path, set: &ObjectSet, scene: &Scene, existing: Existing) -> Result<(), FileError> {
    let labels = (!set.labels.is_empty()).then(|| labels_path(path));
    std::iter::once(path).chain(labels.as_deref()).try_for_each(|path| check_free(path, existing))?;
    if let Some(labels) = &labels {
        let ids = in_file_order(&set.labels, scene);
        cinesplat_files::write(labels, &npy::encode_u16(&[ids.len()], &ids), existing)?;
    }
    let name = labels.as_ref().and_then(|labels| labels.file_name()).map(|name| name.to_string_lossy());
    cinesplat_files::write(path, to_json(path, set, scene, name.as_deref()).as_bytes(), existing)
}

fn entry_json(object: &Object) -> Value {
    json!({
        "id": object.id,
        "label": object.label,
        "center": object.center.to_array(),
        "half_extents": object.half_extents.to_array(),
        "rotation_xyzw": object.rotation.to_array(),
        "num_gaussians": object.num_gaussians,
        "points": object.points.iter().map(DVec3::to_array).collect::<Vec<_>>(),
        "shape_radius": object.shape_radius,
        "mask_iou": object.mask_iou,
    })
}

/// A JSON object of the file, and its place for error messages.
struct Entry<'a> {
    path: &'a Path,
    name: String,
    fields: &'a Map<String, Value>,
}

impl<'a> Entry<'a> {
    fn bad(&self, field: &'static str, found: impl Into<String>, expected: &'static str) -> ObjectsError {
        ObjectsError::BadField {
            path: self.path.to_owned(),
            entry: self.name.clone(),
            field,
            found: shortened(found.into()),
            expected,
        }
    }

    /// A field that is present and not null.
    fn get(&self, field: &str) -> Option<&'a Value> {
        self.fields.get(field).filter(|value| !value.is_null())
    }

    fn text(&self, field: &'static str) -> Result<Option<&'a str>, ObjectsError> {
        let text = |value: &'a Value| value.as_str().ok_or_else(|| self.bad(field, value.to_string(), "a text"));
        self.get(field).map(text).transpose()
    }

    fn numbers<const N: usize>(
        &self,
        field: &'static str,
        expected: &'static str,
    ) -> Result<Option<[f64; N]>, ObjectsError> {
        let Some(value) = self.get(field) else { return Ok(None) };
        let numbers = numbers_of(value).ok_or_else(|| self.bad(field, value.to_string(), expected))?;
        Ok(Some(numbers))
    }

    fn vector(&self, field: &'static str) -> Result<Option<DVec3>, ObjectsError> {
        Ok(self.numbers(field, "three finite numbers")?.map(DVec3::from_array))
    }

    fn unit(&self, field: &'static str, vector: DVec3) -> Result<DVec3, ObjectsError> {
        vector.try_normalize().ok_or_else(|| self.bad(field, format!("{vector}"), "a direction with a length"))
    }

    fn amount(&self, field: &'static str) -> Result<f64, ObjectsError> {
        let Some(value) = self.get(field) else { return Ok(0.0) };
        let number = value.as_f64().filter(|number| *number >= 0.0 && number.is_finite());
        number.ok_or_else(|| self.bad(field, value.to_string(), "a number of at least 0"))
    }

    fn id(&self) -> Result<u32, ObjectsError> {
        let found = self.get("id").map_or_else(|| "missing".to_owned(), Value::to_string);
        let id = self.get("id").and_then(Value::as_u64).and_then(|id| u16::try_from(id).ok()).filter(|id| *id > 0);
        id.map(u32::from).ok_or_else(|| self.bad("id", found, "a whole number 1..65535"))
    }

    fn rotation(&self) -> Result<DQuat, ObjectsError> {
        let expected = "four finite numbers x, y, z, w, not all 0";
        let Some(xyzw) = self.numbers("rotation_xyzw", expected)? else { return Ok(DQuat::IDENTITY) };
        let rotation = DQuat::from_array(xyzw);
        if rotation.length() > 1e-6 {
            return Ok(rotation.normalize());
        }
        Err(self.bad("rotation_xyzw", format!("{xyzw:?}"), expected))
    }

    /// Center and half extents: both, or neither.
    fn extent(&self) -> Result<Option<(DVec3, DVec3)>, ObjectsError> {
        match (self.vector("center")?, self.vector("half_extents")?) {
            (Some(_), Some(half)) if half.min_element() < 0.0 => {
                Err(self.bad("half_extents", format!("{half}"), "three numbers of at least 0"))
            }
            (Some(center), Some(half)) => Ok(Some((center, half))),
            (None, None) => Ok(None),
            (Some(_), None) => Err(self.bad("half_extents", "missing", "three numbers beside `center`")),
            (None, Some(_)) => Err(self.bad("center", "missing", "three numbers beside `half_extents`")),
        }
    }

    fn points(&self) -> Result<Vec<DVec3>, ObjectsError> {
        let expected = "a list of points of three finite numbers";
        let Some(value) = self.get("points") else { return Ok(Vec::new()) };
        let list = value.as_array().ok_or_else(|| self.bad("points", value.to_string(), expected))?;
        let point = |value: &Value| numbers_of(value).map(DVec3::from_array);
        list.iter().map(|p| point(p).ok_or_else(|| self.bad("points", p.to_string(), expected))).collect()
    }
}

/// An object of the file; its box may be missing.
struct FileObject {
    object: Object,
    has_box: bool,
}

fn numbers_of<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let list: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    <[f64; N]>::try_from(list?).ok().filter(|numbers| numbers.iter().all(|n| n.is_finite()))
}

/// Truncates long values, so that an error stays one line.
fn shortened(text: String) -> String {
    if text.chars().count() <= 60 { text } else { text.chars().take(57).chain("...".chars()).collect() }
}

fn object_of<'a>(path: &Path, entry: &str, value: &'a Value) -> Result<&'a Map<String, Value>, ObjectsError> {
    value.as_object().ok_or_else(|| ObjectsError::BadField {
        path: path.to_owned(),
        entry: entry.to_owned(),
        field: "{}",
        found: shortened(value.to_string()),
        expected: "an object in braces",
    })
}

/// One line per key that the reader does not know.
fn unknown_keys(root: &Value) -> Vec<String> {
    let mut unknown = UnknownKeys::default();
    let mut check = |place: &str, value: &Value, known: &[&str]| {
        let keys = value.as_object().into_iter().flat_map(|object| object.keys().map(String::as_str));
        unknown.check(place, keys, known);
    };
    check("", root, &TOP_KEYS);
    check("scene", &root["scene"], &SCENE_KEYS);
    for (idx, object) in root["objects"].as_array().into_iter().flatten().enumerate() {
        check(&format!("objects[{idx}]"), object, &OBJECT_KEYS);
    }
    unknown.into_notes()
}

fn check_kind(top: &Entry) -> Result<(), ObjectsError> {
    let wrong = |key, expected| {
        let found = top.get(key).map_or_else(|| "missing".to_owned(), |value| shortened(value.to_string()));
        Err(ObjectsError::WrongKind { path: top.path.to_owned(), key, found, expected })
    };
    if top.get("format").is_some_and(|format| format != FORMAT) {
        return wrong("format", "\"cinesplat.objects\"");
    }
    if top.get("version").is_some_and(|version| version.as_u64() != Some(VERSION)) {
        return wrong("version", "1");
    }
    Ok(())
}

fn entries(top: &Entry) -> Result<Vec<FileObject>, ObjectsError> {
    let found = top.get("objects").map_or_else(|| "missing".to_owned(), Value::to_string);
    let list = top.get("objects").and_then(Value::as_array);
    let list = list.ok_or_else(|| top.bad("objects", found, "a list of objects"))?;
    list.iter().enumerate().map(|(i, value)| file_object(top.path, i + 1, value)).collect()
}

fn file_object(path: &Path, position: usize, value: &Value) -> Result<FileObject, ObjectsError> {
    let name = format!("object {position}");
    let mut entry = Entry { path, fields: object_of(path, &name, value)?, name };
    let id = entry.id()?;
    entry.name = format!("object {position} (id {id})");
    let extent = entry.extent()?;
    let (center, half_extents) = extent.unwrap_or_default();
    let object = Object {
        id,
        label: entry.text("label")?.unwrap_or_default().to_owned(),
        center,
        half_extents,
        rotation: entry.rotation()?,
        num_gaussians: 0,
        points: entry.points()?,
        shape_radius: entry.amount("shape_radius")?,
        mask_iou: entry.amount("mask_iou")?,
    };
    Ok(FileObject { object, has_box: extent.is_some() })
}

fn check_ids(path: &Path, objects_in_file: &[FileObject]) -> Result<(), ObjectsError> {
    let mut seen = BTreeMap::new();
    for (second, entry) in objects_in_file.iter().enumerate() {
        let id = entry.object.id;
        if let Some(first) = seen.insert(id, second) {
            return Err(ObjectsError::DuplicateId { path: path.to_owned(), id, first: first + 1, second: second + 1 });
        }
    }
    Ok(())
}

/// The objects in order of id, each with its Gaussians and a box.
fn complete(
    top: &Entry,
    objects_in_file: Vec<FileObject>,
    labels: Vec<u16>,
    world: (&Scene, DVec3),
) -> Result<ObjectSet, ObjectsError> {
    let (scene, up) = world;
    let has_labels = !labels.is_empty();
    let mut objects = Vec::with_capacity(objects_in_file.len());
    for (i, FileObject { mut object, has_box }) in objects_in_file.into_iter().enumerate() {
        if !has_box {
            let members = boxes::members(&labels, object.id);
            let Some(fitted) = boxes::fit(&scene.gaussians, &members, up) else {
                let entry = Entry { name: format!("object {} (id {})", i + 1, object.id), ..*top };
                let expected = "a center and half extents, or Gaussians with this id in the labels";
                return Err(entry.bad("center", "missing", expected));
            };
            (object.center, object.half_extents, object.rotation) =
                (fitted.center, fitted.half_extents, fitted.rotation);
        }
        objects.push(object);
    }
    objects.sort_by_key(|object| object.id);
    let labels = if has_labels { labels } else { boxes::labels_from_boxes(&scene.gaussians, &objects) };
    let mut set = ObjectSet { objects, labels };
    boxes::count_members(&mut set);
    Ok(set)
}
