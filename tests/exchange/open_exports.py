#!/usr/bin/env python3
"""Opens exports of a shot in the programs that they are for, and prints tables of what those programs read.

    python3 tests/exchange/open_exports.py target/release/cinesplat SHOT.JSON BLENDER NERFSTUDIO NODE

Needs evo, open3d-cpu, pycolmap, pygltflib and usd-core from PyPI. BLENDER and NERFSTUDIO are the interpreters of environments
with bpy (Blender as a module) and with nerfstudio; NODE is the folder where npm installed @playcanvas/supersplat-viewer and
playcanvas. The truth is the shot's own CSV export: positions and quaternions `world_from_camera` with OpenCV camera axes.

The first table is of every frame; where a program moves the camera between the frames, half frames are compared too: with
lines of glTF as its specification says, with LichtFeld's spline as its file format is published, else by the program
itself. The second table is of `--keyframes`: what the export says that the program strays from the film, and what it does.
Exits with 1 if at a frame a position is off by more than 1e-5 or a rotation by more than 1e-4 degrees, or if the program
strays otherwise than the export says.
"""

import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

MAX_MOVED, MAX_TURNED_DEG = 1e-5, 1e-4
FLIP = np.diag([1.0, -1.0, -1.0])
HERE = Path(__file__).parent
SHOT, BLENDER, NERFSTUDIO, NODE = (*sys.argv[2:], *[None] * 4)[:4]


def rotation(x, y, z, w):
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def truth(path):
    """Times, rotations, positions and vertical fields of view (degrees) of every frame."""
    rows = list(csv.DictReader(path.open()))
    turns = [rotation(*(float(row["q" + axis]) for axis in "xyzw")) for row in rows]
    places = [np.array([float(row[axis]) for axis in "xyz"]) for row in rows]
    return [float(row["time_secs"]) for row in rows], turns, places, [float(row["fov_y_deg"]) for row in rows]


def slerp(a, b, t):
    a, b = np.array(a), np.array(b)
    b = b if a @ b >= 0 else -b
    angle = math.acos(min(1.0, a @ b))
    mixed = a + (b - a) * t if angle < 1e-6 else math.sin((1 - t) * angle) * a + math.sin(t * angle) * b
    return mixed / np.linalg.norm(mixed)


def placed(times, time):
    """The number of the key before a time, and the share of the way to the next one."""
    idx = int(np.clip(np.searchsorted(times, time, side="right") - 1, 0, len(times) - 2))
    return idx, float(np.clip((time - times[idx]) / (times[idx + 1] - times[idx]), 0, 1))


def columns(matrices):
    return [m[:3, :3] for m in matrices], [m[:3, 3] for m in matrices]


# Readers return rotations and positions `world_from_camera` with OpenCV camera axes and fields of view, or None without
# them. Those of formats with times are asked for times.


def read_evo(kind, path):
    from evo.tools import file_interface as files

    readers = {
        "tum": files.read_tum_trajectory_file,
        "kitti": files.read_kitti_poses_file,
        "euroc": files.read_euroc_csv_trajectory,
    }
    return *columns(readers[kind](str(path)).poses_se3), None


def read_colmap(path):
    import pycolmap

    model = pycolmap.Reconstruction(str(path))
    images = sorted(model.images.values(), key=lambda image: image.name)
    inverse = [image.cam_from_world() if callable(image.cam_from_world) else image.cam_from_world for image in images]
    lenses = [model.cameras[image.camera_id] for image in images]
    fovs = [math.degrees(2 * math.atan(lens.height / 2 / lens.params[1])) for lens in lenses]
    return *columns([pose.inverse().matrix() for pose in inverse]), fovs


def read_log(path):
    import open3d

    cameras = open3d.io.read_pinhole_camera_trajectory(str(path)).parameters
    return *columns([np.linalg.inv(camera.extrinsic) for camera in cameras]), None


def read_csv(path):
    import pandas

    table = pandas.read_csv(path)
    turns = [rotation(*row) for row in table[["qx", "qy", "qz", "qw"]].to_numpy()]
    return turns, list(table[["x", "y", "z"]].to_numpy()), list(table["fov_y_deg"])


def read_cameras(path):
    cameras = json.loads(path.read_text())["cameras"]
    fovs = [math.degrees(2 * math.atan(camera["height"] / 2 / camera["fy"])) for camera in cameras]
    return *columns([np.array(camera["world_from_camera"]) for camera in cameras]), fovs


def read_usd(path, times):
    from pxr import Gf, Usd, UsdGeom

    stage = Usd.Stage.Open(str(path))
    camera = next(UsdGeom.Camera(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Camera))
    up = Gf.Vec3d(*stage.GetRootLayer().customLayerData["cinesplat_world_up"])
    back = np.array(Gf.Matrix3d(Gf.Rotation(up, Gf.Vec3d(0, 1, 0)))).reshape(3, 3)
    turns, places, fovs = [], [], []
    for time in times:
        pose = camera.GetCamera(stage.GetStartTimeCode() + time * stage.GetTimeCodesPerSecond())
        matrix = np.array(pose.transform).reshape(4, 4).T
        turns.append(back @ matrix[:3, :3] @ FLIP)
        places.append(back @ matrix[:3, 3])
        fovs.append(pose.GetFieldOfView(Gf.Camera.FOVVertical))
    return turns, places, fovs


def read_gltf(path, times):
    import pygltflib

    file = pygltflib.GLTF2().load(str(path))
    blob = file.binary_blob()

    def values(idx):
        accessor = file.accessors[idx]
        view = file.bufferViews[accessor.bufferView]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor.type]
        numbers = np.frombuffer(blob, "<f4", accessor.count * width, view.byteOffset)
        return numbers.reshape(accessor.count, width).astype(float)

    def at(path, time):
        """The specification's LINEAR: slerp for rotations, else lines."""
        keys, found = channels[path]
        idx, t = placed(keys[:, 0], time)
        a, b = found[idx], found[idx + 1]
        return slerp(a, b, t) if path == "rotation" else a + (b - a) * t

    channels = {}
    for channel in file.animations[0].channels:
        sampler = file.animations[0].samplers[channel.sampler]
        assert sampler.interpolation in (None, "LINEAR"), sampler.interpolation
        channels[channel.target.path] = values(sampler.input), values(sampler.output)
    still = file.cameras[0].perspective.yfov
    fovs = [math.degrees(at("pointer", time)[0] if "pointer" in channels else still) for time in times]
    turns = [rotation(*at("rotation", time)) @ FLIP for time in times]
    return turns, [at("translation", time) for time in times], fovs


def read_lichtfeld(path, times):
    """The program is GPL-3 and needs CUDA: this follows its file format and what is known of its curve.

    Its world is the scene file's turned by half a turn about x. Positions are on a uniform Catmull-Rom spline whose ends
    repeat, rotations and focal lengths between those of both keys; numbers have 32 bits.
    """
    keys = json.loads(path.read_text())["keyframes"]
    column = lambda name: np.array([key[name] for key in keys], dtype=np.float32).astype(float)
    moments, places, turns, focals = map(column, ("time", "position", "rotation", "focal_length_mm"))
    easings = [
        lambda t: t,
        lambda t: t**3,
        lambda t: 1 - (1 - t) ** 3,
        lambda t: 4 * t**3 if t < 0.5 else 1 - 4 * (1 - t) ** 3,
    ]
    found = [], [], []
    for time in times:
        idx, t = placed(moments, time)
        t = easings[keys[idx]["easing"]](t)
        p, a, b, n = (places[np.clip(idx + step, 0, len(keys) - 1)] for step in (-1, 0, 1, 2))
        place = a + t / 2 * (b - p + t * (2 * p - 5 * a + 4 * b - n + t * (3 * (a - b) + n - p)))
        w, x, y, z = slerp(turns[idx], turns[idx + 1], t)
        focal = np.clip(focals[idx] + (focals[idx + 1] - focals[idx]) * t, 10, 200)
        found[0].append(FLIP @ rotation(x, y, z, w) @ FLIP)
        found[1].append(FLIP @ place)
        found[2].append(math.degrees(2 * math.atan(12 / focal)))
    return found


def run_elsewhere(command, stdin=""):
    done = subprocess.run([str(part) for part in command], input=stdin, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def read_supersplat(path, times, *limits):
    # The viewer's world is the scene file's turned by half a turn about z.
    turned = np.diag([-1.0, -1.0, 1.0])
    shot = json.loads(Path(SHOT).read_text())
    aspect = max(1.0, shot["width"] / shot["height"])
    rows = run_elsewhere(["node", HERE / "in_supersplat.mjs", NODE, path, *limits], json.dumps(times))
    fovs = [math.degrees(2 * math.atan(math.tan(math.radians(fov) / 2) / aspect)) for *_, fov in rows]
    turns = [turned @ rotation(*turn) @ FLIP for _, turn, _ in rows]
    return turns, [turned @ np.array(place) for place, *_ in rows], fovs


def read_nerfstudio(what, path, times=()):
    rows = run_elsewhere([NERFSTUDIO, HERE / "in_nerfstudio.py", what, path], json.dumps(list(times)))
    return *columns([np.array(pose) for pose, _ in rows]), [fov for _, fov in rows]


def read_blender(path, times):
    rows = run_elsewhere([BLENDER, HERE / "in_blender.py", path])
    fps = json.loads(Path(SHOT).read_text())["fps"]
    rows = [rows[round(2 * time * fps)] for time in times]
    turns, places = columns([np.array(pose) for pose, _ in rows])
    return [turn @ FLIP for turn in turns], places, [fov for _, fov in rows]


def version(package, python=sys.executable):
    script = "import sys; from importlib.metadata import version; print(version(sys.argv[1]))"
    return subprocess.run([python, "-c", script, package], check=True, capture_output=True, text=True).stdout.strip()


def opened_in():
    """Names and versions of the programs."""
    here = ("evo", "pycolmap", "usd-core", "pygltflib", "pandas", "numpy")
    names = {package: f"{package} {version(package)}" for package in here}
    nerfstudio = f"nerfstudio {version('nerfstudio', NERFSTUDIO)}"
    viewer = json.loads((Path(NODE) / "node_modules/@playcanvas/supersplat-viewer/package.json").read_text())
    return {
        **names,
        "open3d": f"Open3D {version('open3d-cpu')}",
        "render": f"{nerfstudio}, `ns-render`",
        "viewer": f"{nerfstudio}, viewer",
        "dataset": f"{nerfstudio}, dataparser",
        "supersplat": f"supersplat-viewer {viewer['version']}",
        "bpy": f"Blender {version('bpy', BLENDER)} (bpy)",
        "documentation": f"{names['numpy']}, by the documentation",
        "format": f"{names['numpy']}, by the file format",
    }


# Format, file, program, reader, whether the program moves the camera between frames.
ROWS = [
    ("tum", "a.tum", "evo", lambda path, _: read_evo("tum", path), False),
    ("kitti", "a.kitti", "evo", lambda path, _: read_evo("kitti", path), False),
    ("euroc", "a.euroc.csv", "evo", lambda path, _: read_evo("euroc", path), False),
    ("log", "a.log", "open3d", lambda path, _: read_log(path), False),
    ("csv", "a.csv", "pandas", lambda path, _: read_csv(path), False),
    ("cameras", "cameras.json", "documentation", lambda path, _: read_cameras(path), False),
    ("colmap", "text", "pycolmap", lambda path, _: read_colmap(path), False),
    ("colmap", "binary/images.bin", "pycolmap", lambda path, _: read_colmap(path.parent), False),
    ("transforms", "transforms.json", "dataset", lambda path, _: read_nerfstudio("dataset", path), False),
    ("nerfstudio", "camera_path.json", "render", lambda path, _: read_nerfstudio("render", path), False),
    ("nerfstudio", "path.json", "viewer", lambda path, times: read_nerfstudio("viewer", path, times), True),
    ("supersplat", "settings.json", "supersplat", read_supersplat, True),
    ("lichtfeld", "timeline.json", "format", read_lichtfeld, True),
    ("usd", "a.usda", "usd-core", read_usd, True),
    ("gltf", "a.glb", "pygltflib", read_gltf, True),
    ("blender", "a.py", "bpy", read_blender, True),
]


def off(truth, found):
    """Largest differences of positions, rotations (degrees) and fields of view (degrees; None without)."""
    turn_off = lambda a, b: math.degrees(2 * math.asin(min(1.0, np.linalg.norm(a - b) / math.sqrt(8))))
    moved = max(np.linalg.norm(a - b) for a, b in zip(truth[1], found[1]))
    turned = max(turn_off(a, b) for a, b in zip(truth[0], found[0]))
    zoomed = None if found[2] is None else max(abs(a - b) for a, b in zip(truth[2], found[2]))
    return moved, turned, zoomed


def shown(numbers):
    one = lambda number: "-" if number is None else "0" if number == 0 else f"{number:.0e}".replace("e-0", "e-")
    return ", ".join(map(one, numbers))


def exported(program, shot, path, *flags):
    """Exports a shot and returns what is said to be lost."""
    line = [program, "export", shot, "-o", path, "--overwrite", *flags]
    said = subprocess.run(list(map(str, line)), check=True, capture_output=True, text=True).stderr
    return [line.split(": ", 1)[1] for line in said.splitlines() if line.startswith("warning: ")]


def film_of(program, shot, folder, fps=None):
    path = folder / "truth.csv"
    exported(program, shot, path, *([] if fps is None else ["--fps", str(fps)]))
    return truth(path)


def variants(shot, folder):
    """The shot, turned to a world with -y up, which SuperSplat takes for granted; and with easings that LichtFeld has."""
    turned, eased = json.loads(Path(shot).read_text()), json.loads(Path(shot).read_text())
    turned["scene"]["up"] = (FLIP @ turned["scene"]["up"]).tolist()
    for key in turned["keyframes"]:
        x, y, z, w = key["rotation_xyzw"]
        key["position"], key["rotation_xyzw"] = (FLIP @ key["position"]).tolist(), [w, -z, y, -x]
        key.pop("euler_deg", None)
    for key in eased["keyframes"]:
        key["easing"] = "cubic-in-out"
    made = {"shot": Path(shot), "turned": folder / "turned.shot.json", "eased": folder / "eased.shot.json"}
    made["turned"].write_text(json.dumps(turned))
    made["eased"].write_text(json.dumps(eased))
    return made


def frames_table(program, shots, folder, opened):
    """Prints the first table, and returns whether all is well."""
    print("| format | opened in | frames | off at frames: position, rotation, lens | between frames | said to be lost |")
    print("|---|---|---:|---|---|---|")
    is_good = True
    for kind, name, opener, read, moves in ROWS:
        shot, path = shots["turned" if kind == "supersplat" else "shot"], folder / name
        path.parent.mkdir(exist_ok=True)
        times, *frames = film_of(program, shot, folder)
        fps = json.loads(Path(shot).read_text())["fps"]
        halves, *between = (column[1::2] for column in film_of(program, shot, folder, 2 * fps))
        halves = [time for time in halves if time < times[-1]] if moves else []
        lost = exported(program, shot, path, "--to", kind)
        if kind == "supersplat":
            read_supersplat(path, [], "limits")
        found = read(path, times + halves)
        num_frames = len(found[0]) - len(halves)
        errors = off(frames, [column and column[:num_frames] for column in found])
        is_good &= num_frames == len(times) and errors[0] < MAX_MOVED and errors[1] < MAX_TURNED_DEG
        in_between = shown(off(between, [column[num_frames:] for column in found])) if moves else "-"
        label = {"text": "colmap, text", "binary/images.bin": "colmap, binary"}.get(name, kind)
        print(f"| {label} | {opened[opener]} | {num_frames} | {shown(errors)} | {in_between} | {'; '.join(lost) or '-'} |")
    return is_good


def keyframes_table(program, shots, folder, opened):
    """Prints the second table, and returns whether all is well."""
    print("\n| format | opened in | keys | said to stray: position, rotation, lens | strays |")
    print("|---|---|---:|---|---|")
    is_good = True
    line = re.compile(r"up to ([\d.]+) scene units \(at [\d.]+ s\), ([\d.]+) degrees and a field of view ([\d.]+) degrees")
    for kind, name, opener, read, moves in ROWS:
        if not moves:
            continue
        shot, path = shots[{"supersplat": "turned", "lichtfeld": "eased"}.get(kind, "shot")], folder / name
        keys = json.loads(Path(shot).read_text())["keyframes"]
        times, *film = film_of(program, shot, folder)
        times = [time for time in times if time < keys[-1]["time_secs"]]
        said = line.search(" ".join(exported(program, shot, path, "--to", kind, "--keyframes")))
        found = off([column[: len(times)] for column in film], read(path, times))
        found = f"{found[0]:.4f}", f"{found[1]:.2f}", f"{found[2]:.2f}"
        near = [abs(float(a) - float(b)) < 1.5 * 10.0 ** -len(a.split(".")[1]) for a, b in zip(said.groups(), found)]
        is_good &= all(near)
        print(f"| {kind} | {opened[opener]} | {len(keys)} | {', '.join(said.groups())} | {', '.join(found)} |")
    return is_good


def main():
    program, opened = sys.argv[1], opened_in()
    with tempfile.TemporaryDirectory() as folder:
        shots = variants(SHOT, Path(folder))
        is_good = frames_table(program, shots, Path(folder), opened)
        is_good &= keyframes_table(program, shots, Path(folder), opened)
    sys.exit(not is_good)


if __name__ == "__main__":
    main()
