//! Where somebody stands in a room who looks at one subject and then at another.

use glam::DQuat;

use super::context::StepContext;
use crate::framing::{Target, extent_frac};
use crate::lookouts::standing_places;
use crate::view::{aimed, lerp, picked};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::CameraState;

/// Size of the larger of two subjects that are seen from one place.
const OVERLOOK_FILL: (f64, f64) = (0.4, 0.75);
/// Vertical field of view of a camera that turns from one to the other, degrees.
const OVERLOOK_LENS_DEG: (f64, f64) = (20.0, 58.0);
/// Height of the camera over that of a standing person's eyes.
const OVERLOOK_HEIGHT: (f64, f64) = (0.72, 1.08);

/// A camera that looks at the first of two subjects, where somebody stands in the room. Parameter 4 picks the place, 1 the
/// height, 2 the size of the larger subject. `None` where nobody can stand.
pub(super) fn overlook(context: &StepContext, targets: [&Target; 2]) -> Option<CameraState> {
    let world = context.world;
    let parameters = context.parameters;
    let place = picked(standing_places(world), parameters[4])?;
    let rise = (lerp(OVERLOOK_HEIGHT, parameters[1]) - 1.0) * world.eye_height();
    let pose = Pose { position: *place + world.frame.up * rise, rotation: DQuat::IDENTITY };
    let widest = CameraState { pose, fov_y_rad: OVERLOOK_LENS_DEG.1.to_radians(), focus_distance: None };
    let views = targets.map(|target| aimed(world, &widest, target.aim));
    let fill =
        views.iter().zip(targets).map(|(view, target)| extent_frac(world, view, target.sized_by()).max_element());
    let largest = fill.fold(0.0, f64::max);
    let tan = (widest.fov_y_rad / 2.0).tan() * largest / lerp(OVERLOOK_FILL, parameters[2]);
    let narrowest = OVERLOOK_LENS_DEG.0.to_radians();
    let fov_y_rad = (2.0 * tan.atan()).clamp(narrowest, widest.fov_y_rad);
    Some(CameraState { fov_y_rad, ..views[0] })
}
