//! How moves end whose ends the words leave open: with their subject large in the picture, in its middle, or gone from it.

use cinesplat::operator::{Framing, Step};
use cinesplat::trajectory::{CameraState, Move};
use glam::DVec3;

use super::composition::in_frame;
use super::wholes::lone;
use super::{film, solved, world};

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// Center and half extents of the boxes of the room.
const BOXES: [(DVec3, DVec3); 2] =
    [(DVec3::new(1.2, 0.6, 0.9), DVec3::new(0.3, 0.6, 0.3)), (DVec3::new(-1.2, 0.5, 0.8), DVec3::new(0.4, 0.5, 0.3))];

/// Least and largest coordinates of a box in a frame, over its width and height, from its middle.
fn extent(state: &CameraState, (center, half): (DVec3, DVec3)) -> [glam::DVec2; 2] {
    let corners = (0..8).map(|i: i32| {
        let sign = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        in_frame(state, center + half * DVec3::new(sign(0), sign(1), sign(2)))
    });
    corners.fold([glam::DVec2::INFINITY, glam::DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

fn last_of(steps: Vec<Step>) -> CameraState {
    let states = film(&solved(&world(), steps));
    states[states.len() - 1]
}

#[test]
fn a_push_or_zoom_without_a_stated_size_ends_with_its_subject_large() {
    for movement in [Move::PushIn, Move::ZoomIn] {
        let step = Step { end: about(1), ..Step::of(movement) };
        for steps in [vec![step.clone()], vec![Step { end: about(2), ..Step::of(Move::CraneUp) }, step.clone()]] {
            let [low, high] = extent(&last_of(steps.clone()), BOXES[0]);
            assert!((high - low).max_element() > 0.5, "{movement} of {} steps: {low} to {high}", steps.len());
        }
    }
}

#[test]
fn a_hold_turns_to_the_thing_that_it_comes_to() {
    let rest = |id| Step { end: about(id), duration_secs: Some(2.0), ..Step::of(Move::Static) };
    let at = in_frame(&last_of(vec![rest(1), rest(2)]), BOXES[1].0);
    assert!(at.abs().max_element() < 0.1, "{at}");
}

#[test]
fn a_slide_goes_on_until_what_is_to_be_gone_is_out_of_the_picture() {
    let end = Framing { hidden: true, ..about(1) };
    let steps = vec![Step { end: about(1), ..Step::of(Move::PushIn) }, Step { end, ..Step::of(Move::TruckLeft) }];
    let states = film(&solved(&world(), steps));
    let [low, _] = extent(&states[states.len() - 1], BOXES[0]);
    assert!(low.x > 0.45, "{low}");
}

#[test]
fn a_pull_out_to_all_of_a_lone_thing_begins_with_a_part_of_it() {
    let end = Framing { whole: true, ..about(1) };
    let states = film(&solved(&lone(), vec![Step { end, ..Step::of(Move::PullOut) }]));
    let height = |state: &CameraState| {
        let [low, high] = extent(state, (DVec3::ZERO, DVec3::new(0.3, 0.9, 0.3)));
        high.y - low.y
    };
    let (first, last) = (height(&states[0]), height(&states[states.len() - 1]));
    assert!(first > 1.2 && last < 1.0, "{first} and {last}");
}
