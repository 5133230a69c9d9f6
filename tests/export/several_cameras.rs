//! Files that hold several cameras, and what a camera has that a film has not.

use std::path::Path;

use cinesplat::export::{Content, Format, ImportSettings, ReadSettings, read, read_with};
use glam::DVec3;

use super::sample_shot::{file, there_and_back, with_cut};

const GLTF: &[u8] = br#"{"asset": {"version": "2.0"},
    "cameras": [{"type": "perspective", "name": "wide", "perspective": {"yfov": 1.2, "znear": 0.1}},
        {"type": "perspective", "name": "long", "perspective": {"yfov": 0.4, "znear": 0.1}}],
    "nodes": [{"name": "A", "camera": 0, "translation": [1, 0, 0]}, {"name": "B", "camera": 1, "translation": [2, 0, 0]}]}"#;

const USD: &[u8] = br#"#usda 1.0
( upAxis = "Y" )
def Xform "Rig" {
    def Camera "A" { double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"] }
}
def Camera "B" { double3 xformOp:translate = (2, 0, 0)
    float horizontalAperture = 9
    float verticalAperture = 16
    float focalLength = 20
    float horizontalApertureOffset = 0.9
    token projection = "orthographic"
    uniform token[] xformOpOrder = ["xformOp:translate"] }
"#;

fn of(path: &Path, camera: &str) -> DVec3 {
    let settings = ReadSettings { camera: Some(camera.to_owned()), ..ReadSettings::default() };
    read_with(path, &settings).unwrap().track.frames[0].pose.position
}

/// The first camera was read without a word, and `--camera` was ignored.
#[test]
fn the_camera_of_a_scene_with_several_is_named_and_chosen() {
    for (name, content, listed, others) in [
        ("a.gltf", GLTF, "the file holds 2 cameras: A is read, of A, B", ["B", "long"]),
        ("a.usda", USD, "the file holds 2 cameras: /Rig/A is read, of /Rig/A, /B", ["B", "/B"]),
    ] {
        let (path, _folder) = file(name, content);
        let first = read(&path, None).unwrap().track;
        assert_eq!((first.frames[0].pose.position.x, first.unread), (1.0, vec![listed.to_owned()]), "{name}");
        for other in others {
            assert_eq!(of(&path, other).x, 2.0, "{name}: {other}");
            let by_path = read(Path::new(&format!("{}#{other}", path.display())), None).unwrap().track;
            assert_eq!(by_path.frames[0].pose.position.x, 2.0, "{name}#{other}");
        }
        let settings = ReadSettings { camera: Some("C".to_owned()), ..ReadSettings::default() };
        let error = read_with(&path, &settings).unwrap_err().to_string();
        assert!(error.contains("expected one of the cameras"), "{name}: {error}");
    }
}

#[test]
fn the_name_of_a_camera_is_refused_where_files_hold_one_path() {
    let (path, _folder) = file("a.tum", b"0 1 2 3 0 0 0 1\n");
    let settings = ReadSettings { camera: Some("B".to_owned()), ..ReadSettings::default() };
    let error = read_with(&path, &settings).unwrap_err().to_string();
    assert_eq!(error, "found B, the name of a camera, for tum, expected a name for gltf, usd, recammaster or ros");
}

/// A portrait camera of Blender came back with 1280 x 720.
#[test]
fn the_film_of_a_usd_camera_states_the_shape_of_the_image_and_its_losses_are_named() {
    let (path, _folder) = file("a.usda", USD);
    let settings = ReadSettings { camera: Some("B".to_owned()), ..ReadSettings::default() };
    let imported = read_with(&path, &settings).unwrap();
    let (shot, lines) = imported.into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((shot.width, shot.height), (405, 720));
    for line in [
        "the shift of the lens, up to 10.00 % of the film, is not read",
        "the camera is orthographic: its path is read, with a perspective lens",
    ] {
        assert!(lines.iter().any(|found| found == line), "{line}: {lines:?}");
    }
    let (own, _, _folder) = there_and_back(&with_cut(), Format::Usd, "a.usda", Content::Sampled);
    assert_eq!(own.into_shot(&ImportSettings::default()).unwrap().1, Vec::<String>::new());
}
