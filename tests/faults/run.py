"""Disturbs renders in every way that `tests/reliability.md` lists, and prints that page's table.

Usage: python3 tests/faults/run.py target/release/cinesplat [--kills 200] [--only ROW ..]
           [--panics PROGRAM]

Every row compares the film of a disturbed run, and of the runs that go on from it, with the film of an undisturbed run,
byte by byte. Needs Linux and, for the rows of failing writes, a C compiler. Exits with 1 if a row finds a fault.
"""

import argparse
import collections
import errno
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time

import commands
import load
import surroundings
from bench import IO_ERROR, SCENE, STOPPED, Bench, Row, faults_library


def after_some_frames(bench, child, rng):
    """Waits for a random number of further frames, or for a random part of a run."""
    if rng.random() < 0.3:
        time.sleep(rng.uniform(0, bench.secs))
        return
    bench.wait_for(child, len(set(bench.frames())) + rng.randint(0, bench.num_frames // 3))
    time.sleep(rng.uniform(0, 0.01))


def kills(program, num):
    """SIGKILL at random times; the next run goes on."""
    bench, rng, row = Bench(program, 60), random.Random(1), Row("SIGKILL at random times, film of 60 frames", "")
    num_films = num_lost = num_twice = num_torn = 0
    num_killed = 0
    while num_killed < num:
        before = set(bench.frames())
        child = bench.start("--keep-frames")
        after_some_frames(bench, child, rng)
        child.kill()
        child.communicate()
        if child.returncode == -signal.SIGKILL:
            num_killed += 1
        else:
            row.check(child.returncode == 0, f"exit {child.returncode}")
        listed = collections.Counter(bench.frames())
        num_lost += len(before - set(listed))
        # A frame whose line was written and that was killed before it had its name is rendered again: one per kill at most.
        num_twice = max(num_twice, sum(count - 1 for count in listed.values()))
        row.check(not bench.film.exists() or bench.is_whole(), "a film that is not whole")
        if bench.film.exists():
            row.check(len(listed) == 60, f"{len(listed)} frames listed")
            num_films += 1
            num_torn += sum(count - 1 for count in listed.values())
            bench.clear()
    last = bench.run()
    row.check(last.returncode == 0 and bench.is_whole(), "the last film is not whole")
    row.check(bench.leftovers() == [], f"left: {bench.leftovers()}")
    row.check(num_lost == 0, f"{num_lost} frames lost")
    row.check(num_torn <= num_killed, f"{num_torn} frames twice")
    row.tried = f"{num_killed} kills, {num_films + 1} films"
    row.result = f"0 frames lost, {num_torn} kept twice, all films byte-identical"
    bench.close()
    return row


def stops(program, num):
    """SIGINT and SIGTERM once; then the line that the program says is typed."""
    bench, rng, row = Bench(program, 60), random.Random(2), Row("SIGINT, SIGTERM at random times, then the line that it says", "")
    codes = collections.Counter()
    for idx in range(num):
        child = bench.start()
        bench.wait_for(child, rng.randint(1, 59))
        child.send_signal(rng.choice([signal.SIGINT, signal.SIGTERM]))
        said = child.communicate()[1]
        codes[child.returncode] += 1
        if child.returncode == STOPPED:
            line = next((line.split("type: ", 1)[1] for line in said.splitlines() if line.startswith("help: to go on")), "false")
            typed = subprocess.run(["sh", "-c", line], cwd=bench.folder, capture_output=True)
            row.check(typed.returncode == 0, f"the line {line} ends with {typed.returncode}")
        else:
            row.check(child.returncode == 0, f"exit {child.returncode}: {said}")
        row.check(bench.is_whole() and bench.leftovers() == [], f"not whole, or left: {bench.leftovers()}")
        bench.clear()
    row.tried = f"{num} signals"
    row.result = f"{codes[STOPPED]} times exit 75, {codes[0]} times done before; all films byte-identical"
    bench.close()
    return row


def farm(program, num):
    """Two of the programs of a farm are killed per film."""
    bench, rng, row = Bench(program, 60), random.Random(3), Row("SIGKILL of programs of `farm --local 3`", "")
    num_killed, num_twice = 0, 0
    for idx in range(num):
        child = bench.start("--keep-frames", command=("farm", "--local", "3"))
        for _ in range(2):
            bench.wait_for(child, rng.randint(1, 50))
            parts = subprocess.run(["pgrep", "-P", str(child.pid)], capture_output=True, text=True).stdout.split()
            if parts:
                try:
                    os.kill(int(rng.choice(parts)), signal.SIGKILL)
                    num_killed += 1
                except ProcessLookupError:
                    # It ended by itself since it was listed.
                    pass
        said = child.communicate()[1]
        listed = collections.Counter(bench.frames())
        num_twice += sum(count - 1 for count in listed.values())
        row.check(child.returncode == 0 and bench.is_whole(), f"exit {child.returncode}: {said[-300:]}")
        row.check(len(listed) == 60, f"{len(listed)} frames")
        bench.clear()
    row.check(num_twice <= num_killed, f"{num_twice} frames twice")
    row.tried = f"{num_killed} kills, {num} films"
    row.result = f"0 frames lost, {num_twice} kept twice, all films byte-identical"
    bench.close()
    return row


def losses(program, num):
    """A loss of power: the end of the log and of the last frames is cut or filled with zeros."""
    bench, rng, row = Bench(program, 60), random.Random(4), Row("Loss of power: log and last frames cut or zeroed", "")
    num_redone = 0
    for idx in range(num):
        child = bench.start()
        bench.wait_for(child, rng.randint(3, 50))
        child.kill()
        child.communicate()
        if not bench.job.exists():
            bench.clear()
            continue
        log = bench.job / "done.log"
        text = log.read_bytes()
        cut = rng.randint(max(0, len(text) - 120), len(text))
        log.write_bytes(text[:cut] + b"\0" * rng.choice([0, 0, 17]))
        for path in sorted((bench.job / "frames").glob("*.yuv"))[-3:]:
            bytes_, at = path.read_bytes(), rng.randint(0, 86400)
            path.write_bytes(rng.choice([bytes_[:at], bytes_[:at] + b"\0" * (len(bytes_) - at), bytes_]))
        again = bench.run()
        num_redone += "damaged" in again.stderr
        row.check(again.returncode == 0 and bench.is_whole(), f"exit {again.returncode}: {again.stderr[-300:]}")
        bench.clear()
    row.tried = f"{num} losses"
    row.result = f"all films byte-identical; {num_redone} times damaged frames were found and rendered again"
    bench.close()
    return row


def without_locks(program, num):
    """A disk whose locks fail: films that are killed and go on, a second program, a farm."""
    bench, rng, row = Bench(program, 60), random.Random(6), Row("Disk without locks (ENOLCK, ENOSYS, EOPNOTSUPP): kills, a second program, a farm", "")
    numbers, num_killed, num_refused = [errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP], 0, 0
    library = faults_library(bench.folder)
    for idx in range(num):
        faulty = {**os.environ, "LD_PRELOAD": str(library), "FAULT_LOCKS": str(numbers[idx % 3])}
        child = bench.start(env=faulty)
        bench.wait_for(child, rng.randint(1, 30))
        # It stands still while the second one tries.
        child.send_signal(signal.SIGSTOP)
        if child.poll() is None and not bench.film.exists():
            second = bench.run(env=faulty)
            row.check(second.returncode == 75 and "JOB-LOCKED" in second.stderr, f"a second program: exit {second.returncode}: {second.stderr[-300:]}")
            num_refused += second.returncode == 75
        child.kill()
        child.communicate()
        num_killed += child.returncode == -signal.SIGKILL
        # The killed program was on this machine: it is known to be gone at once.
        again = bench.run("--overwrite", env=faulty)
        row.check(again.returncode == 0 and bench.is_whole(), f"exit {again.returncode}: {again.stderr[-300:]}")
        row.check(bench.leftovers() == [], f"left: {bench.leftovers()}")
        bench.clear()
        farmed = bench.start(command=("farm", "--local", "3"), env=faulty)
        said = farmed.communicate()[1]
        row.check(farmed.returncode == 0 and bench.is_whole() and bench.leftovers() == [], f"farm: exit {farmed.returncode}: {said[-300:]}")
        bench.clear()
    row.tried = f"{num_killed} kills, {num} farms"
    row.result = f"{num_refused} second programs refused; all films byte-identical"
    bench.close()
    return row


def calls(program, kind):
    """The nth call that writes fails, n = 1, 2, .. until a run passes without reaching it."""
    bench, row = Bench(program, 3), Row(f"nth write fails: {kind}, film of 3 frames", "")
    library = faults_library(bench.folder)
    codes, call = collections.Counter(), 0
    reached = pathlib.Path(f"{library}.reached")
    while True:
        call += 1
        reached.unlink(missing_ok=True)
        faulty = {**os.environ, "LD_PRELOAD": str(library), "FAULT_KIND": kind, "FAULT_CALL": str(call), "FAULT_REACHED": str(reached)}
        first = bench.run(env=faulty)
        codes[first.returncode] += 1
        where = f"call {call}: exit {first.returncode}: {first.stderr[-300:]}"
        expected = {0} if kind in ("eintr", "short") else {0, IO_ERROR, 73}
        row.check(first.returncode in expected, where)
        row.check(not bench.film.exists() or bench.is_whole(), f"{where}: a film that is not whole")
        row.check(first.returncode != 0 or bench.is_whole(), f"{where}: no film")
        if first.returncode != 0:
            again = bench.run()
            row.check(again.returncode == 0 and bench.is_whole(), f"{where}, then exit {again.returncode}: {again.stderr[-300:]}")
        row.check(bench.leftovers() == [], f"{where}: left {bench.leftovers()}")
        bench.clear()
        if not reached.exists():
            break
    row.tried = f"{call - 1} calls"
    row.result = ", ".join(f"exit {code}: {count}" for code, count in sorted(codes.items())) + "; the next run makes the film"
    bench.close()
    return row


def file_limits(program):
    """`ulimit -f` from 1 KB to beyond the film's size."""
    bench, row, codes = Bench(program, 60), Row("`ulimit -f` from 1 KB to 2 MB", ""), collections.Counter()
    sizes = [1, 2, 4, 8, 16, 24, 32, 48, 64, 80, 90, 100, 128, 256, 512, 1024, 2048]
    for size in sizes:
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size * 1024, size * 1024))
        first = bench.run(preexec_fn=limit)
        codes[first.returncode] += 1
        row.check(first.returncode in (0, IO_ERROR), f"{size} KB: exit {first.returncode}: {first.stderr[-300:]}")
        if first.returncode != 0:
            again = bench.run()
            row.check(again.returncode == 0, f"{size} KB, then exit {again.returncode}")
        row.check(bench.is_whole() and bench.leftovers() == [], f"{size} KB: left {bench.leftovers()}")
        bench.clear()
    row.tried = f"{len(sizes)} limits"
    row.result = f"exit 74: {codes[IO_ERROR]}, exit 0: {codes[0]}; the next run makes the film"
    bench.close()
    return row


def small_disk(program):
    """A disk of a few hundred kilobytes fills up at every stage."""
    bench, row, codes = Bench(program, 20), Row("Disk of 100 KB to 3 MB fills up", ""), collections.Counter()
    disk = bench.folder / "disk"
    disk.mkdir()
    sizes = [100, 300, 500, 800, 1200, 1600, 1800, 2000, 3000]
    for size in sizes:
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", disk], capture_output=True)
        if mounted.returncode != 0:
            row.tried, row.result = "0", "skipped: only root may mount a disk"
            break
        line = [program, "render", SCENE, "--shot", "../shot.json", "-o", "film.mp4"]
        first = subprocess.run(line, cwd=disk, capture_output=True, text=True)
        codes[first.returncode] += 1
        row.check(first.returncode in (0, IO_ERROR), f"{size} KB: exit {first.returncode}: {first.stderr[-300:]}")
        film = disk / "film.mp4"
        row.check(not film.exists() or film.read_bytes() == bench.whole, f"{size} KB: a film that is not whole")
        subprocess.run(["mount", "-o", "remount,size=20m", disk], check=True)
        if first.returncode != 0:
            again = subprocess.run(line, cwd=disk, capture_output=True, text=True)
            row.check(again.returncode == 0, f"{size} KB, then exit {again.returncode}: {again.stderr[-300:]}")
        row.check(film.read_bytes() == bench.whole and len(list(disk.iterdir())) == 1, f"{size} KB: not whole")
        subprocess.run(["umount", disk], check=True)
    row.tried = row.tried or f"{len(sizes)} sizes"
    row.result = row.result or f"exit 74: {codes[IO_ERROR]}, exit 0: {codes[0]}; with space the next run makes the film"
    bench.close()
    return row


def panics(program):
    """A panic in every thread of a film that has work: `program` is built with the feature `panic-points`."""
    bench, row = Bench(program, 20), Row("Panic in each thread of a film", "")
    places = ["load:0", "render:7", "worker:7", "keep:7", "encode:7", "flush:0"]
    for place in places:
        first = bench.run(env={**os.environ, "CINESPLAT_PANIC_AT": place, "TMPDIR": str(bench.folder)})
        reports = list(bench.folder.glob("cinesplat-fault-*.txt"))
        lines = [line for line in first.stderr.splitlines() if line.startswith(("error", "help"))]
        row.check(first.returncode == 70 and len(lines) == 2, f"{place}: exit {first.returncode}: {first.stderr[-300:]}")
        row.check(len(reports) == 1 and "asked for" in reports[0].read_text(), f"{place}: reports {reports}")
        row.check(not bench.film.exists() or bench.is_whole(), f"{place}: a film that is not whole")
        [report.unlink() for report in reports]
        num_kept = len(set(bench.frames()))
        if not bench.film.exists():
            again = bench.run()
            row.check(again.returncode == 0 and (num_kept == 0 or f"{num_kept} of 20 frames were kept" in again.stderr), f"{place}: {again.stderr[-300:]}")
        row.check(bench.is_whole() and bench.leftovers() == [], f"{place}: left {bench.leftovers()}")
        bench.clear()
    row.tried = f"{len(places)} places"
    row.result = "exit 70 with two lines and a report file; the next run goes on and makes the film"
    bench.close()
    return row


def rows(program, num, panics_program=None):
    """The rows by name. `num`: kills of films; `panics_program`: the program built with the feature panic-points."""
    return {
        "kills": lambda: kills(program, num),
        "stops": lambda: stops(program, max(1, num // 4)),
        "farm": lambda: farm(program, max(1, num // 20)),
        "losses": lambda: losses(program, max(1, num // 4)),
        **{kind: lambda kind=kind: calls(program, kind) for kind in ("enospc", "eio", "eintr", "short")},
        "locks": lambda: without_locks(program, max(3, num // 20)),
        "disk": lambda: small_disk(program),
        "file-limits": lambda: file_limits(program),
        **surroundings.rows(program, num),
        **({"panics": lambda: panics(os.path.abspath(panics_program))} if panics_program else {}),
        **commands.rows(program),
        **load.rows(program),
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--panics", help="the program built with the feature panic-points")
    arguments = parser.parse_args()
    program, num = os.path.abspath(arguments.program), arguments.kills
    print("| fault | tried | result |\n|---|---|---|", flush=True)
    num_faults = 0
    for name, make in rows(program, num, arguments.panics).items():
        if arguments.only and name not in arguments.only:
            continue
        row = make()
        num_faults += len(row.faults)
        result = row.result if not row.faults else f"**{len(row.faults)} faults** ({row.result})"
        print(f"| {row.fault} | {row.tried} | {result} |", flush=True)
        for fault in row.faults[:5]:
            print(f"{name}: {fault}", file=sys.stderr, flush=True)
    sys.exit(1 if num_faults else 0)


if __name__ == "__main__":
    main()
