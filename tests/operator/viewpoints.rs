//! Where the camera stands, how high, and what it aims at where the words say nothing; the frame's aspect.

use std::path::Path;

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Program, Solution, SolveLevel, SolveSettings, Step, World, realize};
use cinesplat::pipeline::{OpenedScene, open_scene};
use cinesplat::scene::{Gaussians, LoadOptions};
use cinesplat::trajectory::{CameraState, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::composition::{CENTER, HALF, assert_met};
use super::{ROOM, film, room, solved, wall, world};

/// A generated room, prepared for shots of some objects.
pub fn generated(seed: u64, ids: &[u32]) -> (OpenedScene, World) {
    let opened = open_scene(Path::new(&format!("synth:room:{seed}:0.1")), &LoadOptions::default()).unwrap();
    let set = opened.objects.clone().unwrap();
    let world = World::new(&opened.scene.gaussians, opened.scene.up, &set, ids).unwrap();
    (opened, world)
}

fn solved_with_seed(world: &World, step: Step, seed: u64) -> Solution {
    let program = Program { steps: vec![step], ..Program::default() };
    realize(world, &program, "", &[], &SolveSettings { level: SolveLevel::Fast, seed, ..SolveSettings::default() })
}

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// The box around the floor, walls and furniture of a generated room, without the view through its windows: the walls
/// are those that its pictures, windows and doors hang on.
fn walls(objects: &ObjectSet) -> (DVec3, DVec3) {
    let corners = || objects.objects.iter().flat_map(Object::corners);
    (corners().reduce(DVec3::min).unwrap(), corners().reduce(DVec3::max).unwrap())
}

#[test]
fn a_shot_without_a_subject_stands_in_the_room_at_eye_height() {
    for seed in 1..=10 {
        let (opened, world) = generated(seed, &[]);
        assert!(world.is_indoor(), "room {seed}");
        let (low, high) = walls(&opened.objects.unwrap());
        for movement in [Move::Static, Move::PushIn, Move::PullOut] {
            let frames = film(&solved_with_seed(&world, Step::of(movement), seed));
            for state in [&frames[0], &frames[frames.len() - 1]] {
                let eye = state.pose.position;
                let inside = eye.cmpgt(low).all() && eye.cmplt(high.max(DVec3::new(0.0, 2.2, 0.0))).all();
                assert!(inside, "room {seed}, {movement}: {eye} is not within {low} .. {high}");
                assert!((1.0..2.1).contains(&eye.y), "room {seed}, {movement}: eye at {} m", eye.y);
                let free = world.clearance(eye + state.pose.forward() * 0.6);
                assert!(free > 0.2, "room {seed}, {movement}: {free} m free in front of the lens");
            }
        }
    }
}

#[test]
fn a_room_is_seen_along_its_depth() {
    // A corridor of 8 by 2 m: whoever stands in it and looks at something looks along it.
    let mut gaussians = Gaussians::default();
    let (length, width, height) = (8.0, 2.0, 2.4);
    for y in [0.0, height] {
        wall(&mut gaussians, DVec3::new(0.0, y, 0.0), DVec3::X * length, DVec3::Z * width);
    }
    for z in [0.0, width] {
        wall(&mut gaussians, DVec3::new(0.0, 0.0, z), DVec3::X * length, DVec3::Y * height);
    }
    for x in [0.0, length] {
        wall(&mut gaussians, DVec3::new(x, 0.0, 0.0), DVec3::Z * width, DVec3::Y * height);
    }
    let world = World::new(&gaussians, DVec3::Y, &ObjectSet::default(), &[]).unwrap();
    for seed in 0..5 {
        let state = film(&solved_with_seed(&world, Step::of(Move::Static), seed))[0];
        let (eye, forward) = (state.pose.position, state.pose.forward());
        assert!(forward.x.abs() > 0.9, "looks along {forward}");
        let ahead = if forward.x > 0.0 { length - eye.x } else { eye.x };
        assert!(ahead > 0.5 * length, "{ahead} m ahead of {eye}");
    }
}

/// Elevation of a camera above a point, degrees.
fn elevation_deg(state: &CameraState, point: DVec3) -> f64 {
    let away = state.pose.position - point;
    away.y.atan2(away.x.hypot(away.z)).to_degrees()
}

#[test]
fn things_below_the_eyes_are_looked_down_on() {
    for seed in [3, 7] {
        let (opened, _) = generated(seed, &[]);
        let objects = opened.objects.unwrap();
        let low = |object: &&Object| object.center.y + object.half_extents.y < 1.0;
        let ids: Vec<u32> = objects.objects.iter().filter(low).map(|object| object.id).step_by(3).collect();
        let world = World::new(&opened.scene.gaussians, opened.scene.up, &objects, &ids).unwrap();
        for &id in &ids {
            let object = objects.objects.iter().find(|object| object.id == id).unwrap();
            let step = Step { start: about(id), ..Step::of(Move::Static) };
            let state = film(&solved_with_seed(&world, step, seed))[0];
            let elevation = elevation_deg(&state, object.center);
            let flat = object.half_extents.y < 0.2 * object.half_extents.x.min(object.half_extents.z);
            let least = if flat { 25.0 } else { 5.0 };
            assert!((least..60.0).contains(&elevation), "{}: {elevation} degrees", object.label);
            let bottom = object.center.y - object.half_extents.y;
            assert!(state.pose.position.y > bottom, "{}: the underside shows", object.label);
        }
    }
}

/// A room with a table under which a camera would fit.
fn room_with_table() -> (World, DVec3, DVec3) {
    let (mut gaussians, mut set) = room();
    let (center, half) = (DVec3::new(0.0, 0.82, -1.2), DVec3::new(0.9, 0.03, 0.6));
    for y in [-1.0, 1.0] {
        wall(&mut gaussians, center + half * DVec3::new(-1.0, y, -1.0), DVec3::X * 1.8, DVec3::Z * 1.2);
    }
    set.objects.push(Object::from_box(3, "table", center, half));
    let world = World::new(&gaussians, DVec3::Y, &set, &[1, 2, 3]).unwrap();
    (world, center, half)
}

#[test]
fn the_camera_does_not_stand_under_a_table() {
    let (world, center, half) = room_with_table();
    for seed in 0..6 {
        for (id, movement) in [(1, Move::Static), (2, Move::PullOut), (3, Move::OrbitLeft), (3, Move::CraneDown)] {
            let step = Step { end: about(id), ..Step::of(movement) };
            for state in film(&solved_with_seed(&world, step, seed)) {
                let at = state.pose.position - center;
                let under = at.x.abs() < half.x && at.z.abs() < half.z && at.y < 0.0;
                assert!(!under, "{movement} of {id}, seed {seed}: {}", state.pose.position);
            }
        }
    }
}

#[test]
fn upright_subjects_keep_their_heads() {
    // Box 1 is twice as high as wide.
    let (center, half) = (CENTER, HALF);
    let start = Framing { height_frac: Some(1.0), ..about(1) };
    for state in film(&solved(&world(), vec![Step { start, ..Step::of(Move::Static) }])) {
        let top = super::composition::in_frame(&state, center + DVec3::Y * half.y);
        let middle = super::composition::in_frame(&state, center);
        assert!((0.27..0.47).contains(&top.y), "top at {top}");
        assert!(middle.abs().max_element() < 0.15, "middle at {middle}");
    }
}

/// Share of the corners of box 1 in a frame of an aspect, and its height over the frame's.
fn framed(state: &CameraState, aspect: f64) -> (bool, f64) {
    let (center, half) = (CENTER, HALF);
    let corners = (0..8).map(|i: i32| {
        let sign = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let away = state.pose.rotation.conjugate()
            * (center + half * DVec3::new(sign(0), sign(1), sign(2)) - state.pose.position);
        let tan = (state.fov_y_rad / 2.0).tan();
        (away.x / (2.0 * away.z * tan * aspect), -away.y / (2.0 * away.z * tan))
    });
    let places: Vec<(f64, f64)> = corners.collect();
    let inside = places.iter().all(|(x, y)| x.abs() <= 0.5 && y.abs() <= 0.5);
    let rows = || places.iter().map(|place| place.1);
    (inside, rows().fold(f64::MIN, f64::max) - rows().fold(f64::MAX, f64::min))
}

#[test]
fn portrait_and_square_films_are_planned_for_their_own_frame() {
    for aspect in [9.0 / 16.0, 1.0, 2.39] {
        let mut world = world();
        world.aspect = aspect;
        let both = Framing { subjects: vec![1], whole: true, ..Framing::default() };
        let solution = solved(&world, vec![Step { end: both, ..Step::of(Move::PullOut) }]);
        let frames = film(&solution);
        let (inside, _) = framed(&frames[frames.len() - 1], aspect);
        assert!(inside, "aspect {aspect}: {:#?}", solution.report);
        let start = Framing { size: Some(ShotSize::Medium), ..about(1) };
        let solution = solved(&world, vec![Step { start, ..Step::of(Move::Static) }]);
        let (_, height) = framed(&film(&solution)[0], aspect);
        assert!((0.55..0.85).contains(&height), "aspect {aspect}: height {height}");
        let both = Framing { subjects: vec![1, 2], whole: true, ..Framing::default() };
        let state = film(&solved(&world, vec![Step { start: both, ..Step::of(Move::Static) }]))[0];
        for center in [CENTER, DVec3::new(-1.2, 0.5, 0.8)] {
            let away = state.pose.rotation.conjugate() * (center - state.pose.position);
            let across = away.x / (2.0 * away.z * (state.fov_y_rad / 2.0).tan() * aspect);
            assert!(across.abs() < 0.5, "aspect {aspect}: {across} of the width from the middle");
        }
    }
}

#[test]
fn a_pull_out_does_not_end_in_black() {
    // The room of the tests has no ceiling and ends at its walls: whoever backs off too far sees more void than room.
    let world = world();
    for seed in 0..4 {
        let solution = solved_with_seed(&world, Step { end: about(2), ..Step::of(Move::PullOut) }, seed);
        let frames = film(&solution);
        let last = &frames[frames.len() - 1];
        let inside = last.pose.position.abs().cmplt(ROOM).all();
        assert!(inside, "seed {seed}: backs out of the room to {}", last.pose.position);
        assert_met(&solution, "at least 1.32");
    }
}

#[test]
fn a_whip_to_a_thing_behind_another_starts_where_both_are_seen() {
    // A screen hides box 2 from most of the places from where box 1 fills the picture.
    let (mut gaussians, objects) = room();
    wall(&mut gaussians, DVec3::new(-2.2, 0.0, 0.2), DVec3::X * 2.4, DVec3::Y * 1.1);
    let world = World::new(&gaussians, DVec3::Y, &objects, &[1, 2]).unwrap();
    let whip = Step { start: about(1), end: about(2), either_way: true, ..Step::of(Move::WhipPan) };
    let solution = solved_with_seed(&world, whip, 0);
    let hidden = solution.report.iter().find(|line| line.wanted.starts_with("visible share") && !line.met);
    assert!(hidden.is_none(), "{hidden:?}");
}

#[test]
fn a_film_that_no_camera_can_make_still_stays_in_the_room() {
    // A tilt from one box to another beside it: whatever the place, the turn is no tilt.
    let tilt = Step { start: about(1), end: about(2), ..Step::of(Move::TiltUp) };
    for seed in 0..3 {
        for state in film(&solved_with_seed(&world(), tilt.clone(), seed)) {
            let eye = state.pose.position;
            assert!(eye.x.abs() < ROOM.x && eye.z.abs() < ROOM.z && eye.y > 0.0, "seed {seed}: stands at {eye}");
        }
    }
}

#[test]
fn a_worm_lies_on_the_floor_and_not_under_it() {
    for angle in [ShotAngle::Worm, ShotAngle::Low] {
        let low = Step { end: Framing { angle: Some(angle), ..about(1) }, ..Step::of(Move::Static) };
        for seed in 0..3 {
            for state in film(&solved_with_seed(&world(), low.clone(), seed)) {
                assert!(state.pose.position.y > 0.0, "{angle} of seed {seed} lies at {}", state.pose.position);
            }
        }
    }
}

#[test]
fn a_circle_in_a_room_stays_between_its_walls() {
    let circle = Step { end: about(1), amount: Some(Amount::Degrees(360.0)), ..Step::of(Move::OrbitRight) };
    for seed in 0..3 {
        for state in film(&solved_with_seed(&world(), circle.clone(), seed)) {
            let eye = state.pose.position;
            assert!(eye.x.abs() < ROOM.x && eye.z.abs() < ROOM.z && eye.y > 0.0, "seed {seed}: stands at {eye}");
        }
    }
}
