//! Turns a film away from what the capture lacks.
//!
//! Enters: the segments of a film in a room. Leaves: the same segments, all turned by one angle, where that shows less
//! void and breaks no requirement. A subject at the edge of a capture stands beside the middle of the frame then, and
//! what the capture has fills the rest.

use super::cost::cost;
use super::framing::{in_frame_frac, off_center};
use super::motion::MotionSegment;
use super::pictures::worst_void;
use super::program::{Framing, Program};
use super::world::World;
use cinesplat_geometry::{LevelAngles, Pose};
use cinesplat_trajectory::{CameraState, Move};

/// Void of a picture from which on a film is turned.
const LEAST_VOID: f64 = 0.04;
/// Turns that are tried, as shares of the frame's width and of its height by which the picture moves.
const TURNS: [[f64; 2]; 12] = [
    [-0.05, 0.0],
    [0.05, 0.0],
    [-0.1, 0.0],
    [0.1, 0.0],
    [0.0, -0.05],
    [0.0, 0.05],
    [0.0, -0.1],
    [0.0, 0.1],
    [-0.08, -0.08],
    [0.08, -0.08],
    [-0.08, 0.08],
    [0.08, 0.08],
];
/// Cost by which a turn must be better.
const LEAST_GAIN: f64 = 0.05;
/// Steepest pitch of a view that is turned, radians: near the vertical a turn is a roll.
const MAX_PITCH_RAD: f64 = 1.2;

/// The segments of a program, turned where that shows less void.
pub(super) fn turned_inward(world: &World, program: &Program, segments: Vec<MotionSegment>) -> Vec<MotionSegment> {
    let states = || segments.iter().flat_map(|segment| &segment.states);
    let pitch = |state: &CameraState| world.frame.angles(state.pose.rotation).pitch_rad;
    let is_steep = states().any(|state| pitch(state).abs() > MAX_PITCH_RAD);
    if !world.is_indoor() || is_steep {
        return segments;
    }
    let void = |segments: &[MotionSegment]| {
        worst_void(world, segments.iter().flat_map(|segment| [segment.states[0], segment.last()]))
    };
    let planned_void = void(&segments);
    if planned_void < LEAST_VOID {
        return segments;
    }
    let narrowest = states().map(|state| state.fov_y_rad).fold(f64::INFINITY, f64::min);
    let half = (narrowest / 2.0).tan();
    let total = |segments: &[MotionSegment]| segments.iter().map(|segment| cost(world, segment, None)).sum::<f64>();
    let as_planned = total(&segments);
    let may = |axis: usize| segments.iter().all(|segment| may_turn(program, segment)[axis]);
    let (may_across, may_down) = (may(0), may(1));
    let allowed = |[across, down]: &&[f64; 2]| (may_across || *across == 0.0) && (may_down || *down == 0.0);
    let turned = TURNS.iter().filter(allowed).map(|[across, down]| {
        let angles = [(across * 2.0 * half * world.aspect).atan(), (down * 2.0 * half).atan()];
        segments.iter().map(|segment| turned_by(world, segment, angles)).collect::<Vec<_>>()
    });
    let whole = turned.filter(|turned| !loses_subject(world, program, &segments, turned));
    let turned = whole.map(|turned| (total(&turned), turned));
    match turned.min_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((cost, turned)) if cost < as_planned - LEAST_GAIN && void(&turned) < planned_void => turned,
        _ => segments,
    }
}

/// Share of a subject that may leave the frame.
const MOST_LOST: f64 = 0.02;
/// Distance of a subject's middle from the frame's middle beyond which no turn takes it.
const MOST_OFF: f64 = 0.19;

/// Whether more of a step's subject is out of the frame at an end of a segment than before, or the subject that the end is
/// about stands farther aside than on a third.
fn loses_subject(world: &World, program: &Program, before: &[MotionSegment], after: &[MotionSegment]) -> bool {
    before.iter().zip(after).any(|(before, after)| {
        let Some(step) = program.steps.get(before.step) else { return false };
        let ends = [(&step.start, before.states[0], after.states[0]), (&step.end, before.last(), after.last())];
        let strays = |(framing, before, after): &(&Framing, CameraState, CameraState)| {
            let id = framing.subjects.first().copied();
            let first = id.and_then(|id| world.subject(id));
            let off = |state: &CameraState| first.map_or(0.0, |subject| off_center(world, state, subject.center));
            // What the film goes on to is not what this picture is of.
            let upstaged = |state: &CameraState| id.is_some_and(|id| is_upstaged(world, program, id, state));
            off(after) > MOST_OFF.max(off(before)) || upstaged(after) && !upstaged(before)
        };
        let mut subjects = step.start.subjects.iter().chain(&step.end.subjects).filter_map(|id| world.subject(*id));
        let is_aside = !before.is_join && ends.iter().any(strays);
        is_aside
            || subjects.any(|subject| {
                let shown = |state: &CameraState| in_frame_frac(world, state, &subject.points, 0.0);
                let ends = [(before.states[0], after.states[0]), (before.last(), after.last())];
                ends.iter().any(|(before, after)| shown(before) - shown(after) > MOST_LOST)
            })
    })
}

/// Whether another subject of the film stands nearer to the middle of a picture than the one that it is of.
fn is_upstaged(world: &World, program: &Program, own: u32, state: &CameraState) -> bool {
    let off = |id: u32| world.subject(id).map(|subject| off_center(world, state, subject.center));
    let framings = program.steps.iter().flat_map(|step| [&step.start, &step.end]);
    let mut others = framings.flat_map(|framing| &framing.subjects).filter(|id| **id != own);
    off(own).is_some_and(|own| others.any(|id| off(*id).is_some_and(|other| other < own)))
}

/// Whether a segment stays the move that its words ask for where its cameras look to the side, and where they look up
/// or down: circles and cranes keep their subject in the middle, a truck goes along the camera's right, and a dolly
/// without a subject along its view axis.
fn may_turn(program: &Program, segment: &MotionSegment) -> [bool; 2] {
    let Some(step) = program.steps.get(segment.step) else { return [false; 2] };
    let is_about_nothing = step.start.subjects.is_empty() && step.end.subjects.is_empty();
    if segment.is_join {
        return [true; 2];
    }
    if step.look.is_some() {
        return [false; 2];
    }
    let moves = std::iter::once(&segment.movement).chain(&step.with);
    moves.fold([true; 2], |[across, down], movement| match movement {
        Move::TruckLeft | Move::TruckRight => [false, down],
        Move::PushIn | Move::PullOut if is_about_nothing => [false; 2],
        Move::CraneUp
        | Move::CraneDown
        | Move::OrbitLeft
        | Move::OrbitRight
        | Move::ArcLeft
        | Move::ArcRight
        | Move::DollyZoomIn
        | Move::DollyZoomOut => [false; 2],
        _ => [across, down],
    })
}

/// A segment whose cameras look that much farther to the right and up, radians.
fn turned_by(world: &World, segment: &MotionSegment, [right_rad, up_rad]: [f64; 2]) -> MotionSegment {
    let mut turned = segment.clone();
    for state in &mut turned.states {
        let angles = world.frame.angles(state.pose.rotation);
        let rotation = world.frame.rotation(LevelAngles {
            yaw_rad: angles.yaw_rad + right_rad,
            pitch_rad: angles.pitch_rad + up_rad,
            ..angles
        });
        state.pose = Pose { rotation, ..state.pose };
    }
    turned
}
