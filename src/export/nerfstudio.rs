//! nerfstudio's `camera_path.json`, which `ns-render camera-path` renders and nerfview also reads.
//!
//! Matrices are `world_from_camera` with OpenGL camera axes, 16 numbers in row-major order. Fields of view are
//! vertical, in degrees. `ns-render` renders `camera_path` at `len / seconds` frames per second and ignores `keyframes`
//! and `fps`, so that it holds every frame at even times; the viewer loads only `keyframes`, which are every frame, or
//! the keys of the shot for people who go on editing there. Positions are in the scene file's world, which is that of
//! nerfstudio if nerfstudio exported the scene.

use glam::DMat4;

use super::ExportError;
use super::json_read::{self, Node, matrix_from_rows};
use super::json_write::{Json, matrix_flat, object};
use super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::frames::{from_opengl, to_opengl};

/// The file of a track of every frame. `keys` are what the viewer loads; it joins them with a spline of its own, which has
/// nothing to add to every frame.
pub(super) fn write(track: &PoseTrack, keys: &[PoseFrame]) -> String {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let aspect = track.aspect();
    let default_fov_deg = default_fov_deg(keys);
    let seconds = track.duration_secs();
    let num_frames = track.frames.len() as f64;
    let rate_fps = if seconds > 0.0 { num_frames / seconds } else { DEFAULT_FPS };
    let camera = |frame: &PoseFrame, matrix_name| {
        object([
            (matrix_name, matrix_flat(to_opengl(&frame.pose))),
            ("fov", fov_y_or_default(frame).to_degrees().into()),
            ("aspect", aspect.into()),
        ])
    };
    let keyframes = keys.iter().enumerate().map(|(idx, key)| {
        // Time from the previous key to this one in the viewer.
        let before = idx.checked_sub(1).and_then(|idx| keys.get(idx));
        let transition_secs = before.map_or(0.0, |before| key.time_secs - before.time_secs);
        let Json::Object(mut fields) = camera(key, "matrix") else { return Json::NULL() };
        fields.push(("override_transition_enabled".into(), true.into()));
        fields.push(("override_transition_sec".into(), transition_secs.into()));
        Json::Object(fields)
    });
    object([
        ("default_fov", default_fov_deg.into()),
        ("default_transition_sec", (seconds / (keys.len() as f64 - 1.0).max(1.0)).into()),
        ("camera_type", "perspective".into()),
        ("render_height", height.into()),
        ("render_width", width.into()),
        // A path of no duration still needs a rate: frames over seconds.
        ("fps", track.fps.filter(|_| track.is_sampled() || seconds <= 0.0).unwrap_or(rate_fps).into()),
        ("seconds", if seconds > 0.0 { seconds } else { num_frames / track.fps.unwrap_or(DEFAULT_FPS) }.into()),
        ("is_cycle", false.into()),
        ("smoothness_value", 0.0.into()),
        ("keyframes", Json::list(keyframes)),
        ("camera_path", Json::list(track.frames.iter().map(|frame| camera(frame, "camera_to_world")))),
        ("crop", Json::NULL()),
    ])
    .pretty()
}

/// A default that no key has: the viewer ignores the field of view of a key that has the default.
fn default_fov_deg(keys: &[PoseFrame]) -> f64 {
    const USUAL_DEG: f64 = 75.0;
    let is_taken = |degrees: f64| keys.iter().any(|key| (fov_y_or_default(key).to_degrees() - degrees).abs() < 0.01);
    (0..=keys.len()).map(|step| USUAL_DEG + 0.1 * step as f64).find(|degrees| !is_taken(*degrees)).unwrap_or(USUAL_DEG)
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    let pixels = |name: &str| root.optional(name).map(|node| node.pixels()).transpose();
    let size_px = pixels("render_width")?.zip(pixels("render_height")?);
    let path = root.optional("camera_path").map(|node| node.items()).transpose()?.unwrap_or_default();
    let keys = root.optional("keyframes").map(|node| node.items()).transpose()?.unwrap_or_default();
    let keys = read_keys(&keys, &root)?;
    let seconds = root.optional("seconds").map(|node| node.number()).transpose()?.filter(|secs| *secs > 0.0);
    let fps = root.optional("fps").map(|node| node.number()).transpose()?.filter(|fps| *fps > 0.0);
    // The rate of `ns-render` is that of the frames over the seconds; `fps` has it without the rounding.
    let rendered_fps = seconds.map(|secs| path.len() as f64 / secs);
    let fps =
        fps.filter(|fps| rendered_fps.is_none_or(|rendered| (rendered / fps - 1.0).abs() < 1e-9)).or(rendered_fps);
    let mut frames = Vec::with_capacity(path.len());
    for (idx, node) in path.iter().enumerate() {
        frames.push(read_camera(node, "camera_to_world", idx as f64 / fps.unwrap_or(DEFAULT_FPS))?);
    }
    let projection = root.optional("camera_type").map_or(Ok("perspective"), |node| node.text())?;
    let is_perspective = projection == "perspective";
    let not_read = || format!("the projection {} is read as perspective", json_read::quoted(projection));
    let unread = if is_perspective { Vec::new() } else { vec![not_read()] };
    // A path that repeats its keys was written from keys: their transitions give the times.
    if frames.is_empty() || (frames.len() == keys.len() && frames.iter().zip(&keys).all(|(a, b)| a.pose == b.pose)) {
        return Ok(PoseTrack { size_px, fps, timed: true, unread, ..PoseTrack::untimed(keys) });
    }
    Ok(PoseTrack { size_px, fps, timed: fps.is_some(), keys, unread, ..PoseTrack::untimed(frames) })
}

/// Keyframes, with times summed from the transitions.
fn read_keys(nodes: &[Node], root: &Node) -> Result<Vec<PoseFrame>, ExportError> {
    let default_secs = root.optional("default_transition_sec").map_or(Ok(0.5), |node| node.number())?;
    let mut time_secs = 0.0;
    let mut keys = Vec::with_capacity(nodes.len());
    for node in nodes {
        let own = node.optional("override_transition_enabled").map_or(Ok(false), |on| on.flag())?;
        let own_secs =
            node.optional("override_transition_sec").filter(|_| own).map(|secs| secs.number()).transpose()?;
        time_secs += if keys.is_empty() { 0.0 } else { own_secs.unwrap_or(default_secs) };
        keys.push(read_camera(node, "matrix", time_secs)?);
    }
    Ok(keys)
}

fn read_camera(node: &Node, matrix_name: &str, time_secs: f64) -> Result<PoseFrame, ExportError> {
    let matrix_node = node.field(matrix_name, "16 numbers, row by row")?;
    let matrix = match matrix_node.text() {
        Ok(text) => matrix_in_text(text).ok_or_else(|| matrix_node.error("16 numbers"))?,
        Err(_) => matrix_node.matrix()?,
    };
    let pose = from_opengl(matrix).map_err(|error| matrix_node.error(format!("a rigid pose ({error})")))?;
    let fov_deg = node.optional("fov").map(|fov| fov.number()).transpose()?;
    Ok(PoseFrame { fov_y_rad: fov_deg.map(f64::to_radians), ..PoseFrame::new(time_secs, pose) })
}

/// The matrix in a string with a list in column-major order, as the Blender add-on writes keyframes.
fn matrix_in_text(text: &str) -> Option<DMat4> {
    let numbers = text.trim().trim_start_matches('[').trim_end_matches(']').split(',');
    let columns: Vec<f64> = numbers.map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
    let columns: [f64; 16] = columns.try_into().ok()?;
    matrix_from_rows(&DMat4::from_cols_array(&columns).transpose().to_cols_array())
}
