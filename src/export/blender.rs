//! A Python script that creates the camera in Blender, with one keyframe per frame on location, rotation and lens,
//! linear interpolation between them and a jump at cuts. Between the keyframes of a shot it draws Bezier curves whose
//! handles have the slopes of the film.
//!
//! Blender's world has +z up, so the script rotates the scene's world by `z_up_from_world`; a splat imported into
//! Blender needs the same rotation. All numbers are in one block that is also valid JSON, from which the path is read
//! back.

use super::ExportError;
use super::json_read::{self, Node};
use super::json_write::{Json, object};
use super::key_slopes::{CameraValues, KeySlopes};
use super::opengl::{from_opengl_rotation, opengl_rotation};
use super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::frames::z_up_from_world;
use cinesplat_trajectory::Easing;

const DATA_START: &str = "DATA = ";
const DATA_END: &str = "# end of DATA";

const SCRIPT_HEAD: &str = r"# Camera path for Blender: open in the Scripting tab and run, or `blender -b FILE.blend --python THIS.py`.
# Positions are in the splat scene's own world; z_up_from_world rotates it, and any splat in it, to Blender's.
from math import sin, tan

import bpy
from mathutils import Quaternion, Vector

";

const SCRIPT_BODY: &str = r#"
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = DATA["width"], DATA["height"]
scene.render.fps = max(1, round(DATA["fps"]))
scene.render.fps_base = scene.render.fps / DATA["fps"]
turn = Quaternion(DATA["z_up_from_world_wxyz"])

lens = bpy.data.cameras.new("cinesplat")
lens.sensor_fit = "VERTICAL"
camera = bpy.data.objects.new("cinesplat", lens)
camera.rotation_mode = "QUATERNION"
scene.collection.objects.link(camera)
scene.camera = camera


def curves(holder):
    """The animation curves of a camera or lens: in layers since Blender 4.4, in the action itself before."""
    data = holder.animation_data
    if hasattr(data.action, "fcurves"):
        return list(data.action.fcurves)
    return list(data.action.layers[0].strips[0].channelbag(data.action_slot).fcurves)


before = None
held = set()
slopes = {"location": [], "rotation_quaternion": [], "lens": [], "dof.focus_distance": []}
frames = DATA["frames"]
for index, key in enumerate(frames):
    number = 1 + key["time_secs"] * DATA["fps"]
    rotation = turn @ Quaternion(key["opengl_rotation_wxyz"])
    sign = -1 if before is not None and before.dot(rotation) < 0 else 1
    if sign < 0:
        rotation.negate()
    before = rotation
    if index + 1 < len(frames) and frames[index + 1].get("cut", 0):
        held.add(round(number, 2))
    camera.location = turn @ Vector(key["position"])
    camera.rotation_quaternion = rotation
    lens.lens = lens.sensor_height / 2 / tan(key["fov_y_rad"] / 2)
    camera.keyframe_insert("location", frame=number)
    camera.keyframe_insert("rotation_quaternion", frame=number)
    lens.keyframe_insert("lens", frame=number)
    if "focus_distance" in key:
        lens.dof.focus_distance = key["focus_distance"]
        lens.keyframe_insert("dof.focus_distance", frame=number)
    # What changes per second before and after the key.
    for side in key.get("slopes", []):
        stretch = -lens.sensor_height / 4 / sin(key["fov_y_rad"] / 2) ** 2
        slopes["location"].append(turn @ Vector(side["position"]))
        slopes["rotation_quaternion"].append([sign * part for part in turn @ Quaternion(side["rotation_wxyz"])])
        slopes["lens"].append([stretch * side["fov_y_rad"]])
        slopes["dof.focus_distance"].append([side["focus_distance"]])
for curve in curves(camera) + curves(lens):
    points, sides = curve.keyframe_points, slopes[curve.data_path]
    joined = "BEZIER" if len(sides) == 2 * len(points) else "LINEAR"
    for index, point in enumerate(points):
        point.interpolation = "CONSTANT" if round(point.co[0], 2) in held else joined
        if joined == "BEZIER":
            point.handle_left_type = point.handle_right_type = "FREE"
            for name, neighbor, side in (("handle_left", index - 1, 0), ("handle_right", index + 1, 1)):
                if 0 <= neighbor < len(points):
                    third = (points[neighbor].co[0] - point.co[0]) / 3
                    rise = third / DATA["fps"] * sides[2 * index + side][curve.array_index]
                    setattr(point, name, (point.co[0] + third, point.co[1] + rise))
scene.frame_start = 1
scene.frame_end = max(1, round(DATA["duration_secs"] * DATA["fps"]))
"#;

/// The script. `slopes` are those of the frames where these are the keyframes of a shot, else there are none.
pub(super) fn write(track: &PoseTrack, slopes: &[KeySlopes]) -> String {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let turn = track.up.map_or(glam::DQuat::IDENTITY, z_up_from_world);
    let mut fields = vec![
        ("width", width.into()),
        ("height", height.into()),
        ("fps", track.fps.unwrap_or(DEFAULT_FPS).into()),
        ("duration_secs", track.duration_secs().into()),
        ("z_up_from_world_wxyz", wxyz(turn)),
    ];
    fields.extend(track.up.map(|up| ("up", up.into())));
    fields.push((
        "frames",
        Json::list(
            track.since_start().enumerate().map(|(idx, (secs, frame))| frame_json(secs, frame, slopes.get(idx))),
        ),
    ));
    let data = Json::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()).pretty();
    format!("{SCRIPT_HEAD}{DATA_START}{data}{DATA_END}\n{SCRIPT_BODY}")
}

fn wxyz(rotation: glam::DQuat) -> Json {
    let [x, y, z, w] = rotation.to_array();
    Json::list([w, x, y, z])
}

/// The JSON of a frame, without `null` and `true`, which are not valid Python.
fn frame_json(time_secs: f64, frame: &PoseFrame, slopes: Option<&KeySlopes>) -> Json {
    let mut fields = vec![
        ("time_secs", time_secs.into()),
        ("position", frame.pose.position.into()),
        ("opengl_rotation_wxyz", wxyz(opengl_rotation(&frame.pose))),
        ("fov_y_rad", fov_y_or_default(frame).into()),
    ];
    fields.extend(frame.focus_distance.map(|distance| ("focus_distance", distance.into())));
    fields.extend(frame.cut.then(|| ("cut", 1_u32.into())));
    fields
        .extend(slopes.map(|found| ("slopes", Json::list([found.before, found.after].map(|side| slope_json(&side))))));
    fields.extend((frame.easing != Easing::Linear).then(|| ("easing", frame.easing.as_ref().into())));
    Json::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

fn slope_json([x, y, z, qx, qy, qz, qw, fov, focus]: &CameraValues) -> Json {
    object([
        ("position", Json::list([*x, *y, *z])),
        ("rotation_wxyz", Json::list([*qw, *qx, *qy, *qz])),
        ("fov_y_rad", (*fov).into()),
        ("focus_distance", (*focus).into()),
    ])
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let data = text.split_once(DATA_START).and_then(|(_, rest)| rest.split_once(DATA_END));
    let reason = "only scripts written by this program can be read back".to_owned();
    let (data, _) = data.ok_or(ExportError::NotReadable { format: "blender", reason })?;
    let value = json_read::parse(data)?;
    let root = Node::root(&value);
    let size_px = (root.field("width", "pixels")?.pixels()?, root.field("height", "pixels")?.pixels()?);
    let nodes = root.field("frames", "a list of frames")?.items()?;
    Ok(PoseTrack {
        size_px: Some(size_px),
        fps: Some(root.field("fps", "frames per second")?.number()?).filter(|fps| *fps > 0.0),
        up: root.optional("up").map(|up| up.vector()).transpose()?,
        timed: true,
        ..PoseTrack::untimed(nodes.iter().map(read_frame).collect::<Result<_, _>>()?)
    })
}

fn read_frame(node: &Node) -> Result<PoseFrame, ExportError> {
    let [w, x, y, z] = node.field("opengl_rotation_wxyz", "4 numbers")?.numbers()?;
    let position = node.field("position", "3 numbers")?.vector()?;
    let pose = from_opengl_rotation(position, glam::DQuat::from_xyzw(x, y, z, w));
    Ok(PoseFrame {
        fov_y_rad: Some(node.field("fov_y_rad", "rad")?.number()?),
        focus_distance: node.optional("focus_distance").map(|distance| distance.number()).transpose()?,
        easing: node.optional("easing").map_or(Ok(Easing::Linear), |name| name.choice())?,
        cut: node.optional("cut").is_some(),
        ..PoseFrame::new(node.field("time_secs", "seconds")?.number()?, pose)
    })
}
