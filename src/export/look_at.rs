//! `look_at` on keyframes of a `shot.json`: a point that the camera looks at, whatever else was edited.

use cinesplat_geometry::{LevelAngles, LevelFrame};
use cinesplat_trajectory::Keyframe;
use glam::{DQuat, DVec3};

/// Largest angle between the view axis and the direction to the point that needs no new aim, degrees.
const TOLERANCE_DEG: f64 = 0.01;

/// Aims every keyframe with a `look_at` at its point, and returns one line per keyframe that was turned. The roll about the
/// view axis stays; without `up` the camera turns by the smallest angle.
pub(super) fn apply(keys: &mut [Keyframe], up: Option<DVec3>) -> Vec<String> {
    let level = up.and_then(|up| LevelFrame::new(up).ok());
    let mut notes = Vec::new();
    for (idx, key) in keys.iter_mut().enumerate() {
        let point = key.intent.as_ref().and_then(|intent| intent.look_at);
        let Some(toward) = point.and_then(|point| (point - key.pose.position).try_normalize()) else { continue };
        let off_deg = key.pose.forward().angle_between(toward).to_degrees();
        if off_deg > TOLERANCE_DEG {
            key.pose.rotation = aimed(key.pose.rotation, toward, level.as_ref());
            notes.push(format!("keyframes[{idx}].look_at: the camera is turned by {off_deg:.2} degrees to look at it"));
        }
    }
    notes
}

fn aimed(rotation: DQuat, toward: DVec3, level: Option<&LevelFrame>) -> DQuat {
    match level {
        Some(level) => level.rotation(LevelAngles {
            yaw_rad: level.azimuth(toward),
            pitch_rad: toward.dot(level.up).clamp(-1.0, 1.0).asin(),
            roll_rad: level.angles(rotation).roll_rad,
        }),
        None => (DQuat::from_rotation_arc(rotation * DVec3::Z, toward) * rotation).normalize(),
    }
}
