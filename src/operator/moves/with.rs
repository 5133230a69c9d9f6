//! A second move at the same time: `orbit while rising`, `push in and tilt up`.

use glam::DVec3;

use super::context::StepContext;
use crate::constraint::{Constraint, ConstraintKind};
use crate::motion::MotionSegment;
use crate::view::{aimed, lerp, moved, with_fov};
use cinesplat_geometry::{LevelAngles, Pose};
use cinesplat_trajectory::{CameraState, Move};

/// Least number of keyframes of a combined move, whose path is curved.
const NUM_KEYS: usize = 5;

/// Adds the step's second move to its last segment. The segment keeps its constraints, except those that the second
/// move inevitably violates.
pub(super) fn add_second_move(context: &StepContext, segments: &mut [MotionSegment]) {
    let named_direction = matches!(context.step.movement, Move::WhipPan | Move::Reveal);
    let Some(second) = context.step.with.filter(|second| *second != context.step.movement && !named_direction) else {
        return;
    };
    let Some(segment) = segments.iter_mut().rev().find(|segment| !segment.is_join) else { return };
    if segment.states.len() == 2 {
        segment.states = subdivided(context, segment);
    }
    let count = segment.states.len() - 1;
    let target = context.main_target();
    let keeps_aim = segment.pivot.is_some() || matches!(second, Move::CraneUp | Move::CraneDown);
    for (i, state) in segment.states.iter_mut().enumerate() {
        let share = i as f64 / count as f64;
        *state = added(context, second, state, target.aim, share);
        if keeps_aim {
            *state = aimed(context.world, state, target.aim);
        }
    }
    let violated = |constraint: &Constraint| match constraint.kind {
        ConstraintKind::DistanceRatio(..) | ConstraintKind::LensRatio(_) => !is_turn(second),
        ConstraintKind::Centered(..) => !keeps_aim,
        ConstraintKind::Travel(..)
        | ConstraintKind::YawChange(_)
        | ConstraintKind::PitchChange(_)
        | ConstraintKind::Pitch(_) => true,
        _ => false,
    };
    segment.constraints.retain(|constraint| !violated(constraint));
}

fn is_turn(movement: Move) -> bool {
    matches!(movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw)
}

/// Intermediate states, linear in position, level angles and focal length.
fn subdivided(context: &StepContext, segment: &MotionSegment) -> Vec<CameraState> {
    let (a, b) = (segment.states[0], segment.states[1]);
    let frame = &context.world.frame;
    let (from, to) = (frame.angles(a.pose.rotation), frame.angles(b.pose.rotation));
    let turn =
        (to.yaw_rad - from.yaw_rad + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
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

/// A state with `share` of the second move added, at the move's default amount.
fn added(context: &StepContext, second: Move, state: &CameraState, aim: DVec3, share: f64) -> CameraState {
    let frame = &context.world.frame;
    let away = state.pose.position - aim;
    let distance = away.length();
    let reach = lerp((0.25, 0.5), context.parameters[7]);
    let shift = |by: DVec3| moved(state, by * share);
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
    let around = |sign: f64| {
        let azimuth = frame.azimuth(away) + (sign * 40.0 * share).to_radians();
        let place = aim + frame.direction(azimuth) * frame.horizontal(away).length() + frame.up * frame.height(away);
        aimed(context.world, &moved(state, place - state.pose.position), aim)
    };
    match second {
        Move::PanLeft => turn(-18.0, 0.0, 0.0),
        Move::PanRight => turn(18.0, 0.0, 0.0),
        Move::TiltUp => turn(0.0, 12.0, 0.0),
        Move::TiltDown => turn(0.0, -12.0, 0.0),
        Move::RollCw => turn(0.0, 0.0, 15.0),
        Move::RollCcw => turn(0.0, 0.0, -15.0),
        Move::PushIn | Move::DollyZoomIn => shift(-away * reach),
        Move::PullOut | Move::DollyZoomOut => shift(away * reach * 1.4),
        Move::TruckLeft => shift(-state.pose.right() * distance * reach),
        Move::TruckRight => shift(state.pose.right() * distance * reach),
        Move::PedestalUp | Move::CraneUp => shift(frame.up * distance * reach),
        Move::PedestalDown | Move::CraneDown => shift(-frame.up * distance * reach),
        Move::OrbitLeft | Move::ArcLeft => around(1.0),
        Move::OrbitRight | Move::ArcRight => around(-1.0),
        Move::ZoomIn => lens(0.6),
        Move::ZoomOut => lens(1.6),
        Move::Static
        | Move::Follow
        | Move::FlyThrough
        | Move::Reveal
        | Move::WhipPan
        | Move::RackFocus
        | Move::Handheld => *state,
    }
}
