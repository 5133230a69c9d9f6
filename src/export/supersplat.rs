//! SuperSplat viewer settings, version 2, and the camera poses of a SuperSplat project (`.ssproj`).
//!
//! SuperSplat's world is that of the PLY rotated by half a turn about z, with +y up. A pose is a position, a target and
//! a field of view along the larger side of the image, in degrees; it has no roll. Times count frames.

use std::io::Read as _;

use cinesplat_files::Limits;
use glam::DVec3;

use super::ExportError;
use super::json_read::{self, Node};
use super::json_write::{Json, object};
use super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, LensSide, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::Easing;

/// Time between the repeated keys around a cut, frames.
const HOLD_FRAMES: f64 = 1e-3;

/// A point in SuperSplat's world from one in the scene file's world, or back: half a turn about z.
fn turned(point: DVec3) -> DVec3 {
    DVec3::new(-point.x, -point.y, point.z)
}

/// The field of view along the larger image side from the vertical one, rad.
fn larger_fov(fov_y_rad: f64, aspect: f64) -> f64 {
    2.0 * ((fov_y_rad / 2.0).tan() * aspect.max(1.0)).atan()
}

/// The vertical field of view from the one along the larger image side, rad.
fn vertical_fov(larger_fov_rad: f64, aspect: f64) -> f64 {
    2.0 * ((larger_fov_rad / 2.0).tan() / aspect.max(1.0)).atan()
}

pub(super) fn write(track: &PoseTrack) -> String {
    let fps = track.fps.unwrap_or(DEFAULT_FPS);
    let views = Views::of(track);
    let keys = keys_with_holds(track, fps);
    let positions = keys.iter().flat_map(|(_, frame)| turned(frame.pose.position).to_array());
    let targets = keys.iter().flat_map(|(_, frame)| turned(views.target(frame)).to_array());
    // The viewer's spline returns to the first key after the last one: the animation ends at the last.
    let last_secs = keys.last().map_or(0.0, |(time, _)| time / fps);
    let duration_secs = if last_secs > 0.0 { last_secs } else { 1.0 / fps };
    let fov_deg = |frame: &PoseFrame| larger_fov(fov_y_or_default(frame), views.aspect).to_degrees();
    let keyframes = object([
        ("times", Json::list(keys.iter().map(|(time, _)| *time))),
        (
            "values",
            object([
                ("position", Json::list(positions)),
                ("target", Json::list(targets)),
                ("fov", Json::list(keys.iter().map(|(_, frame)| fov_deg(frame)))),
            ]),
        ),
    ]);
    let animation = object([
        ("name", "cinesplat".into()),
        ("duration", duration_secs.into()),
        ("frameRate", fps.into()),
        ("loopMode", "none".into()),
        ("interpolation", "spline".into()),
        ("smoothness", 1.0.into()),
        ("keyframes", keyframes),
    ]);
    let initial = track.frames.first().map(|frame| {
        let pose = object([
            ("position", turned(frame.pose.position).into()),
            ("target", turned(views.target(frame)).into()),
            ("fov", fov_deg(frame).into()),
        ]);
        object([("initial", pose)])
    });
    object([
        ("version", 2_u32.into()),
        ("tonemapping", "none".into()),
        ("highPrecisionRendering", false.into()),
        ("background", object([("color", Json::list([0.0, 0.0, 0.0]))])),
        ("postEffectSettings", effects_off()),
        ("animTracks", Json::list([animation])),
        ("cameras", Json::list(initial)),
        ("annotations", Json::List(Vec::new())),
        ("startMode", "animTrack".into()),
    ])
    .pretty()
}

/// A time in frames without the rounding of its seconds: the program's check of settings takes whole numbers alone.
fn frame_number(time: f64) -> f64 {
    const ROUNDING: f64 = 1e-6;
    if (time - time.round()).abs() < ROUNDING { time.round() } else { time }
}

/// Each frame with its time in frames. Around a cut the poses on both sides are repeated within an instant, so that the
/// viewer's spline neither sweeps from one to the other nor swings beside them.
fn keys_with_holds(track: &PoseTrack, fps: f64) -> Vec<(f64, &PoseFrame)> {
    let mut keys: Vec<(f64, &PoseFrame)> = Vec::with_capacity(track.frames.len());
    for (secs, frame) in track.since_start() {
        let time = frame_number(secs * fps);
        match keys.last().copied().filter(|_| frame.cut) {
            Some((_, before)) => {
                keys.extend([(time - 2.0 * HOLD_FRAMES, before), (time - HOLD_FRAMES, before)]);
                keys.extend([(time, frame), (time + HOLD_FRAMES, frame)]);
            }
            None => keys.push((time, frame)),
        }
    }
    keys
}

/// A line about what the viewer plays and its check of what editors write refuses: fractions of frames and of rates.
pub(super) fn beyond_editors(track: &PoseTrack) -> Option<String> {
    let fps = track.fps.unwrap_or(DEFAULT_FPS);
    let is_between = |(secs, _): (f64, &PoseFrame)| frame_number(secs * fps).fract() != 0.0;
    let reasons = [
        (fps.fract() != 0.0, format!("{fps} frames per second")),
        (track.frames.iter().any(|frame| frame.cut), "the keys that hold both sides of a cut".to_owned()),
        (track.since_start().any(is_between), "keys between frames".to_owned()),
    ];
    let reasons: Vec<String> = reasons.into_iter().filter(|(is_so, _)| *is_so).map(|(_, reason)| reason).collect();
    let line = || {
        format!("supersplat's viewer plays {}; its check for editors takes whole frames alone", reasons.join(" and "))
    };
    (!reasons.is_empty()).then(line)
}

/// The frames without the repeated poses around cuts, which are marked as cuts.
fn without_holds(frames: &[PoseFrame], fps: f64) -> Vec<PoseFrame> {
    let mut kept: Vec<PoseFrame> = Vec::with_capacity(frames.len());
    let is_near = |a: &PoseFrame, b: &PoseFrame| (b.time_secs - a.time_secs) * fps < 1.5 * HOLD_FRAMES;
    let mut idx = 0;
    while idx < frames.len() {
        match &frames[idx..] {
            [a, b, c, d, ..] if is_near(a, b) && is_near(b, c) && is_near(c, d) && idx > 0 => {
                kept.push(PoseFrame { cut: true, ..c.clone() });
                idx += 4;
            }
            _ => {
                kept.push(frames[idx].clone());
                idx += 1;
            }
        }
    }
    kept
}

/// All post effects that the schema requires, disabled.
fn effects_off() -> Json {
    let off = |numbers: &[(&str, f64)]| {
        let mut fields = vec![("enabled".to_owned(), false.into())];
        fields.extend(numbers.iter().map(|(name, value)| ((*name).to_owned(), (*value).into())));
        Json::Object(fields)
    };
    let Json::Object(mut grading) = off(&[("brightness", 1.0), ("contrast", 1.0), ("saturation", 1.0)]) else {
        return Json::NULL();
    };
    grading.push(("tint".to_owned(), Json::list([1.0, 1.0, 1.0])));
    object([
        ("sharpness", off(&[("amount", 0.0)])),
        ("bloom", off(&[("intensity", 0.0), ("blurLevel", 2.0)])),
        ("grading", Json::Object(grading)),
        ("vignette", off(&[("intensity", 0.0), ("inner", 0.0), ("outer", 0.0), ("curvature", 1.0)])),
        ("fringing", off(&[("intensity", 0.0)])),
    ])
}

/// The numbers of a view that the viewer's spline joins: position, target, field of view along the larger side in rad.
pub(super) type ViewValues = [f64; 7];

/// How the frames of a track become views.
#[derive(Debug, Clone, Copy)]
pub(super) struct Views {
    /// Distance of the targets of frames without a focus distance.
    distance: f64,
    aspect: f64,
}

impl Views {
    pub(super) fn of(track: &PoseTrack) -> Self {
        Self { distance: target_distance(track), aspect: track.aspect() }
    }

    /// The point that a frame looks at, in the scene file's world.
    fn target(&self, frame: &PoseFrame) -> DVec3 {
        frame.pose.position + frame.pose.forward() * frame.focus_distance.unwrap_or(self.distance)
    }

    /// The view of a frame, in the scene file's world.
    pub(super) fn values(&self, frame: &PoseFrame) -> ViewValues {
        let (p, t) = (frame.pose.position, self.target(frame));
        [p.x, p.y, p.z, t.x, t.y, t.z, larger_fov(fov_y_or_default(frame), self.aspect)]
    }

    /// Pose and vertical field of view in rad of a view in the scene file's world; `None` without a direction.
    pub(super) fn camera(&self, [px, py, pz, tx, ty, tz, fov]: ViewValues) -> Option<(Pose, f64)> {
        let pose = Pose::look_at(DVec3::new(px, py, pz), DVec3::new(tx, ty, tz), DVec3::NEG_Y, None).ok()?;
        Some((pose, vertical_fov(fov, self.aspect)))
    }
}

/// The keys of a track with those around its cuts, at their times in seconds.
pub(super) fn held(track: &PoseTrack) -> Vec<PoseFrame> {
    let fps = track.fps.unwrap_or(DEFAULT_FPS);
    let start = track.frames.first().map_or(0.0, |first| first.time_secs);
    let at = |(time, frame): (f64, &PoseFrame)| PoseFrame { time_secs: start + time / fps, ..frame.clone() };
    keys_with_holds(track, fps).into_iter().map(at).collect()
}

/// Distance of targets without a focus distance: the extent of the path, or 1 for a stationary camera.
fn target_distance(track: &PoseTrack) -> f64 {
    let positions = track.frames.iter().map(|frame| frame.pose.position);
    let (low, high) =
        positions.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let extent = (high - low).length();
    if extent > 1e-6 && extent.is_finite() { extent } else { 1.0 }
}

/// Reads viewer settings, or a project's document.
pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    if root.optional("poseSets").is_some() {
        return read_document(&root);
    }
    let version = root.field("version", "2")?.number()?;
    if !version.total_cmp(&2.0).is_eq() {
        return Err(ExportError::WrongVersion { format: "supersplat", found: version.to_string(), expected: "2" });
    }
    let tracks = root.field("animTracks", "a list of camera animations")?.items()?;
    let animation = tracks.first().ok_or(ExportError::NoPoses)?;
    let fps = frame_rate(animation.optional("frameRate"))?;
    let keyframes = animation.field("keyframes", "times and values")?;
    let values = keyframes.field("values", "position, target and fov")?;
    let times = keyframes.field("times", "a list of frames")?.number_list()?;
    let list = |name: &str, width: usize| {
        let node = values.field(name, "a list of numbers")?;
        let list = node.number_list()?;
        if list.len() == times.len() * width { Ok(list) } else { Err(node.error(format!("{width} numbers per key"))) }
    };
    let (positions, targets, fovs) = (list("position", 3)?, list("target", 3)?, list("fov", 1)?);
    let mut frames = Vec::with_capacity(times.len());
    let points = positions.chunks_exact(3).zip(targets.chunks_exact(3));
    for (((time, fov_deg), (p, t)), idx) in times.iter().zip(&fovs).zip(points).zip(0..) {
        let (position, target) = (DVec3::new(p[0], p[1], p[2]), DVec3::new(t[0], t[1], t[2]));
        let place = || format!("animTracks[0].keyframes, key {idx}");
        frames.push(frame(time / fps, position, target, *fov_deg).ok_or_else(|| no_direction(place()))?);
    }
    Ok(track_of(without_holds(&frames, fps), fps))
}

/// Reads the poses of a project's document.
fn read_document(root: &Node) -> Result<PoseTrack, ExportError> {
    let sets = root.field("poseSets", "a list of pose sets")?.items()?;
    let poses = sets.first().ok_or(ExportError::NoPoses)?.field("poses", "a list of poses")?.items()?;
    let timeline = root.optional("timeline");
    let fps = frame_rate(timeline.and_then(|timeline| timeline.optional("frameRate")))?;
    let default_fov = root.optional("camera").and_then(|camera| camera.optional("fov"));
    let default_fov_deg = default_fov.map_or(Ok(60.0), |fov| fov.number())?;
    let mut frames = Vec::with_capacity(poses.len());
    for pose in &poses {
        let time_secs = pose.field("frame", "a frame number")?.number()? / fps;
        let (position, target) =
            (pose.field("position", "3 numbers")?.vector()?, pose.field("target", "3 numbers")?.vector()?);
        let fov_deg = pose.optional("fov").map_or(Ok(default_fov_deg), |fov| fov.number())?;
        frames.push(
            frame(time_secs, position, target, fov_deg).ok_or_else(|| pose.error("different position and target"))?,
        );
    }
    frames.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
    Ok(track_of(frames, fps))
}

fn frame_rate(node: Option<Node>) -> Result<f64, ExportError> {
    let Some(node) = node else { return Ok(DEFAULT_FPS) };
    let fps = node.number()?;
    if fps > 0.0 { Ok(fps) } else { Err(node.error("frames per second above 0")) }
}

fn no_direction(place: String) -> ExportError {
    ExportError::BadField { place, found: "position = target".into(), expected: "two different points".into() }
}

/// A frame from SuperSplat's world. The aspect is that of the default image size, because the file states none.
fn frame(time_secs: f64, position: DVec3, target: DVec3, fov_deg: f64) -> Option<PoseFrame> {
    let pose = Pose::look_at(turned(position), turned(target), DVec3::NEG_Y, None).ok()?;
    let aspect = f64::from(DEFAULT_SIZE_PX.0) / f64::from(DEFAULT_SIZE_PX.1);
    let fov_y_rad = Some(vertical_fov(fov_deg.to_radians(), aspect));
    Some(PoseFrame { fov_y_rad, easing: Easing::Linear, ..PoseFrame::new(time_secs, pose) })
}

fn track_of(frames: Vec<PoseFrame>, fps: f64) -> PoseTrack {
    let lens_side = LensSide::Larger;
    PoseTrack { fps: Some(fps), up: Some(DVec3::NEG_Y), timed: true, lens_side, ..PoseTrack::untimed(frames) }
}

/// The document inside a project file.
pub(super) fn document_in_project(bytes: &[u8]) -> Result<String, ExportError> {
    let unreadable = |reason: String| ExportError::NotReadable { format: "supersplat", reason };
    let mut archive =
        zip::ZipArchive::new(std::io::Cursor::new(bytes)).map_err(|error| unreadable(error.to_string()))?;
    let document = archive.by_name("document.json");
    let document = document.map_err(|_| unreadable("the project holds no document.json".into()))?;
    let (mut text, most) = (String::new(), Limits::DEFAULT.unpacked(bytes.len()));
    let read = document.take(most + 1).read_to_string(&mut text);
    read.map_err(|error| unreadable(error.to_string()))?;
    if text.len() as u64 > most {
        return Err(unreadable(format!("document.json has over {most} bytes")));
    }
    Ok(text)
}
