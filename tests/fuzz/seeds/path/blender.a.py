# Camera path for Blender: open in the Scripting tab and run, or `blender -b FILE.blend --python THIS.py`.
# Positions are in the splat scene's own world; z_up_from_world rotates it, and any splat in it, to Blender's.
from math import tan

import bpy
from mathutils import Quaternion, Vector

DATA = {
  "width": 160,
  "height": 90,
  "fps": 30.0,
  "duration_secs": 0.2,
  "z_up_from_world_wxyz": [0.7071067811865475, 0.7071067811865475, 0.0, 0.0],
  "up": [0.0, 1.0, 0.0],
  "frames": [
    {
      "time_secs": 0.0,
      "position": [0.0, 1.2, 1.5],
      "opengl_rotation_wxyz": [-1.0, 0.0, 0.0, 0.0],
      "fov_y_rad": 0.8726646259971648,
      "easing": "smooth"
    },
    {
      "time_secs": 0.2,
      "position": [0.2, 1.2, 1.5],
      "opengl_rotation_wxyz": [-1.0, 0.0, 0.0, 0.0],
      "fov_y_rad": 0.8726646259971648,
      "easing": "smooth"
    }
  ]
}
# end of DATA

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
frames = DATA["frames"]
for index, key in enumerate(frames):
    number = 1 + key["time_secs"] * DATA["fps"]
    rotation = turn @ Quaternion(key["opengl_rotation_wxyz"])
    if before is not None and before.dot(rotation) < 0:
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
for curve in curves(camera) + curves(lens):
    for point in curve.keyframe_points:
        point.interpolation = "CONSTANT" if round(point.co[0], 2) in held else "LINEAR"
scene.frame_start = 1
scene.frame_end = max(1, round(DATA["duration_secs"] * DATA["fps"]))
