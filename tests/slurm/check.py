"""Films on a cluster that loses tasks and nodes, compared with a film that one machine makes.

Usage: python3 tests/slurm/check.py target/release/cinesplat [--frames 240] [--quality reference --only undisturbed]

Prints a table for `tests/reliability.md`. Exits with 1 if a film differs or a frame was lost. `tests/slurm/cluster.py` says
what it needs.
"""

import argparse
import atexit
import collections
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "faults"))
from bench import shot
from cluster import Cluster

SCENE = "synth:tabletop:1:0.3"
# Tasks that are killed in one film.
NUM_KILLED = 4


class Bench:
    """A folder that all nodes share, with a shot and the film that one machine makes of it."""

    def __init__(self, program, num_frames, quality):
        self.program, self.num_frames, self.quality, self.faults = program, num_frames, quality, []
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="cinesplat-farm-"))
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.children = []
        atexit.register(self.end_children)
        self.film, self.job = self.folder / "film.mp4", self.folder / "film.mp4.job"
        (self.folder / "shot.json").write_text(json.dumps({**shot(num_frames / 30, 30), "scene": {"path": SCENE, "up": [0, 1, 0]}}))
        self.words = [SCENE, "--shot", "shot.json", "--size", "960x540", "--quality", quality, "-o", "film.mp4"]
        start = time.monotonic()
        subprocess.run([program, "render", *self.words, "--threads", "1"], cwd=self.folder, check=True, capture_output=True)
        self.secs = time.monotonic() - start
        self.whole = self.film.read_bytes()
        self.film.unlink()

    def farm(self, *flags):
        child = subprocess.Popen([self.program, "farm", *flags, *self.words], cwd=self.folder, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, text=True)
        self.children.append(child)
        return child

    def end_children(self):
        for child in self.children:
            if child.poll() is None:
                child.kill()

    def num_done(self):
        return len(set(self.frames()))

    def frames(self):
        try:
            lines = (self.job / "done.log").read_text().splitlines()
        except FileNotFoundError:
            return []
        return [int(line.split()[0]) for line in lines if len(line.split()) == 2]

    def wait_for(self, child, num_done):
        while child.poll() is None and self.num_done() < num_done:
            time.sleep(0.02)

    def row(self, fault, tried, child, start, said=None):
        """Waits for the farm, checks the film, and prints a line of the table."""
        said = said or child.communicate()[1]
        secs, listed = time.monotonic() - start, collections.Counter(self.frames())
        twice = sum(count - 1 for count in listed.values())
        is_whole = self.film.exists() and self.film.read_bytes() == self.whole
        if child.returncode != 0 or not is_whole or len(listed) != self.num_frames:
            print(said, file=sys.stderr, flush=True)
            self.faults.append(f"{fault}: exit {child.returncode}, {len(listed)} frames, film {'is whole' if is_whole else 'differs'}\n{said}")
        result = "film byte-identical" if is_whole else "**another film**"
        print(f"| {fault} | {tried} | {result}, {twice} frames twice; {secs:.0f} s, local on one thread {self.secs:.0f} s |", flush=True)
        self.clear()

    def clear(self):
        self.film.unlink(missing_ok=True)
        shutil.rmtree(self.job, ignore_errors=True)


def undisturbed(bench, cluster):
    start = time.monotonic()
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    bench.row(f"Slurm, two nodes, nothing disturbed, {bench.quality} quality", "4 tasks", child, start)


def killed_tasks(bench, cluster):
    """Four tasks are killed, and one node is drained."""
    start, rng = time.monotonic(), random.Random(5)
    child = bench.farm("--slurm", "--parts", "8", "--keep-frames")
    killed = []
    for step in range(NUM_KILLED):
        bench.wait_for(child, bench.num_frames * (step + 1) // 16)
        tasks = cluster.running()
        if tasks:
            job, task, node = rng.choice(tasks)
            # Half of them without a chance to finish their frame.
            words = ["scancel", task] if step % 2 else ["scancel", "--signal=KILL", "--full", task]
            subprocess.run(words, check=False)
            killed.append(task)
        if step == 2:
            cluster.scontrol("update", "nodename=n2", "state=drain", "reason=test")
    bench.wait_for(child, bench.num_frames * 3 // 4)
    cluster.scontrol("update", "nodename=n2", "state=resume")
    bench.row("Slurm, tasks killed, one of two nodes drained", f"{len(killed)} of 8 tasks", child, start)
    if len(killed) < NUM_KILLED:
        bench.faults.append(f"only {len(killed)} tasks were killed before the film was whole")


def crashed_node(bench, cluster):
    """The daemon of a node dies; its tasks are put back into the queue while the orphans go on."""
    start = time.monotonic()
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    bench.wait_for(child, bench.num_frames // 4)
    cluster.kill_node("n1")
    bench.wait_for(child, bench.num_frames // 2)
    cluster.start_node("n1")
    time.sleep(1)
    cluster.scontrol("update", "nodename=n1", "state=resume")
    bench.row("Slurm, the daemon of a node killed", "1 of 2 nodes", child, start)


def stopped_farm(bench, cluster):
    """The waiting program is stopped; its line is typed again. Then it is killed, and the tasks go on without it."""
    start = time.monotonic()
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    bench.wait_for(child, bench.num_frames // 5)
    child.send_signal(signal.SIGINT)
    said = child.communicate()[1]
    if child.returncode != 75 or "to go on, type: " not in said:
        bench.faults.append(f"stopped: exit {child.returncode}\n{said}")
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    bench.wait_for(child, bench.num_frames // 2)
    child.kill()
    child.communicate()
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    bench.row("Slurm, the waiting program stopped, then killed, its line typed again", "2 times", child, start)


def left_alone(bench, cluster):
    start = time.monotonic()
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames", "--no-wait")
    said = child.communicate()[1]
    if child.returncode != 0:
        bench.faults.append(f"--no-wait: exit {child.returncode}\n{said}")
    while not bench.film.exists() and time.monotonic() - start < 300:
        time.sleep(0.2)
    bench.row("Slurm, --no-wait: a further job makes the film", "4 tasks, 1 job", child, start, said)


def refused(bench, cluster):
    """Bad inputs are refused at once; tasks that cannot work say why, and are not submitted for ever."""
    farm = lambda *words: subprocess.run([bench.program, "farm", "--slurm", "--parts", "2", *words, "--shot", "shot.json", "-o", "film.mp4"],
                                         cwd=bench.folder, capture_output=True, text=True)
    before = farm("none.ply")
    # Their shot is not in that folder.
    inside = farm(SCENE, "--sbatch", "--chdir=/")
    is_right = (before.returncode == 66 and "error[SCENE-NOT-FOUND]" in before.stderr
                and inside.returncode == 69 and "finished no frame: error[" in inside.stderr)
    if not is_right:
        bench.faults.append(f"refused: exit {before.returncode}\n{before.stderr}\nexit {inside.returncode}\n{inside.stderr}")
    print(f"| Slurm, a scene that is missing; tasks that cannot work | 2 farms | {'exit 66 at once; exit 69 with what a task says' if is_right else '**fault**'} |", flush=True)
    bench.clear()


def held(bench, cluster):
    """A person holds the waiting tasks, and releases them later: they are not canceled."""
    start = time.monotonic()
    cluster.scontrol("update", "nodename=n1,n2", "state=drain", "reason=test")
    child = bench.farm("--slurm", "--parts", "4", "--keep-frames")
    job = ""
    while not job and child.poll() is None:
        job = cluster.output("squeue", "-h", "-o", "%A").split()[:1]
        time.sleep(0.1)
    job = job[0] if job else "0"
    cluster.scontrol("hold", job)
    cluster.scontrol("update", "nodename=n1,n2", "state=resume")
    time.sleep(6)
    is_waiting = child.poll() is None and len(cluster.output("squeue", "-h", "--array", "-o", "%r").split()) == 4
    cluster.scontrol("release", job)
    bench.row("Slurm, waiting tasks held by a person, released later", "4 tasks", child, start)
    if not is_waiting:
        bench.faults.append("held: the tasks did not wait")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--frames", type=int, default=240)
    parser.add_argument("--quality", default="standard", help="reference frames take long enough to show the speedup")
    parser.add_argument("--only", nargs="*")
    arguments = parser.parse_args()
    bench = Bench(os.path.abspath(arguments.program), arguments.frames, arguments.quality)
    print("| fault | tried | result |\n|---|---|---|", flush=True)
    with Cluster() as cluster:
        for row in (undisturbed, killed_tasks, crashed_node, stopped_farm, held, left_alone, refused):
            if not arguments.only or row.__name__ in arguments.only:
                row(bench, cluster)
    for fault in bench.faults:
        print(fault, file=sys.stderr)
    shutil.rmtree(bench.folder, ignore_errors=True)
    sys.exit(1 if bench.faults else 0)


if __name__ == "__main__":
    main()
