#!/usr/bin/env python3
"""Compares `cinesplat eval --like-evo` with evo on evo's own test data.

    python3 tests/exchange/evo_figures.py target/release/cinesplat FOLDER [ESTIMATE ..]

With names of estimates only their pairs are compared. FOLDER holds the files of `test/data` of evo's repository (https://github.com/MichaelGrupp/evo, GPL-3). evo is called as an
installed package; no part of it is in this repository. Prints one line per comparison that differs by more than 1e-9 and a
summary; exits with 1 if there is one.
"""

import copy
import itertools
import json
import subprocess
import sys
from pathlib import Path

from evo.core import metrics, sync
from evo.core.metrics import PoseRelation, Unit
from evo.core.sync_method import SyncMethod
from evo.tools import file_interface as files

TOLERANCE = 1e-9
RELATIONS = {
    "full": PoseRelation.full_transformation,
    "trans": PoseRelation.translation_part,
    "rot": PoseRelation.rotation_part,
    "angle_deg": PoseRelation.rotation_angle_deg,
    "angle_rad": PoseRelation.rotation_angle_rad,
    "point_distance": PoseRelation.point_distance,
    "point_distance_ratio": PoseRelation.point_distance_error_ratio,
}
UNITS = {"f": Unit.frames, "m": Unit.meters, "d": Unit.degrees, "r": Unit.radians}
# Format, reference, estimate.
PAIRS = [
    ("tum", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam.txt"),
    ("tum", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam_drift.txt"),
    ("tum", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam_drift_short.txt"),
    ("tum", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-ORB_kf_mono.txt"),
    ("tum", "fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt"),
    ("tum", "fr2_desk_groundtruth.txt", "fr2_desk_ORB_kf_mono.txt"),
    ("euroc", "V102_groundtruth.csv", "V102.txt"),
    ("kitti", "KITTI_00_gt.txt", "KITTI_00_ORB.txt"),
    ("kitti", "KITTI_00_gt.txt", "KITTI_00_SPTAM.txt"),
]
ALIGNMENTS = ["none", "origin", "scale", "se3", "sim3"]


def cases(kind):
    """Flags of cinesplat for one pair of files, with what they mean."""
    timed = kind != "kitti"
    for align, relation in itertools.product(ALIGNMENTS, list(RELATIONS)[:6]):
        yield {"align": align, "relation": relation}
    for align, relation, (unit, delta) in itertools.product(
        ["none", "sim3"], RELATIONS, [("f", 1), ("f", 10), ("m", 0.5 if timed else 50), ("d", 5), ("r", 0.1)]
    ):
        yield {"align": align, "relation": relation, "rpe": (unit, delta)}
    for align in ["se3", "sim3"]:
        yield {"align": align, "relation": "trans", "align_poses": 20}
        yield {"align": align, "relation": "angle_deg", "rpe": ("f", 5), "all_pairs": True}
        yield {"align": align, "relation": "trans", "downsample": 100, "max_diff": 0.2}
        yield {"align": align, "relation": "trans", "motion_filter": (0.05 if timed else 5, 5), "max_diff": 0.1}
    if timed:
        for align, max_diff in itertools.product(["none", "sim3"], [0.01, 0.02, 0.1, 0.5]):
            yield {"align": align, "relation": "trans", "max_diff": max_diff}
            yield {"align": align, "relation": "full", "max_diff": max_diff, "interpolate": True}
        yield {"align": "sim3", "relation": "trans", "time_offset": 0.02}
        for start, end in [(0.2, 0.4), (0.5, None), (None, 0.3)]:
            trim = {"start": start, "end": end}
            for max_diff in [0.01, 0.1]:
                yield {"align": "se3", "relation": "trans", "trim": trim, "max_diff": max_diff}
                yield {"align": "sim3", "relation": "angle_deg", "trim": trim, "max_diff": max_diff, "rpe": ("f", 5)}
            yield {"align": "se3", "relation": "full", "trim": trim, "interpolate": True}
            yield {"align": "se3", "relation": "trans", "trim": trim, "downsample": 200, "max_diff": 0.2}
            yield {"align": "se3", "relation": "trans", "trim": trim, "motion_filter": (0.05, 5), "max_diff": 0.1}
            yield {"align": "none", "relation": "trans", "trim": trim, "time_offset": 0.02}


def span(reference, trim):
    """First and last time of a part of the reference."""
    first, last = reference.timestamps[0], reference.timestamps[-1]
    return [
        None if part is None else round(float(first + part * (last - first)), 3) for part in (trim["start"], trim["end"])
    ]


def load(kind, path):
    if kind == "kitti":
        return files.read_kitti_poses_file(str(path))
    if path.suffix == ".csv":
        return files.read_euroc_csv_trajectory(str(path))
    return files.read_tum_trajectory_file(str(path))


def by_evo(kind, reference, estimate, case):
    """Statistics by evo, or None where it refuses."""
    reference, estimate = copy.deepcopy(reference), copy.deepcopy(estimate)
    for path in (reference, estimate):
        if "downsample" in case:
            path.downsample(case["downsample"])
        if "motion_filter" in case:
            path.motion_filter(*case["motion_filter"], True)
    try:
        if "trim" in case:
            # As evo_ape and evo_rpe, evo 1.38.1: after the filters, and the reference alone.
            reference.reduce_to_time_range(*case["trim"])
        if kind != "kitti":
            reference, estimate = sync.associate_trajectories(
                reference,
                estimate,
                max_diff=case.get("max_diff", 0.01),
                offset_2=case.get("time_offset", 0.0),
                sync_method=SyncMethod.interpolation if case.get("interpolate") else SyncMethod.nearest_time,
            )
        elif reference.num_poses != estimate.num_poses:
            return None
        align, count = case["align"], case.get("align_poses", -1)
        if align == "origin":
            estimate.align_origin(reference)
        elif align != "none":
            estimate.align(
                reference, correct_scale=align in ("scale", "sim3"), correct_only_scale=align == "scale", n=count
            )
        relation = RELATIONS[case["relation"]]
        if "rpe" in case:
            unit, delta = case["rpe"]
            metric = metrics.RPE(
                relation, delta=delta, delta_unit=UNITS[unit], all_pairs=case.get("all_pairs", False)
            )
        else:
            metric = metrics.APE(relation)
        metric.process_data((reference, estimate))
        return metric.get_all_statistics()
    except Exception as error:  # evo refuses in many ways
        return str(error)


def by_cinesplat(program, reference, estimate, case):
    flags = ["--align", case["align"], "--relation", case["relation"], "--json", "--like-evo", "--quiet"]
    if "rpe" in case:
        unit, delta = case["rpe"]
        flags += ["--rpe", "--delta", str(delta), "--unit", unit]
    for name in ("max_diff", "time_offset", "align_poses", "downsample"):
        if name in case:
            flags += ["--" + name.replace("_", "-"), str(case[name])]
    if "motion_filter" in case:
        flags += ["--motion-filter", ",".join(map(str, case["motion_filter"]))]
    for name, time in zip(("--start", "--end"), case.get("trim", [])):
        flags += [] if time is None else [name, repr(time)]
    flags += ["--" + name.replace("_", "-") for name in ("all_pairs", "interpolate") if case.get(name)]
    done = subprocess.run([program, "eval", reference, estimate, *flags], capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else done.stderr.strip()


def main():
    program, folder, only = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    compared, differing, refused, largest = 0, 0, 0, 0.0
    for kind, reference_name, estimate_name in PAIRS:
        if only and estimate_name not in only:
            continue
        paths = [folder / reference_name, folder / estimate_name]
        if not all(path.exists() for path in paths):
            print(f"missing: {reference_name} or {estimate_name}")
            continue
        loaded = [load(kind, path) for path in paths]
        for case in cases(kind):
            if "trim" in case:
                case["trim"] = span(loaded[0], case["trim"])
            wanted = by_evo(kind, *loaded, case)
            found = by_cinesplat(program, *map(str, paths), case)
            if wanted is None:
                continue
            if isinstance(wanted, str):
                refused += 1
                continue
            if isinstance(found, str):
                differing += 1
                print(f"{estimate_name} {case}: cinesplat refuses: {found}")
                continue
            # The smallest error may be 0 up to rounding.
            scale = {name: abs(wanted[name]) + (wanted["max"] if name == "min" else 0.0) for name in wanted}
            off = max(
                abs(found[name] - wanted[name]) / scale[name] if scale[name] else abs(found[name]) for name in wanted
            )
            compared += len(wanted)
            largest = max(largest, off)
            if not off <= TOLERANCE:
                differing += 1
                print(
                    f"{estimate_name} {case}: evo {wanted['rmse']:.9g}, cinesplat {found['rmse']:.9g}, off {off:.2g}"
                )
    print(
        f"{compared} figures compared, {differing} comparisons differ, largest relative difference {largest:.1e};"
        f" evo refuses {refused} comparisons"
    )
    sys.exit(differing > 0)


if __name__ == "__main__":
    main()
