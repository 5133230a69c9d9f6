//! The cameras that the director proposes, and the one candidate of a film that is not searched.

use glam::DQuat;

use super::lookouts::lookouts;
use super::motion::{NUM_PARAMETERS, StepParameters};
use super::world::World;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::CameraState;

/// The cameras that the director proposes for one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepCameras {
    /// Camera at the start of the step.
    pub start: CameraState,
    /// Camera at the end of the step.
    pub end: CameraState,
    /// Time from the first to the second, seconds.
    pub secs: f64,
}

/// Parameters 0 and 1: below 0.4, so that a path between two views is straight, and nearly in the middle of what they
/// choose elsewhere.
const STRAIGHT: f64 = 0.39;
/// Parameter 4 where the director proposes a camera: the last of the preferred azimuths, which is the director's.
const PROPOSED_AZIMUTH: f64 = 0.64;

/// Parameter 4 of a step without a subject: the best lookout.
const BEST_LOOKOUT: f64 = 0.0;

/// Cameras at the place with the widest view of the scene, in place of the director's: for their bearing alone. `None`
/// where there is no such place.
pub(super) fn at_viewpoint(world: &World) -> Option<StepCameras> {
    let lookout = lookouts(world).first().map(|lookout| lookout.eye);
    let pose = Pose { position: lookout.or_else(|| world.viewpoints().first().copied())?, rotation: DQuat::IDENTITY };
    let camera = CameraState { pose, fov_y_rad: 1.0, focus_distance: None };
    Some(StepCameras { start: camera, end: camera, secs: 0.0 })
}

/// The open parameters of a step without a search ([`SolveLevel::Off`](super::settings::SolveLevel)): the middle of each
/// range, straight paths, and the bearing of the step's first proposed camera. A step that does not name objects has the
/// best lookout of a room instead.
pub(super) fn parameters_without_search(suggestion: Option<&StepCameras>, names_objects: bool) -> StepParameters {
    let mut out = [0.5; NUM_PARAMETERS];
    (out[0], out[1]) = (STRAIGHT, STRAIGHT);
    if !names_objects {
        out[4] = BEST_LOOKOUT;
    } else if suggestion.is_some() {
        out[4] = PROPOSED_AZIMUTH;
    }
    out
}
