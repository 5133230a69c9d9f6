//! The composition of a step's first and last picture: place of the subject in the frame, and lens.
//!
//! Enters: the segments of a move, aimed at the middle of their subjects. Leaves: the same segments, with the cameras
//! turned (of a slide: shifted along its line) and the lens set where the prompt states a place or a lens. Segments
//! without either stay as they are.

use glam::{DVec2, DVec3};

use super::context::StepContext;
use crate::composition::{frame_place, lens_fov_deg, placed};
use crate::constraint::{Constraint, ConstraintKind};
use crate::framing::{Target, frame_position};
use crate::motion::MotionSegment;
use crate::view::{lerp, moved, with_fov};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Move};

/// Composes the step's own motion, its last segment, and lets its join end where that motion then begins.
pub(super) fn compose(context: &StepContext, segments: &mut Vec<MotionSegment>) {
    let places = Places::of(context);
    let lenses = context.step.start.lens.is_some() || context.step.end.lens.is_some();
    if (!lenses && places.is_empty()) || segments.last().is_none_or(|segment| segment.is_join) {
        return;
    }
    if let Some(segment) = segments.last_mut() {
        if lenses {
            set_lens(context, segment);
        }
        if !places.is_empty() {
            place(context, &places, segment);
            segment.constraints.retain(|constraint| !places.replaces(constraint));
        }
    }
    rejoin(context, segments);
}

/// The places of the subjects at both ends of a step, and the points that are to be there.
struct Places {
    start: Option<DVec2>,
    end: Option<DVec2>,
    from: Target,
    to: Target,
    /// Both ends frame the same subject.
    same: bool,
}

impl Places {
    /// Where the prompt states the place for one end, a move that stays with its subject keeps it from the other end on.
    fn of(context: &StepContext) -> Self {
        let place = |place: Option<_>| place.map(frame_place);
        let (start, end) = (place(context.step.start.place), place(context.step.end.place));
        let (from, to) = (context.opening_target(), context.main_target());
        let same = from.ids.first() == to.ids.first();
        let stays = same && stays_with_subject(context.step.movement);
        let opens = context.before.is_none() || matches!(context.step.movement, Move::Static | Move::Handheld);
        Self { start: start.or(end.filter(|_| stays && opens)), end: end.or(start.filter(|_| stays)), from, to, same }
    }

    fn is_empty(&self) -> bool {
        self.start.is_none() && self.end.is_none()
    }

    /// Whether a constraint that wants a subject in the middle gives way to its place.
    fn replaces(&self, constraint: &Constraint) -> bool {
        match &constraint.kind {
            ConstraintKind::Centered(target, _) | ConstraintKind::OnThird(target) => {
                let is_of = |other: &Target| target.ids.first() == other.ids.first();
                (self.start.is_some() && is_of(&self.from)) || (self.end.is_some() && is_of(&self.to))
            }
            _ => false,
        }
    }
}

fn stays_with_subject(movement: Move) -> bool {
    !matches!(
        movement,
        Move::PanLeft
            | Move::PanRight
            | Move::WhipPan
            | Move::TiltUp
            | Move::TiltDown
            | Move::Follow
            | Move::FlyThrough
            | Move::Reveal
    ) && !is_slide(movement)
}

fn is_slide(movement: Move) -> bool {
    matches!(movement, Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown)
}

/// Share of the way of each state.
fn shares(segment: &MotionSegment) -> Vec<f64> {
    let count = segment.states.len() - 1;
    (0..=count).map(|i| i as f64 / count as f64).collect()
}

/// Sets the stated lenses at both ends. Between them the focal length changes evenly.
fn set_lens(context: &StepContext, segment: &mut MotionSegment) {
    if matches!(context.step.movement, Move::ZoomIn | Move::ZoomOut | Move::DollyZoomIn | Move::DollyZoomOut) {
        return;
    }
    let focal = |fov_rad: f64| 1.0 / (fov_rad / 2.0).tan();
    let first = context.step.start.lens.map_or(segment.states[0], |lens| {
        let (low, high) = lens_fov_deg(lens);
        let kept = segment.states[0].fov_y_rad.to_degrees();
        let fov_deg = if (low..=high).contains(&kept) { kept } else { low.midpoint(high) };
        with_fov(&segment.states[0], fov_deg.to_radians())
    });
    let (from, to) = (focal(first.fov_y_rad), focal(context.end_fov_rad(&first)));
    let factor = from / focal(segment.states[0].fov_y_rad);
    for (share, i) in shares(segment).into_iter().zip(0..) {
        // Without a stated lens at the end, a zoom at the same time stays.
        let own = factor * focal(segment.states[i].fov_y_rad);
        let focal = if context.step.end.lens.is_some() { lerp((from, to), share) } else { own };
        segment.states[i] = with_fov(&segment.states[i], 2.0 * (1.0 / focal).atan());
    }
}

fn place(context: &StepContext, places: &Places, segment: &mut MotionSegment) {
    match context.step.movement {
        movement if is_slide(movement) => slide(context, places, segment),
        Move::ZoomIn | Move::ZoomOut => zoom(context, places, segment),
        _ if segment.pivot.is_some() && places.same => follow_subject(context, places, segment),
        _ => turn(context, places, segment),
    }
}

/// Places the subject on every state; its place changes evenly from the start to the end.
fn follow_subject(context: &StepContext, places: &Places, segment: &mut MotionSegment) {
    let last = segment.states.len() - 1;
    let now =
        |state: &CameraState| frame_position(context.world, state, places.to.aim).map_or(DVec2::ZERO, |(at, _)| at);
    let from = places.start.unwrap_or_else(|| now(&segment.states[0]));
    let to = places.end.unwrap_or_else(|| now(&segment.states[last]));
    for (share, i) in shares(segment).into_iter().zip(0..) {
        segment.states[i] = placed(context.world, &segment.states[i], places.to.aim, from.lerp(to, share));
    }
}

/// Turns both ends; the turns of the states between them change evenly.
fn turn(context: &StepContext, places: &Places, segment: &mut MotionSegment) {
    let last = segment.states.len() - 1;
    let turned = |state: &CameraState, target: &Target, at: Option<DVec2>| {
        at.map_or((0.0, 0.0), |at| turn_between(context, state, &placed(context.world, state, target.aim, at)))
    };
    let from = turned(&segment.states[0], &places.from, places.start);
    let to = turned(&segment.states[last], &places.to, places.end);
    for (share, i) in shares(segment).into_iter().zip(0..) {
        let by = (lerp((from.0, to.0), share), lerp((from.1, to.1), share));
        segment.states[i] = turned_by(context, &segment.states[i], by);
    }
}

/// Yaw and pitch between two cameras.
pub(super) fn turn_between(context: &StepContext, from: &CameraState, to: &CameraState) -> (f64, f64) {
    let frame = &context.world.frame;
    let (from, to) = (frame.angles(from.pose.rotation), frame.angles(to.pose.rotation));
    (rotation::short_turn(to.yaw_rad - from.yaw_rad), to.pitch_rad - from.pitch_rad)
}

/// The camera turned in place by a yaw and a pitch.
pub(super) fn turned_by(context: &StepContext, state: &CameraState, (yaw_rad, pitch_rad): (f64, f64)) -> CameraState {
    let frame = &context.world.frame;
    let angles = frame.angles(state.pose.rotation);
    let angles = LevelAngles { yaw_rad: angles.yaw_rad + yaw_rad, pitch_rad: angles.pitch_rad + pitch_rad, ..angles };
    CameraState { pose: Pose { rotation: frame.rotation(angles), ..state.pose }, ..*state }
}

/// One turn for all states of a zoom: the place is exact at the end that states it.
fn zoom(context: &StepContext, places: &Places, segment: &mut MotionSegment) {
    let at_start = context.step.end.place.is_none();
    let last = segment.states.len() - 1;
    let (state, at) = if at_start { (&segment.states[0], places.start) } else { (&segment.states[last], places.end) };
    let Some(at) = at else { return };
    let rotation = placed(context.world, state, places.to.aim, at).pose.rotation;
    segment.states.iter_mut().for_each(|state| state.pose.rotation = rotation);
}

/// Shifts the ends of a slide along its line, and turns all its states by the same angle for the other direction of the
/// frame. Where one end alone states a place, a free slide is shifted as a whole.
fn slide(context: &StepContext, places: &Places, segment: &mut MotionSegment) {
    let last = segment.states.len() - 1;
    let free = context.before.is_none();
    let lone = free && (places.start.is_none() || places.end.is_none());
    let stated = [(0, &places.from, places.start), (last, &places.to, places.end)];
    // A shift changes the direction to the subject, and with it the turn: eight rounds settle both.
    for _ in 0..8 {
        for (i, target, at) in stated {
            let Some(at) = at.filter(|_| i > 0 || free) else { continue };
            if free {
                square_up(context, segment, i, target.aim, at);
            }
            let Some(by) = shift_to(context, &segment.states[i], target.aim, at) else { continue };
            for (share, state) in shares(segment).into_iter().zip(segment.states.iter_mut()) {
                let weight = if lone { 1.0 } else { 1.0 - (share - i as f64 / last as f64).abs() };
                *state = moved(state, by * weight);
            }
        }
    }
}

/// Turns all states alike, so that a point has the stated position across the line of the slide in one of them.
fn square_up(context: &StepContext, segment: &mut MotionSegment, index: usize, aim: DVec3, at: DVec2) {
    let Some((now, _)) = frame_position(context.world, &segment.states[index], aim) else { return };
    let across = if is_vertical(context) { DVec2::new(at.x, now.y) } else { DVec2::new(now.x, at.y) };
    let rotation = placed(context.world, &segment.states[index], aim, across).pose.rotation;
    segment.states.iter_mut().for_each(|state| state.pose.rotation = rotation);
}

/// The shift along the line of a slide that brings a point to its place in the direction of the slide. With the point at
/// c and the line along a in camera axes, the shift s solves (c.x - s a.x) = k (c.z - s a.z).
fn shift_to(context: &StepContext, state: &CameraState, aim: DVec3, at: DVec2) -> Option<DVec3> {
    let axis = if is_vertical(context) { context.world.frame.up } else { state.pose.right() };
    let (c, a) = (state.pose.to_camera(aim), state.pose.rotation.conjugate() * axis);
    let half = 2.0 * (state.fov_y_rad / 2.0).tan();
    let (off, rate) = if is_vertical(context) {
        (c.y + at.y * half * c.z, a.y + at.y * half * a.z)
    } else {
        let k = at.x * half * context.world.aspect;
        (c.x - k * c.z, a.x - k * a.z)
    };
    (c.z > 0.0 && rate.abs() > 1e-9).then(|| axis * (off / rate))
}

fn is_vertical(context: &StepContext) -> bool {
    matches!(context.step.movement, Move::PedestalUp | Move::PedestalDown)
}

/// Lets the join end where the step's own motion begins. Adds a join where the camera before has another view or lens.
pub(super) fn rejoin(context: &StepContext, segments: &mut Vec<MotionSegment>) {
    let Some(before) = context.before else { return };
    let Some(first) = segments.last().map(|segment| segment.states[0]) else { return };
    let count = segments.len();
    if let Some(join) = segments[..count - 1].last_mut() {
        let end = join.states.len() - 1;
        join.states[end] = first;
        return;
    }
    if !is_same_camera(&before, &first) {
        segments.insert(0, context.join(before, first));
    }
}

/// Whether two cameras stand at the same place with the same lens.
pub(super) fn is_same_place(a: &CameraState, b: &CameraState) -> bool {
    a.pose.position.distance(b.pose.position) < 1e-9 && (a.fov_y_rad - b.fov_y_rad).abs() < 1e-9
}

/// Whether two cameras stand at the same place with the same lens and look the same way.
pub(super) fn is_same_camera(a: &CameraState, b: &CameraState) -> bool {
    is_same_place(a, b) && rotation::angle_between(a.pose.rotation, b.pose.rotation).to_degrees() <= 1e-6
}
