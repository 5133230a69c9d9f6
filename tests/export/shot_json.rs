use cinesplat::export::ExportError;
use cinesplat::export::shot_json::{self, write};
use cinesplat::geometry::{LevelAngles, LevelFrame, Pose, rotation};
use cinesplat::trajectory::{ClearanceFailure, ClearanceProof, Move, Shot, ShotAngle, ShotSize};
use glam::{DQuat, DVec3};
use serde_json::Value;

fn read(text: &str) -> Result<Shot, ExportError> {
    shot_json::read(text).map(|file| file.shot)
}

/// The example of the format's description, with numbers.
const EXAMPLE: &str = r#"{ "format":"cinesplat.shot", "version":1,
  "scene":{"path":"room.spz","sha256":"ab","up":[0,1,0]}, "prompt":"close-up of the cup", "seed":7, "model":{"name":"m","sha256":"cd"},
  "width":1280, "height":720, "fps":30, "duration_secs":8.0, "added_later": {"x": [1, 2]},
  "keyframes":[{ "time_secs":0.0, "position":[1,2,3], "rotation_xyzw":[1,0,0,0],
                 "euler_deg":{"yaw":0,"pitch":0,"roll":0},
                 "fov_y_deg":50.0, "focus_distance":null, "easing":"smooth", "cut":false,
                 "intent":{"subjects":[3],"size":"close-up","move":"orbit-right","angle":"eye-level","words":[0,8],"pivot":[0,1,2]} },
               { "time_secs":2.5, "position":[1,2,4], "rotation_xyzw":[0.707,0,0,0.707], "fov_y_deg":40 }],
  "effects":[{"kind":"depth-of-field", "f_stop":2.8, "because":"asked for"}],
  "report":[{"clause":"close-up of <obj-3>","wanted":"height 1.0-1.6 of frame","got":1.21,"met":true,"note":""}] }"#;

#[test]
fn reads_every_documented_key() {
    let shot = read(EXAMPLE).unwrap();
    let intent = shot.keyframes[0].intent.clone().unwrap();
    assert_eq!((shot.width, shot.height, shot.fps, shot.duration_secs, shot.seed), (1280, 720, 30.0, 8.0, 7));
    assert_eq!(shot.scene.up, Some(DVec3::Y));
    assert_eq!(shot.keyframes[0].pose.rotation, DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0));
    assert_eq!((intent.subjects, intent.words, intent.pivot), (vec![3], Some([0, 8]), Some(DVec3::new(0.0, 1.0, 2.0))));
    assert_eq!(intent.movement, Some(Move::OrbitRight));
    assert_eq!((intent.size, intent.angle), (Some(ShotSize::CloseUp), Some(ShotAngle::EyeLevel)));
    assert_eq!(shot.effects[0].settings, vec![("f_stop".to_owned(), 2.8)]);
    assert!(shot.report[0].met);
}

#[test]
fn a_quaternion_typed_by_hand_becomes_a_unit_one() {
    let shot = read(EXAMPLE).unwrap();
    assert!((shot.keyframes[1].pose.rotation.length() - 1.0).abs() < 1e-15);
}

#[test]
fn a_written_shot_reads_back_the_same() {
    let shot = read(EXAMPLE).unwrap();
    assert_same(&shot, &read(&write(&shot)).unwrap());
    assert_eq!(write(&shot), write(&read(&write(&shot)).unwrap()));
}

/// Checks that two shots are equal, except for the last bit of angles, which are stored in degrees.
fn assert_same(a: &Shot, b: &Shot) {
    let without_fov = |shot: &Shot| {
        let mut shot = shot.clone();
        shot.keyframes.iter_mut().for_each(|key| key.fov_y_rad = 1.0);
        shot
    };
    assert_eq!(without_fov(a), without_fov(b));
    for (a, b) in a.keyframes.iter().zip(&b.keyframes) {
        assert!((a.fov_y_rad - b.fov_y_rad).abs() < 1e-15);
    }
}

#[test]
fn euler_angles_start_at_yaw_0_and_turn_right_positive() {
    let mut shot = read(EXAMPLE).unwrap();
    let level = LevelFrame::new(DVec3::Y).unwrap();
    let facing = |azimuth: f64| Pose::facing(DVec3::ZERO, level.direction(azimuth), DVec3::Y, None);
    shot.keyframes[0].pose = facing(2.0);
    shot.keyframes[1].pose = facing(2.5);
    let text = write(&shot);
    assert!(text.contains(r#""euler_deg": {"yaw": 0.0, "pitch": 0.0, "roll": 0.0}"#), "{text}");
    assert!(text.contains(r#""euler_deg": {"yaw": 28.6479, "pitch": 0.0, "roll": 0.0}"#), "{text}");
}

#[test]
fn a_first_key_that_looks_straight_down_has_yaw_0() {
    let mut shot = read(EXAMPLE).unwrap();
    let hint = Some(DVec3::new(0.3, 0.0, 0.8));
    shot.keyframes[0].pose = Pose::facing(DVec3::ZERO, DVec3::NEG_Y, DVec3::Y, hint);
    assert!(write(&shot).contains(r#""euler_deg": {"yaw": 0.0, "pitch": -90.0, "roll": 0.0}"#));
}

#[test]
fn refuses_with_the_place_and_the_reason() {
    let refused = |from: &str, to: &str| read(&EXAMPLE.replacen(from, to, 1)).unwrap_err().to_string();
    insta::assert_snapshot!(refused("cinesplat.shot", "other"), @r#"found format "other", expected "cinesplat.shot""#);
    insta::assert_snapshot!(refused("\"version\":1", "\"version\":2"), @"cinesplat.shot version 2, expected 1");
    insta::assert_snapshot!(refused("\"version\":1,", ""), @"version: found nothing, expected 1");
    insta::assert_snapshot!(refused("[1,2,4]", "[1,2]"), @"keyframes[1].position: found [1,2], expected 3 finite numbers");
    insta::assert_snapshot!(refused("[1,2,4]", "\"here\""), @r#"keyframes[1].position: found "here", expected 3 finite numbers"#);
    insta::assert_snapshot!(refused("\"fov_y_deg\":40", "\"fov_y_deg\":400"), @"keyframe 1: fov_y_deg is 400, expected 0.1..175");
    insta::assert_snapshot!(refused("\"time_secs\":2.5", "\"time_secs\":0"), @"keyframe 1 is at 0 s, expected later than 0 s");
    insta::assert_snapshot!(refused("[0.707,0,0,0.707]", "[0,0,0,0]"), @"keyframe 1: rotation_xyzw is [0, 0, 0, 0], expected a unit quaternion");
    insta::assert_snapshot!(refused("\"orbit-right\"", "\"fly\""), @r#"keyframes[0].intent.move: found "fly", expected one of static, pan-left, pan-right, tilt-up, tilt-down, roll-cw, roll-ccw, push-in, pull-out, truck-left, truck-right, pedestal-up, pedestal-down, crane-up, crane-down, orbit-left, orbit-right, arc-left, arc-right, zoom-in, zoom-out, dolly-zoom-in, dolly-zoom-out, follow, fly-through, reveal, whip-pan, rack-focus, handheld"#);
    insta::assert_snapshot!(refused("\"words\":[0,8]", "\"words\":[8,0]"), @"keyframes[0].intent.words: found [8,0], expected [first, end] byte offsets into the prompt");
    insta::assert_snapshot!(refused("\"seed\":7", "\"seed\":-7"), @"seed: found -7, expected a whole number 0..18446744073709551615");
}

#[test]
fn hostile_text_is_refused_cleanly() {
    let refused = |text: &str| read(text).unwrap_err().code();
    assert_eq!(refused(&EXAMPLE.replace("[1,2,4]", "[1,1e400,4]")), "EXCHANGE-JSON");
    assert_eq!(refused(&"[".repeat(100_000)), "EXCHANGE-JSON");
    assert_eq!(refused(&EXAMPLE[..EXAMPLE.len() / 2]), "EXCHANGE-JSON");
    assert_eq!(refused(&EXAMPLE.replace("[1,2,4]", "[1,NaN,4]")), "EXCHANGE-JSON");
    assert_eq!(refused("[]"), "EXCHANGE-FIELD");
    assert_eq!(refused(""), "EXCHANGE-JSON");
}

#[test]
fn a_proof_is_kept_until_a_key_is_edited() {
    let mut shot = read(EXAMPLE).unwrap();
    shot.clearance = Some(ClearanceProof {
        camera_radius: 0.08,
        opacity_floor: 0.5,
        sigma_level: 1.5,
        min_distance: 0.125,
        at_secs: 1.25,
        gaussian_idx: Some(4711),
        num_intervals: 93,
        failure: Some(ClearanceFailure { from_secs: 1.0, to_secs: 1.5, distance: 0.01, gaussian_idx: 4711 }),
    });
    let text = write(&shot);
    assert_eq!(read(&text).unwrap().clearance, shot.clearance);
    assert!(text.contains("\"proved\": false"));
    // A person who moves a key leaves the stale proof in the file.
    let moved = text.replacen("\"time_secs\": 2.5", "\"time_secs\": 2.25", 1);
    assert_ne!(moved, text);
    assert_eq!(read(&moved).unwrap().clearance, None);
}

/// A shot whose keys look in many directions, two of them straight down and up, with its first key rolled.
fn turning() -> Shot {
    let mut shot = read(EXAMPLE).unwrap();
    let level = LevelFrame::new(DVec3::Y).unwrap();
    let degrees = [[40.0, 20.0, 5.0], [90.0, 0.0, 0.0], [-170.0, -89.9, 3.0], [10.0, -90.0, 0.0], [200.0, 90.0, 60.0]];
    let template = shot.keyframes[0].clone();
    let key = |(idx, [yaw, pitch, roll]): (usize, [f64; 3])| {
        let angles =
            LevelAngles { yaw_rad: yaw.to_radians(), pitch_rad: pitch.to_radians(), roll_rad: roll.to_radians() };
        let mut key = template.clone();
        key.time_secs = idx as f64;
        key.pose.rotation = level.rotation(angles);
        key
    };
    shot.keyframes = degrees.into_iter().enumerate().map(key).collect();
    shot
}

/// The shot after an edit of its file, and the notes of the reader.
fn edited(edit: impl Fn(&mut Value)) -> (Shot, String) {
    let mut file: Value = serde_json::from_str(&write(&turning())).unwrap();
    edit(&mut file);
    let read = shot_json::read(&file.to_string()).unwrap();
    (read.shot, read.notes.join("\n"))
}

/// Angle in degrees by which every key's rotation differs between two shots; 0 for the same bits.
fn turned_deg(a: &Shot, b: &Shot) -> Vec<f64> {
    let pairs = a.keyframes.iter().zip(&b.keyframes);
    let turned = |a: DQuat, b: DQuat| if a == b { 0.0 } else { rotation::angle_between(a, b).to_degrees() };
    pairs.map(|(a, b)| turned(a.pose.rotation, b.pose.rotation)).collect()
}

#[test]
fn euler_angles_that_nobody_edited_leave_every_bit_of_the_rotations() {
    let (shot, notes) = edited(|_| ());
    assert_eq!((shot.keyframes, notes.as_str()), (turning().keyframes, ""));
}

#[test]
fn edited_euler_angles_decide_over_the_quaternion() {
    for (angle, axis) in [("yaw", DVec3::NEG_Y), ("pitch", DVec3::X), ("roll", DVec3::Z)] {
        let (shot, notes) = edited(|file| {
            let field = &mut file["keyframes"][1]["euler_deg"][angle];
            *field = (field.as_f64().unwrap() + 10.0).into();
        });
        let before = turning().keyframes[1].pose.rotation;
        // A level key: yaw turns about the world's up, pitch and roll about the camera's own axes.
        let turn = DQuat::from_axis_angle(axis, 10.0_f64.to_radians());
        let expected = if angle == "yaw" { turn * before } else { before * turn };
        let off_deg = rotation::angle_between(shot.keyframes[1].pose.rotation, expected).to_degrees();
        assert!(off_deg < 1e-3, "{angle}: {off_deg}");
        assert_eq!(notes, "keyframes[1].euler_deg: 10.00 degrees from rotation_xyzw, so it was edited and decides");
        assert!(turned_deg(&shot, &turning()).iter().enumerate().all(|(idx, turned)| idx == 1 || *turned == 0.0));
    }
}

#[test]
fn an_edited_yaw_of_the_first_key_turns_that_key_alone() {
    let (shot, notes) = edited(|file| file["keyframes"][0]["euler_deg"]["yaw"] = 10.into());
    let turned = turned_deg(&shot, &turning());
    assert!((turned[0] - 10.0).abs() < 1e-3 && turned[1..].iter().all(|turned| *turned == 0.0), "{turned:?}");
    assert!(notes.starts_with("keyframes[0].euler_deg: 10.00 degrees from rotation_xyzw"), "{notes}");
}

#[test]
fn removing_the_first_key_turns_no_other_key() {
    let (shot, notes) = edited(|file| drop(file["keyframes"].as_array_mut().unwrap().remove(0)));
    assert!(shot.keyframes.iter().zip(&turning().keyframes[1..]).all(|(a, b)| a.pose == b.pose));
    insta::assert_snapshot!(notes, @"keyframes: euler_deg.yaw counts from a heading 50.00 degrees to the left of the first keyframe's, as after removing or replacing the first keyframe");
}

#[test]
fn a_new_quaternion_of_the_first_key_turns_no_other_key() {
    let (shot, notes) = edited(|file| {
        let first = file["keyframes"][0].as_object_mut().unwrap();
        first["rotation_xyzw"] = serde_json::json!([1, 0, 0, 0]);
        first.remove("euler_deg");
    });
    assert_eq!(shot.keyframes[0].pose.rotation, DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0));
    assert!(turned_deg(&shot, &turning())[1..].iter().all(|turned| *turned == 0.0));
    assert!(notes.starts_with("keyframes: euler_deg.yaw counts from a heading"), "{notes}");
    // With the old angles beside it, these decide for the first key too.
    let (shot, notes) = edited(|file| file["keyframes"][0]["rotation_xyzw"] = serde_json::json!([1, 0, 0, 0]));
    assert!(turned_deg(&shot, &turning()).iter().all(|turned| *turned < 1e-3), "{notes}");
    assert!(notes.contains("keyframes[0].euler_deg: "), "{notes}");
}

#[test]
fn euler_angles_without_an_up_are_ignored_with_a_note() {
    let (shot, notes) = edited(|file| file["scene"]["up"] = Value::Null);
    assert_eq!(turned_deg(&shot, &turning()), [0.0; 5]);
    insta::assert_snapshot!(notes, @"keyframes[0].euler_deg: ignored, because the file has no scene.up");
}

#[test]
fn a_misspelled_key_is_named_with_the_nearest_known_one() {
    let (_, notes) = edited(|file| {
        file["promt"] = "a".into();
        for key in file["keyframes"].as_array_mut().unwrap() {
            key["fov_y_degs"] = 40.into();
            key["intent"]["pivots"] = 1.into();
        }
        file["keyframes"][3]["euler_deg"]["jaw"] = 3.into();
        file["scene"]["sha265"] = 1.into();
        file["report"][0]["gott"] = 1.into();
        file["effects"][0]["aperture_blades"] = 7.into();
    });
    insta::assert_snapshot!(notes, @r"
    promt: unknown key, the nearest known key is prompt
    keyframes[0].fov_y_degs: unknown key (here and in 4 other places), the nearest known key is fov_y_deg
    keyframes[3].euler_deg.jaw: unknown key, the nearest known key is yaw
    keyframes[0].intent.pivots: unknown key (here and in 4 other places), the nearest known key is pivot
    report[0].gott: unknown key, the nearest known key is got
    scene.sha265: unknown key, the nearest known key is sha256
    ");
}

/// A number in quotes used to be left out without a word.
#[test]
fn a_setting_of_an_effect_that_is_no_number_is_refused() {
    let error = read(&EXAMPLE.replace("\"f_stop\":2.8", "\"f_stop\":\"2.8\"")).unwrap_err();
    insta::assert_snapshot!(error, @r#"effects[0].f_stop: found "2.8", expected a finite number"#);
    assert!(read(&EXAMPLE.replace("\"f_stop\":2.8", "\"f_stop\":null")).unwrap().effects[0].settings.is_empty());
}

#[test]
fn a_word_among_the_settings_of_an_effect_is_noted_and_left_out() {
    let file = shot_json::read(&EXAMPLE.replace("\"f_stop\":2.8", "\"f_stop\":2.8, \"author\":\"A. Meyer\"")).unwrap();
    assert_eq!(file.shot.effects[0].settings, vec![("f_stop".to_owned(), 2.8)]);
    assert!(file.notes.contains(&"effects[0].author: no number, and so no setting: it is not read".to_owned()));
}

#[test]
fn a_misspelled_required_key_is_named_in_the_error() {
    let error = read(&EXAMPLE.replace("\"fov_y_deg\":40", "\"fov_y_degs\":40")).unwrap_err();
    insta::assert_snapshot!(error, @"keyframes[1].fov_y_deg: found nothing but the key fov_y_degs, expected degrees");
}

/// A key of [`turning`] with a point to look at and an edited position.
fn looking(position: DVec3, look_at: [f64; 3]) -> (Shot, String) {
    edited(|shot| {
        let key = &mut shot["keyframes"][1];
        key["position"] = position.to_array().to_vec().into();
        key["look_at"] = look_at.to_vec().into();
    })
}

#[test]
fn a_key_with_a_point_to_look_at_is_aimed_again_when_it_is_moved() {
    let target = DVec3::new(1.0, 0.5, 7.0);
    let (shot, notes) = looking(DVec3::new(3.0, -2.0, 1.0), target.to_array());
    let key = &shot.keyframes[1];
    let toward = (target - key.pose.position).normalize();
    assert!(key.pose.forward().cross(toward).length() < 1e-9 && key.pose.forward().dot(toward) > 0.0);
    assert!(notes.contains("keyframes[1].look_at: the camera is turned by"), "{notes}");
    // Its roll stays, and the point stays in the file: read back, nothing is left to turn.
    let level = cinesplat::geometry::LevelFrame::new(shot.scene.up.unwrap()).unwrap();
    assert!((level.roll_rad(&key.pose) - level.roll_rad(&turning().keyframes[1].pose)).abs() < 1e-9);
    let again = shot_json::read(&shot_json::write(&shot)).unwrap();
    assert_eq!((again.notes.len(), &again.shot.keyframes[1].intent), (0, &key.intent));
    let error = {
        let text = shot_json::write(&turning());
        let mut value: Value = serde_json::from_str(&text).unwrap();
        value["keyframes"][0]["look_at"] = 3.into();
        shot_json::read(&value.to_string()).unwrap_err().to_string()
    };
    assert_eq!(
        error,
        "keyframes[0].look_at: found 3, expected a point (3 finite numbers) or the name of an object (\"<obj-3>\")"
    );
}

/// A `shot.json` whose second key looks at something, read with one object: 3, the mug.
fn looking_at(look_at: &Value, find: &shot_json::FindObject<'_>) -> Result<shot_json::ShotFile, ExportError> {
    let mut value: Value = serde_json::from_str(&shot_json::write(&turning())).unwrap();
    value["keyframes"][1]["look_at"] = look_at.clone();
    shot_json::read_in(&value.to_string(), find)
}

#[test]
fn a_key_that_looks_at_an_object_is_aimed_at_its_center() {
    let center = DVec3::new(1.0, 0.5, 7.0);
    let find = |name: &str| if name == "mug" { Ok(center) } else { Err("one of the objects <obj-3> mug".to_owned()) };
    let read = looking_at(&"mug".into(), &find).unwrap();
    let key = &read.shot.keyframes[1];
    assert!(key.pose.forward().dot((center - key.pose.position).normalize()) > 1.0 - 1e-12);
    // The point stays beside the name: the file is read without its objects from then on.
    let written = shot_json::write(&read.shot);
    assert!(shot_json::names_objects(&written.replace("\"point\"", "\"old\"")) && !shot_json::names_objects(&written));
    let again = shot_json::read(&written).unwrap();
    assert_eq!((again.notes.len(), &again.shot.keyframes[1].intent), (0, &key.intent));
}

#[test]
fn a_changed_name_is_not_filmed_at_the_point_of_the_old_one() {
    let (mug, sofa) = (DVec3::new(1.0, 0.5, 7.0), DVec3::new(-2.0, 0.5, 7.0));
    let find = |name: &str| match name {
        "mug" => Ok(mug),
        "sofa" => Ok(sofa),
        _ => Err("one of the objects mug, sofa".to_owned()),
    };
    let written = shot_json::write(&looking_at(&"mug".into(), &find).unwrap().shot);
    let edited = |name: &str| {
        let mut value: Value = serde_json::from_str(&written).unwrap();
        value["keyframes"][1]["look_at"]["object"] = name.into();
        value.to_string()
    };
    assert!(shot_json::names_objects(&edited("sofa")) && !shot_json::names_objects(&edited("mug")));
    let key = &shot_json::read_in(&edited("sofa"), &find).unwrap().shot.keyframes[1];
    assert!(key.pose.forward().dot((sofa - key.pose.position).normalize()) > 1.0 - 1e-12);
    let error = shot_json::read_in(&edited("lamp"), &find).unwrap_err().to_string();
    assert_eq!(error, "keyframes[1].look_at.object: found \"lamp\", expected one of the objects mug, sofa");
}

#[test]
fn an_object_that_is_not_there_is_an_error_that_names_those_that_are() {
    let find = |_: &str| Err("one of the objects <obj-3> mug".to_owned());
    let error = looking_at(&"lamp".into(), &find).unwrap_err().to_string();
    assert_eq!(error, "keyframes[1].look_at: found \"lamp\", expected one of the objects <obj-3> mug");
    let error = shot_json::read(&{
        let mut value: Value = serde_json::from_str(&shot_json::write(&turning())).unwrap();
        value["keyframes"][1]["look_at"] = serde_json::json!({"object": "lamp"});
        value.to_string()
    });
    assert_eq!(
        error.unwrap_err().to_string(),
        "keyframes[1].look_at.object: found \"lamp\", expected a point (3 finite numbers), because no objects are given (`render` and `map` know them)"
    );
    let misspelled = serde_json::json!({"object": "lamp", "pont": [0, 0, 9], "point": [0, 0, 9], "point_of": "lamp"});
    let notes = looking_at(&misspelled, &find).unwrap().notes.join("\n");
    assert!(notes.contains("keyframes[1].look_at.pont: unknown key, the nearest known key is point"), "{notes}");
}
