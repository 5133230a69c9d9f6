#!/usr/bin/env python3
"""Reads files as nerfstudio does, and prints the cameras that it makes of them.

    python3 tests/exchange/in_nerfstudio.py viewer CAMERA_PATH.JSON < TIMES.JSON
    python3 tests/exchange/in_nerfstudio.py render CAMERA_PATH.JSON
    python3 tests/exchange/in_nerfstudio.py dataset TRANSFORMS.JSON

Needs nerfstudio, torch, splines, viser and scipy from PyPI. `viewer` loads the path with the button "Load Path" of the
viewer's render tab, whose window is replaced by one that only calls back, and asks its camera path for times in seconds.
`render` is what `ns-render camera-path` reads, `dataset` the dataparser `nerfstudio-data` without its changes of the world.
Prints a JSON list of rows: a matrix `world_from_camera` with OpenCV camera axes, and the vertical field of view in degrees;
of `render` and `dataset` they are found from the rays that nerfstudio casts through the middles of the image and its sides.
"""

import contextlib
import json
import math
import re
import shutil
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType, SimpleNamespace
from unittest.mock import MagicMock

import numpy as np

# What these two import, logging to services among it, reads no camera.
sys.modules["nerfstudio.utils.writer"] = MagicMock()
sys.modules["nerfstudio.viewer.control_panel"] = MagicMock()


class Element:
    """A part of the window: a value, and what is called when it changes or is clicked."""

    def __init__(self, value=None):
        self._value, self._on_update, self.clicks = value, [], []
        self.order, self.disabled, self.visible = 0, False, True

    @property
    def value(self):
        return self._value

    @value.setter
    def value(self, value):
        self._value = value
        for call in self._on_update:
            call(None)

    def on_update(self, call):
        self._on_update.append(call)
        return call

    def on_click(self, call):
        self.clicks.append(call)
        return call

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def remove(self):
        pass

    close = remove


class Window:
    """Makes an element for every call, and keeps those with a label."""

    def __init__(self):
        self.made = {}

    def __getattr__(self, name):
        def make(label="", *values, **named):
            element = Element(named.get("initial_value", values[0] if values else None))
            self.made[named.get("label", label)] = element
            return element

        return make


def viewer(path, times):
    # Of this module one number is used, which needs none of what it imports.
    source = Path(find_spec("nerfstudio.viewer").submodule_search_locations[0], "viewer.py").read_text()
    ratio = float(re.search(r"^VISER_NERFSTUDIO_SCALE_RATIO: float = (.+)$", source, re.M)[1])
    stand_in = ModuleType("nerfstudio.viewer.viewer")
    stand_in.VISER_NERFSTUDIO_SCALE_RATIO = ratio
    sys.modules[stand_in.__name__] = stand_in
    from nerfstudio.viewer import render_panel

    made = []

    class CameraPath(render_panel.CameraPath):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            made.append(self)

    render_panel.CameraPath = CameraPath
    gui = Window()
    server = SimpleNamespace(gui=gui, scene=Window(), get_clients=dict)
    event = SimpleNamespace(client=SimpleNamespace(gui=gui, atomic=contextlib.nullcontext), client_id=0)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "camera_paths").mkdir()
        shutil.copy(path, Path(folder) / "camera_paths")
        render_panel.populate_render_tab(server, Path("config.yml"), Path(folder))
        for label in ("Load Path", "Load"):
            gui.made[label].clicks[-1](event)
    [camera_path] = made
    duration = camera_path.compute_duration()
    for secs in times:
        pose, fov = camera_path.interpolate_pose_and_fov_rad(secs / duration)
        matrix = pose.as_matrix()
        matrix[:3, 3] /= ratio
        yield matrix, math.degrees(fov)


def cast(cameras):
    """Cameras by their rays."""
    import torch

    for idx in range(len(cameras)):
        height, width = float(cameras[idx].height), float(cameras[idx].width)
        # Rows and columns; pixel centers are at halves.
        pixels = torch.tensor([[height / 2, width / 2], [height / 2, width], [height, width / 2]])
        rays = cameras.generate_rays(torch.full((3, 1), idx), coords=pixels)
        middle, right, bottom = rays.directions.double().numpy()
        right, down = (side / (side @ middle) - middle for side in (right, bottom))
        axes = np.stack([right / np.linalg.norm(right), down / np.linalg.norm(down), middle], axis=1)
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = axes, rays.origins[0].double().numpy()
        yield matrix, math.degrees(2 * math.atan(np.linalg.norm(down)))


def render(path):
    from nerfstudio.cameras.camera_paths import get_path_from_json

    return cast(get_path_from_json(json.loads(Path(path).read_text())))


def dataset(path):
    from nerfstudio.data.dataparsers.nerfstudio_dataparser import NerfstudioDataParserConfig

    unchanged = {"orientation_method": "none", "center_method": "none", "auto_scale_poses": False}
    config = NerfstudioDataParserConfig(data=Path(path), downscale_factor=1, eval_mode="all", **unchanged)
    return cast(config.setup().get_dataparser_outputs().cameras)


if __name__ == "__main__":
    what, path = sys.argv[1:3]
    readers = {"viewer": lambda path: viewer(path, json.load(sys.stdin)), "render": render, "dataset": dataset}
    with contextlib.redirect_stdout(sys.stderr):
        rows = list(readers[what](path))
    print(json.dumps([[matrix.tolist(), fov] for matrix, fov in rows]))
