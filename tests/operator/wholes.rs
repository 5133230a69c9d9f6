//! What fits into the picture stays whole in it, what is alone fills it, and what lies on a table is followed at its height.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Framing, Pass, Step, SubjectPart, Via, World};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraState, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::composition::in_frame;
use super::{film, room, solved, wall};

/// Half the extents of a thing with nothing around it.
const HALF: DVec3 = DVec3::new(0.3, 0.9, 0.3);

/// A box that is all that was captured.
pub(super) fn lone() -> World {
    let mut gaussians = Gaussians::default();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [-1.0, 1.0] {
            let (mut corner, mut du, mut dv) = (-HALF, DVec3::ZERO, DVec3::ZERO);
            corner[axis] = side * HALF[axis];
            (du[u], dv[v]) = (2.0 * HALF[u], 2.0 * HALF[v]);
            wall(&mut gaussians, corner, du, dv);
        }
    }
    let object = Object { num_gaussians: gaussians.len(), ..Object::from_box(1, "pillar", DVec3::ZERO, HALF) };
    World::new(&gaussians, DVec3::Y, &ObjectSet { objects: vec![object], labels: Vec::new() }, &[1]).unwrap()
}

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// The corners of the pillar in a frame: the least and the largest height over the frame's, from its middle.
fn rows(state: &CameraState) -> (f64, f64) {
    let corners = (0..8).map(|i: i32| {
        let sign = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        in_frame(state, HALF * DVec3::new(sign(0), sign(1), sign(2))).y
    });
    corners.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)))
}

#[test]
fn a_push_toward_a_lone_thing_ends_with_all_of_it_large_in_the_picture() {
    let states = film(&solved(&lone(), vec![Step { end: about(1), ..Step::of(Move::PushIn) }]));
    let (low, high) = rows(&states[states.len() - 1]);
    assert!(high - low > 0.7, "height {}", high - low);
    assert!(low > -0.5 && high < 0.5, "from {low} to {high}");
}

#[test]
fn a_full_shot_of_a_lone_thing_shows_it_from_head_to_toe() {
    let start = Framing { size: Some(ShotSize::CloseUp), ..about(1) };
    let end = Framing { size: Some(ShotSize::Long), whole: true, ..about(1) };
    let states = film(&solved(&lone(), vec![Step { start, end, ..Step::of(Move::PullOut) }]));
    let (low, high) = rows(&states[states.len() - 1]);
    assert!((0.55..0.96).contains(&(high - low)), "height {}", high - low);
}

#[test]
fn a_tilt_along_a_thing_stands_at_half_its_height() {
    let at = |part| Framing { part, ..about(1) };
    let tilt = Step { start: at(SubjectPart::Bottom), end: at(SubjectPart::Top), ..Step::of(Move::TiltUp) };
    let states = film(&solved(&lone(), vec![tilt]));
    let height = states[0].pose.position.y;
    assert!(height.abs() < 0.35 * HALF.y, "height {height}");
}

#[test]
fn a_descent_from_straight_above_ends_at_the_stated_size() {
    let start = Framing { angle: Some(ShotAngle::Overhead), ..Framing::default() };
    let end = Framing { angle: Some(ShotAngle::Overhead), size: Some(ShotSize::MediumLong), ..about(2) };
    let states = film(&solved(&super::world(), vec![Step { start, end, ..Step::of(Move::CraneDown) }]));
    let fall = states[0].pose.position.y - states[states.len() - 1].pose.position.y;
    assert!(fall > 0.3, "fall {fall}");
}

#[test]
fn a_push_over_a_low_thing_begins_behind_it() {
    let via = Some(Via { how: Pass::Over, objects: vec![2] });
    let states = film(&solved(&super::world(), vec![Step { end: about(1), via, ..Step::of(Move::PushIn) }]));
    let (first, last) = (states[0].pose.position, states[states.len() - 1].pose.position);
    let (from, to) = (DVec3::new(-1.2, 0.5, 0.8), DVec3::new(1.2, 0.6, 0.9));
    let way = (to - from).with_y(0.0).normalize();
    assert!((first - from).dot(way) < 0.0, "starts at {first}");
    assert!((last - from).dot(way) > 0.0, "ends at {last}");
    assert!(states.iter().all(|state| state.pose.position.y > 1.0), "over the top of 1 m");
}

#[test]
fn a_pull_out_from_high_on_a_wall_to_the_room_looks_down_into_it() {
    let (gaussians, mut objects) = room();
    let clock = Object::from_box(3, "clock", DVec3::new(2.95, 1.95, 0.0), DVec3::new(0.05, 0.15, 0.15));
    objects.objects.push(clock);
    let world = World::new(&gaussians, DVec3::Y, &objects, &[3]).unwrap();
    let end = Framing { size: Some(ShotSize::Long), ..Framing::default() };
    let frames = film(&solved(&world, vec![Step { start: about(3), end, ..Step::of(Move::PullOut) }]));
    let (first, last) = (frames[0].pose.forward().y, frames[frames.len() - 1].pose.forward().y);
    assert!(last < first - 0.03, "looks up by {first} at first and by {last} at the end");
    let clock = in_frame(&frames[frames.len() - 1], DVec3::new(2.95, 1.95, 0.0));
    assert!(clock.abs().max_element() < 0.5, "the clock has left the picture: {clock}");
}
