//! Hand-written programs for the public prompts, solved on their scenes. The films are measured on their sampled
//! cameras and the boxes of the objects file, with code independent of the solver. `cinesplat bench operator films`
//! covers all cases.

use std::collections::BTreeMap;

use cinesplat::language::program_from_notation;
use cinesplat::objects;
use cinesplat::operator::{Program, SolveLevel, SolveSettings, World, realize};
use cinesplat::scene::{LoadOptions, load};
use cinesplat::trajectory::CameraState;
use glam::{DQuat, DVec3};
use serde_json::Value;

use super::film;
use crate::support::shared;

fn programs() -> BTreeMap<String, Program> {
    let texts: BTreeMap<String, String> = serde_json::from_str(include_str!("intents.json")).unwrap();
    texts.into_iter().map(|(id, text)| (id.clone(), program_from_notation(&text).expect(&id))).collect()
}

/// A box of the objects file.
struct Boxed {
    center: DVec3,
    corners: Vec<DVec3>,
}

/// Films of several cases of one scene, and the boxes of its objects by id.
struct Films {
    frames: BTreeMap<&'static str, Vec<CameraState>>,
    boxes: BTreeMap<u64, Boxed>,
}

fn films(scene: &str, objects_file: &str, ids: &[&'static str]) -> Option<Films> {
    let (scene_path, objects_path) = (shared(scene)?, shared(objects_file)?);
    let scene = load(&scene_path, &LoadOptions::default()).unwrap();
    let read = objects::read(&objects_path, &scene).unwrap();
    let programs = programs();
    let shoot = |id: &&'static str| {
        let program = &programs[*id];
        let world = World::new(&scene.gaussians, read.up.unwrap(), &read.set, &program.object_ids()).unwrap();
        let settings = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
        (*id, film(&realize(&world, program, "", &[], &settings)))
    };
    let json: Value = serde_json::from_str(&std::fs::read_to_string(&objects_path).unwrap()).unwrap();
    let boxes = json["objects"].as_array().unwrap().iter().map(boxed).collect();
    Some(Films { frames: ids.iter().map(shoot).collect(), boxes })
}

fn boxed(object: &Value) -> (u64, Boxed) {
    let number = |value: &Value| value.as_f64().unwrap();
    let vector = |value: &Value| DVec3::new(number(&value[0]), number(&value[1]), number(&value[2]));
    let (center, half, turn) = (vector(&object["center"]), vector(&object["half_extents"]), &object["rotation_xyzw"]);
    let turn = DQuat::from_xyzw(number(&turn[0]), number(&turn[1]), number(&turn[2]), number(&turn[3]));
    let signs = (0..8).map(|i| DVec3::new(sign(i & 1), sign(i & 2), sign(i & 4)));
    (object["id"].as_u64().unwrap(), Boxed { center, corners: signs.map(|s| center + turn * (half * s)).collect() })
}

fn sign(bit: i32) -> f64 {
    if bit > 0 { 1.0 } else { -1.0 }
}

/// Position of a point in a 16:9 frame, from its middle, as shares of its width and height; right and up positive.
fn in_frame(state: &CameraState, point: DVec3) -> (f64, f64) {
    let away = point - state.pose.position;
    let (right, down) = (state.pose.rotation * DVec3::X, state.pose.rotation * DVec3::Y);
    let depth = away.dot(state.pose.rotation * DVec3::Z);
    assert!(depth > 0.0, "behind the camera");
    let half = depth * (state.fov_y_rad / 2.0).tan();
    (away.dot(right) / (2.0 * half * 16.0 / 9.0), -away.dot(down) / (2.0 * half))
}

fn off_center(state: &CameraState, point: DVec3) -> f64 {
    let (x, y) = in_frame(state, point);
    x.abs().max(y.abs())
}

#[test]
fn every_public_prompt_has_a_program() {
    let Some(path) = shared("data/prompts/public.jsonl") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    let programs = programs();
    for line in text.lines() {
        let case: Value = serde_json::from_str(line).unwrap();
        assert!(programs.contains_key(case["id"].as_str().unwrap()), "{}", case["id"]);
    }
}

#[test]
fn kitchen_films_carry_out_their_programs() {
    let ids = ["ps01", "ps03"];
    let Some(films) = films("data/kitchen/scene.spz", "data/prompts/kitchen.objects.json", &ids) else { return };
    let push = &films.frames["ps01"];
    let (first, last) = (&push[0], &push[push.len() - 1]);
    let rack = films.boxes[&2].center;
    assert!(last.pose.position.distance(rack) < 0.75 * first.pose.position.distance(rack));
    assert!(push.iter().all(|s| (s.fov_y_rad - first.fov_y_rad).abs() < 1e-9 && off_center(s, rack) < 0.2));
    // A pan turns from one to the other with the position fixed.
    let pan = &films.frames["ps03"];
    let (from, to) = (films.boxes[&2].center, films.boxes[&3].center);
    assert!(off_center(&pan[0], from) < 0.2 && off_center(&pan[pan.len() - 1], to) < 0.2);
    assert!(pan.iter().all(|s| s.pose.position.distance(pan[0].pose.position) < 1e-9));
    assert!(pan[0].pose.right().dot(to - pan[0].pose.position) > 0.0, "the end is to the right of the start");
}

#[test]
fn composite_films_carry_out_their_programs() {
    let place = ("data/composites/kitchen_plus_dev.spz", "data/prompts/kitchen_plus_dev.objects.json");
    let Some(films) = films(place.0, place.1, &["ps09", "ps10"]) else { return };
    // An arc of 90 degrees to the left is one radius and clockwise from above.
    let arc = &films.frames["ps09"];
    let pivot = films.boxes[&7].center;
    let level = |s: &CameraState| (s.pose.position - pivot).with_y(0.0);
    let radius = level(&arc[0]).length();
    assert!(arc.iter().all(|s| (level(s).length() / radius - 1.0).abs() < 1e-6));
    let swept: f64 = arc.windows(2).map(|p| (level(&p[0]).cross(level(&p[1])).y / (radius * radius)).asin()).sum();
    assert!((swept.to_degrees() + 90.0).abs() < 0.5, "swept {} degrees", swept.to_degrees());
    // A dolly zoom comes nearer while the subject keeps its size.
    let zoom = &films.frames["ps10"];
    let subject = &films.boxes[&9];
    let height = |s: &CameraState| {
        let rows: Vec<f64> = subject.corners.iter().map(|&c| in_frame(s, c).1).collect();
        rows.iter().copied().fold(f64::MIN, f64::max) - rows.iter().copied().fold(f64::MAX, f64::min)
    };
    let (first, last) = (&zoom[0], &zoom[zoom.len() - 1]);
    assert!(last.pose.position.distance(subject.center) < 0.8 * first.pose.position.distance(subject.center));
    // Its middle keeps its size; the near side of its box, which is nearer than anything of it, grows a little.
    let size = |s: &CameraState| 1.0 / (s.pose.position.distance(subject.center) * (s.fov_y_rad / 2.0).tan());
    assert!(zoom.iter().all(|s| (size(s) / size(first) - 1.0).abs() < 0.05));
    assert!(zoom.iter().all(|s| (height(s) / height(first) - 1.0).abs() < 0.2));
}

#[test]
fn a_medium_shot_shows_its_subject_at_medium_height() {
    let place = ("data/composites/livingroom_surfels.spz", "data/prompts/livingroom.objects.json");
    let Some(films) = films(place.0, place.1, &["ps12"]) else { return };
    let still = &films.frames["ps12"];
    let subject = &films.boxes[&1];
    let rows: Vec<f64> = subject.corners.iter().map(|&c| in_frame(&still[0], c).1).collect();
    let height = rows.iter().copied().fold(f64::MIN, f64::max) - rows.iter().copied().fold(f64::MAX, f64::min);
    assert!((0.6..=0.8).contains(&height), "{height} of the frame");
    let moved =
        |s: &CameraState| s.pose.position.distance(still[0].pose.position) + (s.fov_y_rad - still[0].fov_y_rad).abs();
    assert!(still.iter().all(|s| moved(s) < 1e-9 && s.pose.forward().dot(still[0].pose.forward()) > 1.0 - 1e-12));
}
