//! LichtFeld Studio timelines, version 4: per key seconds, position, quaternion (w x y z, OpenGL camera axes), focal
//! length in mm for a frame 24 mm high, and one of four easings.
//!
//! Poses are in the program's own world, which is the scene file's turned by half a turn about x (since April 2026; its
//! `--render-camera-path` since September 2026).
//!
//! The program joins positions with a uniform Catmull-Rom spline and stores numbers as f32. Its easings are linear and
//! cubic: a shot with others is written with a key per frame.

use glam::DVec3;

use super::ExportError;
use super::json_read::{self, Node};
use super::json_write::{Json, object};
use super::opengl::{HALF_TURN_X, from_opengl_rotation, opengl_rotation};
use super::track::{PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::Easing;

const VERSION: u32 = 4;
/// Height of the frame for focal lengths, mm.
const FRAME_HEIGHT_MM: f64 = 24.0;
/// Range of focal lengths in the program, mm; it clamps others.
pub(super) const FOCAL_RANGE_MM: (f64, f64) = (10.0, 200.0);
/// Easings in the order of their numbers in the file.
const EASINGS: [Easing; 4] = [Easing::Linear, Easing::CubicIn, Easing::CubicOut, Easing::CubicInOut];

/// Whether the program has an easing.
pub(super) fn has(easing: Easing) -> bool {
    EASINGS.contains(&easing)
}

/// The program's share of the way at a share of the time.
pub(super) fn eased(easing: Easing, t: f64) -> f64 {
    match easing {
        Easing::CubicIn => t.powi(3),
        Easing::CubicOut => 1.0 - (1.0 - t).powi(3),
        Easing::CubicInOut if t < 0.5 => 4.0 * t.powi(3),
        Easing::CubicInOut => 1.0 - 4.0 * (1.0 - t).powi(3),
        _ => t,
    }
}

/// A pose in the program's world from one in the scene file's world, or back: half a turn about x.
fn turned(pose: &Pose) -> Pose {
    let DVec3 { x, y, z } = pose.position;
    Pose::new(DVec3::new(x, -y, -z), HALF_TURN_X * pose.rotation)
}

pub(super) fn focal_mm(fov_y_rad: f64) -> f64 {
    FRAME_HEIGHT_MM / 2.0 / (fov_y_rad / 2.0).tan()
}

pub(super) fn write(track: &PoseTrack) -> String {
    let keyframes = track.since_start().map(|(secs, frame)| {
        let pose = turned(&frame.pose);
        let [x, y, z, w] = opengl_rotation(&pose).to_array();
        let easing = EASINGS.iter().position(|easing| *easing == frame.easing).unwrap_or(0);
        object([
            ("time", secs.into()),
            ("position", pose.position.into()),
            ("rotation", Json::list([w, x, y, z])),
            ("focal_length_mm", focal_mm(fov_y_or_default(frame)).into()),
            ("easing", easing.into()),
        ])
    });
    let keyframes = Json::list(keyframes);
    let duration = track.duration_secs();
    object([("version", VERSION.into()), ("clip_duration", duration.into()), ("keyframes", keyframes)]).pretty()
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    let version = root.optional("version").map_or(Ok(1), |version| version.whole(u64::from(u32::MAX)))?;
    if !(1..=u64::from(VERSION)).contains(&version) {
        return Err(ExportError::WrongVersion { format: "lichtfeld", found: version.to_string(), expected: "1 to 4" });
    }
    let nodes = root.field("keyframes", "a list of keyframes")?.items()?;
    let mut frames = nodes.iter().map(read_key).collect::<Result<Vec<_>, _>>()?;
    frames.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
    Ok(PoseTrack { timed: true, ..PoseTrack::untimed(frames) })
}

fn read_key(node: &Node) -> Result<PoseFrame, ExportError> {
    let rotation_node = node.field("rotation", "4 numbers w x y z")?;
    let [w, x, y, z] = rotation_node.numbers()?;
    let rotation = glam::DQuat::from_xyzw(x, y, z, w);
    if !(rotation.length() > 1e-6) {
        return Err(rotation_node.error("a quaternion that is not 0"));
    }
    let focal = node.optional("focal_length_mm").map(|focal| {
        let mm = focal.number()?;
        if mm > 0.0 { Ok(mm) } else { Err(focal.error("mm above 0")) }
    });
    let easing = node.optional("easing").map_or(Ok(0), |easing| easing.whole(3))?;
    let position = node.field("position", "3 numbers")?.vector()?;
    Ok(PoseFrame {
        fov_y_rad: focal.transpose()?.map(|mm| 2.0 * (FRAME_HEIGHT_MM / 2.0 / mm).atan()),
        easing: EASINGS.get(easing as usize).copied().unwrap_or(Easing::Linear),
        ..PoseFrame::new(node.field("time", "seconds")?.number()?, turned(&from_opengl_rotation(position, rotation)))
    })
}
