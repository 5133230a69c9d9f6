//! Stated places, sizes, distances, heights, lenses and sides, measured on the film.

use cinesplat::geometry::LevelFrame;
use cinesplat::operator::{
    FramePlace, Framing, Lens, Program, Solution, SolveLevel, SolveSettings, Step, SubjectSide, realize,
};
use cinesplat::trajectory::{CameraState, Move};
use glam::{DVec2, DVec3};

use super::{film, solved, world};

/// Center and half extents of box 1.
pub const CENTER: DVec3 = DVec3::new(1.2, 0.6, 0.9);
pub const HALF: DVec3 = DVec3::new(0.3, 0.6, 0.3);

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// Position of a point in a 16:9 frame, from its middle, as shares of its width and height; right and up positive.
pub fn in_frame(state: &CameraState, point: DVec3) -> DVec2 {
    let away = state.pose.rotation.conjugate() * (point - state.pose.position);
    assert!(away.z > 0.0, "behind the camera");
    let half = away.z * (state.fov_y_rad / 2.0).tan();
    DVec2::new(away.x / (2.0 * half * 16.0 / 9.0), -away.y / (2.0 * half))
}

/// Projected height of box 1 over the frame's height.
fn height(state: &CameraState) -> f64 {
    let sign = |i: i32, bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |i: i32| CENTER + HALF * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2));
    let rows: Vec<f64> = (0..8).map(|i| in_frame(state, corner(i)).y).collect();
    rows.iter().copied().fold(f64::MIN, f64::max) - rows.iter().copied().fold(f64::MAX, f64::min)
}

/// Panics where a line of the report whose request contains `words` is missing or not met.
pub fn assert_met(solution: &Solution, words: &str) {
    let line = solution.report.iter().find(|line| line.wanted.contains(words));
    assert!(line.is_some_and(|line| line.met), "{words}: {:#?}", solution.report);
}

#[test]
fn a_place_in_the_frame_holds_the_subjects_center() {
    let third = 1.0 / 6.0;
    for (place, at, words) in [
        (FramePlace::AtLeft, DVec2::new(-third, 0.0), "on the left third"),
        (FramePlace::AtUpperRight, DVec2::new(third, third), "in the upper right"),
        (FramePlace::AtCenter, DVec2::ZERO, "in the middle of the frame"),
    ] {
        let start = Framing { place: Some(place), ..about(1) };
        let solution = solved(&world(), vec![Step { start, ..Step::of(Move::Static) }]);
        let frames = film(&solution);
        assert!(in_frame(&frames[0], CENTER).distance(at) < 1e-6, "{place}: {}", in_frame(&frames[0], CENTER));
        let frame = LevelFrame::new(DVec3::Y).unwrap();
        assert!(frame.roll_rad(&frames[0].pose).abs() < 1e-9, "level");
        assert_met(&solution, words);
    }
}

#[test]
fn moves_that_stay_with_their_subject_keep_its_place() {
    for movement in [Move::PushIn, Move::OrbitRight, Move::CraneUp] {
        let end = Framing { place: Some(FramePlace::AtRight), ..about(1) };
        let solution = solved(&world(), vec![Step { end, ..Step::of(movement) }]);
        let frames = film(&solution);
        for state in [&frames[0], &frames[frames.len() / 2], &frames[frames.len() - 1]] {
            let off = in_frame(state, CENTER).distance(DVec2::new(1.0 / 6.0, 0.0));
            assert!(off < 0.02, "{movement}: {off}");
        }
        assert_met(&solution, "on the right third");
    }
    let push = Step { end: Framing { place: Some(FramePlace::AtRight), ..about(1) }, ..Step::of(Move::PushIn) };
    let frames = film(&solved(&world(), vec![push]));
    let line = CENTER - frames[0].pose.position;
    for state in &frames {
        assert!((state.pose.position - frames[0].pose.position).cross(line).length() < 1e-9, "straight to the subject");
        assert!(state.pose.forward().angle_between(frames[0].pose.forward()) < 1e-6, "without a turn");
    }
}

#[test]
fn pans_trucks_and_zooms_end_with_their_subject_in_place() {
    for movement in [Move::PanRight, Move::TruckRight, Move::PedestalUp, Move::ZoomIn, Move::Follow] {
        let start = if movement == Move::PanRight { about(2) } else { Framing::default() };
        let end = Framing { place: Some(FramePlace::AtLowerLeft), ..about(1) };
        let either_way = movement == Move::PanRight;
        let solution = solved(&world(), vec![Step { start, end, either_way, ..Step::of(movement) }]);
        let frames = film(&solution);
        let off = in_frame(&frames[frames.len() - 1], CENTER).distance(DVec2::splat(-1.0 / 6.0));
        assert!(off < 0.01, "{movement}: {off}");
        assert_met(&solution, "in the lower left");
        if movement != Move::Follow && movement != Move::PanRight {
            let turn = frames[0].pose.forward().angle_between(frames[frames.len() - 1].pose.forward());
            assert!(turn < 1e-6, "{movement} turns by {turn}");
        }
    }
}

#[test]
fn a_second_step_turns_its_subject_into_place() {
    let hold = Step { start: about(1), ..Step::of(Move::Static) };
    let again = Step { end: Framing { place: Some(FramePlace::AtLeft), ..about(1) }, ..Step::of(Move::Static) };
    let frames = film(&solved(&world(), vec![hold, again]));
    assert!(in_frame(&frames[frames.len() - 1], CENTER).distance(DVec2::new(-1.0 / 6.0, 0.0)) < 1e-6);
    let step = |pair: &[CameraState]| pair[0].pose.forward().angle_between(pair[1].pose.forward()).to_degrees();
    assert!(frames.windows(2).all(|pair| step(pair) < 6.0), "no jump");
}

#[test]
fn heights_distances_and_elevations_are_kept() {
    let start = Framing { height_frac: Some(0.5), ..about(1) };
    let solution = solved(&world(), vec![Step { start, ..Step::of(Move::Static) }]);
    assert!((height(&film(&solution)[0]) - 0.5).abs() < 0.075);
    assert_met(&solution, "0.42 to 0.57 of the frame's height");

    let end = Framing { height_frac: Some(0.9), ..about(1) };
    let frames = film(&solved(&world(), vec![Step { end, ..Step::of(Move::PushIn) }]));
    assert!((height(&frames[frames.len() - 1]) - 0.9).abs() < 0.135);

    let start = Framing { distance: Some(2.0), elevation_deg: Some(20.0), ..about(1) };
    let solution = solved(&world(), vec![Step { start, ..Step::of(Move::Static) }]);
    let away = film(&solution)[0].pose.position - CENTER;
    assert!((away.length() - 2.0).abs() < 0.2, "{}", away.length());
    assert!(((away.y / away.length()).asin().to_degrees() - 20.0).abs() < 6.0);
    assert_met(&solution, "distance to the center of box 1");
    assert_met(&solution, "seen from 14 to 26 degrees above box 1");

    let end = Framing { distance: Some(1.5), ..about(1) };
    let frames = film(&solved(&world(), vec![Step { end, ..Step::of(Move::PushIn) }]));
    assert!((frames[frames.len() - 1].pose.position.distance(CENTER) - 1.5).abs() < 0.15);
}

#[test]
fn heights_above_the_floor_are_kept() {
    for movement in [Move::Static, Move::PedestalUp, Move::CraneUp, Move::OrbitLeft] {
        let end = Framing { height: Some(1.6), ..about(1) };
        let solution = solved(&world(), vec![Step { end, ..Step::of(movement) }]);
        let frames = film(&solution);
        // The floor of the core box is at most the radius of a Gaussian above the floor at y = 0.
        let found = frames[frames.len() - 1].pose.position.y;
        assert!((found - 1.6).abs() < 0.2, "{movement}: {found}");
        assert_met(&solution, "camera above the floor");
    }
}

#[test]
fn lenses_are_those_that_the_prompt_states() {
    let fov = |mm: f64| 2.0 * (12.0 / mm).atan().to_degrees();
    for (lens, range) in [
        (Lens::FocalMm(50.0), (fov(50.0), fov(50.0))),
        (Lens::FovDeg(40.0), (40.0, 40.0)),
        (Lens::Wide, (fov(28.0), fov(16.0))),
        (Lens::Long, (fov(135.0), fov(70.0))),
    ] {
        for movement in [Move::Static, Move::OrbitRight, Move::Follow] {
            let end = Framing { lens: Some(lens), ..about(1) };
            let solution = solved(&world(), vec![Step { end, ..Step::of(movement) }]);
            for state in film(&solution) {
                let deg = state.fov_y_rad.to_degrees();
                assert!(deg > range.0 - 1e-6 && deg < range.1 + 1e-6, "{movement} {lens:?}: {deg}");
            }
            assert_met(&solution, "vertical field of view");
        }
    }
    let end = Framing { lens: Some(Lens::FocalMm(100.0)), ..about(1) };
    let frames = film(&solved(&world(), vec![Step { end, ..Step::of(Move::ZoomIn) }]));
    assert!((frames[frames.len() - 1].fov_y_rad.to_degrees() - fov(100.0)).abs() < 1e-6);
}

#[test]
fn a_side_is_the_one_that_the_prompt_names() {
    // The front faces the middle of the room; somebody in front of the box at (1.2, 0.9) has its left at -(0.9, -1.2).
    let front = DVec3::new(-1.2, 0.0, -0.9).normalize();
    let left = front.cross(DVec3::Y);
    for (side, axis) in
        [(SubjectSide::FromFront, front), (SubjectSide::FromLeft, left), (SubjectSide::FromRight, -left)]
    {
        let start = Framing { side: Some(side), ..about(1) };
        let solution = solved(&world(), vec![Step { start, ..Step::of(Move::Static) }]);
        let away = (film(&solution)[0].pose.position - CENTER).with_y(0.0);
        assert!(away.angle_between(axis).to_degrees() < 41.0, "{side}: {}", away.angle_between(axis).to_degrees());
        assert_met(&solution, &side.as_ref().replace('-', " "));
    }
    let start = Framing { side: Some(SubjectSide::FromFront), ..about(1) };
    let end = Framing { side: Some(SubjectSide::FromRight), ..about(1) };
    let frames = film(&solved(&world(), vec![Step { start, end, ..Step::of(Move::OrbitLeft) }]));
    let away = (frames[frames.len() - 1].pose.position - CENTER).with_y(0.0);
    let found = away.angle_between(-left).to_degrees();
    assert!(found < 41.0 || frames.len() > 60, "an orbit ends on the side that it names: {found}");
}

#[test]
fn a_lens_that_the_second_step_states_is_reached_without_a_jump() {
    let hold = Step { start: about(1), ..Step::of(Move::Static) };
    let end = Framing { lens: Some(Lens::FovDeg(25.0)), ..about(1) };
    let program = Program { steps: vec![hold, Step { end, ..Step::of(Move::PushIn) }], ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
    let frames = film(&realize(&world(), &program, "", &[], &settings));
    assert!((frames[frames.len() - 1].fov_y_rad.to_degrees() - 25.0).abs() < 1e-6);
    assert!(frames.windows(2).all(|pair| (pair[0].fov_y_rad - pair[1].fov_y_rad).abs() < 0.06));
}

#[test]
fn a_follow_ends_as_the_prompt_frames_its_subject() {
    let end = Framing {
        side: Some(SubjectSide::FromFront),
        elevation_deg: Some(15.0),
        height_frac: Some(0.6),
        place: Some(FramePlace::AtRight),
        ..about(1)
    };
    let solution = solved(&world(), vec![Step { start: about(2), end, ..Step::of(Move::Follow) }]);
    let frames = film(&solution);
    let last = &frames[frames.len() - 1];
    let away = last.pose.position - CENTER;
    assert!(away.with_y(0.0).angle_between(DVec3::new(-1.2, 0.0, -0.9)).to_degrees() < 41.0);
    assert!(((away.y / away.length()).asin().to_degrees() - 15.0).abs() < 6.0);
    assert!((height(last) - 0.6).abs() < 0.09, "{}", height(last));
    assert!(in_frame(last, CENTER).distance(DVec2::new(1.0 / 6.0, 0.0)) < 0.01);
    for words in ["from front", "degrees above box 1", "of the frame's height", "on the right third"] {
        assert_met(&solution, words);
    }
}
