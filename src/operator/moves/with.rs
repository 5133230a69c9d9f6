//! A second move at the same time: `orbit while rising`, `push in and tilt up`.

use glam::DVec3;

use super::Scenario;
use crate::draft::{Goal, GoalKind, Part};
use crate::view::{aimed, lerp, moved, with_fov};
use cinesplat_geometry::{LevelAngles, Pose};
use cinesplat_trajectory::{CameraState, Move};

/// Keys of a mixed move at least: its path bends.
const NUM_KEYS: usize = 5;

/// Lays the step's second move over its last part. The first move keeps its own goals except those that the second one
/// breaks by its nature.
pub(super) fn add_second_move(scenario: &Scenario, parts: &mut [Part]) {
    let named_direction = matches!(scenario.step.movement, Move::WhipPan | Move::Reveal);
    let Some(second) = scenario.step.with.filter(|second| *second != scenario.step.movement && !named_direction) else {
        return;
    };
    let Some(part) = parts.iter_mut().rev().find(|part| !part.is_join) else { return };
    if part.states.len() == 2 {
        part.states = subdivided(scenario, part);
    }
    let count = part.states.len() - 1;
    let target = scenario.main();
    let keeps_aim = part.pivot.is_some() || matches!(second, Move::CraneUp | Move::CraneDown);
    for (i, state) in part.states.iter_mut().enumerate() {
        let share = i as f64 / count as f64;
        *state = added(scenario, second, state, target.aim, share);
        if keeps_aim {
            *state = aimed(scenario.world, state, target.aim);
        }
    }
    let broken = |goal: &Goal| match goal.kind {
        GoalKind::DistanceRatio(..) | GoalKind::LensRatio(_) => !is_turn(second),
        GoalKind::Centered(..) => !keeps_aim,
        GoalKind::Travel(..) | GoalKind::YawChange(_) | GoalKind::PitchChange(_) | GoalKind::Pitch(_) => true,
        _ => false,
    };
    part.goals.retain(|goal| !broken(goal));
}

fn is_turn(movement: Move) -> bool {
    matches!(movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw)
}

/// States in between, by way, level angles and lens.
fn subdivided(scenario: &Scenario, part: &Part) -> Vec<CameraState> {
    let (a, b) = (part.states[0], part.states[1]);
    let frame = &scenario.world.frame;
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

/// A state with `share` of the second move added, of the amount that the move has when the words give none.
fn added(scenario: &Scenario, second: Move, state: &CameraState, aim: DVec3, share: f64) -> CameraState {
    let frame = &scenario.world.frame;
    let away = state.pose.position - aim;
    let distance = away.length();
    let reach = lerp((0.25, 0.5), scenario.genes[7]);
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
        aimed(scenario.world, &moved(state, place - state.pose.position), aim)
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
