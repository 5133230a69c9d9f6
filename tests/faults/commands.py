"""Rows about single commands: limits on memory, failing writes, cut inputs. Called by `run.py`.

A command may end with 0 or with an exit code that says what is wrong; never by a signal, never with 70 (a fault of the
program), and never with an output that is neither whole nor absent.
"""

import atexit
import collections
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SEEDS = HERE.parent / "fuzz" / "seeds"
SCENE = "synth:tabletop:1:0.02"
CAMERAS = {"cameras": [{"name": "c", "width": 320, "height": 180, "fx": 200, "fy": 200, "cx": 160, "cy": 90,
                        "world_from_camera": [[1, 0, 0, 0], [0, -1, 0, 1.2], [0, 0, -1, 1.5], [0, 0, 0, 1]]}]}
# What a command may end with where memory is short: done, refused, and the system's loader that cannot start it.
WITHIN_LIMITS = {0, 71, 127}


class Row:
    """A line of the table, and what was wrong."""

    def __init__(self, fault):
        self.fault, self.tried, self.faults, self.result = fault, "", [], ""

    def check(self, is_right, what):
        if not is_right:
            self.faults.append(what)

    def end(self, tried, codes, further=""):
        self.tried = tried
        self.result = ", ".join(f"exit {code}: {count}" for code, count in sorted(codes.items())) + further
        return self


class Folder:
    """A folder with inputs for every command."""

    def __init__(self, program):
        self.program = program
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="cinesplat-faults-"))
        atexit.register(self.close)
        key = lambda time, x: {"time_secs": time, "position": [x, 1.2, 1.5], "rotation_xyzw": [1, 0, 0, 0],
                               "fov_y_deg": 50, "easing": "smooth"}
        shot = {"format": "cinesplat.shot", "version": 1, "width": 320, "height": 180, "fps": 30, "duration_secs": 0.1,
                "scene": {"path": SCENE, "up": [0, 1, 0]}, "keyframes": [key(0, 0), key(0.1, 0.2)]}
        (self.path / "shot.json").write_text(json.dumps(shot))
        (self.path / "cameras.json").write_text(json.dumps(CAMERAS))
        self.inputs = {"shot.json", "cameras.json"}

    def run(self, *words, **options):
        return subprocess.run([self.program, *words], cwd=self.path, capture_output=True, text=True, timeout=600, **options)

    def outputs(self):
        return sorted(name for name in os.listdir(self.path) if name not in self.inputs)

    def clear(self):
        for name in self.outputs():
            path = self.path / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def close(self):
        shutil.rmtree(self.path, ignore_errors=True)


COMMANDS = {
    "info": ["info", SCENE],
    "plan": ["plan", SCENE, "-p", "push in", "-o", "planned.json", "--solve", "fast"],
    "render": ["render", SCENE, "--shot", "shot.json", "-o", "film.mp4"],
    "still": ["still", SCENE, "--cameras", "cameras.json", "-o", "stills", "--npy"],
    "objects": ["objects", SCENE, "-o", "objects.json"],
    "export": ["export", "shot.json", "-o", "path.tum"],
    "map": ["map", SCENE, "--shot", "shot.json", "-o", "map.svg"],
}


def address_space(program):
    """`ulimit -v` from 64 MB to 4 GB over the commands; in steps of 500 KB where the program barely starts and where `plan`
    barely fits."""
    folder, row, codes = Folder(program), Row("`ulimit -v` from 64 MB to 4 GB over 7 commands"), collections.Counter()
    coarse = [64, 128, 192, *range(208, 400, 16), 448, 512, 640, 768, 1024, 1280, 1536, 2048, 3072, 4096]
    runs = [(size << 10, name) for size in coarse for name in COMMANDS]
    runs += [(size, name) for size in range(200_000, 480_000, 500) for name in ("info", "plan")]
    for size, name in runs:
        # In kilobytes, as the shell's.
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (size << 10, size << 10))
        ended = folder.run(*COMMANDS[name], preexec_fn=limit)
        codes[ended.returncode] += 1
        is_right = ended.returncode in WITHIN_LIMITS or is_abort_of_library(ended)
        row.check(is_right, f"{name}, {size} KB: exit {ended.returncode}: {ended.stderr[-300:]}")
        row.check(ended.returncode != 71 or "\nhelp: " in ended.stderr, f"{name}, {size} KB: no help: {ended.stderr[-300:]}")
        folder.clear()
    folder.close()
    return row.end(f"{len({size for size, _ in runs})} limits, {len(runs)} runs", codes, " (127: the system's loader, -6: a library before the program begins)")


def is_abort_of_library(ended):
    """Whether GLib, on which FFmpeg's libraries depend, aborted while the system loaded it: before the program's first line."""
    return ended.returncode == -signal.SIGABRT and "GLib" in ended.stderr and "error[" not in ended.stderr


def max_memory(program):
    """`--max-memory` from 16 MB to 2 GB over the commands, with the peak that the system measured."""
    folder, row, codes = Folder(program), Row("`--max-memory` from 16 MB to 2 GB over 7 commands"), collections.Counter()
    sizes, worst = [16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 1024, 2048], 0
    for size in sizes:
        for name, words in COMMANDS.items():
            timed = subprocess.run(["/usr/bin/time", "-f", "%M", program, *words, "--max-memory", f"{size}M"],
                                   cwd=folder.path, capture_output=True, text=True, timeout=600)
            codes[timed.returncode] += 1
            row.check(timed.returncode in (0, 71), f"{name}, {size} MB: exit {timed.returncode}: {timed.stderr[-300:]}")
            peak = int(timed.stderr.split()[-1]) / 1024
            if timed.returncode == 0:
                worst = max(worst, peak - size)
            folder.clear()
    folder.close()
    # The system counts the pages of the program's own file, too (47 MB), the libraries' and what the allocator keeps for threads.
    row.check(worst < 80, f"{worst:.0f} MB more than allowed")
    return row.end(f"{len(sizes)} bounds, {len(sizes) * len(COMMANDS)} runs", codes, f"; at most {max(0, worst):.0f} MB above the bound")


def failing_writes(program, kind):
    """The nth call that writes fails, for every command that writes, n = 1, 2, .. until a run passes without reaching it."""
    folder, row, codes = Folder(program), Row(f"nth write fails: {kind}, commands other than `render`"), collections.Counter()
    library = folder.path.parent / f"{folder.path.name}.so"
    reached = pathlib.Path(f"{library}.reached")
    built = subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, HERE / "nth_call.c", "-ldl"])
    assert built.returncode == 0, "no C compiler"
    num_calls = 0
    for name, words in COMMANDS.items():
        if name in ("info", "render"):
            continue
        assert folder.run(*words).returncode == 0, name
        whole = {path: (folder.path / path).read_bytes() for path in files(folder)}
        folder.clear()
        for call in range(1, 1000):
            reached.unlink(missing_ok=True)
            faulty = {**os.environ, "LD_PRELOAD": str(library), "FAULT_KIND": kind, "FAULT_CALL": str(call),
                      "FAULT_REACHED": str(reached)}
            ended = folder.run(*words, env=faulty)
            if not reached.exists():
                row.check(ended.returncode == 0, f"{name}: exit {ended.returncode} without a fault")
                folder.clear()
                break
            num_calls += 1
            codes[ended.returncode] += 1
            expected = {0} if kind in ("eintr", "short") else {0, 74, 73}
            row.check(ended.returncode in expected, f"{name}, call {call}: exit {ended.returncode}: {ended.stderr[-300:]}")
            row.check(ended.returncode != 0 or files(folder) == sorted(whole), f"{name}, call {call}: outputs are missing")
            for path in files(folder):
                row.check(path in whole and (folder.path / path).read_bytes() == whole[path], f"{name}, call {call}: {path}")
            folder.clear()
    library.unlink()
    reached.unlink(missing_ok=True)
    folder.close()
    return row.end(f"every one of {num_calls} calls", codes)


def files(folder):
    """Paths of the output files below the folder."""
    found = (path for name in folder.outputs() for path in [folder.path / name, *(folder.path / name).rglob("*")])
    return sorted(str(path.relative_to(folder.path)) for path in found if path.is_file())


def cuts(program):
    """Six small inputs, cut at every byte."""
    folder, row, codes = Folder(program), Row("Six small inputs cut at every byte"), collections.Counter()
    inputs = {
        "scene/binary.ply": ["info", "INPUT.ply"],
        "scene/gzip.spz": ["info", "INPUT.spz"],
        "scene/a.sog": ["info", "INPUT.sog"],
        "shot/whole.json": ["export", "INPUT.json", "-o", "-", "--to", "tum"],
        "cameras/a.json": ["still", SCENE, "--cameras", "INPUT.json", "-o", "stills", "--overwrite"],
        "path/a.glb": ["import", "INPUT.glb", "-o", "-"],
    }
    num = 0
    for seed, words in inputs.items():
        whole = (SEEDS / seed).read_bytes()
        whole = whole[1:] if seed.split("/")[0] in ("scene", "path") else whole
        words = [word.replace("INPUT", str(folder.path / "cut")) for word in words]
        path = folder.path / next(word for word in words if "cut." in word)
        for length in range(len(whole)):
            path.write_bytes(whole[:length])
            ended = folder.run(*words)
            num += 1
            codes[ended.returncode] += 1
            row.check(ended.returncode in (0, 65, 71), f"{seed} cut at {length}: exit {ended.returncode}: {ended.stderr[-300:]}")
    folder.close()
    return row.end(f"{num} cuts", codes)


def rows(program):
    """The rows by name."""
    return {
        "address-space": lambda: address_space(program),
        "max-memory": lambda: max_memory(program),
        **{f"writes-{kind}": lambda kind=kind: failing_writes(program, kind) for kind in ("enospc", "eio", "eintr", "short")},
        "cuts": lambda: cuts(program),
    }
