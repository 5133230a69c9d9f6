//! Paths through keyframes.

mod blends;
mod bounds;
mod easing;
mod hard_keys;
mod moves;
mod shots;
mod stops;

use cinesplat::geometry::{LevelAngles, LevelFrame, Pose};
use cinesplat::trajectory::{Easing, Keyframe, Shot};
use glam::DVec3;

pub use crate::support::shot_over as shot;

/// A level key at a position, with yaw 0.
pub fn key(time_secs: f64, position: DVec3) -> Keyframe {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let rotation = frame.rotation(LevelAngles::default());
    Keyframe {
        time_secs,
        pose: Pose { position, rotation },
        fov_y_rad: 0.8,
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing: Easing::Linear,
        cut: false,
        intent: None,
    }
}

/// Positions at even times.
pub fn positions(shot: &Shot, count: usize) -> Vec<DVec3> {
    let path = cinesplat::trajectory::CameraPath::new(shot).unwrap();
    (0..count).map(|i| path.sample(shot.duration_secs * i as f64 / (count - 1) as f64).pose.position).collect()
}
