//! How one move flows into the next, and the rest before the first and after the last.
//!
//! Enters: the segments of a film, each from rest to rest. Leaves: the segments as they are filmed: where two moves
//! follow each other, the first one hands its speed over to the second one in a blend ([`Easing::Blend`]), so that the
//! camera never stands still and passes close by the state that the two share. Where the words ask for a stop, and at
//! holds, cuts, whip pans and handheld takes, it stops there.

use super::cost::path_of;
use super::motion::MotionSegment;
use super::program::{Look, Program};
use super::stops::asks_for_stop;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Easing, Move, ramp_secs};

/// Longest blend. The camera passes the corner between two moves at 9 % of the speed difference times this.
const MAX_BLEND_SECS: f64 = 1.2;
/// Largest fraction of a segment's time that one blend replaces, twice: half a blend lies in each segment.
const BLEND_FRAC: f64 = 0.6;
/// A shorter blend is a jolt: the camera stops instead.
const MIN_BLEND_SECS: f64 = 0.25;
/// Largest turn to a new aim that a blend takes in, so that the subject of the first move is still in the frame's
/// middle when that move ends; radians.
const SMALL_TURN_RAD: f64 = 0.17;

/// A film whose moves flow into each other.
#[derive(Debug, Clone)]
pub(super) struct Flow {
    /// The segments that are filmed, with blends and rests.
    pub(super) segments: Vec<MotionSegment>,
    /// Start and end of each given segment in the film, seconds. Moves that flow into each other meet in the middle of
    /// their blend.
    pub(super) spans: Vec<[f64; 2]>,
    /// The blends: index of the given segment before each, and its time in the film.
    blends: Vec<(usize, [f64; 2])>,
}

/// Two segments that flow into each other. A small turn between them, which the blend takes in, is left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Joint {
    from: usize,
    to: usize,
    /// Longest blend.
    most_secs: f64,
}

/// The places where moves flow into each other.
pub(super) fn joints(program: &Program, prompt: &str, segments: &[MotionSegment]) -> Vec<Joint> {
    let flows = |from: usize, to: usize| {
        let (a, b) = (&segments[from], &segments[to]);
        let stops = a.step != b.step && asks_for_stop(program, prompt, a.step, b.step);
        !b.cut && !stops && leaves_in_motion(program, a) && arrives_in_motion(program, b)
    };
    let mut out = Vec::new();
    let mut from = 0;
    while from + 1 < segments.len() {
        let skips = is_small_turn(&segments[from + 1]) && from + 2 < segments.len();
        let skips = skips && flows(from, from + 1) && flows(from + 1, from + 2);
        let to = if skips { from + 2 } else { from + 1 };
        if flows(from, to) {
            out.push(Joint { from, to, most_secs: MAX_BLEND_SECS });
        }
        from = to;
    }
    out
}

/// Whether a segment only turns the camera a little.
fn is_small_turn(segment: &MotionSegment) -> bool {
    let (first, last) = (segment.states[0], segment.last());
    segment.is_join
        && first.pose.position == last.pose.position
        && first.fov_y_rad.to_bits() == last.fov_y_rad.to_bits()
        && rotation::angle_between(first.pose.rotation, last.pose.rotation) <= SMALL_TURN_RAD
}

fn leaves_in_motion(program: &Program, segment: &MotionSegment) -> bool {
    moves_on(program, segment) && matches!(segment.easing, Easing::Smooth | Easing::Linear | Easing::EaseIn)
}

/// A camera that looks along its path does so from the first frame: it starts from rest.
fn arrives_in_motion(program: &Program, segment: &MotionSegment) -> bool {
    let look = program.steps.get(segment.step).and_then(|step| step.look.as_ref());
    let along = matches!(look, Some(Look::Ahead | Look::Back));
    moves_on(program, segment) && !along && matches!(segment.easing, Easing::Smooth | Easing::Linear | Easing::EaseOut)
}

/// Whether a segment is a move that may flow: no hold, no whip, no shake.
fn moves_on(program: &Program, segment: &MotionSegment) -> bool {
    let shaken = program.steps.get(segment.step).is_some_and(|step| step.with.contains(&Move::Handheld));
    let still = matches!(segment.movement, Move::Static | Move::Handheld | Move::WhipPan | Move::RackFocus);
    let changes = segment.states.iter().any(|state| {
        let first = &segment.states[0];
        state.pose != first.pose || (state.fov_y_rad - first.fov_y_rad).abs() > 1e-9
    });
    changes && !still && !shaken
}

/// Shortens the segments of free length that do not stop, by the half of a ramp that is left out: their speed stays.
pub(super) fn without_stops(segments: &mut [MotionSegment], joints: &[Joint]) {
    let ramps: Vec<f64> = segments.iter().map(|segment| ramp_secs(segment.secs) / 2.0).collect();
    for index in joints.iter().flat_map(|joint| [joint.from, joint.to]) {
        if !segments[index].secs_bind {
            segments[index].secs -= ramps[index];
        }
    }
}

impl Flow {
    /// The film of `segments` with blends at the joints.
    pub(super) fn new(world: &World, segments: &[MotionSegment], joints: &[Joint]) -> Self {
        let blends: Vec<(Joint, f64)> =
            joints.iter().map(|joint| (*joint, blend_secs(segments, joint))).filter(|(_, secs)| *secs > 0.0).collect();
        let into = |index: usize| blends.iter().find(|(joint, _)| joint.to == index).map(|(_, secs)| *secs);
        let out_of = |index: usize| blends.iter().find(|(joint, _)| joint.from == index).map(|(_, secs)| *secs);
        let mut flow = Self { segments: Vec::new(), spans: Vec::new(), blends: Vec::new() };
        let mut at = 0.0;
        for (index, segment) in segments.iter().enumerate() {
            if is_left_out(segments, joints, index) {
                flow.spans.push([at, at]);
                continue;
            }
            let cut_off = [into(index), out_of(index)];
            let [before, after] = cut_off.map(|secs| secs.unwrap_or(0.0) / 2.0);
            let trimmed = trimmed(world, segment, cut_off);
            if let Some(secs) = into(index) {
                let last = flow.segments.last().map_or(trimmed.states[0], MotionSegment::last);
                flow.segments.push(blend(segment.step, [last, trimmed.states[0]], secs));
                flow.blends.push((index, [at - before, at + before]));
            }
            flow.segments.push(trimmed);
            let end = at + segment.secs.max(before + after);
            flow.spans.push([at, end]);
            at = end;
        }
        flow.change_speed_throughout();
        flow
    }

    /// Where the words ask for a change of speed, a straight move between cuts, holds or the ends of the film changes
    /// it all the way: a ramp at one end would not show. A move that flows on keeps its cruise. Whip pans change it all
    /// the way too, with no jolt.
    fn change_speed_throughout(&mut self) {
        for nth in 0..self.segments.len() {
            let rests = |other: &MotionSegment| other.movement == Move::Static;
            let begins = nth == 0 || self.segments[nth].cut || rests(&self.segments[nth - 1]);
            let ends = self.segments.get(nth + 1).is_none_or(|next| next.cut || rests(next));
            let segment = &mut self.segments[nth];
            segment.easing = match segment.easing {
                Easing::EaseIn if segment.states.len() == 2 && begins && ends => Easing::SineIn,
                // Ramps of a fifth of a second would be jolts.
                Easing::Smooth if segment.states.len() == 2 && segment.movement == Move::WhipPan => Easing::SineInOut,
                Easing::EaseOut if segment.states.len() == 2 && begins && ends => Easing::SineOut,
                easing => easing,
            };
        }
    }

    /// Length of the film.
    pub(super) fn secs(&self) -> f64 {
        self.segments.iter().map(|segment| segment.secs).sum()
    }

    /// Adds rest before the first move and after the last one.
    pub(super) fn add_handles(&mut self, [before_secs, after_secs]: [f64; 2]) {
        let rest = |segment: &MotionSegment, state: CameraState, secs: f64| {
            let mut rest = MotionSegment::new(segment.step, segment.movement, vec![state, state], secs);
            rest.is_join = true;
            rest
        };
        if let (Some(last), true) = (self.segments.last(), after_secs > 0.0) {
            self.segments.push(rest(last, last.last(), after_secs));
        }
        if let (Some(first), true) = (self.segments.first(), before_secs > 0.0) {
            let rest = rest(first, first.states[0], before_secs);
            self.segments.insert(0, rest);
            let later = |[from, to]: &mut [f64; 2]| (*from, *to) = (*from + before_secs, *to + before_secs);
            self.spans.iter_mut().for_each(later);
            self.blends.iter_mut().for_each(|(_, span)| later(span));
        }
    }

    /// Index of the given segment at the end of the blend that plays in an interval of time.
    pub(super) fn blend_in(&self, from_secs: f64, to_secs: f64) -> Option<usize> {
        self.blends.iter().find(|(_, [from, to])| from_secs < *to && to_secs > *from).map(|(index, _)| *index)
    }
}

/// The joints with the blend into a segment halved; without it where it was short already.
pub(super) fn tightened(joints: &[Joint], into: usize) -> Vec<Joint> {
    let tighter = |joint: &Joint| {
        let most_secs = if joint.to == into { joint.most_secs / 2.0 } else { joint.most_secs };
        (most_secs >= MIN_BLEND_SECS).then_some(Joint { most_secs, ..*joint })
    };
    joints.iter().filter_map(tighter).collect()
}

/// Whether a blend leaves out a segment.
pub(super) fn is_left_out(segments: &[MotionSegment], joints: &[Joint], index: usize) -> bool {
    let spans = |joint: &&Joint| joint.from < index && index < joint.to;
    joints.iter().find(spans).is_some_and(|joint| blend_secs(segments, joint) > 0.0)
}

/// Duration of the blend at a joint; 0 where there is no room for one.
fn blend_secs(segments: &[MotionSegment], joint: &Joint) -> f64 {
    let room = segments[joint.from].secs.min(segments[joint.to].secs);
    let secs = joint.most_secs.min(BLEND_FRAC * room);
    if secs >= MIN_BLEND_SECS { secs } else { 0.0 }
}

fn blend(step: usize, states: [CameraState; 2], secs: f64) -> MotionSegment {
    let mut blend = MotionSegment::new(step, Move::Follow, states.to_vec(), secs);
    (blend.easing, blend.is_join) = (Easing::Blend, true);
    blend
}

/// The segment without the halves of the blends at its ends, where it has any: it then does not rest there.
fn trimmed(world: &World, segment: &MotionSegment, blends: [Option<f64>; 2]) -> MotionSegment {
    if blends == [None, None] {
        return segment.clone();
    }
    let rests = |index: usize, rests: bool| rests && blends[index].is_none();
    let easing = match (rests(0, segment.easing.rests_at_start()), rests(1, segment.easing.rests_at_end())) {
        (true, true) => Easing::Smooth,
        (true, false) => Easing::EaseIn,
        (false, true) => Easing::EaseOut,
        (false, false) => Easing::Linear,
    };
    let whole = MotionSegment { easing, ..segment.clone() };
    let path = path_of(world, &whole);
    let [before, after] = blends.map(|secs| secs.unwrap_or(0.0) / 2.0);
    let end = segment.secs - after;
    // An inner key right beside an end would bend the path.
    let room = 0.1 * (end - before) / (segment.states.len() - 1) as f64;
    let inner = path.keyframes().iter().filter(|key| key.time_secs > before + room && key.time_secs < end - room);
    let inner = inner.map(CameraState::from);
    let states = std::iter::once(path.sample(before)).chain(inner).chain(std::iter::once(path.sample(end))).collect();
    MotionSegment { states, secs: end - before, ..whole }
}
