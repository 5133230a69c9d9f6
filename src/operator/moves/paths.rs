//! Moves along a free path: from view to view, between or over things, into sight, back to the start.

use glam::DVec3;

use super::{NORMAL_LENS_DEG, Scenario};
use crate::draft::{GoalKind, Part, When};
use crate::framing::{Fill, Target, bearing_of, distance_for, off_center, view_at};
use crate::view::{aimed, lerp, moved};
use crate::{Pass, Via};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Move};

/// From the view before (or of what it starts on) to a view of what it ends on.
pub(super) fn follow(scenario: &Scenario) -> Vec<Part> {
    let (start, end) = (scenario.opening(), scenario.main());
    let first = match &scenario.before {
        Some(before) => *before,
        None => scenario.view(&start, &scenario.opening_framing(), (0.4, 0.7), NORMAL_LENS_DEG),
    };
    let last = end_view(scenario, &end, &first);
    let mut part = glide(scenario, &first, &last);
    part = scenario.ending(scenario.beginning(part)).keeping(When::End, GoalKind::Centered(end.clone(), 0.15));
    if scenario.before.is_none() {
        part = super::seen(part, &start, When::Start);
    }
    vec![super::seen(part, &end, When::End)]
}

/// A view of the end of a step, through the lens of its start so that the way alone changes the picture.
fn end_view(scenario: &Scenario, end: &Target, first: &CameraState) -> CameraState {
    let world = scenario.world;
    let near = bearing_of(world, end.aim, first.pose.position);
    let genes = scenario.genes;
    // A tent about the bearing the camera comes from: the shortest way shows the side it sees already.
    let spread = |gene: f64| (gene * 2.0 - 1.0) * (gene * 2.0 - 1.0).abs();
    let band = scenario.step.end.angle.map(|angle| {
        let (low, high) = super::circles::pitch_band_deg(angle);
        (-high.min(34.0), -low.max(-70.0))
    });
    let elevation_deg = match band {
        Some(band) => lerp(band, genes[7]),
        None => (near.elevation_rad.to_degrees() * 0.5 + lerp((-6.0, 20.0), genes[7]) * 0.7).clamp(-12.0, 40.0),
    };
    let bearing = crate::framing::Bearing {
        azimuth_rad: near.azimuth_rad + spread(genes[5]) * 2.4,
        elevation_rad: elevation_deg.to_radians(),
    };
    let fill = match scenario.step.end.size {
        Some(size) => crate::view::size_fill(size, genes[6]),
        None => Fill::Fit(lerp((0.35, 0.7), genes[6])),
    };
    let fill = if scenario.step.end.whole { Fill::Fit(lerp((0.5, 0.85), genes[6])) } else { fill };
    let distance = distance_for(world, end, bearing, fill, first.fov_y_rad);
    view_at(world, end.aim, bearing, distance, first.fov_y_rad)
}

/// A way from one view to another, straight or with a bow to one side or up that the search may use to go around things.
fn glide(scenario: &Scenario, first: &CameraState, last: &CameraState) -> Part {
    let way = last.pose.position - first.pose.position;
    let length = way.length();
    let frame = &scenario.world.frame;
    let aside = way.cross(frame.up).try_normalize().unwrap_or_else(|| first.pose.right());
    let bow = |gene: f64| if gene < 0.4 { 0.0 } else { (gene - 0.7) / 0.3 * 0.35 * length };
    let offset = aside * bow(scenario.genes[0]) + frame.up * bow(scenario.genes[1]).max(-0.1 * length);
    let states = if offset.length() > 1e-6 * length && length > 0.0 {
        vec![*first, halfway(scenario, first, last, offset), *last]
    } else {
        vec![*first, *last]
    };
    let angle_deg = rotation::angle_between(first.pose.rotation, last.pose.rotation).to_degrees();
    let natural = (angle_deg / 20.0).max(length / scenario.world.bounds.size() * 11.0).clamp(2.5, 8.0);
    scenario.part(states, natural)
}

/// A state in the middle of two, moved aside, with the rotation half way in yaw and pitch.
fn halfway(scenario: &Scenario, first: &CameraState, last: &CameraState, offset: DVec3) -> CameraState {
    let frame = &scenario.world.frame;
    let (a, b) = (frame.angles(first.pose.rotation), frame.angles(last.pose.rotation));
    let turn = (b.yaw_rad - a.yaw_rad + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    let middle = cinesplat_geometry::LevelAngles {
        yaw_rad: a.yaw_rad + turn / 2.0,
        pitch_rad: a.pitch_rad.midpoint(b.pitch_rad),
        roll_rad: a.roll_rad.midpoint(b.roll_rad),
    };
    let position = first.pose.position.lerp(last.pose.position, 0.5) + offset;
    let pose = cinesplat_geometry::Pose { position, rotation: frame.rotation(middle) };
    CameraState { pose, fov_y_rad: first.fov_y_rad.midpoint(last.fov_y_rad), focus_distance: None }
}

/// Back to the pose and lens of the shot's first frame.
pub(super) fn back_to_origin(scenario: &Scenario) -> Vec<Part> {
    let (Some(before), Some(origin)) = (scenario.before, scenario.origin) else { return Vec::new() };
    let mut part = glide(scenario, &before, &origin);
    part.movement = Move::Follow;
    vec![part]
}

/// Between two things or over one, toward what the step ends on.
pub(super) fn passing(scenario: &Scenario) -> Vec<Part> {
    let Some(gate) = scenario.step.via.as_ref().and_then(|via| gate(scenario, via)) else { return follow(scenario) };
    let frame = &scenario.world.frame;
    let goal = scenario.end.clone();
    let (mut parts, first) = match &scenario.before {
        Some(before) => scenario.turned_to(before, gate),
        None => (Vec::new(), before_gate(scenario, gate, goal.as_ref())),
    };
    let last = match &goal {
        Some(goal) => {
            let along = (goal.aim - gate).length();
            let stop = gate.lerp(goal.aim, lerp((0.25, 0.75), scenario.genes[6]));
            let stop = stop + frame.up * lerp((-0.1, 0.25), scenario.genes[7]) * along;
            aimed(scenario.world, &moved(&first, stop - first.pose.position), goal.aim)
        }
        None => moved(&first, (gate - first.pose.position) * 2.0),
    };
    let aim = goal.as_ref().map_or(gate + (gate - first.pose.position) * 4.0, |goal| goal.aim);
    let middle = aimed(scenario.world, &moved(&first, gate - first.pose.position), aim);
    let length = first.pose.position.distance(gate) + gate.distance(last.pose.position);
    let natural = (length / scenario.world.bounds.size() * 11.0).clamp(3.0, 8.0);
    let mut part = scenario.part(vec![first, middle, last], natural);
    if let Some(goal) = goal {
        if off_center(&first, goal.aim) < 0.5 {
            part = part.about(goal.aim);
            part.states[0] = aimed(scenario.world, &first, goal.aim);
            if let Some(join) = parts.last_mut() {
                let end = join.states.len() - 1;
                join.states[end] = part.states[0];
            }
        }
        part = part.keeping(When::All, GoalKind::DistanceRatio(goal.aim, (0.0, 0.57)));
        part = part.keeping(When::End, GoalKind::Centered(goal.clone(), 0.2));
        part = super::seen(scenario.ending(part), &goal, When::End);
    }
    parts.push(part);
    parts
}

/// The point to pass through: on the line between two things at their common height, or above one.
fn gate(scenario: &Scenario, via: &Via) -> Option<DVec3> {
    let world = scenario.world;
    let frame = &world.frame;
    let subject = |i: usize| via.objects.get(i).and_then(|&id| world.subject(id));
    let first = subject(0)?;
    let top = |corners: &[DVec3]| corners.iter().map(|&c| frame.height(c)).fold(f64::NEG_INFINITY, f64::max);
    match (via.how, subject(1)) {
        (Pass::Between, Some(second)) => {
            let at = first.center.lerp(second.center, lerp((0.3, 0.7), scenario.genes[0]));
            let floor = frame.height(world.bounds.core_min).min(frame.height(world.bounds.core_max));
            let high = top(&first.corners).max(top(&second.corners));
            let height = lerp((0.35, 1.05), scenario.genes[1]) * (high - floor) + floor;
            Some(frame.horizontal(at) + frame.up * height)
        }
        (Pass::Over, _) => {
            let rise = top(&first.corners) - frame.height(first.center);
            let over = rise + world.camera_radius * 2.0 + lerp((0.05, 0.7), scenario.genes[1]) * first.radius;
            Some(first.center + frame.up * over)
        }
        _ => None,
    }
}

/// Where the camera starts before it passes the gate: on the far side of it from where it goes.
fn before_gate(scenario: &Scenario, gate: DVec3, goal: Option<&Target>) -> CameraState {
    let world = scenario.world;
    let frame = &world.frame;
    let size = world.bounds.size();
    let heading = match goal {
        Some(goal) => frame.azimuth(goal.aim - gate),
        None => scenario.genes[2] * std::f64::consts::TAU,
    };
    let heading = heading + (scenario.genes[2] - 0.5) * 1.2;
    let back = lerp((0.08, 0.4), scenario.genes[3]) * size;
    let rise = (scenario.genes[4] - 0.4) * 0.15 * size;
    let position = gate - frame.direction(heading) * back + frame.up * rise;
    let fov_y_rad = lerp((40.0, 58.0), scenario.genes[5]).to_radians();
    let state = CameraState {
        pose: cinesplat_geometry::Pose { position, rotation: glam::DQuat::IDENTITY },
        fov_y_rad,
        focus_distance: None,
    };
    aimed(world, &state, goal.map_or(gate, |goal| goal.aim))
}

/// From where the subject is out of the frame, sideways to where it shows.
pub(super) fn reveal(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let last = match &scenario.before {
        Some(before) => end_view(scenario, &target, before),
        None => scenario.view(&target, &scenario.step.end, (0.4, 0.7), NORMAL_LENS_DEG),
    };
    let first = match &scenario.before {
        Some(before) => *before,
        None => moved(&last, out_of_frame(scenario, &last, &target)),
    };
    let mut part = glide(scenario, &first, &last);
    part = scenario.ending(part).keeping(When::End, GoalKind::Centered(target.clone(), 0.15));
    if scenario.before.is_none() {
        part = part.keeping(When::Start, GoalKind::NotWhole(target.ids.iter().take(1).copied().collect(), 0.25));
    }
    vec![super::seen(part, &target, When::End)]
}

/// The way that takes a camera to where its target is out of the frame, against the direction of the reveal.
fn out_of_frame(scenario: &Scenario, last: &CameraState, target: &Target) -> DVec3 {
    let distance = last.pose.position.distance(target.aim);
    let half_height = (last.fov_y_rad / 2.0).tan() * distance;
    let half_width = half_height * crate::framing::DEFAULT_ASPECT;
    let (right, up) = (last.pose.right(), scenario.world.frame.up);
    let aside = right * (half_width * 1.05 + target.radius);
    let aloft = up * (half_height * 1.05 + target.radius);
    match scenario.step.with {
        Some(Move::TruckRight | Move::PanRight | Move::OrbitRight | Move::ArcRight) => -aside,
        Some(Move::TruckLeft | Move::PanLeft | Move::OrbitLeft | Move::ArcLeft) => aside,
        Some(Move::PedestalUp | Move::CraneUp | Move::TiltUp) => -aloft,
        Some(Move::PedestalDown | Move::CraneDown | Move::TiltDown) => aloft,
        Some(Move::PullOut) => last.pose.forward() * (0.8 * distance) + aside * 0.5,
        _ if scenario.genes[5] < 0.5 => -aside,
        _ => aside,
    }
}
