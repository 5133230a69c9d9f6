//! Ways between places: round a thing, back over a thing, back to the whole of something large; and turns amid a room.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Pass, Step, Via, World};
use cinesplat::trajectory::{CameraState, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::composition::in_frame;
use super::viewpoints::generated;
use super::{ROOM, film, room, solved, wall, world};

const BOX_1: DVec3 = DVec3::new(1.2, 0.6, 0.9);
const BOX_2: DVec3 = DVec3::new(-1.2, 0.5, 0.8);

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn past(how: Pass, id: u32) -> Via {
    Via { how, objects: vec![id] }
}

/// The room with a third thing: a low post with a thin rod on it (3), or a die on box 1 (4).
fn with_small_things(ids: &[u32]) -> World {
    let (mut gaussians, set) = room();
    let mut objects = set.objects;
    let first = gaussians.len();
    for side in [-1.0, 1.0] {
        wall(&mut gaussians, DVec3::new(-0.1, 0.0, -1.5 + 0.1 * side), DVec3::X * 0.2, DVec3::Y * 0.25);
        wall(&mut gaussians, DVec3::new(0.1 * side, 0.0, -1.6), DVec3::Z * 0.2, DVec3::Y * 0.25);
    }
    wall(&mut gaussians, DVec3::new(0.0, 0.25, -1.5), DVec3::Y * 0.45, DVec3::ZERO);
    let (center, half) = (DVec3::new(0.0, 0.35, -1.5), DVec3::new(0.1, 0.35, 0.1));
    objects.push(Object { num_gaussians: gaussians.len() - first, ..Object::from_box(3, "radio", center, half) });
    let first = gaussians.len();
    let (center, half) = (DVec3::new(1.2, 1.24, 0.9), DVec3::splat(0.04));
    wall(&mut gaussians, center - half, DVec3::X * 0.08, DVec3::Y * 0.08);
    wall(&mut gaussians, center - half, DVec3::Z * 0.08, DVec3::Y * 0.08);
    objects.push(Object { num_gaussians: gaussians.len() - first, ..Object::from_box(4, "die", center, half) });
    World::new(&gaussians, DVec3::Y, &ObjectSet { objects, labels: Vec::new() }, ids).unwrap()
}

#[test]
fn a_curve_round_a_thing_between_two_places_ends_at_the_second() {
    let step = Step { start: about(1), end: about(3), via: Some(past(Pass::Past, 2)), ..Step::of(Move::ArcRight) };
    let frames = film(&solved(&with_small_things(&[1, 2, 3]), vec![step]));
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(in_frame(first, BOX_1).abs().max_element() < 0.3, "begins on the first: {}", in_frame(first, BOX_1));
    let at = in_frame(last, DVec3::new(0.0, 0.35, -1.5));
    assert!(at.abs().max_element() < 0.2, "ends on the last: {at}");
    let nearest = frames.iter().map(|state| state.pose.position.distance(BOX_2)).fold(f64::INFINITY, f64::min);
    assert!(nearest < 2.0, "passes box 2 at {nearest}");
}

#[test]
fn a_camera_that_backs_over_something_looks_where_it_came_from() {
    let end = Framing { whole: true, ..about(1) };
    let start = Framing { size: Some(ShotSize::CloseUp), ..about(4) };
    let step = Step { start, end, via: Some(past(Pass::Over, 2)), ..Step::of(Move::PullOut) };
    let frames = film(&solved(&with_small_things(&[1, 2, 4]), vec![step]));
    let distance = |state: &CameraState| state.pose.position.distance(BOX_1);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(distance(last) > 1.3 * distance(first), "from {} to {}", distance(first), distance(last));
    let at = in_frame(last, BOX_1);
    assert!(at.abs().max_element() < 0.35, "box 1 is at {at}");
}

#[test]
fn what_turns_all_the_way_round_stands_amid_the_room() {
    let step = Step { amount: Some(Amount::Degrees(360.0)), ..Step::of(Move::PanRight) };
    let frames = film(&solved(&world(), vec![step]));
    let eye = frames[0].pose.position;
    let to_wall = (ROOM.x - eye.x.abs()).min(ROOM.z - eye.z.abs());
    assert!(to_wall > 1.0, "{to_wall} from the wall, at {eye}");
}

#[test]
fn a_close_picture_of_a_thing_under_a_rod_is_one_of_its_body() {
    let close = Framing { size: Some(ShotSize::CloseUp), ..about(3) };
    let world = with_small_things(&[3]);
    let state = film(&solved(&world, vec![Step { end: close, ..Step::of(Move::Static) }]))[0];
    let [body, tip] = [0.12, 0.66].map(|height| in_frame(&state, DVec3::new(0.0, height, -1.5)).y);
    assert!(body.abs() < tip.abs(), "the body is at {body}, the tip of the rod at {tip}");
}

#[test]
fn a_way_in_begins_on_the_group_that_its_goal_belongs_to() {
    let start = Framing { subjects: vec![1, 2], whole: true, ..Framing::default() };
    let end = Framing { height_frac: Some(0.5), ..about(2) };
    let frames = film(&solved(&world(), vec![Step { start, end, ..Step::of(Move::PushIn) }]));
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    for center in [BOX_1, BOX_2] {
        assert!(in_frame(first, center).abs().max_element() < 0.5, "begins on both: {}", in_frame(first, center));
    }
    let at = in_frame(last, BOX_2);
    assert!(at.abs().max_element() < 0.2, "ends on the second: {at}");
    let [from, to] = [first, last].map(|state| state.pose.position.distance(BOX_2));
    assert!(to < 0.8 * from, "goes from {from} to {to}");
}

#[test]
fn a_camera_backs_out_between_two_things_with_its_eyes_on_a_third() {
    let via = Some(Via { how: Pass::Between, objects: vec![1, 2] });
    let frames =
        film(&solved(&with_small_things(&[1, 2, 3]), vec![Step { end: about(3), via, ..Step::of(Move::PullOut) }]));
    let radio = DVec3::new(0.0, 0.35, -1.5);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    let [from, to] = [first, last].map(|state| state.pose.position.distance(radio));
    assert!(to > 1.3 * from, "backs from {from} to {to}");
    let off = frames.iter().map(|state| in_frame(state, radio).abs().max_element()).fold(0.0, f64::max);
    assert!(off < 0.25, "looks away from it: {off}");
    assert!(first.pose.position.z < 0.8 && last.pose.position.z > 0.9, "{:?} {:?}", first.pose, last.pose);
    let crosses = |pair: &[CameraState]| (pair[0].pose.position.z < 0.85) != (pair[1].pose.position.z < 0.85);
    let gate = frames.windows(2).find(|pair| crosses(pair)).unwrap()[0].pose.position;
    assert!((-1.2..1.2).contains(&gate.x), "passes at {gate}");
}

#[test]
fn a_camera_that_sinks_to_the_floor_backs_away_above_it() {
    let end = Framing { angle: Some(ShotAngle::Worm), ..about(1) };
    let step = Step { end, with: vec![Move::PullOut], ..Step::of(Move::CraneDown) };
    let frames = film(&solved(&world(), vec![step]));
    let (first, last) = (frames[0].pose.position, frames[frames.len() - 1].pose.position);
    assert!((0.0..0.2).contains(&last.y), "ends at {last}");
    assert!(first.y > last.y + 0.3, "sinks from {first} to {last}");
    let level = |eye: DVec3| (eye - BOX_1).with_y(0.0).length();
    assert!(level(last) > level(first), "backs away from {first} to {last}");
}

#[test]
fn a_low_circle_around_what_stands_on_a_table_stays_above_the_table() {
    let start = Framing { angle: Some(ShotAngle::Low), ..about(4) };
    let step = Step {
        start,
        end: about(4),
        with: vec![Move::CraneUp],
        amount: Some(Amount::Degrees(360.0)),
        ..Step::of(Move::OrbitLeft)
    };
    let frames = film(&solved(&with_small_things(&[1, 4]), vec![step]));
    let lowest = frames.iter().map(|state| state.pose.position.y).fold(f64::INFINITY, f64::min);
    assert!(lowest > 1.2, "goes down to {lowest}, below the top of the box");
}

#[test]
fn a_lens_narrows_on_the_thing_that_it_is_to_narrow_on() {
    let step = |movement: Move, id: u32| Step { end: about(id), ..Step::of(movement) };
    let frames = film(&solved(&world(), vec![step(Move::Static, 1), step(Move::ZoomIn, 2)]));
    let last = &frames[frames.len() - 1];
    assert!(in_frame(last, BOX_2).abs().max_element() < 0.2, "{}", in_frame(last, BOX_2));
}

#[test]
fn a_way_past_a_thing_shows_it_and_goes_by_it() {
    let step = Step { end: about(1), via: Some(past(Pass::Past, 2)), ..Step::of(Move::FlyThrough) };
    let frames = film(&solved(&world(), vec![step]));
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    let shows = |state: &CameraState| in_frame(state, BOX_2).abs().max_element() < 0.5;
    assert!(frames.iter().any(shows), "box 2 is never in the picture");
    let way = (last.pose.position - first.pose.position).reject_from(DVec3::Y).normalize();
    let ahead = |state: &CameraState| (BOX_2 - state.pose.position).dot(way);
    assert!(ahead(first) > 0.0 && ahead(last) < 0.3, "box 2 lies {} and then {} ahead", ahead(first), ahead(last));
    let at = in_frame(last, BOX_1);
    assert!(at.abs().max_element() < 0.2, "ends on box 1: {at}");
}

#[test]
fn a_worm_creeps_over_a_rug_and_not_above_it() {
    // Room 1279 has a rug (7) under its coffee table (8).
    let (opened, world) = generated(1279, &[7, 8]);
    let table = opened.objects.unwrap().objects.iter().find(|object| object.id == 8).unwrap().center;
    let end = Framing { angle: Some(ShotAngle::Worm), ..about(8) };
    let step = Step { end, via: Some(past(Pass::Over, 7)), ..Step::of(Move::PushIn) };
    let frames = film(&solved(&world, vec![step]));
    let highest = frames.iter().map(|state| state.pose.position.y).fold(0.0, f64::max);
    assert!(highest < 0.6, "the camera is {highest} above the floor");
    let [from, to] = [&frames[0], &frames[frames.len() - 1]].map(|state| state.pose.position.distance(table));
    assert!(to < 0.8 * from, "goes from {from} to {to}");
}

#[test]
fn a_pull_out_to_a_thing_and_what_it_stands_beside_ends_on_the_middle_of_both() {
    let start = Framing { size: Some(ShotSize::CloseUp), ..about(2) };
    let end = Framing { subjects: vec![2, 1], whole: true, ..Framing::default() };
    let frames = film(&solved(&world(), vec![Step { start, end, ..Step::of(Move::PullOut) }]));
    let last = &frames[frames.len() - 1];
    let [one, other] = [BOX_1, BOX_2].map(|center| in_frame(last, center));
    assert!((one.x + other.x).abs() / 2.0 < 0.15, "box 1 at {one}, box 2 at {other}");
}
