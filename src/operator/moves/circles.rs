//! Moves about a subject with the aim kept on it: orbit, arc, crane.

use glam::DVec3;

use super::Scenario;
use crate::Amount;
use crate::draft::{GoalKind, Part, When};
use crate::framing::{Target, bearing_of};
use crate::view::{aimed, lerp, moved};
use cinesplat_trajectory::{CameraState, Move, ShotAngle};

/// Most degrees of an orbit between two keys, so that a person sees its shape in the keys.
const DEG_PER_KEY: f64 = 30.0;

/// Around the upright axis through the subject's center, at one radius and height.
pub(super) fn orbit(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let (mut parts, first) = scenario.opened_on(&Target { aim: target.center, ..target.clone() }, (0.4, 0.72));
    let sign = scenario.sign(match scenario.step.movement {
        Move::OrbitLeft | Move::ArcLeft => 1.0,
        _ => -1.0,
    });
    let degrees = orbit_deg(scenario);
    let pivot = target.center;
    let away = first.pose.position - pivot;
    let frame = &scenario.world.frame;
    let (radius, rise) = (frame.horizontal(away).length(), frame.height(away));
    let from = frame.azimuth(away);
    let count = (degrees / DEG_PER_KEY).ceil().max(2.0) as usize;
    let at = |i: usize| {
        let azimuth = from + sign * degrees.to_radians() * i as f64 / count as f64;
        let position = pivot + frame.direction(azimuth) * radius + frame.up * rise;
        aimed(scenario.world, &moved(&first, position - first.pose.position), pivot)
    };
    let states: Vec<CameraState> = (0..=count).map(at).collect();
    let mut part = scenario.part(states, (degrees / 14.0).clamp(3.0, 20.0)).about(pivot);
    // Left where the words leave the direction open, the keys say which way it went.
    part.movement = match (scenario.step.movement, sign > 0.0) {
        (Move::OrbitLeft | Move::OrbitRight, true) => Move::OrbitLeft,
        (Move::OrbitLeft | Move::OrbitRight, false) => Move::OrbitRight,
        (_, true) => Move::ArcLeft,
        (_, false) => Move::ArcRight,
    };
    part = scenario.ending(scenario.beginning(part));
    if let Some(angle) = scenario.step.start.angle.or(scenario.step.end.angle).filter(|_| scenario.before.is_none()) {
        part = part.keeping(When::All, GoalKind::Pitch(pitch_band_deg(angle)));
    }
    parts.push(super::seen(part, &target, When::All));
    parts
}

/// Angle of an orbit: stated, or what its words usually mean.
fn orbit_deg(scenario: &Scenario) -> f64 {
    let arc = matches!(scenario.step.movement, Move::ArcLeft | Move::ArcRight);
    match scenario.step.amount {
        Some(Amount::Degrees(degrees)) => degrees.clamp(1.0, 1080.0),
        Some(Amount::Factor(turns)) => (turns * 360.0).clamp(1.0, 1080.0),
        Some(Amount::Slight) => 25.0,
        Some(Amount::Large) if arc => 180.0,
        Some(Amount::Large) => 360.0,
        _ if arc => lerp((40.0, 60.0), scenario.genes[6]),
        _ => lerp((58.0, 88.0), scenario.genes[6]),
    }
}

/// Pitch of the camera that an angle word stands for, degrees, positive up.
pub(super) fn pitch_band_deg(angle: ShotAngle) -> (f64, f64) {
    match angle {
        ShotAngle::Overhead => (-90.0, -40.0),
        ShotAngle::High => (-40.0, -12.0),
        ShotAngle::EyeLevel => (-12.0, 10.0),
        ShotAngle::Low => (8.0, 42.0),
        ShotAngle::Worm => (38.0, 90.0),
    }
}

/// Up or down with the aim on the subject.
pub(super) fn crane(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let upward = (scenario.step.movement == Move::CraneUp) != (scenario.step.either_way && scenario.genes[5] < 0.5);
    let (mut parts, first) = if scenario.before.is_none() && scenario.step.start.angle.is_none() {
        let view = scenario.view(&target, &opening_for_crane(scenario, upward), (0.35, 0.62), super::NORMAL_LENS_DEG);
        (Vec::new(), view)
    } else {
        scenario.opened_on(&target, (0.35, 0.62))
    };
    let last = raised(scenario, &first, &target, upward);
    let middle = CameraState {
        pose: cinesplat_geometry::Pose { position: first.pose.position.lerp(last.pose.position, 0.5), ..first.pose },
        ..first
    };
    let states = vec![first, aimed(scenario.world, &middle, target.aim), last];
    let mut part = scenario.part(states, 4.5).about(target.aim);
    let end_angle = scenario.step.end.angle;
    let goal = match (end_angle, upward) {
        (Some(angle), _) => pitch_band_deg(angle),
        (None, true) => (-60.0, -7.0),
        (None, false) => (-40.0, 25.0),
    };
    part = part.keeping(When::End, GoalKind::Pitch(goal));
    if let Some(angle) = scenario.step.start.angle {
        part = part.keeping(When::Start, GoalKind::Pitch(pitch_band_deg(angle)));
    }
    part = scenario.ending(scenario.beginning(part)).keeping(When::All, GoalKind::Centered(target.clone(), 0.14));
    parts.push(super::seen(part, &target, When::All));
    parts
}

/// Framing of a crane's open start: low enough to rise, or high enough to sink.
fn opening_for_crane(scenario: &Scenario, upward: bool) -> crate::Framing {
    let mut framing = scenario.opening_framing();
    framing.angle = if upward { None } else { Some(ShotAngle::High) };
    framing
}

/// Least change of the angle under which a crane sees its subject.
const LEAST_CRANE_DEG: f64 = 14.0;

/// The camera after the rise (or fall), aimed at the target.
fn raised(scenario: &Scenario, first: &CameraState, target: &Target, upward: bool) -> CameraState {
    let frame = &scenario.world.frame;
    let away = first.pose.position - target.aim;
    let level = frame.horizontal(away);
    let distance = away.length();
    let start = bearing_of(scenario.world, target.aim, first.pose.position).elevation_rad.to_degrees();
    let sign = if upward { 1.0 } else { -1.0 };
    let asked = match scenario.step.end.angle {
        Some(ShotAngle::Overhead) => lerp((46.0, 66.0), scenario.genes[6]),
        Some(ShotAngle::High) => lerp((16.0, 36.0), scenario.genes[6]),
        Some(ShotAngle::EyeLevel) => lerp((-4.0, 7.0), scenario.genes[6]),
        Some(ShotAngle::Low) => lerp((-30.0, -10.0), scenario.genes[6]),
        Some(ShotAngle::Worm) => -45.0,
        None => start + sign * lerp((18.0, 38.0), scenario.genes[6]),
    };
    // Whatever the angle at its end, a crane that does not rise (or sink) is none.
    let least = start + sign * LEAST_CRANE_DEG;
    let elevation = if upward { asked.max(least) } else { asked.min(least) };
    let rise = match scenario.step.amount {
        Some(Amount::Units(units)) => sign * units,
        Some(Amount::Slight) => sign * 0.22 * distance,
        Some(Amount::Large) => sign * 1.2 * distance,
        _ => (level.length() * elevation.clamp(-70.0, 70.0).to_radians().tan()) - frame.height(away),
    };
    // The jib swings in a little as it rises.
    let swing: DVec3 = -level * lerp((0.0, 0.3), scenario.genes[7]) * rise.abs() / (rise.abs() + distance);
    aimed(scenario.world, &moved(first, frame.up * rise + swing), target.aim)
}
