#!/usr/bin/env python3
"""Opens exports of a shot in the programs that they are for, and prints a table of what those programs read.

    python3 tests/exchange/open_exports.py target/release/cinesplat SHOT.JSON PYTHON

Needs evo, pycolmap, usd-core and pygltflib from PyPI, and bpy (Blender as a module) for PYTHON, the interpreter of another
environment. The truth is the shot's own CSV export: positions and quaternions `world_from_camera` with OpenCV camera axes.
Where a program moves the camera between the frames, half frames are compared too: with lines of glTF as its specification
says, else by the program itself. Exits with 1 if at a frame a position is off by more than 1e-5 or a rotation by more than
1e-4 degrees.
"""

import csv
import importlib.metadata
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

MAX_MOVED, MAX_TURNED_DEG = 1e-5, 1e-4
FLIP = np.diag([1.0, -1.0, -1.0])


def rotation(x, y, z, w):
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def truth(path):
    """Rotations, positions and vertical fields of view (degrees) of every frame."""
    rows = list(csv.DictReader(path.open()))
    turns = [rotation(*(float(row["q" + axis]) for axis in "xyzw")) for row in rows]
    return (
        turns,
        [np.array([float(row[axis]) for axis in "xyz"]) for row in rows],
        [float(r["fov_y_deg"]) for r in rows],
    )


def slerp(a, b, t):
    a, b = np.array(a), np.array(b)
    b = b if a @ b >= 0 else -b
    angle = math.acos(min(1.0, a @ b))
    mixed = a + (b - a) * t if angle < 1e-6 else math.sin((1 - t) * angle) * a + math.sin(t * angle) * b
    return mixed / np.linalg.norm(mixed)


def read_evo(kind, path):
    from evo.tools import file_interface as files

    readers = {
        "tum": files.read_tum_trajectory_file,
        "kitti": files.read_kitti_poses_file,
        "euroc": files.read_euroc_csv_trajectory,
    }
    poses = readers[kind](str(path)).poses_se3
    return [pose[:3, :3] for pose in poses], [pose[:3, 3] for pose in poses], None, None


def read_colmap(path):
    import pycolmap

    model = pycolmap.Reconstruction(str(path))
    images = sorted(model.images.values(), key=lambda image: image.name)
    inverse = [image.cam_from_world() if callable(image.cam_from_world) else image.cam_from_world for image in images]
    world = [pose.inverse().matrix() for pose in inverse]
    lenses = [model.cameras[image.camera_id] for image in images]
    fovs = [math.degrees(2 * math.atan(lens.height / 2 / lens.params[1])) for lens in lenses]
    return [pose[:, :3] for pose in world], [pose[:, 3] for pose in world], fovs, None


def read_usd(path):
    from pxr import Gf, Usd, UsdGeom

    stage = Usd.Stage.Open(str(path))
    camera = next(UsdGeom.Camera(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Camera))
    codes = np.arange(stage.GetStartTimeCode(), stage.GetEndTimeCode() + 0.5)
    up = Gf.Vec3d(*stage.GetRootLayer().customLayerData["cinesplat_world_up"])
    back = np.array(Gf.Matrix3d(Gf.Rotation(up, Gf.Vec3d(0, 1, 0)))).reshape(3, 3)

    def at(codes):
        turns, positions, fovs = [], [], []
        for code in codes:
            pose = camera.GetCamera(code)
            matrix = np.array(pose.transform).reshape(4, 4).T
            turns.append(back @ matrix[:3, :3] @ FLIP)
            positions.append(back @ matrix[:3, 3])
            fovs.append(pose.GetFieldOfView(Gf.Camera.FOVVertical))
        return turns, positions, fovs

    return *at(codes), at(codes[:-1] + 0.5)


def read_gltf(path):
    import pygltflib

    file = pygltflib.GLTF2().load(str(path))
    blob = file.binary_blob()

    def values(idx):
        accessor = file.accessors[idx]
        view = file.bufferViews[accessor.bufferView]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor.type]
        numbers = np.frombuffer(blob, "<f4", accessor.count * width, view.byteOffset)
        return numbers.reshape(accessor.count, width).astype(float)

    found = {}
    for channel in file.animations[0].channels:
        found[channel.target.path] = values(file.animations[0].samplers[channel.sampler].output)
    fov = math.degrees(file.cameras[0].perspective.yfov)
    turned, moved = found["rotation"], found["translation"]
    fovs = [math.degrees(value[0]) for value in found["pointer"]] if "pointer" in found else [fov] * len(moved)
    middle = lambda values: [(a + b) / 2 for a, b in zip(values, values[1:])]
    halves = [rotation(*slerp(a, b, 0.5)) @ FLIP for a, b in zip(turned, turned[1:])], middle(moved), middle(fovs)
    return [rotation(*q) @ FLIP for q in turned], list(moved), fovs, halves


def read_blender(path, python):
    script = Path(__file__).with_name("in_blender.py")
    said = subprocess.run([python, script, path], check=True, capture_output=True, text=True).stdout
    rows = json.loads(said.splitlines()[-1])
    poses = [np.array(pose) for pose, _ in rows]
    columns = [p[:3, :3] @ FLIP for p in poses], [p[:3, 3] for p in poses], [fov for _, fov in rows]
    return *(column[::2] for column in columns), tuple(column[1::2] for column in columns)


def read_nerfstudio(path):
    file = json.loads(path.read_text())
    poses = [np.array(frame["camera_to_world"]).reshape(4, 4) for frame in file["camera_path"]]
    return [p[:3, :3] @ FLIP for p in poses], [p[:3, 3] for p in poses], [f["fov"] for f in file["camera_path"]], None


ROWS = [
    ("tum", "a.tum", "evo", lambda path: read_evo("tum", path)),
    ("kitti", "a.kitti", "evo", lambda path: read_evo("kitti", path)),
    ("euroc", "a.euroc.csv", "evo", lambda path: read_evo("euroc", path)),
    ("colmap", "text", "pycolmap", read_colmap),
    ("colmap", "binary/images.bin", "pycolmap", lambda path: read_colmap(path.parent)),
    ("usd", "a.usda", "usd-core", read_usd),
    ("gltf", "a.glb", "pygltflib", read_gltf),
    ("nerfstudio", "camera_path.json", "numpy", read_nerfstudio),
]


def off(truth, found):
    """Largest differences of positions, rotations (degrees) and fields of view (degrees, "-" without)."""
    moved = max(np.linalg.norm(a - b) for a, b in zip(truth[1], found[1]))
    turned = max(
        math.degrees(2 * math.asin(min(1.0, np.linalg.norm(a - b) / math.sqrt(8)))) for a, b in zip(truth[0], found[0])
    )
    zoomed = "-" if found[2] is None else f"{max(abs(a - b) for a, b in zip(truth[2], found[2])):.0e}"
    return moved, turned, zoomed


def main():
    program, shot, blender = sys.argv[1:4]
    rows = [*ROWS, ("blender", "a.py", "bpy", lambda path: read_blender(path, blender))]
    version_of_bpy = [blender, "-c", "from importlib.metadata import version; print(version('bpy'))"]
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        run = lambda *flags: subprocess.run(
            [program, "export", shot, *flags], check=True, capture_output=True, text=True
        )
        run("-o", str(folder / "truth.csv"))
        frames = truth(folder / "truth.csv")
        double = 2 * json.loads(Path(shot).read_text())["fps"]
        run("-o", str(folder / "halves.csv"), "--fps", str(double))
        halves = [column[1::2] for column in truth(folder / "halves.csv")]
        print("| format | opened in | frames | off at frames: position, rotation, lens | between frames | said to be lost |")
        print("|---|---|---:|---|---|---|")
        for kind, name, package, reader in rows:
            path = folder / name
            if "/" in name:
                path.parent.mkdir()
            said = run("--to", kind, "-o", str(path)).stderr
            lost = [line.split(": ", 1)[1] for line in said.splitlines() if line.startswith("warning: ")]
            *found, between = reader(path)
            moved, turned, zoomed = off(frames, found)
            failed |= len(found[0]) != len(frames[0]) or not (moved < MAX_MOVED and turned < MAX_TURNED_DEG)
            in_between = "-" if between is None else "{:.0e}, {:.0e}, {}".format(*off(halves, between))
            if package == "bpy":
                version = subprocess.run(version_of_bpy, check=True, capture_output=True, text=True).stdout.strip()
            else:
                version = importlib.metadata.version(package)
            print(
                f"| {kind} | {package} {version} | {len(found[0])} | {moved:.0e}, {turned:.0e}, {zoomed} | {in_between} |"
                f" {'; '.join(lost) or '-'} |"
            )
    sys.exit(failed)


if __name__ == "__main__":
    main()
