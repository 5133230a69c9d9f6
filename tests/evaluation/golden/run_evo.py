#!/usr/bin/env python3
"""Writes `expected_evo.json`: what evo says of `estimate.tum` against `reference.tum`.

evo (https://github.com/MichaelGrupp/evo, GPL-3) is called here as an installed package; no part of it is in this
repository.

    python3 -m venv target/evo && target/evo/bin/pip install evo==1.38.1
    target/evo/bin/python tests/evaluation/golden/run_evo.py
"""
import copy
import importlib.metadata
import json
from pathlib import Path

from evo.core import sync
from evo.core.metrics import PoseRelation, Unit
from evo.main_ape import ape
from evo.main_rpe import rpe
from evo.tools import file_interface

from make_trajectories import CLOCK_OFFSET_SECS

HERE = Path(__file__).resolve().parent
MAX_DIFF_SECS = 0.01
ALIGNMENTS = {
    "none": {},
    "origin": dict(align_origin=True),
    "se3": dict(align=True),
    "sim3": dict(align=True, correct_scale=True),
    "scale": dict(correct_scale=True),
}
RELATIONS = {
    "full": PoseRelation.full_transformation,
    "trans": PoseRelation.translation_part,
    "rot": PoseRelation.rotation_part,
    "angle_deg": PoseRelation.rotation_angle_deg,
    "angle_rad": PoseRelation.rotation_angle_rad,
    "point_distance": PoseRelation.point_distance,
}
RATIO = {"point_distance_ratio": PoseRelation.point_distance_error_ratio}
METRICS = {
    "ape": (ape, RELATIONS, {}),
    "rpe_1_frame": (rpe, RELATIONS | RATIO, dict(delta=1.0, delta_unit=Unit.frames)),
    "rpe_quarter_unit": (rpe, RELATIONS | RATIO, dict(delta=0.25, delta_unit=Unit.meters)),
}


def main():
    reference = file_interface.read_tum_trajectory_file(HERE / "reference.tum")
    estimate = file_interface.read_tum_trajectory_file(HERE / "estimate.tum")
    case = dict(
        name="figure of eight", reference="reference.tum", estimate="estimate.tum",
        evo=importlib.metadata.version("evo"), max_diff=MAX_DIFF_SECS, time_offset=CLOCK_OFFSET_SECS,
        ref_poses=reference.num_poses, est_poses=estimate.num_poses,
    )
    pair = sync.associate_trajectories(reference, estimate, max_diff=MAX_DIFF_SECS, offset_2=CLOCK_OFFSET_SECS)
    case["pairs"] = pair[0].num_poses
    for name, (metric, relations, arguments) in METRICS.items():
        case[name] = {}
        for align, flags in ALIGNMENTS.items():
            case[name][align] = {}
            for relation, pose_relation in relations.items():
                # evo aligns in place.
                result = metric(*copy.deepcopy(pair), pose_relation=pose_relation, **arguments, **flags)
                case[name][align][relation] = {key: float(value) for key, value in result.stats.items()}
    case["scale"] = {}
    for align in ("sim3", "scale"):
        ours = copy.deepcopy(pair)
        case["scale"][align] = float(ours[1].align(ours[0], True, align == "scale")[2])
    first = ape(*copy.deepcopy(pair), pose_relation=RELATIONS["trans"], align=True, correct_scale=True, n_to_align=50)
    case["sim3_of_50_poses"] = {key: float(value) for key, value in first.stats.items()}
    (HERE / "expected_evo.json").write_text(json.dumps([case], indent=1) + "\n")


if __name__ == "__main__":
    main()
