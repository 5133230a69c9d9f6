//! Moves along a straight line without a turn: push in, pull out, truck, pedestal.

use glam::DVec3;

use super::{NORMAL_LENS_DEG, Scenario};
use crate::draft::{Axis, GoalKind, Part, When};
use crate::framing::{Fill, Target, bearing_of, distance_for, frame_position, in_frame_frac};
use crate::view::{lerp, moved, size_fill};
use crate::{Amount, Framing, Part as ObjectPart, Pass};
use cinesplat_trajectory::{CameraState, Move, ShotSize};

/// Seconds for a change of distance by a factor of two.
const SECS_PER_DOUBLING: f64 = 3.4;

/// Along the line to the subject, toward it or away.
pub(super) fn dolly(scenario: &Scenario) -> Vec<Part> {
    let inward = (scenario.step.movement == Move::PushIn) != (scenario.step.either_way && scenario.genes[5] < 0.5);
    let target = if inward { scenario.main() } else { scenario.start.clone().unwrap_or_else(|| left_behind(scenario)) };
    let fill = if inward { (0.2, 0.45) } else { (0.55, 0.95) };
    let (mut parts, first) =
        if scenario.before.is_none() && scenario.step.start.size.is_none() && !scenario.step.start.whole {
            (Vec::new(), open_first(scenario, &target, inward, fill))
        } else {
            scenario.opened_on(&target, fill)
        };
    let distance = first.pose.position.distance(target.aim);
    let ratio = distance_ratio(scenario, &target, &first, inward);
    let last = moved(&first, first.pose.forward() * distance * (1.0 - ratio));
    let natural = (ratio.ln().abs() / std::f64::consts::LN_2 * SECS_PER_DOUBLING).clamp(2.2, 7.0);
    let part = scenario.part(vec![first, last], natural);
    let wanted = if inward { (0.0, 0.76) } else { (1.32, f64::INFINITY) };
    let subtle = matches!(scenario.step.amount, Some(Amount::Slight | Amount::Units(_) | Amount::Factor(_)));
    let part = if subtle { part } else { part.keeping(When::All, GoalKind::DistanceRatio(target.aim, wanted)) };
    let part = part.keeping(When::All, GoalKind::Centered(target.clone(), 0.17));
    let mut part = scenario.ending(scenario.beginning(part));
    if !inward && scenario.step.end.whole && scenario.step.start.whole == scenario.step.end.whole {
        part = part.keeping(When::End, GoalKind::InFrame(scenario.step.end.subjects.clone(), 0.97));
    }
    if !inward && scenario.step.end.whole && scenario.before.is_none() {
        let left = target.ids.first();
        let ids = &scenario.step.end.subjects;
        let others: Vec<u32> = ids.iter().filter(|&id| Some(id) != left).copied().collect();
        part = part.keeping(When::Start, GoalKind::NotWhole(if others.is_empty() { ids.clone() } else { others }, 0.6));
    }
    if !inward {
        part = part.keeping(When::End, GoalKind::InFrame(target.ids.iter().take(1).copied().collect(), 0.95));
    }
    parts.push(super::seen(part, &target, When::All));
    parts
}

/// What a pull-out without a start of its own pulls away from: what was in view, else the first of what it ends on.
fn left_behind(scenario: &Scenario) -> Target {
    let first =
        Framing { subjects: scenario.step.end.subjects.iter().take(1).copied().collect(), ..Framing::default() };
    let first = || Target::of(scenario.world, &first);
    scenario.subject.clone().or_else(first).unwrap_or_else(|| scenario.main())
}

/// First view of a dolly whose start size is open: for a push that ends at a size, far enough out to push in.
fn open_first(scenario: &Scenario, target: &Target, inward: bool, fill: (f64, f64)) -> CameraState {
    let framing = if scenario.start.is_some() || !inward { scenario.step.start.clone() } else { Framing::default() };
    let angle = framing.angle.or(scenario.step.end.angle);
    let Some(size) = scenario.step.end.size.filter(|_| inward) else {
        return scenario.view(target, &Framing { angle, ..framing }, fill, NORMAL_LENS_DEG);
    };
    // The end decides: stand there, then back up.
    let end_framing = Framing { size: Some(size), angle, ..framing };
    let end = scenario.view(target, &end_framing, fill, NORMAL_LENS_DEG);
    let distance = end.pose.position.distance(target.aim);
    let back = lerp((1.4, 2.8), scenario.genes[6]);
    moved(&end, -end.pose.forward() * distance * back)
}

/// Distance at the end over that at the start.
fn distance_ratio(scenario: &Scenario, target: &Target, first: &CameraState, inward: bool) -> f64 {
    let distance = first.pose.position.distance(target.aim);
    let open = if inward { lerp((0.42, 0.66), scenario.genes[6]) } else { lerp((1.5, 2.8), scenario.genes[6]) };
    let size = scenario.step.end.size;
    let by_size = size.and_then(|size| size_ratio(scenario, target, first, size));
    let by_whole = || whole_ratio(scenario, first, distance);
    let stated = match scenario.step.amount {
        Some(Amount::Factor(factor)) => Some(factor),
        Some(Amount::Units(units)) => Some(1.0 + if inward { -units / distance } else { units / distance }),
        Some(Amount::Slight) => Some(if inward { 0.82 } else { 1.25 }),
        Some(Amount::Large) => Some(if inward { 0.32 } else { 3.2 }),
        _ => None,
    };
    let ratio = stated.or(by_size).or_else(|| (!inward).then(by_whole).flatten()).unwrap_or(open);
    if inward { ratio.clamp(0.05, 0.97) } else { ratio.clamp(1.03, 12.0) }
}

/// Ratio that makes the subject the wanted size at the end; `None` where that would go the other way.
fn size_ratio(scenario: &Scenario, target: &Target, first: &CameraState, size: ShotSize) -> Option<f64> {
    let inward = scenario.step.movement == Move::PushIn;
    let world = scenario.world;
    let subject = scenario.end.as_ref().unwrap_or(target);
    let wide = matches!(size, ShotSize::Long | ShotSize::ExtremeLong);
    let gene = match (wide && !inward, inward && scenario.before.is_none()) {
        (true, _) => 0.55 + 0.45 * scenario.genes[6],
        // The very size that the open start was backed up from.
        (false, true) => scenario.genes[2],
        (false, false) => scenario.genes[6],
    };
    let fill = match size_fill(size, gene) {
        Fill::Height(height) if scenario.step.end.subjects.is_empty() && wide => Fill::Height(height.min(0.4)),
        fill => fill,
    };
    let bearing = bearing_of(world, subject.aim, first.pose.position);
    let wanted = distance_for(world, subject, bearing, fill, first.fov_y_rad);
    let ratio = wanted / first.pose.position.distance(target.aim);
    let sensible = if inward { ratio < 0.9 } else { ratio > 1.1 };
    sensible.then_some(ratio)
}

/// Ratio at which all that the end names is in the frame, going straight back; `None` where the end names nothing.
fn whole_ratio(scenario: &Scenario, first: &CameraState, distance: f64) -> Option<f64> {
    let end = scenario.end.as_ref().filter(|_| scenario.step.end.whole)?;
    let ids = &scenario.step.end.subjects;
    let corners: Vec<DVec3> = ids
        .iter()
        .filter_map(|&id| scenario.world.subject(id))
        .flat_map(|s| s.corners.iter().copied())
        .chain(end.corners.iter().copied())
        .collect();
    let back = |ratio: f64| moved(first, first.pose.forward() * distance * (1.0 - ratio));
    let ratios = (0..40).map(|i| 1.32 * 1.07_f64.powi(i));
    let spare = lerp((1.0, 1.2), scenario.genes[7]);
    ratios.into_iter().find(|&ratio| in_frame_frac(&back(ratio), &corners, 0.02) >= 1.0).map(|ratio| ratio * spare)
}

/// Sideways, past or along something.
pub(super) fn truck(scenario: &Scenario) -> Vec<Part> {
    let sign = scenario.sign(if scenario.step.movement == Move::TruckLeft { -1.0 } else { 1.0 });
    let along = |state: &CameraState| state.pose.right() * sign;
    let axis = if sign > 0.0 { Axis::Right } else { Axis::Left };
    slide(scenario, axis, along, |scenario, target, state| {
        let right = state.pose.right() * sign;
        frame_depth(state, target.aim).map(|_| (target.aim - state.pose.position).dot(right)).map(|way| {
            let half = target.corners.iter().map(|c| (*c - target.aim).dot(right)).fold(0.0, f64::max);
            way + match scenario.step.end.part {
                ObjectPart::Left => -half * 0.8 * sign,
                ObjectPart::Right => half * 0.8 * sign,
                _ => 0.0,
            }
        })
    })
}

/// Up or down.
pub(super) fn pedestal(scenario: &Scenario) -> Vec<Part> {
    let sign = scenario.sign(if scenario.step.movement == Move::PedestalDown { -1.0 } else { 1.0 });
    let up = scenario.world.frame.up;
    let axis = if sign > 0.0 { Axis::Up } else { Axis::Down };
    slide(
        scenario,
        axis,
        |_| up * sign,
        |_, target, state| {
            // The rise that brings the target to the middle row: the view axis passes it at this height.
            let away = target.aim - state.pose.position;
            let forward = state.pose.forward();
            let level = forward - up * forward.dot(up);
            let reach = away.dot(level) / level.length_squared().max(1e-9);
            (reach > 0.0).then(|| (away - forward * reach).dot(up) * sign)
        },
    )
}

fn frame_depth(state: &CameraState, point: DVec3) -> Option<f64> {
    frame_position(state, point).map(|(_, depth)| depth)
}

/// A slide along an axis: from what it starts on to what it ends on, or about what it passes.
/// `way_to` gives the way along the axis that brings a target to the frame's middle.
fn slide(
    scenario: &Scenario,
    axis: Axis,
    along: impl Fn(&CameraState) -> DVec3,
    way_to: impl Fn(&Scenario, &Target, &CameraState) -> Option<f64>,
) -> Vec<Part> {
    let passed = scenario.step.via.as_ref().filter(|via| via.how == Pass::Past);
    let passed = passed
        .and_then(|via| Target::of(scenario.world, &Framing { subjects: via.objects.clone(), ..Framing::default() }));
    let same = matches!((&scenario.start, &scenario.end), (Some(a), Some(b)) if a.ids.first() == b.ids.first());
    let travels = scenario.end.is_some() && !same && (scenario.start.is_some() || scenario.before.is_some());
    let target = if travels { scenario.opening() } else { passed.clone().unwrap_or_else(|| scenario.main()) };
    let (mut parts, mut first) = match (&scenario.before, &scenario.start) {
        (Some(before), None) => (Vec::new(), *before),
        _ => scenario.opened_on(&target, (0.28, 0.6)),
    };
    if scenario.before.is_none() && axis_is_upright(axis) && scenario.step.start.angle.is_none() {
        first = leveled(scenario, &first, &target);
    }
    let distance = first.pose.position.distance(target.aim);
    let way = match (&scenario.end, travels) {
        (Some(end), true) => way_to(scenario, end, &first).unwrap_or(0.0),
        _ => open_way(scenario, &target, &first, &along, distance),
    };
    if scenario.before.is_none() && !travels {
        // Slide evenly about what is passed; a pedestal starts in front of it.
        let lead = if axis_is_upright(axis) { 0.12 } else { 0.5 };
        first = moved(&first, -along(&first) * way * lead);
    }
    let last = moved(&first, along(&first) * way);
    let natural = (way.abs() / distance.max(1e-9) * 5.0).clamp(2.5, 7.0);
    let mut part = scenario.part(vec![first, last], natural);
    let slight = matches!(scenario.step.amount, Some(Amount::Slight | Amount::Units(_)));
    part = part.keeping(When::All, GoalKind::Travel(axis, target.aim, if slight { 0.02 } else { 0.24 }));
    if travels {
        part = part.keeping(When::Start, GoalKind::Centered(target.clone(), 0.22));
        if let Some(end) = &scenario.end {
            part = part.keeping(When::End, GoalKind::Centered(end.clone(), 0.2));
            part = super::seen(part, end, When::End);
        }
        part = super::seen(part, &target, When::Start);
    } else if scenario.before.is_none() {
        let ids: Vec<u32> = target.ids.iter().take(1).copied().collect();
        let (when, share) = if same { (When::All, 0.35) } else { (When::All, 0.3) };
        part =
            part.keeping(when, GoalKind::InFrame(ids.clone(), share)).keeping(When::Any, GoalKind::InFrame(ids, 0.8));
        part = super::seen(part, &target, When::All);
    }
    parts.push(scenario.ending(scenario.beginning(part)));
    parts
}

fn axis_is_upright(axis: Axis) -> bool {
    matches!(axis, Axis::Up | Axis::Down)
}

/// The camera at the height of its target with a level view axis: what a pedestal starts from.
fn leveled(scenario: &Scenario, state: &CameraState, target: &Target) -> CameraState {
    let frame = &scenario.world.frame;
    let fall = frame.height(state.pose.position - target.aim) * lerp((1.0, 0.4), scenario.genes[7]);
    let lowered = moved(state, -frame.up * fall);
    crate::view::aimed(scenario.world, &lowered, target.aim)
}

/// Length of a slide whose end the words leave open.
fn open_way(
    scenario: &Scenario,
    target: &Target,
    state: &CameraState,
    along: impl Fn(&CameraState) -> DVec3,
    distance: f64,
) -> f64 {
    let axis = along(state);
    let reach = target.corners.iter().map(|c| (*c - target.aim).dot(axis).abs()).fold(0.0, f64::max);
    match scenario.step.amount {
        Some(Amount::Units(units)) => units,
        Some(Amount::Slight) => 0.12 * distance,
        Some(Amount::Large) => 0.9 * distance,
        _ => lerp((0.34, 0.75), scenario.genes[6]) * distance.max(0.8 * reach),
    }
}
