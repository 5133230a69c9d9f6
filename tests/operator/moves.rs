//! Every move follows the definition of `Move`, measured on the film.

use cinesplat::geometry::{LevelFrame, rotation};
use cinesplat::operator::{
    Amount, Framing, Look, Pass, Program, Slant, SolveLevel, SolveSettings, Step, StepCameras, Via, realize,
};
use cinesplat::trajectory::{CameraState, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::composition::HALF;
use super::{film, solved, world};

const CENTER: DVec3 = DVec3::new(1.2, 0.6, 0.9);

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn filmed(step: Step) -> Vec<CameraState> {
    film(&solved(&world(), vec![step]))
}

fn turn(a: &CameraState, b: &CameraState) -> f64 {
    rotation::angle_between(a.pose.rotation, b.pose.rotation).to_degrees()
}

#[test]
fn push_in_is_straight_without_a_turn_and_leaves_the_lens_alone() {
    let frames = filmed(Step { end: about(1), ..Step::of(Move::PushIn) });
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(last.pose.position.distance(CENTER) < 0.77 * first.pose.position.distance(CENTER));
    for state in &frames {
        assert!(turn(first, state) < 1e-6 && (state.fov_y_rad - first.fov_y_rad).abs() < 1e-12);
        assert!((state.pose.position - first.pose.position).cross(first.pose.forward()).length() < 1e-9);
    }
}

#[test]
fn a_pan_turns_right_in_place_from_one_to_the_other() {
    let frames = filmed(Step { start: about(2), end: about(1), either_way: true, ..Step::of(Move::PanRight) });
    let last = &frames[frames.len() - 1];
    // The box is twice as high as wide: the camera ends on its middle or on its upper part.
    let (to_box, forward) = (CENTER - last.pose.position, last.pose.forward());
    let at = forward * to_box.with_y(0.0).length() / forward.with_y(0.0).length() - to_box;
    assert!(at.with_y(0.0).length() < 1e-6 && (-1e-9..0.3).contains(&at.y), "ends on the box: {at} from its middle");
    assert!(frames.iter().all(|s| s.pose.position.distance(last.pose.position) < 1e-12));
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    assert!(frames.iter().all(|s| frame.roll_rad(&s.pose).abs() < 1e-9), "level on the way");
}

#[test]
fn orbits_sweep_the_stated_angle_at_one_radius() {
    for (movement, sign) in [(Move::OrbitRight, 1.0), (Move::OrbitLeft, -1.0)] {
        let amount = Some(Amount::Degrees(75.0));
        let frames = filmed(Step { start: about(1), amount, ..Step::of(movement) });
        // Counter-clockwise from above (looking down -y): the angle from +z toward +x grows.
        let angle = |s: &CameraState| (s.pose.position - CENTER).x.atan2((s.pose.position - CENTER).z);
        let swept: f64 = frames
            .windows(2)
            .map(|p| {
                (angle(&p[1]) - angle(&p[0]) + 3.0 * std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                    - std::f64::consts::PI
            })
            .sum();
        assert!((swept.to_degrees() - sign * 75.0).abs() < 0.5, "{}: {}", movement.as_ref(), swept.to_degrees());
        let radius = |s: &CameraState| (s.pose.position - CENTER).with_y(0.0).length();
        assert!(frames.iter().all(|s| (radius(s) / radius(&frames[0]) - 1.0).abs() < 1e-3));
    }
}

#[test]
fn a_dolly_zoom_keeps_the_size_of_its_subject() {
    let frames = filmed(Step { start: about(1), ..Step::of(Move::DollyZoomIn) });
    let corners =
        (0..8).map(|i| CENTER + HALF * DVec3::from([1, 2, 4].map(|bit| f64::from(i & bit).min(1.0) * 2.0 - 1.0)));
    let corners: Vec<DVec3> = corners.collect();
    // Its height in the frame, up to a factor: its near side is what one sees.
    let height = |s: &CameraState| {
        let rows = corners.iter().map(|corner| s.pose.to_camera(*corner)).map(|at| at.y / at.z);
        let (low, high) = rows.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
        (high - low) / (s.fov_y_rad / 2.0).tan()
    };
    for state in &frames {
        let change = height(state) / height(&frames[0]);
        assert!((change - 1.0).abs() < 0.03, "{change}");
    }
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(last.fov_y_rad > first.fov_y_rad, "in: the lens widens");
    assert!(last.pose.position.distance(CENTER) < 0.8 * first.pose.position.distance(CENTER));
}

#[test]
fn trucks_and_pedestals_do_not_turn() {
    for movement in [Move::TruckLeft, Move::TruckRight, Move::PedestalUp, Move::PedestalDown] {
        let frames = filmed(Step { start: about(1), ..Step::of(movement) });
        let (first, last) = (&frames[0], &frames[frames.len() - 1]);
        let axis = match movement {
            Move::TruckLeft => -first.pose.right(),
            Move::TruckRight => first.pose.right(),
            Move::PedestalUp => DVec3::Y,
            _ => DVec3::NEG_Y,
        };
        let way = last.pose.position - first.pose.position;
        assert!(way.dot(axis) > 0.99 * way.length() && way.length() > 0.2, "{}: {way}", movement.as_ref());
        assert!(frames.iter().all(|s| turn(first, s) < 1e-6));
    }
}

#[test]
fn a_medium_shot_frames_its_subject_at_medium_height() {
    let framing = Framing { size: Some(ShotSize::Medium), ..about(1) };
    let solution = solved(&world(), vec![Step { start: framing, ..Step::of(Move::Static) }]);
    let line = solution.report.iter().find(|line| line.wanted.contains("frame's height")).unwrap();
    assert!(line.met && (0.6..=0.8).contains(&line.got), "{line:?}");
}

#[test]
fn stated_durations_are_kept() {
    let world = world();
    let hold = Step { start: about(1), duration_secs: Some(2.0), ..Step::of(Move::Static) };
    let push = Step { end: about(1), ..Step::of(Move::PushIn) };
    let program = Program { steps: vec![hold, push], duration_secs: Some(7.0), ..Program::default() };
    let solution = realize(&world, &program, "", &[], &SolveSettings { seed: 1, ..SolveSettings::default() });
    assert!((solution.duration_secs - 7.0).abs() < 1e-9);
    assert!((solution.keyframes[1].time_secs - 2.0).abs() < 1e-6, "the hold lasts two seconds");
}

#[test]
fn a_contradiction_is_reported_and_still_gives_a_film() {
    let world = world();
    // An extreme close-up of both boxes, wholly in the frame, contradicts itself.
    let start =
        Framing { subjects: vec![1, 2], whole: true, size: Some(ShotSize::ExtremeCloseUp), ..Framing::default() };
    let solution = solved(&world, vec![Step { start, ..Step::of(Move::Static) }]);
    assert!(solution.report.iter().any(|line| !line.met && !line.note.is_empty()));
    assert!(film(&solution).iter().all(|s| s.pose.position.is_finite()));
}

#[test]
fn a_held_view_puts_its_subject_on_a_third_and_a_push_in_the_middle() {
    let frames = filmed(Step { start: about(2), ..Step::of(Move::Static) });
    let state = &frames[0];
    let away = DVec3::new(-1.2, 0.5, 0.8) - state.pose.position;
    let width = 2.0 * away.dot(state.pose.forward()) * (state.fov_y_rad / 2.0).tan() * 16.0 / 9.0;
    let across = away.dot(state.pose.right()) / width;
    assert!((across.abs() - 1.0 / 6.0).abs() < 1e-4, "{across} of the width from the middle");
    let push = filmed(Step { end: about(2), ..Step::of(Move::PushIn) });
    let away = DVec3::new(-1.2, 0.5, 0.8) - push[0].pose.position;
    assert!(away.angle_between(push[0].pose.forward()) < 1e-6);
}

#[test]
fn a_dutch_angle_slants_every_frame_and_the_report_says_so() {
    let step = Step { start: about(1), amount: Some(Amount::Degrees(60.0)), ..Step::of(Move::OrbitRight) };
    let program = Program { steps: vec![step], ..Program::default() };
    let slant = Some(Slant { degrees: 15.0, steps: [0, 0] });
    let settings = SolveSettings { slant, level: SolveLevel::Fast, ..SolveSettings::default() };
    let solution = realize(&world(), &program, "", &[], &settings);
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    for state in film(&solution) {
        let roll = frame.roll_rad(&state.pose).to_degrees();
        assert!((roll - 15.0).abs() < 1e-6, "roll {roll}");
    }
    assert!(solution.report.iter().any(|line| line.clause == "dutch angle" && line.met));
}

#[test]
fn a_dutch_angle_belongs_to_its_step() {
    let orbit = Step { start: about(1), amount: Some(Amount::Degrees(60.0)), ..Step::of(Move::OrbitRight) };
    let program = Program {
        steps: vec![Step { end: about(1), ..Step::of(Move::PushIn) }, orbit, Step::of(Move::PullOut)],
        ..Program::default()
    };
    let slant = Some(Slant { degrees: 15.0, steps: [1, 1] });
    let settings = SolveSettings { slant, level: SolveLevel::Fast, ..SolveSettings::default() };
    let solution = realize(&world(), &program, "", &[], &settings);
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let rolls: Vec<f64> = film(&solution).iter().map(|state| frame.roll_rad(&state.pose).to_degrees()).collect();
    let ends = [rolls[0], rolls[rolls.len() - 1]];
    assert!(ends.iter().all(|roll| roll.abs() < 1e-6), "level before and after: {ends:?}");
    let most = rolls.iter().copied().fold(0.0, f64::max);
    assert!((most - 15.0).abs() < 1e-6, "{most}");
    let steepest = rolls.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(steepest < 5.0, "leans over without a jump: {steepest}");
    assert!(solution.report.iter().any(|line| line.clause == "dutch angle" && line.met));
}

#[test]
fn without_a_search_the_move_is_exact_and_starts_from_the_suggested_side() {
    let world = world();
    let at = |position: DVec3| CameraState {
        pose: cinesplat::geometry::Pose::look_at(position, CENTER, DVec3::Y, None).unwrap(),
        fov_y_rad: 0.8,
        focus_distance: None,
    };
    // The second camera turns away from the subject and zooms: no push-in.
    let (start, mut end) = (at(DVec3::new(-0.5, 1.0, -1.5)), at(DVec3::new(0.2, 0.9, -0.4)));
    end.pose = cinesplat::geometry::Pose::look_at(end.pose.position, DVec3::ZERO, DVec3::Y, None).unwrap();
    end.fov_y_rad = 0.5;
    let suggestion = StepCameras { start, end, secs: 3.0 };
    let program = Program { steps: vec![Step { end: about(1), ..Step::of(Move::PushIn) }], ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Off, ..SolveSettings::default() };
    let solution = realize(&world, &program, "", &[suggestion], &settings);
    let frames = film(&solution);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    let side = |s: &CameraState| (s.pose.position - CENTER).with_y(0.0);
    let off = side(first).angle_between(side(&start)).to_degrees();
    assert!(off < 3.0, "{off} degrees from the suggested bearing");
    assert!(last.pose.position.distance(CENTER) < 0.76 * first.pose.position.distance(CENTER));
    assert!(frames.iter().all(
        |s| (s.fov_y_rad - first.fov_y_rad).abs() < 1e-9 && s.pose.forward().dot(first.pose.forward()) > 1.0 - 1e-9
    ));
    assert!(
        solution.report.iter().any(|line| line.clause == "clear of matter"),
        "the report measures the one candidate"
    );
}

#[test]
fn a_way_to_the_only_thing_named_comes_nearer() {
    let frames = filmed(Step { end: about(1), ..Step::of(Move::Follow) });
    let distance = |state: &CameraState| state.pose.position.distance(CENTER);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(distance(last) < 0.75 * distance(first), "{} to {}", distance(first), distance(last));
}

#[test]
fn a_walk_from_one_thing_to_another_does_not_lead_away_from_it() {
    let frames = filmed(Step { start: about(2), end: about(1), ..Step::of(Move::Follow) });
    let distance = |state: &CameraState| state.pose.position.distance(CENTER);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(distance(last) < 1.05 * distance(first), "{} to {}", distance(first), distance(last));
}

#[test]
fn a_rise_after_a_picture_keeps_its_subject_in_the_frame() {
    let steps = vec![Step { end: about(1), ..Step::of(Move::Static) }, Step::of(Move::PedestalUp)];
    for state in film(&solved(&world(), steps)) {
        let local = state.pose.rotation.inverse() * (CENTER - state.pose.position);
        let below = local.y / local.z / (2.0 * (state.fov_y_rad / 2.0).tan());
        assert!(below.abs() < 0.5, "{below} frame heights from the middle");
    }
}

#[test]
fn a_slide_from_thing_to_thing_does_not_go_along_a_third() {
    let slide = Step { start: about(2), end: about(1), ..Step::of(Move::TruckRight) };
    let along =
        Step { via: Some(Via { how: Pass::Along, objects: vec![1] }), look: Some(Look::At(vec![2])), ..slide.clone() };
    assert_eq!(solved(&world(), vec![along]).keyframes, solved(&world(), vec![slide]).keyframes);
}

#[test]
fn a_rack_focus_has_one_subject_near_and_the_other_far_behind_it() {
    let frames = filmed(Step { start: about(2), end: about(1), ..Step::of(Move::RackFocus) });
    let state = &frames[0];
    let depths = [CENTER, DVec3::new(-1.2, 0.5, 0.8)].map(|center| {
        let at = state.pose.to_camera(center);
        let half = (state.fov_y_rad / 2.0).tan() * at.z;
        assert!(at.z > 0.0 && at.y.abs() < half && at.x.abs() < half * 16.0 / 9.0, "in the frame: {at}");
        at.z
    });
    let ratio = depths[0].max(depths[1]) / depths[0].min(depths[1]);
    assert!(ratio > 1.25 && state.fov_y_rad.to_degrees() < 28.0, "depths {depths:?}");
}

#[test]
fn a_rack_focus_from_a_close_up_shows_what_it_racks_to() {
    let close = Framing { size: Some(ShotSize::CloseUp), ..about(2) };
    let frames = filmed(Step { start: close, end: about(1), ..Step::of(Move::RackFocus) });
    let state = &frames[0];
    let [far, near] = [CENTER, DVec3::new(-1.2, 0.5, 0.8)].map(|center| state.pose.to_camera(center));
    let half = (state.fov_y_rad / 2.0).tan() * far.z;
    assert!(far.z > near.z, "the close-up is of what is near: {near} {far}");
    assert!(far.y.abs() < half && far.x.abs() < half * 16.0 / 9.0, "in the frame: {far}");
}

#[test]
fn a_zoom_in_does_not_cut_what_it_goes_in_on() {
    let frames = filmed(Step { end: about(1), ..Step::of(Move::ZoomIn) });
    let state = &frames[frames.len() - 1];
    let at = state.pose.to_camera(CENTER + DVec3::new(0.0, 0.6, 0.0));
    let below = state.pose.to_camera(CENTER - DVec3::new(0.0, 0.6, 0.0));
    let height = |at: DVec3| at.y / at.z / (2.0 * (state.fov_y_rad / 2.0).tan());
    assert!(height(at).abs() < 0.5 && height(below).abs() < 0.5, "{} to {}", height(at), height(below));
}

#[test]
fn a_descent_from_above_that_circles_keeps_its_distance() {
    let angle = |angle| Framing { angle: Some(angle), ..about(1) };
    let frames = filmed(Step {
        start: angle(ShotAngle::Overhead),
        end: angle(ShotAngle::EyeLevel),
        with: vec![Move::OrbitRight],
        ..Step::of(Move::CraneDown)
    });
    let away = |state: &CameraState| state.pose.position - CENTER;
    let nearest = frames.iter().map(|state| away(state).length()).fold(f64::INFINITY, f64::min);
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    assert!(nearest > 0.85 * away(first).length(), "comes no nearer: {nearest}");
    assert!(first.pose.forward().y < -0.98 && last.pose.forward().y.abs() < 0.3, "from above to its level");
    let swept: f64 = frames
        .windows(2)
        .map(|pair| away(&pair[0]).with_y(0.0).angle_between(away(&pair[1]).with_y(0.0)).to_degrees())
        .sum();
    assert!(swept > 120.0, "circles by {swept} degrees");
}

#[test]
fn a_flight_between_two_things_is_level_with_their_middles() {
    let via = Some(Via { how: Pass::Between, objects: vec![1, 2] });
    let frames = filmed(Step { via, ..Step::of(Move::FlyThrough) });
    let heights = frames.iter().map(|state| state.pose.position.y);
    let (low, high) = heights.fold((f64::INFINITY, 0.0_f64), |(low, high), y| (low.min(y), high.max(y)));
    assert!(high - low < 0.05 && (0.3..1.0).contains(&low), "flies from {low} to {high}");
}
