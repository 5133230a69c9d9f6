//! Reading `objects.json`, version 1, its label array and its clouds.
//!
//! Enters: a file, possibly from another tool, in which an object needs only an `id` and a box or labels. Leaves: an
//! [`ObjectSet`] in which every object has a box and, where the scene has them, Gaussians. An unknown key becomes a note.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DQuat, DVec3};
use serde_json::{Map, Value};

use super::boxes;
use super::clouds_file;
use super::error::ObjectsError;
use super::object::{Object, ObjectSet, PointFeatures};
use cinesplat_files::{Limits, UnknownKeys, beside, json_excess, npy};
use cinesplat_scene::Scene;

/// Value of the key `format`.
pub(crate) const FORMAT: &str = "cinesplat.objects";

/// The only supported version.
pub(crate) const VERSION: u64 = 1;

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
    let mut entries = entries(&top)?;
    check_ids(path, &entries)?;
    check_parents(path, &entries)?;
    add_clouds(&top, &mut entries)?;
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
    let mut entries = entries(&top)?;
    check_ids(path, &entries)?;
    check_parents(path, &entries)?;
    add_clouds(&top, &mut entries)?;
    Ok(entries.into_iter().map(|entry| entry.object).collect())
}

fn json_of(path: &Path) -> Result<Value, ObjectsError> {
    let bytes = cinesplat_files::read(path, Limits::DEFAULT.text_bytes)?;
    let bad = |reason: String| ObjectsError::NotJson { path: path.to_owned(), reason };
    // Of what is no JSON, such as a scene, the parser says so.
    let begins = bytes.iter().find(|byte| !byte.is_ascii_whitespace()).is_some_and(|byte| matches!(byte, b'{' | b'['));
    json_excess(&bytes, &Limits::DEFAULT).filter(|_| begins).map_or(Ok(()), |excess| Err(bad(excess)))?;
    serde_json::from_slice(&bytes).map_err(|error| bad(error.to_string()))
}

/// Reads a label array of a scene: one id per Gaussian in file order, 0 for no object. The ids of Gaussians that the
/// scene's reader dropped are dropped too.
///
/// # Errors
/// [`ObjectsError::File`] where the file cannot be read, [`ObjectsError::BadLabels`] for another type, shape or count.
pub fn read_labels(path: &Path, scene: &Scene) -> Result<Vec<u16>, ObjectsError> {
    let expected = format!("one u8, u16 or u32 id (at most 65535) for each of {} Gaussians", scene.num_in_file());
    let bad = |found: String| ObjectsError::BadLabels { path: path.to_owned(), found, expected: expected.clone() };
    let ids = decode_ids(&cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?).map_err(bad)?;
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

    fn parent(&self) -> Result<Option<u32>, ObjectsError> {
        let Some(value) = self.get("parent") else { return Ok(None) };
        let id = value.as_u64().and_then(|id| u16::try_from(id).ok()).filter(|id| *id > 0);
        let id = id.ok_or_else(|| self.bad("parent", value.to_string(), "null, or the id of another object"))?;
        Ok(Some(u32::from(id)))
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
        parent: entry.parent()?,
        points: entry.points()?,
        features: PointFeatures::default(),
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

/// Most wholes that an object lies in, one inside the other.
const MAX_LEVELS: usize = 16;

/// Every parent is another object of the file, and no object is a part of itself.
fn check_parents(path: &Path, objects_in_file: &[FileObject]) -> Result<(), ObjectsError> {
    let parents: BTreeMap<u32, Option<u32>> =
        objects_in_file.iter().map(|entry| (entry.object.id, entry.object.parent)).collect();
    for (i, entry) in objects_in_file.iter().enumerate() {
        let mut above = entry.object.parent;
        for level in 0.. {
            let Some(id) = above else { break };
            above = parents.get(&id).copied().flatten();
            if level < MAX_LEVELS && parents.contains_key(&id) && id != entry.object.id {
                continue;
            }
            return Err(ObjectsError::BadField {
                path: path.to_owned(),
                entry: format!("object {} (id {})", i + 1, entry.object.id),
                field: "parent",
                found: id.to_string(),
                expected: "the id of another object, which is no part of this one, at most 16 levels deep",
            });
        }
    }
    Ok(())
}

/// Adds the points of the clouds file, and their features, to the objects that state no points themselves.
fn add_clouds(top: &Entry, objects_in_file: &mut [FileObject]) -> Result<(), ObjectsError> {
    let Some(name) = top.text("clouds")? else { return Ok(()) };
    let mut clouds = clouds_file::read(&beside(top.path, name))?;
    for FileObject { object, .. } in objects_in_file.iter_mut().filter(|entry| entry.object.points.is_empty()) {
        (object.points, object.features) = clouds.remove(&object.id).unwrap_or_default();
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
    let mut has_box: Vec<bool> = Vec::with_capacity(objects_in_file.len());
    let mut set = ObjectSet { objects: Vec::with_capacity(objects_in_file.len()), labels };
    for entry in objects_in_file {
        has_box.push(entry.has_box);
        set.objects.push(entry.object);
    }
    let members = set.members();
    for (i, object) in set.objects.iter_mut().enumerate().filter(|(i, _)| !has_box[*i]) {
        let members = members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let Some(fitted) = boxes::fit(&scene.gaussians, members, up) else {
            let entry = Entry { name: format!("object {} (id {})", i + 1, object.id), ..*top };
            let expected = "a center and half extents, or Gaussians with this id in the labels";
            return Err(entry.bad("center", "missing", expected));
        };
        object.take_box(&fitted);
    }
    set.objects.sort_by_key(|object| object.id);
    if set.labels.is_empty() {
        set.labels = boxes::labels_from_boxes(&scene.gaussians, &set.objects);
    }
    let members = set.members();
    for object in &mut set.objects {
        object.num_gaussians = members.get(&object.id).map_or(0, Vec::len);
    }
    Ok(set)
}
