use cinesplat::export::{Content, ExportSettings, Format, read, write};
use cinesplat::files::Existing;
use cinesplat::geometry::Pose;
use glam::{DMat4, DVec3};
use serde_json::Value;

use super::sample_shot::{file, key, shot, there_and_back, with_cut};

fn exported(settings: ExportSettings) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    write(&path, Format::Nerfstudio, &with_cut(), &settings, Existing::Keep).unwrap();
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn a_projection_that_is_not_perspective_is_named() {
    let mut path = exported(ExportSettings::default());
    path["camera_type"] = "equirectangular".into();
    let (path, _folder) = file("a.json", path.to_string().as_bytes());
    let unread = read(&path, None).unwrap().track.unread;
    assert_eq!(unread, ["the projection equirectangular is read as perspective"]);
}

#[test]
fn holds_every_key_that_ns_render_and_the_viewer_read() {
    let path = exported(ExportSettings::default());
    for name in
        ["camera_type", "render_width", "render_height", "fps", "seconds", "default_fov", "default_transition_sec"]
    {
        assert!(!path[name].is_null(), "{name}");
    }
    assert_eq!(path["camera_type"], "perspective");
    assert_eq!((path["camera_path"].as_array().unwrap().len(), path["keyframes"].as_array().unwrap().len()), (72, 72));
    // The frame rate of ns-render is the number of frames over the seconds.
    assert_eq!(path["seconds"].as_f64().unwrap(), 3.0);
    let key = &path["keyframes"][24];
    assert!((key["override_transition_sec"].as_f64().unwrap() - 1.0 / 24.0).abs() < 1e-12);
    assert!((key["fov"].as_f64().unwrap() - 40.0).abs() < 1e-12);
    assert!((key["aspect"].as_f64().unwrap() - 16.0 / 9.0).abs() < 1e-12);
}

#[test]
fn no_key_has_the_default_lens_which_would_switch_its_own_off() {
    let path = exported(ExportSettings::default());
    let default = path["default_fov"].as_f64().unwrap();
    let keys = path["keyframes"].as_array().unwrap();
    assert!(keys.iter().all(|key| (key["fov"].as_f64().unwrap() - default).abs() > 1e-3), "{default}");
}

#[test]
fn the_rate_can_be_chosen() {
    let path = exported(ExportSettings { fps: Some(10.0), ..ExportSettings::default() });
    assert_eq!((path["camera_path"].as_array().unwrap().len(), path["fps"].as_f64().unwrap()), (30, 10.0));
}

#[test]
fn cameras_look_along_minus_z_with_y_up() {
    // At (1, 2, 3), looking along world +x with world +y up.
    let looking = Pose::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::new(9.0, 2.0, 3.0), DVec3::Y, None).unwrap();
    let shot = shot(vec![key(0.0, looking.position, looking.rotation, 50.0)], DVec3::Y);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    write(
        &path,
        Format::Nerfstudio,
        &shot,
        &ExportSettings { content: Content::Keyframes, ..ExportSettings::default() },
        Existing::Keep,
    )
    .unwrap();
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let rows: Vec<f64> =
        file["camera_path"][0]["camera_to_world"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let matrix = DMat4::from_cols_array(&rows.try_into().unwrap()).transpose();
    let direction = |v: DVec3| matrix.transform_vector3(v);
    assert!((direction(DVec3::NEG_Z) - DVec3::X).length() < 1e-12, "forward");
    assert!((direction(DVec3::Y) - DVec3::Y).length() < 1e-12, "up");
    assert_eq!(matrix.w_axis.truncate(), DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn reads_files_of_other_writers() {
    // nerfview omits camera_type and crop; the Blender add-on writes key matrices as strings in column-major order.
    let text = br#"{"render_width": 640.0, "render_height": 360, "fps": 30, "seconds": 0.5, "camera_path": [
        {"camera_to_world": [1,0,0,4, 0,-1,0,5, 0,0,-1,6, 0,0,0,1], "fov": 60.0, "aspect": 1.7}],
      "keyframes": [{"matrix": "[1.0,0,0,0, 0,-1,0,0, 0,0,-1,0, 4,5,7,1]", "fov": 60.0, "properties": "[]"}]}"#;
    let (path, _folder) = file("a.json", text);
    let track = read(&path, None).unwrap().track;
    assert_eq!((track.size_px, track.fps), (Some((640, 360)), Some(2.0)));
    assert_eq!(track.frames[0].pose, Pose { position: DVec3::new(4.0, 5.0, 6.0), ..Pose::IDENTITY });
    assert_eq!(track.keys[0].pose, Pose { position: DVec3::new(4.0, 5.0, 7.0), ..Pose::IDENTITY });
    assert_eq!(track.frames[0].fov_y_rad, Some(60_f64.to_radians()));
}

/// The keys of a shot are uneven in time, and `ns-render` rendered them as the only frames, at even times.
#[test]
fn keyframes_stand_beside_a_path_of_every_frame() {
    let path = exported(ExportSettings { content: Content::Keyframes, ..ExportSettings::default() });
    let list = |name: &str| path[name].as_array().unwrap().clone();
    assert_eq!((list("camera_path").len(), list("keyframes").len()), (72, with_cut().keyframes.len()));
    assert_eq!(path["seconds"].as_f64().unwrap(), 3.0);
    let whole = exported(ExportSettings::default());
    assert_eq!(path["camera_path"], whole["camera_path"]);
    let steps: f64 = list("keyframes").iter().map(|key| key["override_transition_sec"].as_f64().unwrap()).sum();
    assert!((steps - with_cut().keyframes[3].time_secs).abs() < 1e-12, "{steps}");
    let (imported, lines, _folder) = there_and_back(&with_cut(), Format::Nerfstudio, "a.json", Content::Keyframes);
    assert_eq!((imported.track.frames.len(), imported.track.keys.len()), (72, 4));
    let is_said = |line: &String| line.starts_with("nerfstudio's viewer joins keyframes with its own spline: up to ");
    assert!(lines.iter().any(is_said), "{lines:?}");
}

/// The line said 16.14 degrees for another spline. The numbers are those of nerfstudio 1.1.5 itself: the largest
/// differences between the film and what its viewer makes of the file (`tests/exchange/in_nerfstudio.py viewer`).
#[test]
fn the_viewers_curve_is_said_to_stray_as_it_does() {
    let mut joined = with_cut();
    joined.keyframes[2].cut = false;
    let (_, lines, _folder) = there_and_back(&joined, Format::Nerfstudio, "a.json", Content::Keyframes);
    let strays = "up to 0.5412 scene units (at 0.58 s), 18.27 degrees and a field of view 2.03 degrees off the film";
    assert!(lines.iter().any(|line| line.contains(strays)), "{lines:?}");
    joined.keyframes.drain(2..);
    let (_, lines, _folder) = there_and_back(&joined, Format::Nerfstudio, "a.json", Content::Keyframes);
    let strays = "0.67 degrees and a field of view 0.53 degrees off the film";
    assert!(lines.iter().any(|line| line.contains(strays)), "{lines:?}");
}

#[test]
fn a_transition_switch_that_is_no_flag_is_an_error() {
    let (_, _, folder) = there_and_back(&with_cut(), Format::Nerfstudio, "a.json", Content::Keyframes);
    let path = folder.path().join("a.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let edited = text.replacen("\"override_transition_enabled\": true", "\"override_transition_enabled\": \"yes\"", 1);
    assert_ne!(edited, text);
    std::fs::write(&path, edited).unwrap();
    insta::assert_snapshot!(read(&path, None).unwrap_err(), @r#"keyframes[0].override_transition_enabled: found "yes", expected true or false"#);
}
