//! Paths through keyframes.

mod hard_keys;
mod moves;
mod shots;

use cinesplat::geometry::{LevelAngles, LevelFrame, Pose};
use cinesplat::trajectory::{Easing, Keyframe, SceneRef, Shot};
use glam::DVec3;

/// A shot over keys in a world whose up is +y.
pub fn shot(keyframes: Vec<Keyframe>) -> Shot {
    Shot {
        scene: SceneRef { up: Some(DVec3::Y), ..SceneRef::default() },
        prompt: String::new(),
        seed: 0,
        model: None,
        width: 640,
        height: 360,
        fps: 30.0,
        duration_secs: keyframes.last().map_or(0.0, |key| key.time_secs),
        keyframes,
        effects: Vec::new(),
        report: Vec::new(),
    }
}

/// A key at a place, level, heading at yaw 0.
pub fn key(time_secs: f64, position: DVec3) -> Keyframe {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let rotation = frame.rotation(LevelAngles::default());
    Keyframe {
        time_secs,
        pose: Pose { position, rotation },
        fov_y_rad: 0.8,
        focus_distance: None,
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
