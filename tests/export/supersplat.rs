use std::io::Write as _;

use cinesplat::export::{Content, Format, read};
use cinesplat::geometry::Pose;
use glam::DVec3;
use serde_json::Value;

use super::sample_shot::{file, key, shot, there_and_back, with_cut};

/// Two level keys in a world with y down.
fn level_shot() -> cinesplat::trajectory::Shot {
    let at = |z: f64| Pose::look_at(DVec3::new(1.0, -2.0, z), DVec3::new(1.0, -1.0, 5.0), DVec3::NEG_Y, None).unwrap();
    let keys = [0.0, 1.0].map(|secs| key(secs, at(secs).position, at(secs).rotation, 40.0));
    shot(keys.to_vec(), DVec3::NEG_Y)
}

#[test]
fn the_world_is_turned_and_the_lens_measured_along_the_larger_side() {
    let (imported, warnings, folder) =
        there_and_back(&level_shot(), Format::Supersplat, "settings.json", Content::Keyframes);
    assert!(!warnings.iter().any(|line| line.contains("roll")), "{warnings:?}");
    let text = std::fs::read_to_string(folder.path().join("settings.json")).unwrap();
    let settings: Value = serde_json::from_str(&text).unwrap();
    let track = &settings["animTracks"][0];
    // A point (x, y, z) of a PLY is at (-x, -y, z) in the viewer; times count frames.
    assert_eq!(track["keyframes"]["values"]["position"].to_string(), "[-1.0,2.0,0.0,-1.0,2.0,1.0]");
    assert_eq!(track["keyframes"]["times"].to_string(), "[0.0,24.0]");
    // By hand: a vertical field of view of 40 degrees on 16:9 is 2 atan(tan(20) * 16 / 9) = 65.8104 degrees
    // horizontally.
    let fov = track["keyframes"]["values"]["fov"][0].as_f64().unwrap();
    assert!((fov - 65.8104).abs() < 1e-3, "{fov}");
    for (a, b) in level_shot().keyframes.iter().zip(&imported.track.frames) {
        assert!((a.pose.position - b.pose.position).length() < 1e-12);
        assert!((a.pose.forward() - b.pose.forward()).length() < 1e-12);
        assert!((a.fov_y_rad - b.fov_y_rad.unwrap()).abs() < 1e-12);
    }
}

#[test]
fn the_animation_ends_at_its_last_key_and_jumps_at_a_cut() {
    let mut cut = level_shot();
    let aside = key(1.5, DVec3::new(-4.0, -2.0, 1.0), cut.keyframes[1].pose.rotation, 40.0);
    cut.keyframes.push(cinesplat::trajectory::Keyframe { cut: true, ..aside });
    cut.duration_secs = 2.0;
    let (imported, warnings, folder) = there_and_back(&cut, Format::Supersplat, "settings.json", Content::Sampled);
    assert!(warnings.iter().all(|line| !line.contains("holds no cuts")), "{warnings:?}");
    let text = std::fs::read_to_string(folder.path().join("settings.json")).unwrap();
    let track = &serde_json::from_str::<Value>(&text).unwrap()["animTracks"][0];
    let times: Vec<f64> =
        track["keyframes"]["times"].as_array().unwrap().iter().map(|time| time.as_f64().unwrap()).collect();
    let end = track["duration"].as_f64().unwrap() * track["frameRate"].as_f64().unwrap();
    assert!((end - times[times.len() - 1]).abs() < 1e-9, "{end}");
    // Two keys on both sides of the cut at frame 36 within a hundredth of a frame.
    assert_eq!(times.iter().filter(|time| (*time - 36.0).abs() < 0.01).count(), 4);
    let cuts: Vec<usize> = (0..48).filter(|idx| imported.track.frames[*idx].cut).collect();
    assert_eq!((cuts, imported.track.frames.len()), (vec![36], 48));
}

/// The viewer's check of settings refused 31.000000000000004, which is 31 / 30 s at 30 frames per second.
#[test]
fn frames_have_whole_numbers() {
    let thirty = cinesplat::trajectory::Shot { fps: 30.0, duration_secs: 4.0, ..level_shot() };
    let (_, _, folder) = there_and_back(&thirty, Format::Supersplat, "settings.json", Content::Sampled);
    let text = std::fs::read_to_string(folder.path().join("settings.json")).unwrap();
    let times = &serde_json::from_str::<Value>(&text).unwrap()["animTracks"][0]["keyframes"]["times"];
    let expected: Vec<f64> = (0..120).map(f64::from).collect();
    assert_eq!(times, &Value::from(expected));
    // What it refuses else is said.
    let odd = cinesplat::trajectory::Shot { fps: 29.97, ..thirty };
    let (_, warnings, _folder) = there_and_back(&odd, Format::Supersplat, "settings.json", Content::Keyframes);
    let line = "supersplat's viewer plays 29.97 frames per second and keys between frames; its check for editors takes whole \
                frames alone";
    assert!(warnings.iter().any(|warning| warning == line), "{warnings:?}");
}

#[test]
fn the_lens_of_a_portrait_film_comes_back_with_its_size() {
    let portrait = cinesplat::trajectory::Shot { width: 720, height: 1280, ..level_shot() };
    let (imported, _, _folder) = there_and_back(&portrait, Format::Supersplat, "settings.json", Content::Keyframes);
    let settings = cinesplat::export::ImportSettings { size_px: Some((720, 1280)), ..Default::default() };
    let (shot, lines) = imported.into_shot(&settings).unwrap();
    assert!((shot.keyframes[0].fov_y_rad.to_degrees() - 40.0).abs() < 1e-9, "{:?}", shot.keyframes[0].fov_y_rad);
    assert!(lines.iter().any(|line| line.contains("of an image of 720 x 1280")), "{lines:?}");
}

#[test]
fn has_every_field_that_the_viewer_asserts() {
    let (_, _, folder) = there_and_back(&level_shot(), Format::Supersplat, "settings.json", Content::Sampled);
    let settings: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("settings.json")).unwrap()).unwrap();
    assert_eq!(settings["version"], 2);
    let effects = &settings["postEffectSettings"];
    let fields = [
        ("sharpness", vec!["amount"]),
        ("bloom", vec!["intensity", "blurLevel"]),
        ("grading", vec!["brightness", "contrast", "saturation"]),
        ("vignette", vec!["intensity", "inner", "outer", "curvature"]),
        ("fringing", vec!["intensity"]),
    ];
    for (effect, numbers) in fields {
        assert!(effects[effect]["enabled"] == false && numbers.iter().all(|name| effects[effect][*name].is_number()));
    }
    assert_eq!(effects["grading"]["tint"].as_array().unwrap().len(), 3);
    assert!(settings["highPrecisionRendering"].is_boolean() && settings["annotations"].is_array());
    assert_eq!(settings["cameras"][0]["initial"]["target"].as_array().unwrap().len(), 3);
}

#[test]
fn roll_is_lost_with_a_warning_that_says_how_much() {
    let mut rolled = level_shot();
    let turn = glam::DQuat::from_rotation_z(10_f64.to_radians());
    rolled.keyframes[1].pose.rotation *= turn;
    let (_, warnings, _folder) = there_and_back(&rolled, Format::Supersplat, "settings.json", Content::Keyframes);
    assert!(warnings.iter().any(|line| line.contains("no roll: up to 10.0 degrees")), "{warnings:?}");
}

/// The line said 16.14 degrees: the viewer's spline joins targets, not rotations. The numbers are those of its own code:
/// the largest differences between the film and supersplat-viewer 1.36.2 (`tests/exchange/in_supersplat.mjs`).
#[test]
fn the_viewers_spline_of_targets_is_said_to_stray_as_it_does() {
    let mut joined = with_cut();
    joined.keyframes[2].cut = false;
    let (_, lines, _folder) = there_and_back(&joined, Format::Supersplat, "settings.json", Content::Keyframes);
    let strays = "up to 0.4259 scene units (at 0.67 s), 46.49 degrees and a field of view 2.02 degrees off the film";
    assert!(lines.iter().any(|line| line.contains(strays)), "{lines:?}");
}

#[test]
fn reads_the_poses_inside_a_project() {
    let document = br#"{"version": 0, "camera": {"fov": 70}, "timeline": {"frames": 90, "frameRate": 30},
      "poseSets": [{"name": "set0", "poses": [
        {"name": "b", "frame": 60, "position": [0, 1, 3], "target": [0, 1, 0]},
        {"name": "a", "frame": 0, "position": [0, 1, 2], "target": [0, 1, 0], "fov": 60}]}]}"#;
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive.start_file("document.json", zip::write::SimpleFileOptions::default()).unwrap();
    archive.write_all(document).unwrap();
    let (path, _folder) = file("a.ssproj", &archive.finish().unwrap().into_inner());
    let imported = read(&path, None).unwrap();
    let frames = &imported.track.frames;
    assert_eq!((imported.format, frames.len(), frames[1].time_secs), (Format::Supersplat, 2, 2.0));
    assert_eq!(frames[0].pose.position, DVec3::new(0.0, -1.0, 2.0));
    assert!((frames[0].pose.forward() - DVec3::NEG_Z).length() < 1e-12);
    assert!((frames[0].pose.up() - DVec3::NEG_Y).length() < 1e-12);
}
