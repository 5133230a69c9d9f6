use glam::DVec3;

use super::{ClearanceProof, Easing, Move, ShotAngle, ShotSize, TrajectoryError};
use cinesplat_geometry::Pose;

/// A shot: keyframes with what they are for. The in-memory twin of `shot.json`, version 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The scene it was made for.
    pub scene: SceneRef,
    /// The sentence, empty for an imported path.
    pub prompt: String,
    /// Seed of every random choice.
    pub seed: u64,
    /// The weights that directed it, if any.
    pub model: Option<ModelRef>,
    /// Frame width in pixels.
    pub width: u32,
    /// Frame height in pixels.
    pub height: u32,
    /// Frames a second.
    pub fps: f64,
    /// Length of the film.
    pub duration_secs: f64,
    /// Keys in order of time.
    pub keyframes: Vec<Keyframe>,
    /// Effects that the words or a person asked for.
    pub effects: Vec<EffectRequest>,
    /// What was asked for and what came of it, clause by clause.
    pub report: Vec<ReportLine>,
    /// What was proved about the path's distance to matter; `None` for a path that was not looked at, or changed since.
    pub clearance: Option<ClearanceProof>,
}

/// Which scene a shot belongs to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SceneRef {
    /// Path as written in the file (relative to it), or empty.
    pub path: String,
    /// SHA-256 of the scene file in hex, or empty.
    pub sha256: String,
    /// World up, unit length; `None` when the file does not say.
    pub up: Option<DVec3>,
}

/// Which weights made a shot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModelRef {
    /// Name of the model.
    pub name: String,
    /// SHA-256 of the weights in hex.
    pub sha256: String,
}

/// The camera at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Keyframe {
    /// When.
    pub time_secs: f64,
    /// Where, `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view.
    pub fov_y_rad: f64,
    /// Distance of sharpest focus along the view axis, scene units; `None` without depth of field.
    pub focus_distance: Option<f64>,
    /// Shape of the segment that starts here.
    pub easing: Easing,
    /// Whether the camera jumps from the key before to this one.
    pub cut: bool,
    /// What the key is for.
    pub intent: Option<Intent>,
}

/// What a key shows and what the segment that starts at it does.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Intent {
    /// Ids of the objects it is about, the main one first.
    pub subjects: Vec<u32>,
    /// How large the main subject is.
    pub size: Option<ShotSize>,
    /// The move of the segment that starts here.
    pub movement: Option<Move>,
    /// From how high the subject is seen.
    pub angle: Option<ShotAngle>,
    /// Byte range of the prompt this comes from.
    pub words: Option<[usize; 2]>,
    /// For orbits and arcs: the point that the upright axis of the circle goes through, world. With it the path
    /// between this key and the next is a true circle; JSON key `pivot`, an addition to version 1.
    pub pivot: Option<DVec3>,
}

/// An effect called for.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectRequest {
    /// Name, as in `--effects`.
    pub kind: String,
    /// Why it is there, for a person to read.
    pub because: String,
    /// Further settings, kept as they were read.
    pub settings: Vec<(String, f64)>,
}

/// One line of the report: what a clause wanted and what it got.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportLine {
    /// The clause, in words of the prompt.
    pub clause: String,
    /// What it means as a number.
    pub wanted: String,
    /// What the shot does.
    pub got: f64,
    /// Whether that is as wanted.
    pub met: bool,
    /// What gave way and why, or empty.
    pub note: String,
}

impl Shot {
    /// A shot of keyframes alone: of no scene in particular, without a prompt, nothing decided or reported.
    pub fn of_keyframes(size_px: [u32; 2], fps: f64, duration_secs: f64, keyframes: Vec<Keyframe>) -> Self {
        let [width, height] = size_px;
        Self {
            scene: SceneRef::default(),
            prompt: String::new(),
            seed: 0,
            model: None,
            width,
            height,
            fps,
            duration_secs,
            keyframes,
            effects: Vec::new(),
            report: Vec::new(),
            clearance: None,
        }
    }

    /// Number of frames of the film: duration times rate, at least one. Frame `k` is the camera at `k / fps`.
    pub fn num_frames(&self) -> usize {
        ((self.duration_secs * self.fps).round() as usize).max(1)
    }

    /// Time of frame `frame_idx`.
    pub fn frame_time_secs(&self, frame_idx: usize) -> f64 {
        frame_idx as f64 / self.fps
    }

    /// The shot, once all its numbers are usable: the one check at the border between files and the engine.
    ///
    /// # Errors
    /// [`TrajectoryError`] naming the first keyframe and field at fault.
    pub fn validated(self) -> Result<Self, TrajectoryError> {
        check_shot_values(&self)?;
        for (index, key) in self.keyframes.iter().enumerate() {
            check_keyframe(index, key)?;
            if let Some(previous) = index.checked_sub(1).and_then(|i| self.keyframes.get(i)) {
                // Written so that NaN fails.
                if !(key.time_secs > previous.time_secs) {
                    let (found, previous) = (key.time_secs, previous.time_secs);
                    return Err(TrajectoryError::TimesNotIncreasing { index, found, previous });
                }
            }
        }
        Ok(self)
    }
}

fn check_shot_values(shot: &Shot) -> Result<(), TrajectoryError> {
    if shot.keyframes.is_empty() {
        return Err(TrajectoryError::NoKeyframes);
    }
    let bad = |field, found: String, expected| Err(TrajectoryError::BadShotValue { field, found, expected });
    if !(1..=16384).contains(&shot.width) || !(1..=16384).contains(&shot.height) {
        return bad("width x height", format!("{} x {}", shot.width, shot.height), "1..16384 each");
    }
    if !(shot.fps > 0.0 && shot.fps <= 1000.0) {
        return bad("fps", shot.fps.to_string(), "above 0, at most 1000");
    }
    if !(shot.duration_secs >= 0.0 && shot.duration_secs <= 86_400.0) {
        return bad("duration_secs", shot.duration_secs.to_string(), "0..86400");
    }
    Ok(())
}

fn check_keyframe(index: usize, key: &Keyframe) -> Result<(), TrajectoryError> {
    let bad = |field, found: String, expected| Err(TrajectoryError::BadValue { index, field, found, expected });
    if !(key.time_secs >= 0.0 && key.time_secs <= 86_400.0) {
        return bad("time_secs", key.time_secs.to_string(), "0..86400");
    }
    if !key.pose.position.is_finite() {
        return bad("position", key.pose.position.to_string(), "three finite numbers");
    }
    if !((key.pose.rotation.length() - 1.0).abs() < 1e-3) {
        return bad("rotation_xyzw", key.pose.rotation.to_string(), "a unit quaternion");
    }
    let fov_deg = key.fov_y_rad.to_degrees();
    if !(fov_deg > 0.1 && fov_deg < 175.0) {
        return bad("fov_y_deg", fov_deg.to_string(), "0.1..175");
    }
    if key.focus_distance.is_some_and(|d| !(d > 0.0 && d.is_finite())) {
        return bad("focus_distance", format!("{:?}", key.focus_distance), "above 0, or null");
    }
    Ok(())
}
