//! Edits of `euler_deg` in a `shot.json`.
//!
//! Enters: keyframes as in the file, and the angles beside their quaternions. Leaves: keyframes whose rotations follow the
//! edited angles, and one line per edit. The one invariant: a quaternion beside the angles that were written for it keeps
//! its bits.
//!
//! Yaw counts from the heading of the first keyframe, which its quaternion gives: an edited yaw of the first keyframe
//! turns that keyframe alone, and the yaws of the others keep their meaning. The first keyframe of the file may not be the
//! one that the yaws were written for, because a person removed keyframes, put one in front, or replaced the first
//! quaternion. The file shows it where the first keyframe's own angles do not fit its quaternion and at least two
//! keyframes agree on another heading: yaw then counts from that heading. Who edits the quaternion of a keyframe has to
//! remove its `euler_deg`, because the angles decide.

use std::f64::consts::{PI, TAU};

use cinesplat_geometry::{LevelAngles, LevelFrame, rotation};
use cinesplat_trajectory::Keyframe;
use glam::{DQuat, DVec3};

/// Largest angle between a quaternion and the rounded angles that were written for it, degrees.
const TOLERANCE_DEG: f64 = 0.01;

/// The angles that a file holds beside the quaternion of a keyframe.
struct Written {
    key_idx: usize,
    quaternion: DQuat,
    angles: LevelAngles,
}

/// Sets the rotation of each keyframe whose angles were edited, and returns one line per edit.
///
/// `angles` holds one entry per keyframe: `None` without `euler_deg`. Without `up` the angles have no frame.
pub(super) fn apply(keys: &mut [Keyframe], angles: &[Option<LevelAngles>], up: Option<DVec3>) -> Vec<String> {
    let written = keys.iter().zip(angles).enumerate().filter_map(|(key_idx, (key, angles))| {
        Some(Written { key_idx, quaternion: key.pose.rotation, angles: (*angles)? })
    });
    let written: Vec<Written> = written.collect();
    let (Some(first_key), Some(first)) = (keys.first(), written.first()) else { return Vec::new() };
    let Some(level) = up.and_then(|up| LevelFrame::new(up).ok()) else {
        return vec![format!("keyframes[{}].euler_deg: ignored, because the file has no scene.up", first.key_idx)];
    };
    let own_start_rad = level.angles(first_key.pose.rotation).yaw_rad;
    let start_rad = start_yaw_rad(&level, &written, own_start_rad);
    let mut notes = Vec::new();
    let shift_deg = wrapped(start_rad - own_start_rad).to_degrees();
    if shift_deg.abs() > TOLERANCE_DEG {
        let side = if shift_deg > 0.0 { "right" } else { "left" };
        notes.push(format!(
            "keyframes: euler_deg.yaw counts from a heading {:.2} degrees to the {side} of the first keyframe's, \
             as after removing or replacing the first keyframe",
            shift_deg.abs()
        ));
    }
    for Written { key_idx, quaternion, angles } in &written {
        let edited = rotation_of(&level, *angles, start_rad);
        let off_deg = rotation::angle_between(*quaternion, edited).to_degrees();
        if off_deg > TOLERANCE_DEG {
            notes.push(format!(
                "keyframes[{key_idx}].euler_deg: {off_deg:.2} degrees from rotation_xyzw, so it was edited and decides"
            ));
            keys[*key_idx].pose.rotation = if quaternion.dot(edited) < 0.0 { -edited } else { edited };
        }
    }
    notes
}

/// The heading that yaw counts from: `own_start_rad`, that of the first keyframe, unless the file shows another.
fn start_yaw_rad(level: &LevelFrame, written: &[Written], own_start_rad: f64) -> f64 {
    let fits = |key: &Written, start_rad: f64| {
        let found = rotation_of(level, key.angles, start_rad);
        rotation::angle_between(key.quaternion, found).to_degrees() <= TOLERANCE_DEG
    };
    if written.first().is_some_and(|first| first.key_idx == 0 && fits(first, own_start_rad)) {
        return own_start_rad;
    }
    // The majority vote of Boyer and Moore: one pass, whatever the number of keyframes.
    let (mut majority_rad, mut lead) = (own_start_rad, 0_usize);
    for key in written {
        let start_rad = level.angles(key.quaternion).yaw_rad - key.angles.yaw_rad;
        if !fits(key, start_rad) {
            continue;
        }
        if lead == 0 {
            majority_rad = start_rad;
        }
        let agrees = wrapped(start_rad - majority_rad).to_degrees().abs() <= TOLERANCE_DEG;
        lead = if agrees { lead + 1 } else { lead - 1 };
    }
    let votes = |start_rad: f64| written.iter().filter(|key| fits(key, start_rad)).count();
    let majority = votes(majority_rad);
    if majority >= 2 && majority > votes(own_start_rad) { majority_rad } else { own_start_rad }
}

fn rotation_of(level: &LevelFrame, angles: LevelAngles, start_rad: f64) -> DQuat {
    level.rotation(LevelAngles { yaw_rad: angles.yaw_rad + start_rad, ..angles })
}

/// An angle in -pi..pi.
fn wrapped(angle_rad: f64) -> f64 {
    (angle_rad + PI).rem_euclid(TAU) - PI
}
