#!/usr/bin/env python3
"""Reads cameras that usd-core saves and transforms that rosbags records, and prints a table of the errors.

    python3 tests/exchange/other_files.py target/release/cinesplat [FOLDER]

Needs usd-core, rosbags and numpy from PyPI. The truth of USD are the transforms and lenses that usd-core itself computes;
that of ROS are chains of matrices, with lines between positions and slerp between rotations as in tf2 (evo reads
transforms only where ROS is installed). With a folder the files stay there. Exits with 1 if a position is off by more than
1e-5, a rotation by more than 1e-4 or a lens by more than 1e-5 degrees.
"""

import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom

MAX_OFF = (1e-5, 1e-4, 1e-5)
FLIP = np.diag([1.0, -1.0, -1.0])
CODES_PER_SECOND = 25


def turned(axis, degrees):
    axis = np.array(axis, float) / np.linalg.norm(axis)
    half = math.radians(degrees) / 2
    return np.array([math.cos(half), *(math.sin(half) * axis)])


def matrix(wxyz):
    w, x, y, z = wxyz
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def imported(program, path, folder):
    """Times, rotations, positions and lenses of a path, as the program reads it."""
    shot, table = folder / "read.shot.json", folder / "read.csv"
    for line in (["import", path, "-o", shot], ["export", shot, "--to", "csv", "-o", table, "--keyframes"]):
        subprocess.run([program, *map(str, line), "--overwrite", "-q"], check=True)
    rows = list(csv.DictReader(table.open()))
    turn = lambda row: matrix([float(row["q" + axis]) for axis in "wxyz"])
    return (
        np.array([float(row["time_secs"]) for row in rows]),
        [turn(row) for row in rows],
        [np.array([float(row[axis]) for axis in "xyz"]) for row in rows],
        [float(row["fov_y_deg"]) for row in rows],
    )


def angle(a, b):
    return math.degrees(2 * math.asin(min(1.0, np.linalg.norm(a - b) / math.sqrt(8))))


def worst(found, truth):
    """Largest errors of positions, rotations and lenses (degrees; None without)."""
    _, turns, places, lenses = found
    _, true_turns, true_places, true_lenses = truth
    assert len(turns) == len(true_turns), f"{len(turns)} poses of {len(true_turns)}"
    moved = max(np.linalg.norm(a - b) for a, b in zip(places, true_places))
    spun = max(angle(a, b) for a, b in zip(turns, true_turns))
    zoomed = max(abs(a - b) for a, b in zip(lenses, true_lenses)) if true_lenses else None
    return moved, spun, zoomed


def save_camera(path, kind, num_frames):
    """A camera below a turned and scaled prim, with all that a reader of cameras has to skip beside it."""
    stage = Usd.Stage.CreateNew(str(path))
    stage.SetTimeCodesPerSecond(CODES_PER_SECOND)
    stage.SetFramesPerSecond(CODES_PER_SECOND)
    UsdGeom.SetStageUpAxis(stage, "Z")
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    stage.GetRootLayer().customLayerData = {"note": "hello", "nested": {"a": 1, "b": Gf.Vec3d(1, 2, 3.5)}}
    mesh = UsdGeom.Mesh.Define(stage, "/zz/mesh")
    mesh.GetPointsAttr().Set([Gf.Vec3f(i, 0.5 * i, 1) for i in range(40)])
    rig = UsdGeom.Xform.Define(stage, "/rig")
    rig.AddTranslateOp().Set(Gf.Vec3d(0, 0, 5))
    rig.AddRotateXYZOp().Set(Gf.Vec3f(80, 10, -30))
    rig.AddScaleOp().Set(Gf.Vec3f(2, 2, 2))
    camera = UsdGeom.Camera.Define(stage, "/rig/arm/camera")
    frames = range(num_frames)
    if kind == "translate, orient":
        translate, orient = camera.AddTranslateOp(), camera.AddOrientOp(UsdGeom.XformOp.PrecisionDouble)
        for code in frames:
            translate.Set(Gf.Vec3d(math.sin(code / 9), code * 0.1, 0.25 * code * code / 7), code)
            orient.Set(Gf.Quatd(*turned((0.6, 0, 0.8), 3.0 * code)), code)
    elif kind == "matrix":
        transform = camera.AddTransformOp()
        for code in frames:
            turn, place = Gf.Rotation(Gf.Vec3d(0.2, 1, 0.1), 4.0 * code), Gf.Vec3d(code, 2, -0.5 * code)
            transform.Set(Gf.Matrix4d().SetTransform(turn, place), 2.5 * code)
    elif kind == "pivot, halves":
        camera.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat, "pivot").Set(Gf.Vec3f(1, 2, 3))
        orient = camera.AddOrientOp(UsdGeom.XformOp.PrecisionFloat)
        for code in frames:
            orient.Set(Gf.Quatf(*map(float, turned((0, 1, 0), 5.0 * code))), code)
        camera.AddRotateYOp(UsdGeom.XformOp.PrecisionHalf).Set(12.5)
        camera.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat, "pivot", True)
    else:
        camera.AddTranslateOp(UsdGeom.XformOp.PrecisionHalf).Set(Gf.Vec3h(1.5, 2, 3.25))
    if kind != "still":
        for code in frames[::3]:
            # At the times of the other samples: usd-core does not keep matrices rigid between theirs.
            camera.GetFocalLengthAttr().Set(20 + code * 0.37, code * (2.5 if kind == "matrix" else 1))
    camera.GetFocusDistanceAttr().Set(4.5)
    camera.GetVerticalApertureAttr().Set(18.25)
    settings = stage.DefinePrim("/Render/settings", "RenderSettings")
    settings.CreateAttribute("resolution", Sdf.ValueTypeNames.Int2).Set(Gf.Vec2i(1920, 800))
    stage.GetRootLayer().Save()


def true_camera(path, times):
    """What usd-core computes at the times that the program read."""
    stage = Usd.Stage.Open(str(path))
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/rig/arm/camera"))
    turns, places, lenses = [], [], []
    for time in times:
        code = Usd.TimeCode(time * CODES_PER_SECOND)
        world = np.array(camera.ComputeLocalToWorldTransform(code)).T
        axes = world[:3, :3] / np.linalg.norm(world[:3, :3], axis=0)
        turns.append(axes @ FLIP)
        places.append(world[:3, 3])
        height, focal = camera.GetVerticalApertureAttr().Get(code), camera.GetFocalLengthAttr().Get(code)
        lenses.append(math.degrees(2 * math.atan(height / 2 / focal)))
    return times, turns, places, lenses


def packed(path):
    """A package that holds a layer."""
    package = path.with_name(path.stem + "." + path.suffix[1:] + ".usdz")
    writer = Sdf.ZipFileWriter.CreateNew(str(package))
    writer.AddFile(str(path), path.name)
    assert writer.Save()
    return package


def check_usd(program, folder):
    for number, kind in enumerate(["translate, orient", "matrix", "pivot, halves", "still"]):
        text, binary = folder / f"camera{number}.usda", folder / f"camera{number}.usdc"
        for path in (text, binary):
            path.unlink(missing_ok=True)
            save_camera(path, kind, 12)
        for path in (text, binary, packed(text), packed(binary)):
            found = imported(program, path, folder)
            yield f"USD, {kind}", path.name.split(".", 1)[1], len(found[0]), worst(found, true_camera(binary, found[0]))


def slerp(a, b, t):
    b = b if a @ b >= 0 else -b
    angle = math.acos(min(1.0, a @ b))
    if angle < 1e-9:
        return a
    return (math.sin((1 - t) * angle) * a + math.sin(t * angle) * b) / math.sin(angle)


def odom_of(secs):
    return np.array([0.1 * secs, 0.02, -0.3]), turned((0, 0.1, 1), 5 * secs)


def base_of(secs):
    return np.array([2 * math.sin(secs), secs, 0.1 * secs]), turned((0.3, 0.2, 1), 40 * math.sin(0.7 * secs) + 10 * secs)


CAMERA = (np.array([0.3, -0.1, 0.9]), turned((1, -1, 1), -120))


def record(path, version, packing):
    """map <- odom at 10 Hz, odom <- base at 50 Hz, base <- camera once, of 20 s."""
    from rosbags.rosbag1 import Writer as Bag
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
    from rosbags.rosbag2 import Writer as Bag2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if version == 1 else Stores.ROS2_HUMBLE)
    name = "tf2_msgs/msg/TFMessage"
    if name not in store.types:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", name))
    types = store.types

    def message(nanos, parent, child, pose):
        place, turn = pose
        stamp = types["builtin_interfaces/msg/Time"](sec=nanos // 10**9, nanosec=nanos % 10**9)
        number = {"seq": 0} if version == 1 else {}
        header = types["std_msgs/msg/Header"](**number, stamp=stamp, frame_id=parent)
        w, x, y, z = map(float, turn)
        turn = types["geometry_msgs/msg/Quaternion"](x=x, y=y, z=z, w=w)
        place = types["geometry_msgs/msg/Vector3"](*map(float, place))
        transform = types["geometry_msgs/msg/Transform"](translation=place, rotation=turn)
        return types[name](
            transforms=[types["geometry_msgs/msg/TransformStamped"](header=header, child_frame_id=child, transform=transform)]
        )

    start = 1_700_000_000 * 10**9
    writer = Bag(path) if version == 1 else Bag2(path, version=8, storage_plugin=StoragePlugin.MCAP)
    pack = store.serialize_ros1 if version == 1 else store.serialize_cdr
    if packing and version == 1:
        writer.set_compression(Bag.CompressionFormat[packing.upper()])
    elif packing:
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat[packing.upper()])
    with writer as bag:
        moving = bag.add_connection("/tf", name, typestore=store)
        static = bag.add_connection("/tf_static", name, typestore=store)
        bag.write(static, start, pack(message(start, "base", "camera", CAMERA), name))
        for nanos in range(0, 20 * 10**9 + 1, 20_000_000):
            if nanos % 100_000_000 == 0:
                bag.write(moving, start + nanos, pack(message(start + nanos, "map", "odom", odom_of(nanos / 1e9)), name))
            bag.write(moving, start + nanos, pack(message(start + nanos, "odom", "base", base_of(nanos / 1e9)), name))


def transform(pose):
    out = np.eye(4)
    out[:3, 3], out[:3, :3] = pose[0], matrix(pose[1])
    return out


def odom_between(secs):
    low = math.floor(secs * 10 + 1e-6) / 10
    t = (secs - low) / 0.1
    (a, p), (b, q) = odom_of(low), odom_of(low + 0.1)
    return a + (b - a) * t, slerp(p, q, t)


def check_ros(program, folder):
    recordings = [(folder / "plain.bag", 1, None), (folder / "lz4.bag", 1, "lz4"), (folder / "plain", 2, None)]
    recordings.append((folder / "zstd", 2, "zstd"))
    for path, version, packing in recordings:
        if not path.exists():
            record(path, version, packing)
    chains = {
        "map.camera": lambda secs: transform(odom_between(secs)) @ transform(base_of(secs)) @ transform(CAMERA),
        "camera.map": lambda secs: np.linalg.inv(chains["map.camera"](secs)),
        "odom.camera": lambda secs: transform(base_of(secs)) @ transform(CAMERA),
        "map.base": lambda secs: transform(odom_between(secs)) @ transform(base_of(secs)),
    }
    for path in (path if version == 1 else next(path.glob("*.mcap")) for path, version, _ in recordings):
        for frames, truth in chains.items():
            found = imported(program, f"{path}#/tf:{frames}", folder)
            # Seconds since 1970 hold a quarter of a microsecond.
            poses = [truth(round(float(time), 3)) for time in found[0]]
            true = found[0], [pose[:3, :3] for pose in poses], [pose[:3, 3] for pose in poses], None
            yield f"ROS, /tf:{frames}", path.name, len(found[0]), worst(found, true)


def shown(error):
    return "-" if error is None else "0" if error == 0 else f"{error:.0e}".replace("e-0", "e-")


def main():
    program = sys.argv[1]
    is_good = True
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(sys.argv[2] if len(sys.argv) > 2 else temporary)
        folder.mkdir(parents=True, exist_ok=True)
        found = {}
        for check in (check_usd, check_ros):
            for what, *row in check(program, folder):
                found.setdefault(what, []).append(row)
        print("| what | files | poses | position off | rotation off, deg | lens off, deg |")
        print("|---|---|---:|---:|---:|---:|")
        for what, rows in found.items():
            files, counts, errors = zip(*rows)
            # The lens is in all files of a kind, or in none.
            errors = [None if None in column else max(column) for column in zip(*errors)]
            is_good &= all(error is None or error <= most for error, most in zip(errors, MAX_OFF))
            print(f"| {what} | {', '.join(files)} | {max(counts)} | " + " | ".join(map(shown, errors)) + " |")
    sys.exit(0 if is_good else 1)


main()
