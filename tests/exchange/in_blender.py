#!/usr/bin/env python3
"""Runs a script that `cinesplat export --to blender` wrote in Blender, and prints what its camera is at every half frame.

    python3 tests/exchange/in_blender.py a.py

Needs bpy from PyPI, which is Blender as a module. Prints a JSON list of rows of the matrix `world_from_camera` with
Blender's camera axes, in the scene's own world, and the vertical field of view in degrees.
"""

import contextlib
import json
import math
import runpy
import sys

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
with contextlib.redirect_stdout(sys.stderr):
    script = runpy.run_path(sys.argv[1])
scene, back = bpy.context.scene, script["turn"].inverted().to_matrix().to_4x4()
found = []
for half in range(2 * scene.frame_start, 2 * scene.frame_end + 1):
    scene.frame_set(half // 2, subframe=half % 2 / 2)
    camera = script["camera"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    fov = 2 * math.atan(camera.data.sensor_height / 2 / camera.data.lens)
    found.append([[list(row) for row in back @ camera.matrix_world], math.degrees(fov)])
print(json.dumps(found))
