//! The view of a step that names no subject in a room: from where people stand, toward what there is to see.
//!
//! Parameter 4 picks the lookout, 0 turns the view by up to 11 degrees, 1 chooses how far it looks down.

use glam::DVec3;

use crate::composition::lens_fov_deg;
use crate::framing::Target;
use crate::lookout::Lookout;
use crate::lookouts::lookouts;
use crate::motion::StepParameters;
use crate::program::Framing;
use crate::view::{aimed, lerp, moved, picked};
use crate::world::World;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, ShotAngle, ShotSize};

/// Distance to the aim over the length of the line of sight: a move that closes in on it stops before the wall.
const AIM_FRAC: f64 = 0.62;
/// Range of the angle by which a standing person looks down into a room, degrees.
const DOWN_DEG: (f64, f64) = (6.0, 13.0);
/// Vertical field of view of a room, degrees, of a 20 to 26 mm lens; and of one that the prompt wants wide.
const ROOM_LENS_DEG: (f64, f64) = (50.0, 62.0);
const WIDE_LENS_DEG: (f64, f64) = (60.0, 70.0);
/// Aspect from which on the vertical field of view grows in a narrower frame, and its limit, degrees.
const LANDSCAPE: f64 = 16.0 / 9.0;
const MAX_FOV_DEG: f64 = 76.0;
/// Half the edge of the box about the aim that stands for the subject, over the distance to it.
const BOX_FRAC: f64 = 0.18;

/// What a view of a room is aimed at; `None` where nobody can stand.
pub(super) fn room_target(world: &World, parameters: &StepParameters) -> Option<Target> {
    let lookout = lookout(world, parameters)?;
    let off = parameters[0] * 2.0 - 1.0;
    let along = world.frame.direction(lookout.azimuth_rad + off * off.abs() * 0.2);
    let fall = lerp(DOWN_DEG, parameters[1]).to_radians().tan();
    Some(target_at(lookout.eye, (along - world.frame.up * fall) * AIM_FRAC * lookout.depth))
}

/// What a camera is aimed at that names nothing: a point on its view axis before the first surface.
pub(super) fn target_ahead(world: &World, camera: &CameraState) -> Target {
    let (eye, forward) = (camera.pose.position, camera.pose.forward());
    let sight = world.hit_distance(eye, forward).unwrap_or(0.6 * world.bounds.size());
    target_at(eye, forward * AIM_FRAC * sight)
}

/// The lookout's view of its target: at eye height, or as high as the framing says. `fov_deg` is the range that the move
/// needs, `None` the usual one of a room. No view where the framing cannot be
/// met by a person who stands there.
pub(super) fn room_view(
    world: &World,
    target: &Target,
    framing: &Framing,
    parameters: &StepParameters,
    fov_deg: Option<(f64, f64)>,
) -> Option<CameraState> {
    let lookout = lookout(world, parameters)?;
    let eye = world.eye_height();
    let height = match (framing.height, framing.angle) {
        (Some(height), _) => height,
        (None, None | Some(ShotAngle::EyeLevel)) => eye,
        (None, Some(ShotAngle::High)) => eye + lerp((0.35, 0.9), parameters[2]) * headroom(world, &lookout),
        (None, Some(ShotAngle::Low)) => lerp((0.2, 0.4), parameters[2]) * eye,
        (None, Some(ShotAngle::Overhead | ShotAngle::Worm)) => return None,
    };
    let position = lookout.eye + world.frame.up * (height - eye);
    let range = match (framing.lens, framing.size) {
        (Some(lens), _) => lens_fov_deg(lens),
        (None, Some(ShotSize::Long | ShotSize::ExtremeLong)) => for_aspect(world, WIDE_LENS_DEG),
        _ => fov_deg.unwrap_or_else(|| for_aspect(world, ROOM_LENS_DEG)),
    };
    let fov_y_rad = lerp(range, parameters[3]).to_radians();
    let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
    Some(aimed(world, &CameraState { pose, fov_y_rad, focus_distance: None }, target.aim))
}

/// Horizontal directions in which the room about a camera is measured.
const NUM_AROUND: u32 = 12;

/// The camera where the room is widest about it, from among the places where people stand: what turns all the way round stands
/// amid the room.
pub(super) fn amid_room(world: &World, state: &CameraState) -> CameraState {
    let frame = &world.frame;
    let height = frame.height(state.pose.position);
    let at = |point: &DVec3| frame.at_height(*point, height);
    let free = |eye: &DVec3| {
        let ways =
            (0..NUM_AROUND).map(|i| frame.direction(f64::from(i) / f64::from(NUM_AROUND) * std::f64::consts::TAU));
        ways.map(|way| world.hit_distance(*eye, way).unwrap_or(0.0)).fold(f64::INFINITY, f64::min)
    };
    let widest = world.viewpoints().iter().map(at).max_by(|a, b| free(a).total_cmp(&free(b)));
    widest.map_or(*state, |eye| moved(state, eye - state.pose.position))
}

/// Free height above a lookout, less the camera's radius.
fn headroom(world: &World, lookout: &Lookout) -> f64 {
    let eye = world.eye_height();
    let above = world.hit_distance(lookout.eye, world.frame.up).unwrap_or(0.6 * eye);
    (above.min(0.6 * eye) - 2.0 * world.camera_radius).max(0.0)
}

/// A range of the vertical field of view that shows as much of a room in a narrower frame: the half tangents grow with
/// the root of the lost width.
fn for_aspect(world: &World, (low, high): (f64, f64)) -> (f64, f64) {
    let factor = (LANDSCAPE / world.aspect).max(1.0).sqrt();
    let widened = |deg: f64| (2.0 * ((deg.to_radians() / 2.0).tan() * factor).atan().to_degrees()).min(MAX_FOV_DEG);
    (widened(low), widened(high))
}

/// The lookout of parameter 4; better ones more often.
fn lookout(world: &World, parameters: &StepParameters) -> Option<Lookout> {
    picked(lookouts(world), parameters[4] * parameters[4]).copied()
}

fn target_at(eye: DVec3, way: DVec3) -> Target {
    let (aim, half) = (eye + way, BOX_FRAC * way.length());
    let sign = |i: usize, bit: usize| if i >> bit & 1 == 1 { half } else { -half };
    let corners = (0..8).map(|i| aim + DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2))).collect();
    Target { ids: Vec::new(), aim, center: aim, corners, outline: None, radius: half * 3.0_f64.sqrt() }
}
