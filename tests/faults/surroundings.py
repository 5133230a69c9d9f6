"""Rows about what surrounds a film: the clock, TMPDIR, other builds and inputs, and kills while a folder is removed. Called by
`run.py`.
"""

import contextlib
import json
import os
import pathlib
import random
import signal
import subprocess
import time

from bench import SCENE, STOPPED, Bench, Row, faults_library


def clock_jumps(program):
    """The time of day jumps a year ahead or back at every second look, while a film is made, stopped and goes on."""
    bench, rng, row = Bench(program, 60), random.Random(7), Row("The clock jumps a year ahead or back", "")
    library, year = faults_library(bench.folder), 365 * 24 * 3600
    for jump in (year, -year):
        jumping = {**os.environ, "LD_PRELOAD": str(library), "FAULT_CLOCK": str(jump)}
        row.check(bench.run(env=jumping).returncode == 0 and bench.is_whole(), f"{jump} s: another film")
        bench.clear()
        child = bench.start(env=jumping)
        bench.wait_for(child, rng.randint(5, 40))
        child.send_signal(signal.SIGINT)
        child.communicate()
        row.check(child.returncode in (0, STOPPED), f"{jump} s: exit {child.returncode}")
        again = bench.run("--overwrite", env=jumping)
        row.check(again.returncode == 0 and bench.is_whole() and bench.leftovers() == [], f"{jump} s: {again.stderr[-300:]}")
        bench.clear()
    row.tried, row.result = "2 jumps, 4 films", "all films byte-identical"
    bench.close()
    return row


def cleanups(program, num):
    """SIGKILL while the folder of a whole film is removed; the same line then removes the rest."""
    bench, rng, row = Bench(program, 60), random.Random(8), Row("SIGKILL while the folder of a whole film is removed", "")
    num_left = 0
    for _ in range(num):
        child = bench.start()
        while child.poll() is None and not bench.film.exists():
            time.sleep(0.0005)
        time.sleep(rng.uniform(0, 0.01))
        child.kill()
        child.communicate()
        num_left += bench.job.exists()
        row.check(bench.is_whole(), "no whole film")
        flags = rng.choice([[], ["--overwrite"]])
        again = bench.run(*flags)
        row.check(again.returncode == (0 if flags else 73), f"{flags}: exit {again.returncode}: {again.stderr[-300:]}")
        row.check(bench.is_whole() and bench.leftovers() == [], f"{flags}: left {bench.leftovers()}")
        bench.clear()
    row.tried = f"{num} kills"
    row.result = f"{num_left} times a folder was left; the next run removed it, all films byte-identical"
    bench.close()
    return row


def changes(program):
    """One thing that a stopped film is made from is changed: refused, field by field; the first line goes on."""
    bench, row = Bench(program, 20), Row("A stopped film with another scene, shot, setting or build", "")
    other = bench.folder / "other-build"
    other.write_bytes(pathlib.Path(program).read_bytes() + b"\n")
    other.chmod(0o755)
    original = json.loads((bench.folder / "shot.json").read_text())
    moved = {**original, "keyframes": [{**original["keyframes"][0], "position": [0.1, 1.2, 1.5]}, original["keyframes"][1]]}
    (bench.folder / "moved.json").write_text(json.dumps(moved))
    flags = {"fps": ["--fps", "15"], "size": ["--size", "160x90"], "quality": ["--quality", "draft"], "crf": ["--crf", "30"],
             "preset": ["--preset", "slow"], "near": ["--near", "0.3"], "filter": ["--filter", "mip"], "sort": ["--sort", "ray"],
             "color-clamp": ["--color-clamp", "khr"], "duration": ["--duration", "0.5"], "frames": ["--frames", "0..9"]}
    lines = {name: bench.words(*words) for name, words in flags.items()}
    lines["engine"] = [str(other), *bench.words()[1:]]
    lines["scene"] = ["synth:tabletop:2:0.02" if word == SCENE else word for word in bench.words()]
    lines["keyframes"] = ["moved.json" if word == "shot.json" else word for word in bench.words()]
    assert bench.run("--keep-frames").returncode == 0
    bench.film.unlink()
    for field, line in lines.items():
        refused = subprocess.run(line, cwd=bench.folder, capture_output=True, text=True)
        said = refused.returncode == 65 and "JOB-MISMATCH" in refused.stderr and f"{field} was " in refused.stderr
        row.check(said, f"{field}: exit {refused.returncode}: {refused.stderr[-300:]}")
        row.check(len(set(bench.frames())) == 20 and not bench.film.exists(), f"{field}: the frames are gone")
    again = bench.run()
    row.check(again.returncode == 0 and bench.is_whole() and "20 of 20 frames were kept" in again.stderr, again.stderr[-300:])
    row.tried, row.result = f"{len(lines)} fields", "exit 65 names the field; the first line goes on and makes the film"
    bench.close()
    return row


def temporary_folder(program):
    """TMPDIR is full, on another disk, read-only, or no folder."""
    bench, row = Bench(program, 20), Row("TMPDIR full, on another disk, read-only, missing", "")
    disk = bench.folder / "disk"
    disk.mkdir()
    places = {"missing": "/nowhere", "a file": str(bench.folder / "shot.json"), "read-only": "/proc"}
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk], capture_output=True).returncode == 0
    if mounted:
        with contextlib.suppress(OSError), open(disk / "fill", "wb", buffering=0) as fill:
            while fill.write(b"x" * 4096):
                pass
        places["full, on another disk"] = str(disk)
    for place, folder in places.items():
        made = bench.run(env={**os.environ, "TMPDIR": folder})
        row.check(made.returncode == 0 and bench.is_whole(), f"{place}: exit {made.returncode}: {made.stderr[-300:]}")
        bench.clear()
    row.tried = f"{len(places)} places" + ("" if mounted else " (only root may mount a disk)")
    row.result = "all films byte-identical"
    bench.close()
    return row


def rows(program, num):
    """The rows by name. `num`: kills."""
    return {
        "cleanups": lambda: cleanups(program, max(1, num // 4)),
        "changes": lambda: changes(program),
        "clock": lambda: clock_jumps(program),
        "tmpdir": lambda: temporary_folder(program),
    }
