//! Limits of a program: the finished film keeps them at every moment, measured here by its frames, and the report says where it
//! cannot.

use cinesplat::operator::{Framing, Level, Limit, Program, Solution, SolveLevel, SolveSettings, Step, realize};
use cinesplat::trajectory::Move;

use super::{brute_force, film, room, world};

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn solved(step: Step, limits: &[Limit]) -> Solution {
    solved_all(vec![step], limits)
}

fn solved_all(steps: Vec<Step>, limits: &[Limit]) -> Solution {
    let program = Program { steps, limits: limits.to_vec(), ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Fast, seed: 3, ..SolveSettings::default() };
    realize(&world(), &program, "", &[], &settings)
}

/// What the report says of the limit whose clause begins so: whether it is met.
fn is_met(solution: &Solution, clause: &str) -> bool {
    solution.report.iter().find(|line| line.clause.starts_with(clause)).expect(clause).met
}

#[test]
fn the_camera_keeps_its_height_and_distance() {
    let step = || Step { end: about(1), ..Step::of(Move::PushIn) };
    let limits = [Limit::Above(Level::Units(0.9)), Limit::Below(Level::Units(1.3)), Limit::Clear(Some(1), 0.8)];
    let solution = solved(step(), &limits);
    let heights: Vec<f64> = film(&solution).iter().map(|state| state.pose.position.y).collect();
    let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(*y), high.max(*y)));
    assert!(low > 0.85 && high < 1.35, "{low} to {high}");
    assert!(is_met(&solution, "least height") && is_met(&solution, "largest height"), "{:?}", solution.report);
    // Box 1 is 0.6 wide and 1.2 high about (1.2, 0.6, 0.9).
    let nearest = |state: &cinesplat::trajectory::CameraState| {
        let off = (state.pose.position - glam::DVec3::new(1.2, 0.6, 0.9)).abs() - glam::DVec3::new(0.3, 0.6, 0.3);
        off.max(glam::DVec3::ZERO).length()
    };
    let distance = film(&solution).iter().map(nearest).fold(f64::MAX, f64::min);
    assert!(distance > 0.72, "{distance}");
    assert!(is_met(&solution, "least distance to box 1"));
}

#[test]
fn a_film_stays_away_from_all_matter() {
    let (gaussians, _) = room();
    let step = Step { end: about(2), ..Step::of(Move::TruckRight) };
    let solution = solved(step, &[Limit::Clear(None, 0.45)]);
    let near = |state: &cinesplat::trajectory::CameraState| brute_force(&gaussians, state.pose.position).0;
    let frames = film(&solution);
    let distance = frames.iter().step_by(4).map(near).fold(f64::MAX, f64::min);
    assert!(distance > 0.4, "{distance}");
    assert!(is_met(&solution, "least distance to anything"));
}

#[test]
fn a_film_takes_the_time_that_its_speeds_need() {
    let push = || Step { end: about(1), ..Step::of(Move::PushIn) };
    let free = solved(push(), &[]);
    let slow = solved(push(), &[Limit::Speed(0.1)]);
    assert!(slow.duration_secs > 2.0 * free.duration_secs, "{} {}", slow.duration_secs, free.duration_secs);
    let frames = film(&slow);
    let secs = slow.duration_secs / (frames.len() - 1) as f64;
    let speed =
        |pair: &[cinesplat::trajectory::CameraState]| pair[0].pose.position.distance(pair[1].pose.position) / secs;
    let fastest = frames.windows(2).map(speed).fold(0.0, f64::max);
    assert!(fastest < 0.104, "{fastest}");
    assert!(is_met(&slow, "largest speed"));
    let pan = Step { start: about(2), end: about(1), either_way: true, ..Step::of(Move::PanRight) };
    let slow = solved(pan, &[Limit::TurnSpeed(5.0)]);
    assert!(is_met(&slow, "fastest turn") && slow.duration_secs > 10.0, "{}", slow.duration_secs);
}

#[test]
fn a_limit_that_the_words_leave_no_time_for_is_not_met() {
    let push = Step { end: about(1), duration_secs: Some(1.0), ..Step::of(Move::PushIn) };
    assert!(!is_met(&solved(push, &[Limit::Speed(0.05)]), "largest speed"));
}

#[test]
fn a_step_of_stated_length_that_is_too_fast_does_not_slow_the_others() {
    let push = || Step { end: about(1), duration_secs: Some(1.0), ..Step::of(Move::PushIn) };
    let truck = || Step { end: about(2), either_way: true, ..Step::of(Move::TruckRight) };
    let limits = [Limit::Speed(0.1)];
    let (alone, both) = (solved(truck(), &limits), solved_all(vec![push(), truck()], &limits));
    assert!(!is_met(&both, "largest speed"));
    assert!(both.duration_secs < 4.0 * alone.duration_secs, "{} {}", both.duration_secs, alone.duration_secs);
}
