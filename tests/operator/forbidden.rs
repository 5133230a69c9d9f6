//! Forbidden motions: the film avoids what it can, and the report says what it contains.

use cinesplat::operator::{Framing, Motion, Program, Solution, SolveLevel, SolveSettings, Step, realize};
use cinesplat::trajectory::{Move, ReportLine};
use glam::DVec3;

use super::{film, world};

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn solved(steps: Vec<Step>, forbidden: &[Motion]) -> Solution {
    let program = Program { steps, forbidden: forbidden.to_vec(), ..Program::default() };
    realize(
        &world(),
        &program,
        "",
        &[],
        &SolveSettings { level: SolveLevel::Fast, seed: 3, ..SolveSettings::default() },
    )
}

fn line<'a>(solution: &'a Solution, clause: &str) -> &'a ReportLine {
    solution.report.iter().find(|line| line.clause == clause).expect(clause)
}

#[test]
fn a_push_in_neither_turns_nor_zooms() {
    let step = Step { end: about(1), ..Step::of(Move::PushIn) };
    let solution = solved(vec![step], &[Motion::Zoom, Motion::Roll, Motion::Turn, Motion::Travel, Motion::Cut]);
    for clause in ["no zoom", "no roll", "no turn", "no cut"] {
        assert!(line(&solution, clause).met, "{clause}: {:?}", line(&solution, clause));
    }
    let travel = line(&solution, "no travel");
    let frames = film(&solution);
    let far = frames[0].pose.position.distance(frames[frames.len() - 1].pose.position);
    assert!(!travel.met && (travel.got - far).abs() < 1e-6, "{travel:?}");
    assert!(travel.note.contains("push-in"), "{travel:?}");
}

#[test]
fn a_program_with_a_forbidden_move_is_not_met() {
    let pan = Step { start: about(2), end: about(1), either_way: true, ..Step::of(Move::PanRight) };
    let cut = Step { end: about(1), cut: true, ..Step::of(Move::Handheld) };
    let solution = solved(vec![pan, cut], &[Motion::Pan, Motion::Shake, Motion::Cut]);
    let frames = film(&solution);
    assert!(line(&solution, "no pan").got > 10.0 && !line(&solution, "no pan").met);
    assert!(!line(&solution, "no shake").met && !line(&solution, "no cut").met);
    assert!((line(&solution, "no cut").got - 1.0).abs() < 1e-12);
    assert!(frames.len() > 2);
}

#[test]
fn where_turns_are_forbidden_no_step_begins_with_one() {
    let truck = Step { start: about(1), ..Step::of(Move::TruckLeft) };
    let push = Step { end: about(1), ..Step::of(Move::PushIn) };
    let solution = solved(vec![truck, push], &[Motion::Turn]);
    let frames = film(&solution);
    let forward = frames[0].pose.forward();
    assert!(frames.iter().all(|s| s.pose.forward().angle_between(forward).to_degrees() < 0.5));
    assert!(line(&solution, "no turn").met);
    assert!(frames[0].pose.position.distance(DVec3::ZERO).is_finite());
}

#[test]
fn a_follow_without_turns_only_travels() {
    let step = Step { start: about(2), end: about(1), ..Step::of(Move::Follow) };
    let solution = solved(vec![step], &[Motion::Turn, Motion::Zoom]);
    let frames = film(&solution);
    let forward = frames[0].pose.forward();
    assert!(frames.iter().all(|s| s.pose.forward().angle_between(forward).to_degrees() < 0.5));
    assert!(frames[0].pose.position.distance(frames[frames.len() - 1].pose.position) > 0.2);
    assert!(line(&solution, "no turn").met && line(&solution, "no zoom").met);
}

#[test]
fn a_push_in_that_looks_down_keeps_a_constant_height() {
    let from_above = Framing { elevation_deg: Some(30.0), ..about(1) };
    for step in [
        Step { start: from_above.clone(), end: about(1), ..Step::of(Move::PushIn) },
        Step { start: about(2), end: about(1), ..Step::of(Move::Follow) },
    ] {
        let free = solved(vec![step.clone()], &[]);
        let level = solved(vec![step], &[Motion::Rise]);
        let range = |solution: &Solution| {
            let heights: Vec<f64> = film(solution).iter().map(|state| state.pose.position.y).collect();
            heights.iter().copied().fold(f64::MIN, f64::max) - heights.iter().copied().fold(f64::MAX, f64::min)
        };
        assert!(range(&free) > 0.05 && range(&level) < 1e-6, "{} {}", range(&free), range(&level));
        assert!(line(&level, "no rise").met, "{:?}", line(&level, "no rise"));
        // The camera still travels, and looks at its subject.
        assert!(level.report.iter().filter(|line| line.clause != "no rise").all(|line| line.met), "{:?}", level.report);
    }
}
