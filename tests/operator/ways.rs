//! Ways between places: round a thing, back over a thing, back to the whole of something large; and turns amid a room.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Pass, Step, Via, World};
use cinesplat::trajectory::{CameraState, Move, ShotSize};
use glam::DVec3;

use super::composition::in_frame;
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
