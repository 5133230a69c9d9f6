use cinesplat::export::{Content, Format, read};
use cinesplat::geometry::Pose;
use glam::{DMat4, DQuat, DVec3};
use serde_json::Value;

use super::sample_shot::{file, there_and_back, with_cut};

fn gltf() -> Value {
    let (_, warnings, folder) = there_and_back(&with_cut(), Format::Gltf, "a.gltf", Content::Sampled);
    assert!(
        warnings.iter().all(|line| !line.contains("cuts") && !line.contains("holds no field of view")),
        "{warnings:?}"
    );
    serde_json::from_str(&std::fs::read_to_string(folder.path().join("a.gltf")).unwrap()).unwrap()
}

#[test]
fn a_zoom_is_animated_through_the_pointer_extension() {
    let file = gltf();
    let target = &file["animations"][0]["channels"][2]["target"];
    assert_eq!(file["extensionsUsed"][0], "KHR_animation_pointer");
    assert_eq!(target["path"], "pointer");
    assert_eq!(target["extensions"]["KHR_animation_pointer"]["pointer"], "/cameras/0/perspective/yfov");
    assert!(target.get("node").is_none());
}

#[test]
fn a_lens_that_most_viewers_ignore_is_named() {
    let (_, warnings, _folder) = there_and_back(&with_cut(), Format::Gltf, "a.gltf", Content::Sampled);
    assert!(warnings.iter().any(|line| line.contains("which three.js and others ignore")), "{warnings:?}");
    let mut constant = with_cut();
    constant.keyframes.iter_mut().for_each(|key| key.fov_y_rad = 0.8);
    let (_, warnings, _folder) = there_and_back(&constant, Format::Gltf, "a.gltf", Content::Sampled);
    assert!(warnings.iter().all(|line| !line.contains("field of view")), "{warnings:?}");
}

#[test]
fn animations_of_the_nodes_above_a_camera_move_it() {
    // Blender hangs the camera under the node that it animates. Two keys at 0 and 1 s: x from 0 to 2, then half a turn
    // about y; the camera is 1 unit along the parent's x, looking along -z.
    let numbers: [f32; 16] = [0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0];
    let bytes: Vec<u8> = numbers.iter().flat_map(|v| v.to_le_bytes()).collect();
    let data = cinesplat::files::base64::encode(&bytes);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.8, "znear": 0.1}}}}],
        "nodes": [{{"children": [1]}}, {{"camera": 0, "translation": [1, 0, 0]}}],
        "buffers": [{{"byteLength": 64, "uri": "data:application/octet-stream;base64,{data}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 8}}, {{"buffer": 0, "byteOffset": 8, "byteLength": 24}},
            {{"buffer": 0, "byteOffset": 32, "byteLength": 32}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"}},
            {{"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"}},
            {{"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC4"}}],
        "animations": [{{"samplers": [{{"input": 0, "output": 1}}, {{"input": 0, "output": 2}}],
            "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}},
                {{"sampler": 1, "target": {{"node": 0, "path": "rotation"}}}}]}}]}}"#
    );
    let (path, _folder) = file("a.gltf", text.as_bytes());
    let frames = read(&path, None).unwrap().track.frames;
    assert_eq!(frames.len(), 2);
    assert!(
        (frames[0].pose.position - DVec3::X).length() < 1e-6 && (frames[0].pose.forward() + DVec3::Z).length() < 1e-6
    );
    // The parent is at x = 2 with its x axis turned around.
    assert!(
        (frames[1].pose.position - DVec3::X).length() < 1e-6 && (frames[1].pose.forward() - DVec3::Z).length() < 1e-6
    );
}

/// Only the keys of a spline were read, joined by lines.
#[test]
fn cubic_splines_of_gltf_are_followed_between_their_keys() {
    // Keys at 0 and 1 s: in-tangent, value, out-tangent of x from 0 to 3, leaving at 3 per second and arriving at rest.
    let x = [0.0, 0.0, 3.0, 0.0, 3.0, 0.0_f32].map(|x| [x, 0.0, 0.0]);
    let numbers = [0.0_f32, 1.0].into_iter().chain(x.into_iter().flatten());
    let bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    let data = cinesplat::files::base64::encode(&bytes);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.8, "znear": 0.1}}}}],
        "nodes": [{{"camera": 0}}],
        "buffers": [{{"byteLength": 80, "uri": "data:application/octet-stream;base64,{data}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 8}}, {{"buffer": 0, "byteOffset": 8, "byteLength": 72}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"}},
            {{"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC3"}}],
        "animations": [{{"samplers": [{{"input": 0, "output": 1, "interpolation": "CUBICSPLINE"}}],
            "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}}]}}]}}"#
    );
    let (path, _folder) = file("a.gltf", text.as_bytes());
    let track = read(&path, None).unwrap().track;
    assert_eq!(
        (track.frames.len(), track.unread),
        (31, vec!["cubic splines are read at 30 frames per second".to_owned()])
    );
    for frame in &track.frames {
        let t = frame.time_secs;
        let wanted = 3.0 * (t.powi(3) - 2.0 * t * t + t) + 3.0 * (3.0 * t * t - 2.0 * t.powi(3));
        assert!((frame.pose.position.x - wanted).abs() < 1e-6, "{t}: {} instead of {wanted}", frame.pose.position.x);
    }
}

#[test]
fn a_cut_adds_one_key_that_holds() {
    // 72 frames, and one key that holds the pose before the cut.
    assert_eq!(gltf()["accessors"][0]["count"], 73);
}

#[test]
fn the_node_above_takes_the_scenes_up_to_plus_y() {
    let node = &gltf()["nodes"][0];
    let turn: Vec<f64> = node["rotation"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let up = DQuat::from_array(turn.try_into().unwrap()) * DVec3::NEG_Y;
    assert!((up - DVec3::Y).length() < 1e-12);
}

#[test]
fn reads_a_camera_that_hangs_under_a_moved_node() {
    // Without animation there is one frame. The parent is rotated by half a turn about y, at x = 10; the camera looks
    // along its -z axis.
    let text = br#"{"asset": {"version": "2.0"}, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
      "nodes": [{"camera": 0, "translation": [1, 0, 0]}, {"children": [0], "translation": [10, 0, 0], "rotation": [0, 1, 0, 0]}],
      "scenes": [{"nodes": [1]}]}"#;
    let (path, _folder) = file("a.gltf", text);
    let track = read(&path, None).unwrap().track;
    let pose: Pose = track.frames[0].pose;
    assert!((pose.position - DVec3::new(9.0, 0.0, 0.0)).length() < 1e-12);
    assert!((pose.forward() - DVec3::Z).length() < 1e-12 && (pose.up() - DVec3::Y).length() < 1e-12);
    assert_eq!((track.frames.len(), track.frames[0].fov_y_rad, track.up), (1, Some(0.8), Some(DVec3::Y)));
}

#[test]
fn reads_usd_of_other_writers() {
    // A matrix by rows, rotations by axis, a parent, metadata, comments and a variant set.
    let text = br#"#usda 1.0
( """a comment"""
  upAxis = "Z"
  timeCodesPerSecond = 10
)
def Xform "rig" ( kind = "component" prepend variantSets = "v" ) {
  double3 xformOp:translate = (0, 0, 5)
  float3 xformOp:rotateXYZ = (90, 0, 0)
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
  variantSet "v" = { "one" { def Sphere "s" { } } }
  def Camera "cam" {   # looks along -z of the rig
    float focalLength = 50
    float verticalAperture = 50 ( doc = "film" )
    matrix4d xformOp:transform.timeSamples = {
      0: ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 2, 3, 1) ),
      20: ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (4, 2, 3, 1) ),
    }
    uniform token[] xformOpOrder = ["xformOp:transform"]
    rel material:binding = </nothing>
  }
}
"#;
    let (path, _folder) = file("a.usda", text);
    let track = read(&path, None).unwrap().track;
    let pose = track.frames[1].pose;
    // By hand: a quarter turn about x maps (4, 2, 3) to (4, -3, 2), and the view direction -z to +y.
    assert!((pose.position - DVec3::new(4.0, -3.0, 7.0)).length() < 1e-12, "{}", pose.position);
    assert!((pose.forward() - DVec3::Y).length() < 1e-12 && (pose.up() - DVec3::Z).length() < 1e-12);
    assert_eq!((track.frames[1].time_secs, track.fps, track.up), (2.0, Some(10.0), Some(DVec3::Z)));
    assert!((track.frames[0].fov_y_rad.unwrap() - 2.0 * 0.5_f64.atan()).abs() < 1e-12);
    assert_eq!(pose.world_from_camera().w_axis, DMat4::from_translation(pose.position).w_axis);
}

#[test]
fn an_animated_rotation_of_length_0_is_an_error() {
    // Times 0 and 1, rotations (0, 0, 0, 1) and (0, 0, 0, 0).
    let gltf = br#"{"asset": {"version": "2.0"}, "cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0}],
      "animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 2},
        {"bufferView": 0, "byteOffset": 8, "componentType": 5126, "type": "VEC4", "count": 2}],
      "bufferViews": [{"buffer": 0, "byteLength": 40}],
      "buffers": [{"uri": "data:;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAAAAAA=="}]}"#;
    let (path, _folder) = file("a.gltf", gltf);
    insta::assert_snapshot!(read(&path, None).unwrap_err(), @"animations[0].samplers[0].output, rotation of key 1: found [0.0, 0.0, 0.0, 0.0], expected 4 finite numbers, not all 0");
}
