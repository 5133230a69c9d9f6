"""Rows about load: Gaussians, pixels, frames and parallel programs, with the memory that they take. Called by `run.py`."""

import json
import os
import subprocess

from commands import CAMERAS, SCENE, Folder, Row

NUM_GAUSSIANS = 10_000_000
SIZE_PX = (16384, 8192)
NUM_FRAMES = 10_000
NUM_PROGRAMS = 16


def spent(row, folder, *words):
    """Runs a command that must end with 0; returns its peak memory in bytes and its CPU seconds."""
    with open(folder.path / "said", "wb") as said:
        child = subprocess.Popen([folder.program, *words], cwd=folder.path, stdout=subprocess.DEVNULL, stderr=said)
        _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    row.check(child.returncode == 0, f"exit {child.returncode}: {(folder.path / 'said').read_text(errors='replace')[-300:]}")
    return usage.ru_maxrss * 1024, usage.ru_utime + usage.ru_stime


def end(row, folder, tried, peak, secs, further=""):
    folder.close()
    row.tried = tried
    row.result = f"exit 0{further}, at most {peak / 1e9:.2f} GB, {secs:.0f} s of CPU time"
    return row


def write_cloud(path, num):
    """A .splat of small Gaussians at random places in a cube from 1 to 2: every byte of a column at once."""
    rows = bytearray(bytes(num * 32))
    has_high_bit = bytes(byte | 128 for byte in range(256))
    for axis in range(3):
        # A float from 1 to 2: 23 random bits below a fixed sign and exponent.
        for place, column in enumerate((os.urandom(num), os.urandom(num), os.urandom(num).translate(has_high_bit), b"\x3f" * num)):
            rows[axis * 4 + place::32] = column
        for place, byte in enumerate(b"\x6f\x12\x03\x3b"):
            rows[12 + axis * 4 + place::32] = bytes([byte]) * num
        rows[24 + axis::32] = os.urandom(num)
    for place, byte in enumerate((200, 255, 128, 128, 128)):
        rows[27 + place::32] = bytes([byte]) * num
    path.write_bytes(rows)


def gaussians(program):
    folder, row = Folder(program), Row("Many Gaussians: a still of 1280x720")
    write_cloud(folder.path / "cloud.splat", NUM_GAUSSIANS)
    camera = {"name": "c", "width": 1280, "height": 720, "fx": 640, "fy": 640, "cx": 640, "cy": 360,
              "world_from_camera": [[1, 0, 0, 1.5], [0, -1, 0, 1.5], [0, 0, -1, 3], [0, 0, 0, 1]]}
    (folder.path / "cloud.json").write_text(json.dumps({"cameras": [camera]}))
    peak, secs = spent(row, folder, "still", "cloud.splat", "--cameras", "cloud.json", "-o", "stills")
    row.check((folder.path / "stills" / "c.png").exists(), "no picture")
    return end(row, folder, f"{NUM_GAUSSIANS:,} Gaussians", peak, secs)


def pixels(program):
    folder, row = Folder(program), Row("Many pixels: one still")
    width, height = SIZE_PX
    camera = {**CAMERAS["cameras"][0], "width": width, "height": height, "fx": width / 1.6, "fy": width / 1.6, "cx": width / 2, "cy": height / 2}
    (folder.path / "large.json").write_text(json.dumps({"cameras": [camera]}))
    peak, secs = spent(row, folder, "still", SCENE, "--cameras", "large.json", "-o", "stills")
    row.check((folder.path / "stills" / "c.png").exists(), "no picture")
    return end(row, folder, f"{width}x{height}, {width * height / 1e6:.0f} million", peak, secs)


def frames(program):
    folder, row = Folder(program), Row("Many frames: a film of 64x36")
    shot = json.loads((folder.path / "shot.json").read_text())
    duration = NUM_FRAMES / shot["fps"]
    shot["keyframes"][-1]["time_secs"] = shot["duration_secs"] = duration
    (folder.path / "long.json").write_text(json.dumps(shot))
    peak, secs = spent(row, folder, "render", SCENE, "--shot", "long.json", "--size", "64x36", "-o", "film.mp4")
    row.check((folder.path / "film.mp4").exists() and not (folder.path / "film.mp4.job").exists(), "no film, or its frames stayed")
    return end(row, folder, f"{NUM_FRAMES:,} frames", peak, secs)


def programs(program):
    folder, row = Folder(program), Row("Many programs at once: films of 3 frames")
    words = ["render", SCENE, "--shot", "shot.json", "-o"]
    alone = folder.run(*words, "alone.mp4")
    row.check(alone.returncode == 0, f"exit {alone.returncode}: {alone.stderr[-300:]}")
    start = os.times()
    names = [f"{idx}.mp4" for idx in range(NUM_PROGRAMS)]
    children = [subprocess.Popen([program, *words, name], cwd=folder.path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for name in names]
    peak = 0
    for name, child in zip(names, children):
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        peak += usage.ru_maxrss * 1024
        row.check(child.returncode == 0, f"{name}: exit {child.returncode}")
    ended = os.times()
    secs = ended.children_user + ended.children_system - start.children_user - start.children_system
    whole = (folder.path / "alone.mp4").read_bytes()
    row.check(all((folder.path / name).read_bytes() == whole for name in names), "films that differ")
    return end(row, folder, f"{NUM_PROGRAMS} programs", peak, secs, ", films byte-identical")


def rows(program):
    """The rows by name."""
    return {
        "load-gaussians": lambda: gaussians(program),
        "load-pixels": lambda: pixels(program),
        "load-frames": lambda: frames(program),
        "load-programs": lambda: programs(program),
    }
