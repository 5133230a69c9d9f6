//! What is seen behind a subject, measured here on the finished film's frames.

use cinesplat::operator::{Framing, Lens, Solution, Step};
use cinesplat::trajectory::{CameraState, Move};
use glam::DVec3;

use super::{film, solved, world};

/// Middles of boxes 1 and 2 of the room.
const BOXES: [DVec3; 2] = [DVec3::new(1.2, 0.6, 0.9), DVec3::new(-1.2, 0.5, 0.8)];

/// Depth of a point along the view axis, and its distance from it to the right, both over the depth.
fn seen(state: &CameraState, point: DVec3) -> (f64, f64) {
    let to = point - state.pose.position;
    let forward = state.pose.rotation * DVec3::Z;
    let right = state.pose.rotation * DVec3::X;
    let depth = to.dot(forward);
    (depth, to.dot(right) / depth)
}

fn assert_behind(state: &CameraState) {
    let ([near, far], half) = (BOXES.map(|middle| seen(state, middle)), (state.fov_y_rad / 2.0).tan() * 16.0 / 9.0);
    assert!(far.0 > near.0 && near.0 > 0.0, "depths {} and {}", near.0, far.0);
    assert!((far.1 - near.1).abs() < half && far.1.abs() < half, "{} beside {} of {half}", far.1, near.1);
}

fn before(backdrop: u32) -> Framing {
    Framing { subjects: vec![1], backdrop: vec![backdrop], ..Framing::default() }
}

fn is_met(solution: &Solution) -> bool {
    let lines: Vec<_> = solution.report.iter().filter(|line| line.wanted.contains(" behind ")).collect();
    !lines.is_empty() && lines.iter().all(|line| line.met)
}

#[test]
fn a_picture_at_rest_and_a_push_in_have_their_background() {
    for movement in [Move::Static, Move::PushIn] {
        // Through a longer lens the room ends before the camera.
        let end = Framing { lens: Some(Lens::Wide), ..before(2) };
        let solution = solved(&world(), vec![Step { end, ..Step::of(movement) }]);
        assert_behind(film(&solution).last().unwrap());
        assert!(is_met(&solution), "{movement}: {:?}", solution.report);
    }
}

#[test]
fn a_way_round_ends_before_its_background() {
    let solution = solved(&world(), vec![Step { end: before(2), ..Step::of(Move::ArcLeft) }]);
    assert_behind(film(&solution).last().unwrap());
    assert!(is_met(&solution), "{:?}", solution.report);
}

#[test]
fn a_background_at_the_start_is_that_of_the_first_picture() {
    let step =
        Step { start: before(2), end: Framing { subjects: vec![2], ..Framing::default() }, ..Step::of(Move::PanLeft) };
    let solution = solved(&world(), vec![Step { either_way: true, ..step }]);
    assert_behind(&film(&solution)[0]);
}

#[test]
fn a_thing_that_cannot_be_behind_is_said_to_be_missing_there() {
    // A thing is not behind itself.
    let solution = solved(&world(), vec![Step { end: before(1), ..Step::of(Move::Static) }]);
    assert!(!is_met(&solution), "{:?}", solution.report);
}
