//! The opening view of a step whose prompt states where the camera stands: at an object, or behind the shoulder of one.
//!
//! Enters: a step with the values of its open parameters. Leaves: the camera at the stated place.

use glam::DVec3;

use crate::composition::{front_azimuth, lens_fov_deg};
use crate::framing::{Fill, Target, extent_frac};
use crate::motion::StepParameters;
use crate::passage::STANDING_FRAC;
use crate::program::{Framing, Pass, Step};
use crate::view::{aimed, aimed_at_side, lerp, stated_fill, with_fov};
use crate::world::{Subject, World};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move};

/// Largest angle about an object between the way back from the target and a camera over its shoulder.
const MAX_ASIDE_RAD: f64 = 1.1;

/// Narrowest and widest vertical field of view for a size that the prompt states, degrees.
const LENS_LIMITS_DEG: (f64, f64) = (9.0, 84.0);

/// A step whose camera may stand at a stated place.
#[derive(Clone, Copy)]
pub(super) struct Standing<'a> {
    pub(super) world: &'a World,
    pub(super) step: &'a Step,
    pub(super) parameters: &'a StepParameters,
}

/// The object over whose shoulder the step sees its subject: the one that a held camera or a push-in is past.
pub(super) fn shoulder(standing: &Standing) -> Option<u32> {
    let holds = matches!(standing.step.movement, Move::Static | Move::Handheld | Move::PushIn);
    let via = standing.step.via.as_ref().filter(|via| holds && via.how == Pass::Past)?;
    let id = *via.objects.first()?;
    let ends = [&standing.step.start, &standing.step.end];
    let framed = ends.iter().any(|framing| framing.subjects.first().is_some_and(|&subject| subject != id));
    (framed && standing.world.subject(id).is_some()).then_some(id)
}

/// The object at which the camera stands where the step starts.
pub(super) fn stood_at(standing: &Standing) -> Option<u32> {
    let via = standing.step.via.as_ref().filter(|via| via.how == Pass::From)?;
    via.objects.first().copied().filter(|&id| standing.world.subject(id).is_some())
}

/// Whether the prompt states the place of the opening by another object.
pub(super) fn stands(standing: &Standing) -> bool {
    stood_at(standing).or_else(|| shoulder(standing)).is_some()
}

/// The opening view of a target from the stated place; `None` where the prompt states none. `fill` and `fov_deg` are the
/// ranges of size and field of view where the prompt states none.
pub(super) fn standing_view(
    standing: &Standing,
    target: &Target,
    framing: &Framing,
    fill: (f64, f64),
    fov_deg: (f64, f64),
) -> Option<CameraState> {
    let subject = |id: Option<u32>| id.and_then(|id| standing.world.subject(id));
    let position = match (subject(stood_at(standing)), subject(shoulder(standing))) {
        (Some(subject), _) => beside(standing, subject, target, framing),
        (None, Some(subject)) => behind_shoulder(standing, subject, target, framing)?,
        (None, None) => return None,
    };
    let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
    let fov_y_rad = lerp(fov_deg, standing.parameters[3]).to_radians();
    let camera = CameraState { pose, fov_y_rad, focus_distance: None };
    let view = aimed(
        standing.world,
        &camera,
        if target.ids.is_empty() { into_room(standing, position, target) } else { target.aim },
    );
    let view = filled(standing, target, framing, &view, fill, fov_deg);
    Some(aimed_at_side(standing.world, target, framing.part, view))
}

/// Steepest view down of somebody who stands and looks into a room, degrees.
const INTO_ROOM_DEG: f64 = 7.0;

/// The aim of somebody who stands at a place and looks at nothing in particular: toward the target, and nearly level.
fn into_room(standing: &Standing, position: DVec3, target: &Target) -> DVec3 {
    let frame = &standing.world.frame;
    let away = target.aim - position;
    let least = -frame.horizontal(away).length() * INTO_ROOM_DEG.to_radians().tan();
    if standing.world.is_indoor() { target.aim + frame.up * (least - frame.height(away)).max(0.0) } else { target.aim }
}

/// A place beside an object, next to its box: toward the target, toward the middle of the scene, or anywhere. Parameters
/// 0 and 4 choose the direction, 1 the height and 2 the room to the box.
fn beside(standing: &Standing, subject: &Subject, target: &Target, framing: &Framing) -> DVec3 {
    let (world, frame, parameters) = (standing.world, &standing.world.frame, standing.parameters);
    let off = parameters[0] * 2.0 - 1.0;
    let to_target = frame.horizontal(target.aim - subject.center);
    let front = front_azimuth(world, subject.center);
    let middle = if to_target.length() > 1e-9 { frame.azimuth(to_target) } else { front };
    let azimuth = match parameters[4] {
        pick if pick < 0.4 => middle + off,
        pick if pick < 0.7 => front + off,
        _ => middle + off * std::f64::consts::PI,
    };
    let direction = frame.direction(azimuth);
    let size = world.bounds.size();
    let margin = 1.5 * world.camera_radius + lerp((0.0, 0.55 * STANDING_FRAC), parameters[2]) * size;
    let upright = subject.axis_along(frame.up);
    let mut across = subject.in_box(subject.center + direction).abs();
    across[upright] = 0.0;
    let exit = 1.0 / across.max_element().max(1e-9);
    let height = framing.height.unwrap_or_else(|| {
        let center = world.height_above_floor(subject.center);
        let top = center + subject.reach(frame.up);
        let low = center.min(world.eye_height()).max(1.5 * world.camera_radius);
        lerp((low, (top + 0.5 * STANDING_FRAC * size).min(world.eye_height().max(center))), parameters[1])
    });
    subject.center + direction * (exit + margin) + frame.up * (height - world.height_above_floor(subject.center))
}

/// A place behind an object, seen from the target, more or less aside and mostly above its middle; `None` where one is
/// above the other. Parameter 0 chooses the side, 1 the height and 2 the distance.
fn behind_shoulder(standing: &Standing, subject: &Subject, target: &Target, framing: &Framing) -> Option<DVec3> {
    let (world, frame, parameters) = (standing.world, &standing.world.frame, standing.parameters);
    let back = frame.horizontal(subject.center - target.aim).try_normalize()?;
    let off = parameters[0] * 2.0 - 1.0;
    let back = frame.direction(frame.azimuth(back) + off * off.abs() * MAX_ASIDE_RAD);
    let right = frame.up.cross(back);
    let size = world.bounds.size();
    let room = 1.5 * world.camera_radius + lerp((0.0, 0.2), parameters[2]) * size;
    let aside = -off.signum() * (lerp((0.4, 1.5), off.abs()) * subject.reach(right) + 0.25 * room);
    let half = subject.reach(frame.up);
    let free = lerp((-0.2 * half, (1.6 * half).max(0.1 * size)), parameters[1]);
    let rise = framing.height.map_or(free, |height| height - world.height_above_floor(subject.center));
    Some(subject.center + back * (subject.reach(back) + room) + right * aside + frame.up * rise)
}

/// The view with the stated lens, or else with the lens that gives the target its size.
fn filled(
    standing: &Standing,
    target: &Target,
    framing: &Framing,
    view: &CameraState,
    fill: (f64, f64),
    fov_deg: (f64, f64),
) -> CameraState {
    if let Some(lens) = framing.lens {
        return with_fov(view, lerp(lens_fov_deg(lens), standing.parameters[3]).to_radians());
    }
    let extent = extent_frac(standing.world, view, target.sized_by());
    let stated = stated_fill(framing, standing.parameters[5]);
    let (now, wanted) = match stated.unwrap_or(Fill::Fit(lerp(fill, standing.parameters[5]))) {
        Fill::Height(wanted) => (extent.y, wanted),
        Fill::Fit(wanted) => (extent.max_element(), wanted),
    };
    let (narrow, wide) = if stated.is_some() { LENS_LIMITS_DEG } else { (0.7 * fov_deg.0, fov_deg.1) };
    let tan = (view.fov_y_rad / 2.0).tan() * now / wanted;
    with_fov(view, (2.0 * tan.atan()).clamp(narrow.to_radians(), wide.to_radians()))
}
