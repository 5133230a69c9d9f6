//! Ends of a film that show what nobody wants to see.
//!
//! Enters: the segments of a film in a room. Leaves: the same segments; a slide that has to begin anywhere is shifted along
//! its line, and a move without a stated extent begins later or ends earlier, where that shows less void or meets more of
//! what the words ask for. Every requirement is measured again on the new path.

use super::cost::{cost, evenly_spaced};
use super::motion::MotionSegment;
use super::pictures::worst_void;
use super::program::{Framing, Program, Step};
use super::world::World;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move};

/// Void of a picture at an end from which on another end is looked for.
const LEAST_VOID: f64 = 0.15;
/// Cost from which on a requirement is violated.
const VIOLATED: f64 = 3.0;
/// Shifts of a slide along its line, over its length.
const SHIFTS: [f64; 6] = [-0.5, -0.35, -0.2, 0.2, 0.35, 0.5];
/// Parts of a path, as shares of its length: cut at its end, at its start, and at both.
const PARTS: [[f64; 2]; 8] =
    [[0.0, 0.85], [0.0, 0.7], [0.0, 0.55], [0.15, 1.0], [0.3, 1.0], [0.45, 1.0], [0.15, 0.85], [0.2, 0.75]];
/// Cost by which another end must be better.
const LEAST_GAIN: f64 = 0.12;
/// Points that divide a path of more than two cameras, over those of the path itself.
const FINENESS: usize = 16;

/// The segments of a program with better ends.
pub(super) fn bettered(world: &World, program: &Program, mut segments: Vec<MotionSegment>) -> Vec<MotionSegment> {
    if !world.is_indoor() {
        return segments;
    }
    // A film that returns ends where it begins.
    let returns = program.steps.iter().any(|step| step.returns);
    for index in 0..segments.len() {
        let Some(step) = program.steps.get(segments[index].step) else { continue };
        let opens = (index == 0 && !returns || segments[index].cut) && is_open(&step.start);
        let closes = segments.get(index + 1).is_none_or(|next| next.cut) && is_open(&step.end);
        if is_bad(world, &segments[index]) {
            let slid = if opens && closes && is_slide(&segments[index]) {
                shifted(world, &segments[index])
            } else {
                segments[index].clone()
            };
            segments[index] = if may_be_shorter(step, &slid) { shortened(world, &slid, [opens, closes]) } else { slid };
        }
    }
    segments
}

/// Whether the words leave a picture open but for what is in it: a close-up at the start is no end to trade.
fn is_open(framing: &Framing) -> bool {
    *framing == Framing { subjects: framing.subjects.clone(), ..Framing::default() }
}

fn is_bad(world: &World, segment: &MotionSegment) -> bool {
    !segment.is_join && (void(world, segment) > LEAST_VOID || cost(world, segment, None) >= VIOLATED)
}

/// Void in the worse of the pictures at the ends.
fn void(world: &World, segment: &MotionSegment) -> f64 {
    worst_void(world, [segment.states[0], segment.last()].into_iter())
}

fn is_slide(segment: &MotionSegment) -> bool {
    matches!(segment.movement, Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown)
}

/// Whether the words leave the extent of a segment open.
fn may_be_shorter(step: &Step, segment: &MotionSegment) -> bool {
    let is_way = is_slide(segment)
        || matches!(
            segment.movement,
            Move::PushIn
                | Move::PullOut
                | Move::CraneUp
                | Move::CraneDown
                | Move::OrbitLeft
                | Move::OrbitRight
                | Move::ArcLeft
                | Move::ArcRight
                | Move::ZoomIn
                | Move::ZoomOut
                | Move::Reveal
        );
    is_way && step.amount.is_none() && !step.returns
}

/// A slide at the place of its line where it costs least.
fn shifted(world: &World, segment: &MotionSegment) -> MotionSegment {
    let way = segment.last().pose.position - segment.states[0].pose.position;
    let by = |share: &f64| {
        let moved = |state: &CameraState| CameraState {
            pose: Pose { position: state.pose.position + way * *share, ..state.pose },
            ..*state
        };
        MotionSegment { states: segment.states.iter().map(moved).collect(), ..segment.clone() }
    };
    better(world, segment, SHIFTS.iter().map(by).collect())
}

/// The part of a segment that costs least; `[opens, closes]` says which ends nothing else joins.
fn shortened(world: &World, segment: &MotionSegment, [opens, closes]: [bool; 2]) -> MotionSegment {
    let allowed = |[from, to]: &&[f64; 2]| (opens || *from <= 0.0) && (closes || *to >= 1.0);
    let intervals = FINENESS * (segment.states.len() - 1);
    let fine = evenly_spaced(world, segment, intervals + 1);
    let part = |[from, to]: &[f64; 2]| {
        let last = segment.states.len() - 1;
        let index = |i: usize| {
            let share = from + (to - from) * i as f64 / last as f64;
            ((share * intervals as f64).round() as usize).min(intervals)
        };
        MotionSegment { states: (0..=last).map(|i| fine[index(i)]).collect(), ..segment.clone() }
    };
    better(world, segment, PARTS.iter().filter(allowed).map(part).collect())
}

/// The cheapest of some segments, or the segment as it is where none is clearly better.
fn better(world: &World, segment: &MotionSegment, others: Vec<MotionSegment>) -> MotionSegment {
    let priced = others.into_iter().map(|other| (cost(world, &other, None), other));
    let best = priced.min_by(|a, b| a.0.total_cmp(&b.0));
    let as_planned = cost(world, segment, None);
    best.filter(|(cost, _)| *cost < as_planned - LEAST_GAIN).map_or_else(|| segment.clone(), |(_, other)| other)
}
