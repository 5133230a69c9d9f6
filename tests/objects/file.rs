//! Oracles: bytes written by NumPy, and the expected error messages.

use cinesplat::files::Existing;
use std::path::Path;

use cinesplat::objects::{self, ObjectSet, ObjectsError};
use cinesplat::scene::{Gaussians, Scene};
use glam::{DQuat, DVec3, Vec3};
use tempfile::TempDir;

use super::{push, push_box, scene_of};

/// `numpy.save` of four values: the header with its padding, then the data.
fn numpy_bytes(descr: &str, data: &[u8]) -> Vec<u8> {
    numpy_bytes_of(4, descr, data)
}

fn numpy_bytes_of(count: usize, descr: &str, data: &[u8]) -> Vec<u8> {
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({count},), }}");
    header.extend(std::iter::repeat_n(' ', 117 - header.len()));
    header.push('\n');
    [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes(), data].concat()
}

/// Four Gaussians on the x axis at 0, 1, 2, 3.
fn four() -> Scene {
    let mut gaussians = Gaussians::default();
    for x in 0..4 {
        push(&mut gaussians, DVec3::new(f64::from(x), 0.0, 0.0), 0.1, Vec3::splat(0.5));
    }
    scene_of(gaussians)
}

fn read_text(text: &str, scene: &Scene) -> Result<objects::ObjectsFile, ObjectsError> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("objects.json");
    std::fs::write(&path, text).unwrap();
    objects::read(&path, scene)
}

/// The error message without the folder.
fn message(text: &str, scene: &Scene) -> String {
    let error = read_text(text, scene).unwrap_err();
    let said = error.to_string();
    let (file, found) = said.split_once(": ").unwrap();
    format!("{} {}: {found}", error.code(), Path::new(file).file_name().unwrap().to_string_lossy())
}

#[test]
fn an_id_and_a_box_are_enough() {
    let text =
        r#"{"objects":[{"id":3,"center":[1.5,0,0],"half_extents":[0.6,1,1],"instance":7,"color":"red"}],"mood":1}"#;
    let file = read_text(text, &four()).unwrap();
    assert_eq!(file.up, None);
    assert_eq!(file.set.labels, [0, 3, 3, 0], "solid Gaussians in the box are members");
    let object = &file.set.objects[0];
    assert_eq!((object.id, object.label.as_str(), object.num_gaussians), (3, "", 2));
    assert_eq!(object.rotation, DQuat::IDENTITY);
}

#[test]
fn a_rotated_box_contains_the_gaussians_inside_it() {
    // A quarter turn about y: the long x side now runs along z.
    let text = r#"{"objects":[{"id":1,"center":[1,0,0],"half_extents":[9,1,0.5],"rotation_xyzw":[0,0.70710678,0,0.70710678]}]}"#;
    assert_eq!(read_text(text, &four()).unwrap().set.labels, [0, 1, 0, 0]);
}

#[test]
fn the_smaller_of_two_boxes_owns_their_intersection() {
    let text = r#"{"objects":[{"id":1,"center":[1.5,0,0],"half_extents":[5,1,1]},{"id":2,"center":[1,0,0],"half_extents":[0.1,1,1]}]}"#;
    assert_eq!(read_text(text, &four()).unwrap().set.labels, [1, 2, 1, 1]);
}

#[test]
fn faint_gaussians_belong_to_no_box() {
    let mut scene = four();
    scene.gaussians.opacities[2] = 0.3;
    let text = r#"{"objects":[{"id":1,"center":[1.5,0,0],"half_extents":[5,1,1]}]}"#;
    assert_eq!(read_text(text, &scene).unwrap().set.labels, [1, 1, 0, 1]);
}

#[test]
fn labels_of_every_width_are_read_and_give_boxes() {
    let columns: [(&str, Vec<u8>); 3] = [
        ("|u1", vec![0, 1, 2, 2]),
        ("<u2", vec![0, 0, 1, 0, 2, 0, 2, 0]),
        ("<u4", vec![0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0]),
    ];
    for (descr, data) in columns {
        let folder = TempDir::new().unwrap();
        std::fs::write(folder.path().join("l.npy"), numpy_bytes(descr, &data)).unwrap();
        let path = folder.path().join("o.json");
        std::fs::write(&path, r#"{"version":1,"up":[0,2,0],"labels":"l.npy","objects":[{"id":2,"label":"pair"}]}"#)
            .unwrap();
        let file = objects::read(&path, &four()).unwrap();
        assert_eq!(file.up, Some(DVec3::Y));
        assert_eq!(file.set.labels, [0, 1, 2, 2], "{descr}");
        let object = &file.set.objects[0];
        assert_eq!((object.num_gaussians, object.center, object.half_extents.x), (2, DVec3::new(2.5, 0.0, 0.0), 0.5));
    }
}

#[test]
fn ids_of_the_scene_file_serve_as_labels() {
    let mut scene = four();
    scene.gaussians.ids = vec![5, 5, 0, 0];
    let file = read_text(r#"{"objects":[{"id":5}]}"#, &scene).unwrap();
    assert_eq!((file.set.labels.as_slice(), file.set.objects[0].center.x), ([5, 5, 0, 0].as_slice(), 0.5));
}

#[test]
fn labels_count_the_gaussians_that_were_dropped_on_reading() {
    let mut scene = four();
    for column in [&mut scene.gaussians.means, &mut scene.gaussians.scales, &mut scene.gaussians.sh_dc] {
        column.remove(1);
    }
    scene.gaussians.opacities.remove(1);
    scene.gaussians.rotations.remove(1);
    scene.dropped = vec![1];
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("l.npy");
    std::fs::write(&path, numpy_bytes("|u1", &[7, 9, 8, 6])).unwrap();
    assert_eq!(objects::read_labels(&path, &scene).unwrap(), [7, 8, 6]);
    let set = ObjectSet { objects: Vec::new(), labels: vec![7, 8, 6] };
    let json = folder.path().join("o.json");
    objects::write(&json, &set, &scene, Existing::Keep).unwrap();
    assert_eq!(
        std::fs::read(folder.path().join("o.labels.npy")).unwrap(),
        numpy_bytes("<u2", &[7, 0, 0, 0, 8, 0, 6, 0])
    );
}

#[test]
fn a_written_file_reads_back_equal() {
    let mut gaussians = Gaussians::default();
    push_box(&mut gaussians, DVec3::ZERO, DVec3::ONE, 0.5, Vec3::new(0.8, 0.1, 0.1));
    push_box(&mut gaussians, DVec3::new(5.0, 0.0, 0.0), DVec3::new(0.2, 1.0, 0.3), 0.1, Vec3::splat(0.9));
    let count = gaussians.len();
    let scene = scene_of(gaussians);
    let labels = (0..count).map(|i| 1 + u16::from(scene.gaussians.means[i].x > 3.0)).collect();
    let mut set = objects::from_labels(&scene, labels);
    set.objects[0].points = vec![DVec3::new(0.1, 1.0 / 3.0, -1e-9)];
    set.objects[0].shape_radius = 0.125;
    set.objects[0].mask_iou = 0.75;
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("set.objects.json");
    objects::write(&path, &set, &scene, Existing::Keep).unwrap();
    let again = objects::read(&path, &scene).unwrap();
    assert_eq!(again.up, Some(DVec3::Y));
    assert_eq!(again.set.labels, set.labels);
    for (read, written) in again.set.objects.iter().zip(&set.objects) {
        assert!(read.rotation.dot(written.rotation).abs() > 1.0 - 1e-15);
        let comparable = objects::Object { rotation: written.rotation, ..read.clone() };
        assert_eq!(&comparable, written);
    }
    assert!(folder.path().read_dir().unwrap().all(|entry| entry.unwrap().path().extension().unwrap() != "part"));
}

#[test]
fn an_object_is_one_line_and_its_cloud_is_beside_the_file() {
    let scene = four();
    let mut set = objects::from_labels(&scene, vec![1, 1, 2, 2]);
    set.objects[0].points = (0..40).map(|i| DVec3::new(f64::from(i) / 3.0, 0.1, -1.0)).collect();
    set.objects[1].parent = Some(1);
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("o.json");
    objects::write(&path, &set, &scene, Existing::Keep).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().filter(|line| line.contains("\"id\"")).count(), 2);
    assert!(text.lines().count() < 16, "{text}");
    let again = objects::read(&path, &scene).unwrap().set;
    assert_eq!(again.objects[0].points, set.objects[0].points);
    assert_eq!((again.objects[1].parent, again.objects[0].num_gaussians), (Some(1), 4), "parts belong to the whole");
    // The layout that the format's specification gives: 8 bytes of length, JSON, then little-endian numbers.
    let bytes = std::fs::read(folder.path().join("o.clouds.safetensors")).unwrap();
    let length = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
    let header: serde_json::Value = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
    assert_eq!(header["1.points"]["shape"], serde_json::json!([40, 3]));
    assert_eq!(
        f64::from_le_bytes(bytes[8 + length + 24..8 + length + 32].try_into().unwrap()).to_bits(),
        (1.0_f64 / 3.0).to_bits()
    );
}

#[test]
fn features_of_points_are_beside_them_and_must_fit_them() {
    let scene = four();
    let mut set = objects::from_labels(&scene, vec![1, 1, 2, 2]);
    let folder = TempDir::new().unwrap();
    let (path, clouds) = (folder.path().join("o.json"), folder.path().join("o.clouds.safetensors"));
    for object in &mut set.objects {
        object.points = vec![DVec3::X, DVec3::Y];
    }
    objects::write(&path, &set, &scene, Existing::Keep).unwrap();
    let without = std::fs::read(&clouds).unwrap();
    set.objects[1].features = objects::PointFeatures { num_channels: 3, values: vec![0.5, -1.0, 2.0, 0.25, 8.0, 1e-9] };
    objects::write(&path, &set, &scene, Existing::Replace).unwrap();
    assert_eq!(objects::read(&path, &scene).unwrap().set.objects, set.objects);
    let with = safetensors::SafeTensors::deserialize(&std::fs::read(&clouds).unwrap()).unwrap().names().len();
    assert_eq!(with, 3, "1.points, 2.points and 2.dino");
    objects::merge(&scene, &mut set, &[2, 1]).unwrap();
    assert_eq!(set.objects[0].features, objects::PointFeatures::default());
    // A byte of the name or of the shape makes it the features of another object, or of another number of points.
    let damaged = |from: &str, to: &str| {
        write_features(&path, &scene);
        let bytes = std::fs::read(&clouds).unwrap();
        let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
        std::fs::write(&clouds, [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()).unwrap();
        objects::read(&path, &scene).unwrap_err().to_string().replace(&folder.path().display().to_string(), "DIR")
    };
    let told = [damaged("2.dino", "7.dino"), damaged("[2,6]", "[6,2]")];
    insta::assert_snapshot!(told.join("\n"), @r"
    DIR/o.clouds.safetensors: clouds: found 7.dino without 7.points, expected tensors ID.points of N x 3 finite numbers (F32 or F64), and ID.dino of N rows (F32)
    DIR/o.clouds.safetensors: clouds: found 2.dino: F32 [6, 2], expected tensors ID.points of N x 3 finite numbers (F32 or F64), and ID.dino of N rows (F32)
    ");
    std::fs::write(&clouds, without).unwrap();
    let again = objects::read(&path, &scene).unwrap().set;
    assert!(again.objects.iter().all(|object| object.features == objects::PointFeatures::default()));
}

/// Writes two objects of two points, the second with six features per point.
fn write_features(path: &std::path::Path, scene: &Scene) {
    let mut set = objects::from_labels(scene, vec![1, 1, 2, 2]);
    for object in &mut set.objects {
        object.points = vec![DVec3::X, DVec3::Y];
    }
    set.objects[1].features = objects::PointFeatures { num_channels: 6, values: vec![0.5; 12] };
    objects::write(path, &set, scene, Existing::Replace).unwrap();
}

#[test]
fn the_gaussians_of_parts_belong_to_their_whole() {
    let text = r#"{"objects":[{"id":1,"center":[0,0,0],"half_extents":[1.5,1,1]},{"id":2,"parent":1,"center":[1,0,0],"half_extents":[0.2,1,1]}]}"#;
    let set = read_text(text, &four()).unwrap().set;
    assert_eq!((set.labels.as_slice(), set.labels_of(1).as_ref()), ([1, 2, 0, 0].as_slice(), [1, 1, 0, 0].as_slice()));
    assert_eq!((set.objects[0].num_gaussians, set.objects[1].num_gaussians), (2, 1));
    assert_eq!(set.parts_of(1), [2]);
}

#[test]
fn an_object_is_no_part_of_itself_or_of_nothing() {
    let object =
        |id: u32, parent: &str| format!(r#"{{"id":{id},"parent":{parent},"center":[0,0,0],"half_extents":[1,1,1]}}"#);
    let said = |entries: &[String]| message(&format!(r#"{{"objects":[{}]}}"#, entries.join(",")), &four());
    let said = [
        said(&[object(1, "1")]),
        said(&[object(1, "9")]),
        said(&[object(1, "2"), object(2, "1")]),
        said(&[object(1, "\"mug\"")]),
    ];
    insta::assert_snapshot!(said.join("\n"), @r#"
    OBJ-FIELD objects.json: object 1 (id 1): field `parent` is 1, expected the id of another object, which is no part of this one, at most 16 levels deep
    OBJ-FIELD objects.json: object 1 (id 1): field `parent` is 9, expected the id of another object, which is no part of this one, at most 16 levels deep
    OBJ-FIELD objects.json: object 1 (id 1): field `parent` is 1, expected the id of another object, which is no part of this one, at most 16 levels deep
    OBJ-FIELD objects.json: object 1 (id 1): field `parent` is "mug", expected null, or the id of another object
    "#);
}

#[test]
fn a_clouds_file_of_another_kind_is_refused() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("c.safetensors"), b"not tensors at all").unwrap();
    let path = folder.path().join("o.json");
    std::fs::write(&path, r#"{"clouds":"c.safetensors","objects":[{"id":1,"center":[0,0,0],"half_extents":[1,1,1]}]}"#)
        .unwrap();
    assert_eq!(objects::read(&path, &four()).unwrap_err().code(), "OBJ-CLOUDS");
}

#[test]
fn errors_name_file_entry_and_field() {
    let scene = four();
    let cases = [
        "{\"objects\":[",
        r#"{"format":"cinesplat.shot","objects":[]}"#,
        r#"{"version":2,"objects":[]}"#,
        r#"{"version":1}"#,
        r#"{"objects":[{"id":0,"center":[0,0,0],"half_extents":[1,1,1]}]}"#,
        r#"{"objects":[{"id":65536}]}"#,
        r#"{"objects":[{"id":4}]}"#,
        r#"{"objects":[{"id":4,"center":[0,0],"half_extents":[1,1,1]}]}"#,
        r#"{"objects":[{"id":4,"center":[0,0,0]}]}"#,
        r#"{"objects":[{"id":4,"center":[0,0,0],"half_extents":[1,-1,1]}]}"#,
        r#"{"objects":[{"id":4,"center":[0,0,0],"half_extents":[1,1,1],"rotation_xyzw":[0,0,0,0]}]}"#,
        r#"{"objects":[{"id":4,"center":[0,0,0],"half_extents":[1,1,1],"label":5}]}"#,
        r#"{"objects":[{"id":1,"center":[0,0,0],"half_extents":[1,1,1]},{"id":1,"center":[0,0,0],"half_extents":[1,1,1]}]}"#,
        r#"{"up":[0,0,0],"objects":[]}"#,
    ];
    let said: Vec<String> = cases.iter().map(|text| message(text, &scene)).collect();
    insta::assert_snapshot!(said.join("\n"), @r#"
    OBJ-JSON objects.json: not JSON: EOF while parsing a list at line 1 column 12, expected an objects file
    OBJ-VERSION objects.json: found format "cinesplat.shot", expected "cinesplat.objects"
    OBJ-VERSION objects.json: found version 2, expected 1
    OBJ-FIELD objects.json: file: field `objects` is missing, expected a list of objects
    OBJ-FIELD objects.json: object 1: field `id` is 0, expected a whole number 1..65535
    OBJ-FIELD objects.json: object 1: field `id` is 65536, expected a whole number 1..65535
    OBJ-FIELD objects.json: object 1 (id 4): field `center` is missing, expected a center and half extents, or Gaussians with this id in the labels
    OBJ-FIELD objects.json: object 1 (id 4): field `center` is [0,0], expected three finite numbers
    OBJ-FIELD objects.json: object 1 (id 4): field `half_extents` is missing, expected three numbers beside `center`
    OBJ-FIELD objects.json: object 1 (id 4): field `half_extents` is [1, -1, 1], expected three numbers of at least 0
    OBJ-FIELD objects.json: object 1 (id 4): field `rotation_xyzw` is [0.0, 0.0, 0.0, 0.0], expected four finite numbers x, y, z, w, not all 0
    OBJ-FIELD objects.json: object 1 (id 4): field `label` is 5, expected a text
    OBJ-DUPLICATE objects.json: object 1 and object 2 both have id 1, expected one object per id
    OBJ-FIELD objects.json: file: field `up` is [0, 0, 0], expected a direction with a length
    "#);
}

#[test]
fn errors_of_label_files_name_the_reason() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("l.npy");
    let said = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let error = objects::read_labels(&path, &four()).unwrap_err();
        assert_eq!(error.code(), "OBJ-LABELS");
        let said = error.to_string();
        said.split_once(": ").unwrap().1.split(", expected").next().unwrap().to_owned()
    };
    let said = [
        said(b"PK"),
        said(&numpy_bytes("<f4", &[0; 16])),
        said(&numpy_bytes("<u2", &[0; 6])),
        said(&numpy_bytes("<u4", &[0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0])),
        said(&numpy_bytes_of(3, "|u1", &[0; 3])),
        said(&numpy_bytes("<u2", &[0; 8])[..40]),
    ];
    insta::assert_snapshot!(said.join("\n"), @r"
    labels: found no .npy signature
    labels: found values of type `<f4`
    labels: found an array of shape [4], 2 bytes per value, with 6 bytes of data
    labels: found id 65536 at index 0
    labels: found 3 ids
    labels: found a cut-off .npy header
    ");
}

#[test]
fn a_missing_file_is_an_io_error() {
    let error = objects::read(Path::new("/nowhere/objects.json"), &four()).unwrap_err();
    assert_eq!(error.code(), "FILE-READ");
}

#[test]
fn a_misspelled_key_is_named_with_the_nearest_known_one() {
    let text = r#"{"version":1,"uo":[0,1,0],"scene":{"pth":"a"},"objects":[
        {"id":1,"center":[0,0,0],"half_extents":[1,1,1],"parent":null,"labell":"cup"},
        {"id":2,"center":[2,0,0],"half_extents":[1,1,1],"labell":"lamp"}]}"#;
    insta::assert_snapshot!(read_text(text, &four()).unwrap().notes.join("\n"), @r"
    uo: unknown key, the nearest known key is up
    objects[0].labell: unknown key (here and in 1 other place), the nearest known key is label
    scene.pth: unknown key, the nearest known key is path
    ");
}
