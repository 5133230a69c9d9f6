use glam::DVec3;

use super::{ClearanceProof, Easing, LensModel, Move, ShotAngle, ShotSize, TrajectoryError};
use cinesplat_geometry::Pose;

/// Most keyframes of a shot: 55 minutes with a key per frame at 30 frames per second.
pub const MAX_KEYFRAMES: usize = 100_000;

/// Most frames of a film: 37 hours at 30 frames per second. What is known of every frame must fit into memory.
pub const MAX_FRAMES: usize = 4_000_000;

/// Time by which a key may lie after the end of its film without a warning: rounding of times in files, seconds.
const TIME_ROUNDING_SECS: f64 = 1e-6;

/// A shot: keyframes, their purpose, and the report. The in-memory form of `shot.json`, version 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The scene of the shot.
    pub scene: SceneRef,
    /// The prompt; empty for an imported path.
    pub prompt: String,
    /// Seed of the random choices.
    pub seed: u64,
    /// The director's weights; `None` for a shot without a director.
    pub model: Option<ModelRef>,
    /// Frame width in pixels.
    pub width: u32,
    /// Frame height in pixels.
    pub height: u32,
    /// Frames per second.
    pub fps: f64,
    /// Length of the film.
    pub duration_secs: f64,
    /// Keys in order of time, at least one.
    pub keyframes: Vec<Keyframe>,
    /// Effects requested by the prompt or the user.
    pub effects: Vec<EffectRequest>,
    /// One line per clause of the prompt: requested and achieved values.
    pub report: Vec<ReportLine>,
    /// Proven distance of the path to matter; `None` if it was not examined, or was edited since.
    pub clearance: Option<ClearanceProof>,
}

/// Which scene a shot belongs to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SceneRef {
    /// Path as written in the shot's file, relative to it; may be empty.
    pub path: String,
    /// SHA-256 of the scene file in hex; may be empty.
    pub sha256: String,
    /// World up, unit length; `None` if unknown.
    pub up: Option<DVec3>,
}

/// The weights of a director.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModelRef {
    /// Name of the model.
    pub name: String,
    /// SHA-256 of the weights in hex.
    pub sha256: String,
}

/// The camera at one moment, and the purpose of the key.
#[derive(Debug, Clone, PartialEq)]
pub struct Keyframe {
    /// Time from the start of the shot.
    pub time_secs: f64,
    /// `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view.
    pub fov_y_rad: f64,
    /// Distance of sharpest focus along the view axis, scene units; `None` without depth of field.
    pub focus_distance: Option<f64>,
    /// The lens and the shutter, as far as the key sets them.
    pub optics: KeyOptics,
    /// Speed profile of the segment that starts here.
    pub easing: Easing,
    /// Whether the camera jumps from the key before to this one.
    pub cut: bool,
    /// Purpose of the key.
    pub intent: Option<Intent>,
}

/// What a key says about the lens and the shutter. JSON keys `f_stop`, `shutter_angle_deg` and `lens`, additions to version
/// 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KeyOptics {
    /// Focal length over the diameter of the aperture; `None` = not set here.
    pub f_stop: Option<f64>,
    /// Share of the frame's time that the shutter is open, as an angle of a full turn; `None` = not set here.
    pub shutter_angle_rad: Option<f64>,
    /// The lens from the cut before the key to the one after it; `None` = not set here. Keys between two cuts that state a
    /// lens state the same one.
    pub lens: Option<LensModel>,
}

impl KeyOptics {
    /// Whether the key sets the aperture or the shutter.
    pub fn is_exposing(&self) -> bool {
        self.f_stop.is_some() || self.shutter_angle_rad.is_some()
    }
}

/// The purpose of a key, and of the segment that starts at it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Intent {
    /// Ids of the subjects, the main one first.
    pub subjects: Vec<u32>,
    /// Size of the main subject in the frame.
    pub size: Option<ShotSize>,
    /// The move of the segment that starts here.
    pub movement: Option<Move>,
    /// Height from which the camera sees the subject.
    pub angle: Option<ShotAngle>,
    /// Byte range of the prompt that this key comes from.
    pub words: Option<[usize; 2]>,
    /// For orbits and arcs a point on the upright axis of the circle, world. With it the path from this key to the next
    /// is a true circle. JSON key `pivot`, an addition to version 1.
    pub pivot: Option<DVec3>,
    /// What the camera looks at: a key whose position was edited is aimed at it again. JSON key `look_at` of the
    /// keyframe, an addition to version 1.
    pub look_at: Option<LookAt>,
}

/// What the camera of a key looks at.
#[derive(Debug, Clone, PartialEq)]
pub struct LookAt {
    /// The point, world.
    pub point: DVec3,
    /// The object whose center the point is, as the file names it; `None` for a point alone.
    pub object: Option<String>,
}

/// A requested effect.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectRequest {
    /// Name, as in `--effects`.
    pub kind: String,
    /// Reason, as text for the user.
    pub because: String,
    /// Further settings as names and values.
    pub settings: Vec<(String, f64)>,
    /// Where it runs; `None` if no film was planned yet. A record: it is found anew for every film.
    pub runs: Option<EffectRuns>,
}

/// The frames that an effect runs on, and the number that decided.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectRuns {
    /// First frame of each run, and one past its last.
    pub frames: Vec<[usize; 2]>,
    /// Fewest and most samples of a frame; 0 if it runs on none.
    pub samples: [u32; 2],
    /// What was measured, and its unit.
    pub measure: String,
    /// The largest error of a film without the effect.
    pub error: f64,
    /// The error that was allowed.
    pub allowed: f64,
}

/// One line of the report: the requested and the achieved value of a clause.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportLine {
    /// The clause, in the words of the prompt.
    pub clause: String,
    /// The request as a number or range, in words.
    pub wanted: String,
    /// The achieved value; NaN if it was not measured.
    pub got: f64,
    /// Whether the achieved value satisfies the request.
    pub met: bool,
    /// Compromise and its reason; may be empty.
    pub note: String,
}

impl Shot {
    /// A shot of keyframes alone, without scene, prompt, effects or report.
    pub fn from_keyframes(size_px: [u32; 2], fps: f64, duration_secs: f64, keyframes: Vec<Keyframe>) -> Self {
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

    /// Number of frames of the film: duration times frame rate, rounded, at least one.
    pub fn num_frames(&self) -> usize {
        ((self.duration_secs * self.fps).round() as usize).max(1)
    }

    /// Checks that the film is no longer than [`MAX_FRAMES`].
    ///
    /// # Errors
    /// [`TrajectoryError::TooManyFrames`].
    pub fn check_frames(&self) -> Result<(), TrajectoryError> {
        let (found, expected) = (self.num_frames(), MAX_FRAMES);
        if found > expected { Err(TrajectoryError::TooManyFrames { found, expected }) } else { Ok(()) }
    }

    /// Time of a frame: `frame_idx / fps`.
    pub fn frame_time_secs(&self, frame_idx: usize) -> f64 {
        frame_idx as f64 / self.fps
    }

    /// The lens that the keyframes state for the part around a time, from cut to cut.
    pub fn lens_at(&self, time_secs: f64) -> Option<LensModel> {
        let is_begun = |key: &Keyframe| key.time_secs <= time_secs;
        let begin = self.keyframes.iter().rposition(|key| key.cut && is_begun(key)).unwrap_or(0);
        let after = self.keyframes.iter().skip(begin + 1).take_while(|key| !key.cut);
        self.keyframes.get(begin).into_iter().chain(after).find_map(|key| key.optics.lens)
    }

    /// One line per surprise in the times of a valid shot: keys after the end of the film, a film without length.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let (fps, duration_secs) = (self.fps, self.duration_secs);
        let last_secs = self.keyframes.last().map_or(0.0, |key| key.time_secs);
        let end_secs = duration_secs + TIME_ROUNDING_SECS;
        let num_late = self.keyframes.iter().filter(|key| key.time_secs > end_secs).count();
        if num_late > 0 {
            let num_keys = self.keyframes.len();
            lines.push(format!(
                "{num_late} of {num_keys} keyframes lie after the end of the film and are not shown: the last is at \
                 {last_secs} s, duration_secs is {duration_secs}"
            ));
        }
        if duration_secs * fps < 0.5 {
            lines.push(format!(
                "duration_secs is {duration_secs}, less than half a frame at {fps} frames per second: the film has one frame"
            ));
        }
        lines
    }

    /// The shot itself, if every number is in range. Every shot from a file passes this check before the engine uses
    /// it.
    ///
    /// # Errors
    /// [`TrajectoryError`] naming the first keyframe and field at fault.
    pub fn validated(self) -> Result<Self, TrajectoryError> {
        check_shot_values(&self)?;
        for (index, key) in self.keyframes.iter().enumerate() {
            check_keyframe(index, key)?;
            if let Some(previous) = index.checked_sub(1).and_then(|i| self.keyframes.get(i)) {
                // NaN fails.
                if !(key.time_secs > previous.time_secs) {
                    let (found, previous) = (key.time_secs, previous.time_secs);
                    return Err(TrajectoryError::TimesNotIncreasing { index, found, previous });
                }
            }
        }
        check_lenses(&self.keyframes)?;
        Ok(self)
    }
}

/// Refuses two lenses between two cuts: a lens is changed only where the camera stops.
fn check_lenses(keyframes: &[Keyframe]) -> Result<(), TrajectoryError> {
    let mut stated: Option<(usize, LensModel)> = None;
    for (index, key) in keyframes.iter().enumerate() {
        stated = stated.filter(|_| !key.cut);
        let Some(lens) = key.optics.lens else { continue };
        let bad = |found, expected| Err(TrajectoryError::BadValue { index, field: "lens", found, expected });
        if let Some((found, expected)) = lens.fault() {
            return bad(found.to_string(), expected);
        }
        match stated {
            Some((first, other)) if other != lens => {
                return bad(format!("another lens than that of keyframe {first}"), "one lens from cut to cut");
            }
            _ => stated = stated.or(Some((index, lens))),
        }
    }
    Ok(())
}

fn check_shot_values(shot: &Shot) -> Result<(), TrajectoryError> {
    if shot.keyframes.is_empty() {
        return Err(TrajectoryError::NoKeyframes);
    }
    if shot.keyframes.len() > MAX_KEYFRAMES {
        return Err(TrajectoryError::TooManyKeyframes { found: shot.keyframes.len(), expected: MAX_KEYFRAMES });
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
    shot.check_frames()
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
    if let Some(found) = key.focus_distance.filter(|distance| !(*distance > 0.0 && distance.is_finite())) {
        return bad("focus_distance", found.to_string(), "above 0, or null");
    }
    let KeyOptics { f_stop, shutter_angle_rad, .. } = key.optics;
    if let Some(found) = f_stop.filter(|f_stop| !(*f_stop >= 0.1 && *f_stop <= 1000.0)) {
        return bad("f_stop", found.to_string(), "0.1..1000, or null");
    }
    let angle_deg = shutter_angle_rad.map(f64::to_degrees);
    if let Some(found) = angle_deg.filter(|angle| !(*angle >= 0.0 && *angle <= 3600.0)) {
        return bad("shutter_angle_deg", found.to_string(), "0..3600, or null");
    }
    Ok(())
}
