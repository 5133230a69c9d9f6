//! How a film passes its keys: what changes per second right before and right after each of them.
//!
//! Cubic curves through the keys that have these slopes follow the film more closely than lines: Bezier curves in Blender.

use super::opengl::opengl_rotation;
use super::track::{PoseFrame, PoseTrack};
use cinesplat_trajectory::{CameraPath, CameraState, Shot, TrajectoryError};

/// Step of a difference, over the time to the neighboring key.
const STEP_FRAC: f64 = 1e-4;
/// Numbers of a camera: position, rotation with OpenGL axes (x, y, z, w), vertical field of view in rad, focus distance.
pub(super) const NUM_VALUES: usize = 9;

/// The numbers of a camera, or their change per second.
pub(super) type CameraValues = [f64; NUM_VALUES];

/// The change per second at a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KeySlopes {
    /// On the way to the key; 0 at the first and after a cut.
    pub(super) before: CameraValues,
    /// On the way from the key; 0 at the last and before a cut.
    pub(super) after: CameraValues,
}

/// The numbers of a frame, with the sign of its rotation.
pub(super) fn values(frame: &PoseFrame) -> CameraValues {
    let (at, [x, y, z, w]) = (frame.pose.position, opengl_rotation(&frame.pose).to_array());
    let (fov, focus) = (frame.fov_y_rad.unwrap_or(1.0), frame.focus_distance.unwrap_or(0.0));
    [at.x, at.y, at.z, x, y, z, w, fov, focus]
}

/// The slopes of a shot's film at its keys.
///
/// # Errors
/// [`TrajectoryError`] if the shot is out of range.
pub(super) fn key_slopes(shot: &Shot) -> Result<Vec<KeySlopes>, TrajectoryError> {
    let path = CameraPath::new(shot)?;
    let keys = PoseTrack::keyframes(shot).frames;
    let slope = |idx: usize, neighbor: Option<usize>| {
        let Some(other) = neighbor.filter(|other| *other < keys.len() && !keys[idx.max(*other)].cut) else {
            return [0.0; NUM_VALUES];
        };
        let step = STEP_FRAC * (keys[other].time_secs - keys[idx].time_secs);
        let at_key = values(&keys[idx]);
        let [near, far] = [1.0, 2.0].map(|steps| beside(&at_key, &path.sample(keys[idx].time_secs + steps * step)));
        // One-sided and of second order.
        std::array::from_fn(|k| (4.0 * near[k] - 3.0 * at_key[k] - far[k]) / (2.0 * step))
    };
    let slopes = |idx: usize| KeySlopes { before: slope(idx, idx.checked_sub(1)), after: slope(idx, Some(idx + 1)) };
    Ok((0..keys.len()).map(slopes).collect())
}

/// The numbers of a state near a key, with the sign of the key's rotation.
fn beside(at_key: &CameraValues, state: &CameraState) -> CameraValues {
    let frame = PoseFrame {
        fov_y_rad: Some(state.fov_y_rad),
        focus_distance: state.focus_distance,
        ..PoseFrame::new(0.0, state.pose)
    };
    let mut found = values(&frame);
    if (3..7).map(|k| found[k] * at_key[k]).sum::<f64>() < 0.0 {
        (3..7).for_each(|k| found[k] = -found[k]);
    }
    found
}
