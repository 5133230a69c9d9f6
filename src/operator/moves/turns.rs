//! Moves that leave the camera in place: hold, handheld, pan, tilt, roll.

use glam::DVec3;

use super::{Scenario, TURN_DEG_PER_SEC};
use crate::draft::{GoalKind, Part, When};
use crate::framing::{DEFAULT_ASPECT, Target, extent_frac, frame_position, off_center};
use crate::view::{aimed, aimed_at_side, lerp};
use crate::{Amount, Part as ObjectPart};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Easing, Move};

/// Turn of a pan or tilt that the words give no end for, degrees.
const OPEN_TURN_DEG: (f64, f64) = (24.0, 42.0);

/// Holds still on what it starts on.
pub(super) fn hold(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let named = scenario.start.is_some() || scenario.end.is_some();
    let (mut parts, state) = match &scenario.before {
        Some(before) if named => scenario.turned_to(before, target.aim),
        Some(before) => (Vec::new(), *before),
        None => {
            let mut framing = scenario.step.start.clone();
            framing.size = framing.size.or(scenario.step.end.size);
            framing.angle = framing.angle.or(scenario.step.end.angle);
            framing.whole |= scenario.step.end.whole;
            let view = scenario.view(&target, &framing, (0.45, 0.75), super::NORMAL_LENS_DEG);
            (Vec::new(), if is_free(scenario, &framing) { on_a_third(scenario, &target, view) } else { view })
        }
    };
    let natural = if scenario.index == 0 && scenario.before.is_none() { 4.0 } else { 1.5 };
    let mut part = scenario.part(vec![state, state], natural);
    if scenario.before.is_none() {
        part = super::seen(scenario.ending(scenario.beginning(part)), &target, When::All);
        part = pitch_goal(scenario, part);
        if (off_center(&state, target.aim) - THIRD).abs() < 1e-4 {
            part = part.keeping(When::All, GoalKind::OnThird(target.clone()));
        }
    }
    parts.push(part);
    parts
}

/// Distance of a third from the frame's middle, over its width.
const THIRD: f64 = 1.0 / 6.0;
/// Widest subject that is put on a third, over the frame's width: a wider one would nearly touch the frame.
const MOST_WIDTH: f64 = 0.5;

/// Whether words leave the composition of a held view open: one subject, nothing said of its size, place or angle, and no
/// later step that needs it in the middle.
fn is_free(scenario: &Scenario, framing: &crate::Framing) -> bool {
    let alone = framing.subjects.len() <= 1 && !framing.whole && framing.part == ObjectPart::Middle;
    alone && framing.size.is_none() && framing.angle.is_none() && scenario.is_last
}

/// The view turned so that its subject stands on the left or right third, where it fits there.
fn on_a_third(scenario: &Scenario, target: &Target, view: CameraState) -> CameraState {
    if target.ids.is_empty() || extent_frac(&view, &target.corners).x > MOST_WIDTH {
        return view;
    }
    let distance = view.pose.position.distance(target.aim);
    let frame_width = 2.0 * distance * (view.fov_y_rad / 2.0).tan() * DEFAULT_ASPECT;
    let sign = if scenario.genes[5] < 0.5 { -1.0 } else { 1.0 };
    let (mut beside, mut out) = (frame_width * THIRD, view);
    // A pitched camera swings on a cone, so the turn is found step by step; each one divides what is off by ten or more.
    for _ in 0..8 {
        out = aimed(scenario.world, &view, target.aim + view.pose.right() * (sign * beside));
        let across = frame_position(&out, target.aim).map_or(THIRD, |(at, _)| at.x.abs());
        beside *= THIRD / across.max(0.01);
    }
    out
}

/// Pitch that an angle word asks for on the first view.
fn pitch_goal(scenario: &Scenario, part: Part) -> Part {
    match scenario.step.start.angle.or(scenario.step.end.angle) {
        Some(angle) => part.keeping(When::Start, GoalKind::Pitch(super::circles::pitch_band_deg(angle))),
        None => part,
    }
}

/// Holds a view with small, slow, seeded unsteadiness: sway of 0.3 % of the distance and 0.35 degrees.
pub(super) fn handheld(scenario: &Scenario) -> Vec<Part> {
    let mut parts = hold(scenario);
    let Some(part) = parts.last_mut() else { return parts };
    let target = scenario.main();
    let base = part.states[0];
    let distance = base.pose.position.distance(target.aim);
    let count = ((part.secs / 0.45).ceil() as usize).max(3);
    let phase = scenario.genes[6] * 60.0;
    let sway = |i: usize, channel: f64| {
        // Incommensurate sines: never repeats within a shot, smooth, the same for the same seed.
        let t = i as f64 * 0.45;
        ((t * 2.1 + channel * 1.7 + phase).sin() + 0.6 * (t * 3.7 + channel * 2.9 + phase * 1.3).sin()) / 1.6
    };
    let fade = |i: usize| if i == 0 || i == count { 0.0 } else { 1.0 };
    let wobbled = |i: usize| {
        let offset = DVec3::new(sway(i, 1.0), sway(i, 2.0), 0.5 * sway(i, 3.0)) * (0.003 * distance * fade(i));
        let twist = DVec3::new(sway(i, 4.0), sway(i, 5.0), 0.4 * sway(i, 6.0)) * (0.35_f64.to_radians() * fade(i));
        let turn = base.pose.rotation;
        CameraState { pose: Pose::new(base.pose.position + turn * offset, turn * rotation::exp(twist)), ..base }
    };
    part.states = (0..=count).map(wobbled).collect();
    part.easing = Easing::Linear;
    parts
}

/// Turns about the world's up, from one subject to another or by an angle.
pub(super) fn pan(scenario: &Scenario) -> Vec<Part> {
    let whip = scenario.step.movement == Move::WhipPan;
    let direction = if whip { scenario.step.with.unwrap_or(Move::WhipPan) } else { scenario.step.movement };
    let named = if direction == Move::PanLeft { -1.0 } else { 1.0 };
    let sign = scenario.sign(named);
    turn(
        scenario,
        sign,
        whip,
        |state, angle_rad| turned(scenario, state, angle_rad * sign, 0.0),
        |sign| {
            let yaw = band(sign, 13.0, 178.0);
            (GoalKind::YawChange(yaw), GoalKind::PitchChange((-10.0, 10.0)))
        },
    )
}

/// Turns up or down, from one subject to another or by an angle.
pub(super) fn tilt(scenario: &Scenario) -> Vec<Part> {
    let named = if scenario.step.movement == Move::TiltDown { -1.0 } else { 1.0 };
    let sign = scenario.sign(named);
    turn(
        scenario,
        sign,
        false,
        |state, angle_rad| turned(scenario, state, 0.0, angle_rad * sign),
        |sign| {
            let pitch = band(sign, 10.0, 120.0);
            (GoalKind::PitchChange(pitch), GoalKind::YawChange((-9.0, 9.0)))
        },
    )
}

/// Low and high of a signed quantity whose size is between two numbers.
fn band(sign: f64, least: f64, most: f64) -> (f64, f64) {
    if sign > 0.0 { (least, most) } else { (-most, -least) }
}

/// A camera turned by yaw (to the right) and pitch (up).
fn turned(scenario: &Scenario, state: &CameraState, yaw_rad: f64, pitch_rad: f64) -> CameraState {
    let frame = &scenario.world.frame;
    let angles = frame.angles(state.pose.rotation);
    let limit = 1.45;
    let turned = LevelAngles {
        yaw_rad: angles.yaw_rad + yaw_rad,
        pitch_rad: (angles.pitch_rad + pitch_rad).clamp(-limit, limit),
        roll_rad: angles.roll_rad,
    };
    CameraState { pose: Pose { rotation: frame.rotation(turned), ..state.pose }, ..*state }
}

/// A turn in place: `by` turns a camera by an angle in the step's direction; `goals` gives the bands of both angles.
fn turn(
    scenario: &Scenario,
    sign: f64,
    whip: bool,
    by: impl Fn(&CameraState, f64) -> CameraState,
    goals: impl Fn(f64) -> (GoalKind, GoalKind),
) -> Vec<Part> {
    let open_rad = lerp(OPEN_TURN_DEG, scenario.genes[6]).to_radians();
    let stated_rad = match scenario.step.amount {
        Some(Amount::Degrees(degrees)) => Some(degrees.to_radians()),
        Some(Amount::Slight) => Some(14.0_f64.to_radians()),
        Some(Amount::Large) => Some(75.0_f64.to_radians()),
        _ => None,
    };
    let angle_rad = stated_rad.unwrap_or(open_rad);
    let (mut parts, first, last) = match (&scenario.start, &scenario.end, stated_rad) {
        (_, Some(end), None) => onto(scenario, end, |state| by(state, -angle_rad)),
        (None, Some(end), Some(_)) if scenario.before.is_none() => onto(scenario, end, |state| by(state, -angle_rad)),
        _ => {
            let (parts, first) = scenario.opened_on(&scenario.opening(), (0.3, 0.6));
            let last = by(&first, angle_rad);
            (parts, first, last)
        }
    };
    let angle_deg = rotation::angle_between(first.pose.rotation, last.pose.rotation).to_degrees();
    let natural = if whip { 0.5 } else { (angle_deg / TURN_DEG_PER_SEC).clamp(1.8, 7.0) };
    let mut part = scenario.part(vec![first, last], natural);
    if whip && scenario.step.duration_secs.is_none() {
        part.secs = natural;
    }
    let (along, across) = goals(sign);
    if !(whip && scenario.step.either_way) {
        let along = if angle_rad < 0.3 && stated_rad.is_some() { None } else { Some(along) };
        part.goals.extend(along.map(|kind| crate::draft::Goal { kind, when: When::All }));
        part = part.keeping(When::All, across);
    }
    part = scenario.ending(scenario.beginning(part));
    if let Some(start) = &scenario.start {
        part = super::seen(part, start, When::Start);
    }
    if let Some(end) = &scenario.end {
        part = super::seen(part, end, When::End);
    }
    parts.push(part);
    parts
}

/// A turn that ends on a target: from what it starts on, or from a view turned away from it.
fn onto(
    scenario: &Scenario,
    end: &Target,
    away: impl Fn(&CameraState) -> CameraState,
) -> (Vec<Part>, CameraState, CameraState) {
    let (parts, first) = match (&scenario.start, &scenario.before) {
        (None, Some(before)) => (Vec::new(), *before),
        (Some(start), _) => scenario.opened_on(start, (0.25, 0.6)),
        (None, None) => {
            let view = scenario.view(end, &scenario.step.end, (0.3, 0.6), super::NORMAL_LENS_DEG);
            (Vec::new(), away(&view))
        }
    };
    let whole = aimed(scenario.world, &first, end.aim);
    let last = match scenario.step.end.part {
        ObjectPart::Left | ObjectPart::Right => aimed_at_side(scenario.world, end, scenario.step.end.part, whole),
        _ => whole,
    };
    (parts, first, last)
}

/// Turns about the view axis.
pub(super) fn roll(scenario: &Scenario) -> Vec<Part> {
    let (mut parts, first) = match (&scenario.before, &scenario.start, &scenario.end) {
        (Some(before), None, None) => (Vec::new(), *before),
        _ => scenario.opened_on(&scenario.main(), (0.4, 0.7)),
    };
    let degrees = match scenario.step.amount {
        Some(Amount::Degrees(degrees)) => degrees,
        Some(Amount::Slight) => 8.0,
        Some(Amount::Large) => 45.0,
        _ => 20.0,
    };
    let sign = scenario.sign(if scenario.step.movement == Move::RollCw { 1.0 } else { -1.0 });
    let count = (degrees / 60.0).ceil().max(1.0) as usize;
    // About the view axis z: positive turns x (right) toward y (down), which is clockwise for the operator.
    let rolled = |i: usize| {
        let angle = sign * degrees.to_radians() * i as f64 / count as f64;
        let pose = Pose::new(first.pose.position, first.pose.rotation * rotation::exp(DVec3::Z * angle));
        CameraState { pose, ..first }
    };
    let part = scenario.part((0..=count).map(rolled).collect(), (degrees / 12.0).clamp(2.0, 12.0));
    parts.push(super::seen(part, &scenario.main(), When::Start));
    parts
}
