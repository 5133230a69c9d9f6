//! Composition at the edge of a capture: where a room ends in void on one side, the camera turns towards what was
//! captured, and the subject stands off the middle on the side of the void.
//!
//! Enters: the segments of a move, aimed at the middle of their subjects. Leaves: the same segments, turned by a few
//! degrees where that takes void out of the frame. Scenes without void, stated places and stated turns stay as they are.

use glam::IVec2;

use super::compose::{is_same_camera, is_same_place, rejoin, turn_between, turned_by};
use super::context::StepContext;
use crate::constraint::ConstraintKind;
use crate::framing::{Target, in_frame_frac, off_center};
use crate::motion::MotionSegment;
use crate::pictures::{VoidMap, void_frac};
use crate::view::{aimed, lerp};
use cinesplat_trajectory::{CameraState, Move};

/// Void of a picture from which on another composition is looked for.
const LEAST_VOID: f64 = 0.05;
/// Distance of a subject from the frame's middle, over the frame's width and height, up to which it counts as in the
/// middle; what each unit beyond costs, as a share of void; and the largest distance: a little more than a third.
const FREE_OFF: f64 = 0.13;
const OFF_COST: f64 = 0.6;
const MOST_OFF: f64 = 0.185;
/// Distance from the middle that a subject at the edge of a capture is allowed, where the words want it in the middle.
const ALLOWED_OFF: f64 = 0.2;
/// The same for a subject on a third, with the least distance.
const THIRD_BAND: (f64, f64) = (0.135, 0.195);
/// Cost of the largest turn, as a share of void: less void than this is not worth it.
const TURN_COST: f64 = 0.04;

/// Turns the step's own motion, its last segment, away from void, and lets its join end where that motion then begins.
pub(super) fn fill_frame(context: &StepContext, segments: &mut Vec<MotionSegment>) {
    let Some(way) = way_of(context.step.movement) else { return };
    let stated = [&context.step.start, &context.step.end].iter().any(|framing| framing.place.is_some());
    if !context.world.is_indoor() || stated || context.step.look.is_some() || !context.forbidden.is_empty() {
        return;
    }
    // A stated turn is exact.
    if matches!(way, Way::SamePitch | Way::SameYaw) && context.step.amount.is_some() {
        return;
    }
    let Some(segment) = segments.last_mut().filter(|segment| !segment.is_join) else { return };
    let last = segment.states.len() - 1;
    let (first, end) = (segment.states[0], segment.states[last]);
    let continues = context.before.is_some_and(|before| is_same_camera(&before, &first));
    if way == Way::Same && continues {
        return;
    }
    let is_full = |state: &CameraState| void_frac(context.world, state) < LEAST_VOID;
    if is_full(&first) && (first == end || is_full(&end)) {
        return;
    }
    let third = segment.constraints.iter().any(|constraint| matches!(constraint.kind, ConstraintKind::OnThird(_)));
    // A move that keeps its direction is aimed at one subject from the beginning.
    let opening =
        if way == Way::Same && context.start.is_none() { context.main_target() } else { context.opening_target() };
    let first = Picture::of(context, &first, opening, third);
    let end = Picture::of(context, &end, context.main_target(), third);
    let Some((from, to)) = turns(context, way, continues, &first, &end) else { return };
    if from == (0.0, 0.0) && to == (0.0, 0.0) {
        return;
    }
    for (i, state) in segment.states.iter_mut().enumerate() {
        let share = i as f64 / last as f64;
        *state = turned_by(context, state, (lerp((from.0, to.0), share), lerp((from.1, to.1), share)));
    }
    for constraint in &mut segment.constraints {
        if let ConstraintKind::Centered(_, most) = &mut constraint.kind {
            *most = most.max(ALLOWED_OFF);
        }
    }
    rejoin(context, segments);
    segments.retain(|segment| !(segment.is_join && is_same_camera(&segment.states[0], &segment.last())));
}

/// How the turn of a move may differ between its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The camera keeps its direction: one turn for the whole move.
    Same,
    /// A pan has one pitch.
    SamePitch,
    /// A tilt has one yaw.
    SameYaw,
    /// Both ends for themselves.
    Free,
}

fn way_of(movement: Move) -> Option<Way> {
    match movement {
        Move::PanLeft | Move::PanRight | Move::WhipPan => Some(Way::SamePitch),
        Move::TiltUp | Move::TiltDown => Some(Way::SameYaw),
        Move::OrbitLeft
        | Move::OrbitRight
        | Move::ArcLeft
        | Move::ArcRight
        | Move::CraneUp
        | Move::CraneDown
        | Move::Follow
        | Move::Reveal => Some(Way::Free),
        Move::RollCw | Move::RollCcw | Move::FlyThrough | Move::RackFocus | Move::Handheld => None,
        _ => Some(Way::Same),
    }
}

/// The turns, yaw and pitch, of the first and of the last camera. `None` where they would make a pan or a tilt smaller.
fn turns(
    context: &StepContext,
    way: Way,
    continues: bool,
    first: &Picture,
    last: &Picture,
) -> Option<((f64, f64), (f64, f64))> {
    if way == Way::Same {
        let both = |at: IVec2| Some((first.cost(context, at)?.max(last.cost(context, at)?), at));
        let (_, at) = Picture::places().filter_map(both).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let keeps_last = |by: &(f64, f64)| last.keeps_subject(context, &turned_by(context, &last.state, *by));
        let by = first.turn_to_before(context).filter(keeps_last).unwrap_or_else(|| first.turn(context, at));
        return Some((by, by));
    }
    let free = |_: IVec2| true;
    let opening = || first.turn_to_before(context).unwrap_or_else(|| first.best(context, free));
    let from = || if continues { (0.0, 0.0) } else { opening() };
    let (from, to) = match way {
        // A pan from a free start looks up or down as a whole, a tilt to a side.
        Way::SamePitch if opens_freely(context, continues, first) => level_turns(context, first, last),
        Way::SameYaw if opens_freely(context, continues, first) => upright_turns(context, first, last),
        Way::SamePitch => ((from().0, 0.0), (last.best(context, free).0, 0.0)),
        Way::SameYaw => ((0.0, from().1), (0.0, last.best(context, free).1)),
        _ => (from(), last.best(context, free)),
    };
    // A pan or a tilt is a turn: it is not made smaller.
    let own = turn_between(context, &first.state, &last.state);
    let shrinks = (own.0 * (to.0 - from.0)).min(own.1 * (to.1 - from.1)) < 0.0;
    (way == Way::Free || !shrinks).then_some((from, to))
}

/// Whether a turn in place begins anywhere, so that both its ends may be moved alike.
fn opens_freely(context: &StepContext, continues: bool, first: &Picture) -> bool {
    !continues && first.turn_to_before(context).is_none()
}

/// The turns of both ends of a pan, with one pitch for both.
fn level_turns(context: &StepContext, first: &Picture, last: &Picture) -> ((f64, f64), (f64, f64)) {
    let rows = -VoidMap::MARGIN.y..=VoidMap::MARGIN.y;
    let (from, to) = best_pair(context, (first, last), rows.map(|row| move |at: IVec2| at.y == row));
    (from, (to.0, from.1))
}

/// The turns of both ends of a tilt, with one yaw for both.
fn upright_turns(context: &StepContext, first: &Picture, last: &Picture) -> ((f64, f64), (f64, f64)) {
    let columns = -VoidMap::MARGIN.x..=VoidMap::MARGIN.x;
    let (from, to) = best_pair(context, (first, last), columns.map(|column| move |at: IVec2| at.x == column));
    (from, (from.0, to.1))
}

/// The turns of two pictures to places on the line of the frame on which they cost least together; none where no line
/// has places for both.
fn best_pair<F: Fn(IVec2) -> bool>(
    context: &StepContext,
    (first, last): (&Picture, &Picture),
    lines: impl Iterator<Item = F>,
) -> ((f64, f64), (f64, f64)) {
    let both = |line: F| {
        let (from, to) = (first.cheapest(context, &line)?, last.cheapest(context, &line)?);
        Some((from.0 + to.0, from.1, to.1))
    };
    let best = lines.filter_map(both).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(((0.0, 0.0), (0.0, 0.0)), |(_, from, to)| (first.turn(context, from), last.turn(context, to)))
}

/// One end of a move: its camera, its target, and where its surroundings are void.
struct Picture {
    state: CameraState,
    target: Target,
    /// The subject stands on a third of the frame.
    is_on_third: bool,
    map: VoidMap,
}

impl Picture {
    fn of(context: &StepContext, state: &CameraState, target: Target, is_on_third: bool) -> Self {
        Self { state: *state, target, is_on_third, map: VoidMap::around(context.world, state) }
    }

    fn void(&self) -> f64 {
        self.map.void(IVec2::ZERO)
    }

    /// Turns by whole cells of the map, the unturned picture first.
    fn places() -> impl Iterator<Item = IVec2> {
        let most = VoidMap::MARGIN;
        let all = (-most.x..=most.x).flat_map(move |x| (-most.y..=most.y).map(move |y| IVec2::new(x, y)));
        std::iter::once(IVec2::ZERO).chain(all)
    }

    /// Void of the picture turned by some cells, with the cost of the turn. `None` where its subject would leave the
    /// middle or the frame.
    fn cost(&self, context: &StepContext, at: IVec2) -> Option<f64> {
        let share = at.as_dvec2() / VoidMap::MARGIN.as_dvec2();
        let cost = self.map.void(at) + TURN_COST * share.length();
        let turned = self.turned(context, at);
        let stays = at == IVec2::ZERO || self.keeps_subject(context, &turned);
        let beyond = if self.is_on_third { 0.0 } else { (self.off(context, &turned) - FREE_OFF).max(0.0) };
        stays.then_some(cost + OFF_COST * beyond)
    }

    /// Distance of the subject from the middle of the frame of a turned camera; 0 without a subject.
    fn off(&self, context: &StepContext, turned: &CameraState) -> f64 {
        let off = |point| off_center(context.world, turned, point);
        if self.target.ids.is_empty() { 0.0 } else { off(self.target.aim).max(off(self.target.center)) }
    }

    /// Whether the subject stays near the middle and as whole as it is, seen from a turned camera.
    fn keeps_subject(&self, context: &StepContext, turned: &CameraState) -> bool {
        let (world, target) = (context.world, &self.target);
        let off = self.off(context, turned);
        let framed = |state: &CameraState| in_frame_frac(world, state, &target.corners, 0.02);
        let (least, most) = if self.is_on_third { THIRD_BAND } else { (0.0, MOST_OFF) };
        target.ids.is_empty() || ((least..=most).contains(&off) && framed(turned) >= framed(&self.state))
    }

    /// The turn to the best of the allowed places.
    fn best(&self, context: &StepContext, allowed: impl Fn(IVec2) -> bool) -> (f64, f64) {
        self.cheapest(context, allowed).map_or((0.0, 0.0), |(_, at)| self.turn(context, at))
    }

    /// The best of the allowed places, with its cost.
    fn cheapest(&self, context: &StepContext, allowed: impl Fn(IVec2) -> bool) -> Option<(f64, IVec2)> {
        let priced = Self::places().filter(|at| allowed(*at)).filter_map(|at| Some((self.cost(context, at)?, at)));
        priced.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The turn back to the camera before, where it stands at the same place and its picture has no more void.
    fn turn_to_before(&self, context: &StepContext) -> Option<(f64, f64)> {
        let before = context.before.filter(|before| is_same_place(before, &self.state))?;
        let kept = self.keeps_subject(context, &before);
        let is_as_good = kept && void_frac(context.world, &before) <= self.void();
        is_as_good.then(|| turn_between(context, &self.state, &before))
    }

    fn turned(&self, context: &StepContext, at: IVec2) -> CameraState {
        let ahead = self.state.pose.position + self.map.direction(&self.state, at);
        aimed(context.world, &self.state, ahead)
    }

    fn turn(&self, context: &StepContext, at: IVec2) -> (f64, f64) {
        turn_between(context, &self.state, &self.turned(context, at))
    }
}
