//! A second move at the same time: `orbit while rising`, `push in and tilt up`.

use glam::DVec3;

use super::context::StepContext;
use super::sway::{num_sways, swayed};
use crate::constraint::{Constraint, ConstraintKind, Scope};
use crate::cost::evenly_spaced;
use crate::framing::Target;
use crate::motion::MotionSegment;
use crate::pacing::natural_secs;
use crate::program::{Amount, Motion, Step};
use crate::view::{aimed, lerp, moved, with_fov};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Move};

/// Least number of keyframes of a combined move, whose path is curved.
const NUM_KEYS: usize = 5;

/// Adds the step's further moves to its last segment. The segment keeps its constraints, except those that a further
/// move inevitably violates.
pub(super) fn add_second_moves(context: &StepContext, segments: &mut [MotionSegment]) {
    // The first of these moves only names the direction of a whip pan or a reveal.
    let named_direction = usize::from(matches!(context.step.movement, Move::WhipPan | Move::Reveal));
    let further = || context.step.with.iter().skip(named_direction).filter(|second| **second != context.step.movement);
    // Turns come last: a travel that keeps its aim would undo them.
    for turns in [false, true] {
        for second in further().filter(|second| is_turn(**second) == turns) {
            add_second_move(context, *second, segments);
        }
    }
    let Some(segment) = segments.iter_mut().rev().find(|segment| !segment.is_join) else { return };
    let target = context.main_target();
    for &second in further() {
        if second == Move::Handheld {
            sway(context, segment, &target);
        } else if !opposes(context.step.movement, second) {
            segment.constraints.push(Constraint { kind: ConstraintKind::Also(second, target.aim), scope: Scope::All });
        }
    }
}

/// Adds the sway of a handheld camera to a moving one.
fn sway(context: &StepContext, segment: &mut MotionSegment, target: &Target) {
    let distance = segment.states[0].pose.position.distance(target.aim);
    if !segment.secs_bind {
        segment.secs = natural_secs(context.world, context.step, segment);
    }
    let even = evenly_spaced(context.world, segment, num_sways(segment.secs) + 1);
    segment.states = swayed(&even, distance, context.parameters[6] * 60.0);
}

/// Whether the main move is of the same kind as the further one: the extents of both then add up or cancel.
fn opposes(main: Move, second: Move) -> bool {
    let family = |movement: Move| match movement {
        Move::PanLeft | Move::PanRight | Move::WhipPan => 1,
        Move::TiltUp | Move::TiltDown => 2,
        Move::RollCw | Move::RollCcw => 3,
        Move::PushIn | Move::PullOut | Move::DollyZoomIn | Move::DollyZoomOut => 4,
        Move::TruckLeft | Move::TruckRight | Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => 5,
        Move::PedestalUp | Move::PedestalDown | Move::CraneUp | Move::CraneDown => 6,
        Move::ZoomIn | Move::ZoomOut => 7,
        _ => 0,
    };
    family(main) == family(second)
}

fn add_second_move(context: &StepContext, second: Move, segments: &mut [MotionSegment]) {
    if second == Move::Handheld {
        return;
    }
    let Some(segment) = segments.iter_mut().rev().find(|segment| !segment.is_join) else { return };
    if segment.states.len() == 2 {
        segment.states = subdivided(context, segment);
    }
    let count = segment.states.len() - 1;
    let target = context.main_target();
    let aims = segment.pivot.is_some() || matches!(second, Move::CraneUp | Move::CraneDown);
    let keeps_aim = aims && !is_turn(second);
    for (i, state) in segment.states.iter_mut().enumerate() {
        let share = i as f64 / count as f64;
        *state = added(context, second, state, target.aim, share);
        if keeps_aim {
            *state = aimed(context.world, state, target.aim);
        }
    }
    let zooms = matches!(second, Move::ZoomIn | Move::ZoomOut);
    let violated = |constraint: &Constraint| match constraint.kind {
        ConstraintKind::DistanceRatio(..) | ConstraintKind::LensRatio(_) => !is_turn(second),
        ConstraintKind::Centered(..) => !keeps_aim,
        ConstraintKind::Travel(..)
        | ConstraintKind::YawChange(_)
        | ConstraintKind::PitchChange(_)
        // A lens neither travels nor turns.
        | ConstraintKind::Pitch(_) => !zooms,
        _ => false,
    };
    segment.constraints.retain(|constraint| !violated(constraint));
}

/// Whether a further move turns the camera for itself.
pub(super) fn is_turn(movement: Move) -> bool {
    matches!(movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw)
}

/// Intermediate states, linear in position, level angles and focal length.
fn subdivided(context: &StepContext, segment: &MotionSegment) -> Vec<CameraState> {
    let (a, b) = (segment.states[0], segment.states[1]);
    let frame = &context.world.frame;
    let (from, to) = (frame.angles(a.pose.rotation), frame.angles(b.pose.rotation));
    let turn = rotation::short_turn(to.yaw_rad - from.yaw_rad);
    let between = |i: usize| {
        let t = i as f64 / (NUM_KEYS - 1) as f64;
        let angles = LevelAngles {
            yaw_rad: from.yaw_rad + turn * t,
            pitch_rad: lerp((from.pitch_rad, to.pitch_rad), t),
            roll_rad: lerp((from.roll_rad, to.roll_rad), t),
        };
        let pose = Pose { position: a.pose.position.lerp(b.pose.position, t), rotation: frame.rotation(angles) };
        let focal = lerp((1.0 / (a.fov_y_rad / 2.0).tan(), 1.0 / (b.fov_y_rad / 2.0).tan()), t);
        CameraState { pose, fov_y_rad: 2.0 * (1.0 / focal).atan(), focus_distance: a.focus_distance }
    };
    (0..NUM_KEYS).map(between).collect()
}

/// Extent of a further move that the prompt states: an amount that the main move does not take itself. Degrees belong to
/// a turn or an orbit, a length to a travel, and a factor to a zoom.
fn stated_extent(context: &StepContext, second: Move) -> Option<f64> {
    let main = Extent::of(context.step.movement);
    let extent = Extent::of(second).filter(|extent| main != Some(*extent))?;
    match (context.step.amount?, extent) {
        (Amount::Degrees(degrees), Extent::Angle) => Some(degrees),
        (Amount::Units(units), Extent::Length) => Some(units),
        (Amount::Factor(factor), Extent::Lens) if factor > 0.0 && main != Some(Extent::Length) => Some(factor),
        _ => None,
    }
}

/// The kind of quantity that measures a move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    Angle,
    Length,
    Lens,
}

impl Extent {
    fn of(movement: Move) -> Option<Self> {
        match movement {
            Move::PanLeft
            | Move::PanRight
            | Move::WhipPan
            | Move::TiltUp
            | Move::TiltDown
            | Move::RollCw
            | Move::RollCcw
            | Move::OrbitLeft
            | Move::OrbitRight
            | Move::ArcLeft
            | Move::ArcRight => Some(Self::Angle),
            Move::PushIn
            | Move::PullOut
            | Move::TruckLeft
            | Move::TruckRight
            | Move::PedestalUp
            | Move::PedestalDown
            | Move::CraneUp
            | Move::CraneDown
            | Move::DollyZoomIn
            | Move::DollyZoomOut => Some(Self::Length),
            Move::ZoomIn | Move::ZoomOut => Some(Self::Lens),
            Move::Static | Move::Handheld | Move::Follow | Move::FlyThrough | Move::Reveal | Move::RackFocus => None,
        }
    }
}

/// Angle about the subject of a circle beside another move, degrees. Somebody who circles a thing while rising or sinking
/// goes around it, on a spiral.
fn beside_deg(context: &StepContext, second: Move) -> f64 {
    let circles = matches!(second, Move::OrbitLeft | Move::OrbitRight);
    if circles && matches!(context.step.movement, Move::CraneUp | Move::CraneDown) { SPIRAL_DEG } else { ASIDE_DEG }
}

/// The angle of such a spiral, and of a circle beside any other move, degrees.
const SPIRAL_DEG: f64 = 150.0;
const ASIDE_DEG: f64 = 40.0;

/// Factor on the distance that the prompt states for a circle that comes nearer on its way, or goes away. Any other factor of a
/// circle is a number of turns.
pub(super) fn factor_beside_circle(step: &Step) -> Option<f64> {
    let factor = match step.amount {
        Some(Amount::Factor(factor)) if step.movement.is_circular() => factor,
        _ => return None,
    };
    let nears = step.with.contains(&Move::PushIn) && factor > 0.0 && factor < 1.0;
    let leaves = step.with.contains(&Move::PullOut) && factor > 1.0;
    (nears || leaves).then_some(factor)
}

/// A state with `share` of the second move added: by the stated amount, or else the move's default.
fn added(context: &StepContext, second: Move, state: &CameraState, aim: DVec3, share: f64) -> CameraState {
    let frame = &context.world.frame;
    let away = state.pose.position - aim;
    let distance = away.length();
    let stated = stated_extent(context, second);
    let degrees = |default: f64| stated.unwrap_or(default);
    let reach = lerp((0.25, 0.5), context.parameters[7]);
    let shift = |by: DVec3| match stated {
        Some(units) => moved(state, by.normalize_or_zero() * units * share),
        None => moved(state, by * share),
    };
    let turn = |yaw_deg: f64, pitch_deg: f64, roll_deg: f64| {
        let angles = frame.angles(state.pose.rotation);
        let turned = LevelAngles {
            yaw_rad: angles.yaw_rad + (yaw_deg * share).to_radians(),
            pitch_rad: (angles.pitch_rad + (pitch_deg * share).to_radians()).clamp(-1.45, 1.45),
            roll_rad: angles.roll_rad + (roll_deg * share).to_radians(),
        };
        CameraState { pose: Pose { rotation: frame.rotation(turned), ..state.pose }, ..*state }
    };
    let lens = |ratio: f64| with_fov(state, 2.0 * ((state.fov_y_rad / 2.0).tan() * ratio.powf(share)).atan());
    // From one thing to another, the camera looks at what it would look at without the circle.
    let leads = matches!((&context.start, &context.end), (Some(start), Some(end)) if start.ids != end.ids);
    let around = |sign: f64| {
        let swing = (sign * degrees(beside_deg(context, second)) * share).to_radians();
        let place = frame.swung(aim, state.pose.position, swing);
        if leads {
            let angles = frame.angles(state.pose.rotation);
            let yaw_rad = angles.yaw_rad + swing;
            let rotation = frame.rotation(LevelAngles { yaw_rad, ..angles });
            return CameraState { pose: Pose { position: place, rotation }, ..*state };
        }
        aimed(context.world, &moved(state, place - state.pose.position), aim)
    };
    // A crane or pedestal alone decides on the height.
    let rises = Motion::of(context.step.movement) == Some(Motion::Rise);
    let back = if rises { frame.horizontal(away) } else { away };
    // Lower down, a camera is nearer.
    let away_by = if rises { 2.2 } else { 1.4 };
    if let (Move::PushIn | Move::PullOut, Some(factor)) = (second, factor_beside_circle(context.step)) {
        return moved(state, away * ((factor - 1.0) * share));
    }
    match second {
        Move::PanLeft => turn(-degrees(18.0), 0.0, 0.0),
        Move::PanRight => turn(degrees(18.0), 0.0, 0.0),
        Move::TiltUp => turn(0.0, degrees(12.0), 0.0),
        Move::TiltDown => turn(0.0, -degrees(12.0), 0.0),
        Move::RollCw => turn(0.0, 0.0, degrees(15.0)),
        Move::RollCcw => turn(0.0, 0.0, -degrees(15.0)),
        Move::PushIn | Move::DollyZoomIn => shift(-back * reach),
        Move::PullOut | Move::DollyZoomOut => shift(back * reach * away_by),
        Move::TruckLeft => shift(-state.pose.right() * distance * reach),
        Move::TruckRight => shift(state.pose.right() * distance * reach),
        Move::PedestalUp | Move::CraneUp => shift(frame.up * distance * reach),
        Move::PedestalDown | Move::CraneDown => shift(-frame.up * distance * reach),
        Move::OrbitLeft | Move::ArcLeft => around(1.0),
        Move::OrbitRight | Move::ArcRight => around(-1.0),
        Move::ZoomIn => lens(stated.map_or(0.6, |factor| 1.0 / factor)),
        Move::ZoomOut => lens(stated.map_or(1.6, |factor| 1.0 / factor)),
        Move::Static
        | Move::Follow
        | Move::FlyThrough
        | Move::Reveal
        | Move::WhipPan
        | Move::RackFocus
        | Move::Handheld => *state,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_beside_a_way_in_is_one_on_the_distance() {
        let factor = |movement: Move, with: &[Move], factor: f64| {
            let step = Step { with: with.to_vec(), amount: Some(Amount::Factor(factor)), ..Step::of(movement) };
            factor_beside_circle(&step)
        };
        assert_eq!(factor(Move::ArcLeft, &[Move::PushIn], 0.75), Some(0.75));
        assert_eq!(factor(Move::OrbitRight, &[Move::PullOut], 1.5), Some(1.5));
        // Two turns, and three quarters of one.
        assert_eq!(factor(Move::OrbitRight, &[Move::PushIn], 2.0), None);
        assert_eq!(factor(Move::OrbitRight, &[], 0.75), None);
        assert_eq!(factor(Move::PushIn, &[Move::PushIn], 0.75), None);
    }
}
