"""A film to disturb, and the row of the table that tells what became of it. Used by `run.py` and `surroundings.py`."""

import atexit
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
SCENE = "synth:tabletop:1:0.02"
STOPPED, IO_ERROR = 75, 74


def shot(duration, fps):
    """A shot of the small scene: the camera moves to the right."""
    key = lambda time, x: {"time_secs": time, "position": [x, 1.2, 1.5], "rotation_xyzw": [1, 0, 0, 0], "fov_y_deg": 50, "easing": "smooth"}
    return {"format": "cinesplat.shot", "version": 1, "width": 320, "height": 180, "fps": fps, "duration_secs": duration,
            "scene": {"path": SCENE, "up": [0, 1, 0]}, "keyframes": [key(0, 0), key(duration, 0.2)]}


class Bench:
    """A folder with a shot of `num_frames` frames and the bytes of its undisturbed film."""

    def __init__(self, program, num_frames):
        self.program, self.num_frames = program, num_frames
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="cinesplat-faults-"))
        atexit.register(self.close)
        self.film, self.job = self.folder / "film.mp4", self.folder / "film.mp4.job"
        (self.folder / "shot.json").write_text(json.dumps(shot(num_frames / 30, 30)))
        start = time.monotonic()
        assert self.run().returncode == 0, "the undisturbed film fails"
        self.secs = time.monotonic() - start
        self.whole = self.film.read_bytes()
        self.clear()

    def words(self, *flags, command=("render",)):
        return [self.program, *command, SCENE, "--shot", "shot.json", "-o", "film.mp4", *flags]

    def start(self, *flags, command=("render",), **options):
        return subprocess.Popen(self.words(*flags, command=command), cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, **options)

    def run(self, *flags, **options):
        return subprocess.run(self.words(*flags), cwd=self.folder, capture_output=True, text=True, **options)

    def frames(self):
        """The frame numbers that the log lists, in order."""
        try:
            lines = (self.job / "done.log").read_text(errors="replace").splitlines()
        except FileNotFoundError:
            return []
        return [int(line.split()[0]) for line in lines if len(line.split()) == 2]

    def wait_for(self, child, goal):
        """Waits until the log lists `goal` different frames, or the program ends."""
        while child.poll() is None and len(set(self.frames())) < goal:
            time.sleep(0.001)

    def is_whole(self):
        return self.film.exists() and self.film.read_bytes() == self.whole

    def leftovers(self):
        return sorted(path.name for path in self.folder.iterdir() if path.name not in ("shot.json", "film.mp4"))

    def clear(self):
        self.film.unlink(missing_ok=True)
        shutil.rmtree(self.job, ignore_errors=True)

    def close(self):
        if os.path.ismount(self.folder / "disk"):
            subprocess.run(["umount", self.folder / "disk"], check=False)
        shutil.rmtree(self.folder, ignore_errors=True)
        pathlib.Path(f"{self.folder}.so").unlink(missing_ok=True)
        pathlib.Path(f"{self.folder}.so.reached").unlink(missing_ok=True)


class Row:
    """One line of the table."""

    def __init__(self, fault, tried):
        self.fault, self.tried, self.faults, self.result = fault, tried, [], ""

    def check(self, is_right, what):
        if not is_right:
            self.faults.append(what)


def faults_library(folder):
    """Builds the library that makes calls fail, beside a folder."""
    library = folder.parent / f"{folder.name}.so"
    built = subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, HERE / "nth_call.c", "-ldl"])
    assert built.returncode == 0, "no C compiler"
    return library
