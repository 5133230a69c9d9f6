#!/usr/bin/env python3
"""Writes four small paths and prints what evo says of them: the rows of `tests/evaluation/conventions.rs`.

evo (https://github.com/MichaelGrupp/evo, GPL-3) is called as an installed package; no part of it is in this repository.
"""

from pathlib import Path

import numpy as np
from evo.core import sync, trajectory, metrics
from evo.core.sync_method import SyncMethod
from evo.core.metrics import PoseRelation, Unit
from evo.tools import file_interface as fi
from scipy.spatial.transform import Rotation as R

rng = np.random.default_rng(5)
OUT = str(Path(__file__).parent) + "/"


def curve(t):
    p = np.stack([2 * np.sin(0.7 * t), 1.2 * np.cos(0.5 * t) + 0.3 * t, 0.4 * np.sin(1.3 * t)], 1)
    r = R.from_euler("zyx", np.stack([0.6 * t, 0.3 * np.sin(0.8 * t), 0.2 * np.cos(t)], 1))
    return p, r


def write(name, t, p, r):
    with open(OUT + name, "w") as f:
        for a, b, c in zip(t, p, r.as_quat()):
            f.write(" ".join(f"{v:.6f}" for v in [a, *b, *c]) + "\n")


t = np.arange(0, 8, 0.05)
p, r = curve(t)
write("repeated_reference.tum", t, p, r)
te = np.sort(np.concatenate([np.arange(0.013, 8.3, 0.21), [1.273, 1.273, 4.633]]))
p, r = curve(te)
p = 0.8 * R.from_euler("z", [0.4]).apply(p) + [1, 2, 3] + rng.normal(0, 0.02, p.shape)
r = R.from_euler("z", [0.4]) * r * R.from_rotvec(rng.normal(0, 0.01, p.shape))
write("repeated_estimate.tum", te, p, r)
# a straight start
ts = np.arange(0, 6, 0.1)
ps = np.stack(
    [
        np.where(ts < 3, ts, 3 + (ts - 3) * 0.8),
        np.where(ts < 3, 0, (ts - 3) ** 2 * 0.3) + 2e-4 * np.sin(9 * ts),
        1e-4 * np.cos(7 * ts),
    ],
    1,
)
rs = R.from_euler("z", np.where(ts < 3, 0, 0.3 * (ts - 3))[:, None])
write("straight_reference.tum", ts, ps, rs)
pe = R.from_euler("xyz", [0.3, 0.2, 0.5]).apply(ps + rng.normal(0, 1e-4, ps.shape))
re_ = R.from_euler("xyz", [0.3, 0.2, 0.5]) * rs
write("straight_estimate.tum", ts, pe, re_)


def load(n):
    return fi.read_tum_trajectory_file(OUT + n)


REL = {
    "trans": PoseRelation.translation_part,
    "angle_deg": PoseRelation.rotation_angle_deg,
    "full": PoseRelation.full_transformation,
}
rows = []


def row(ref, est, md, method, align, n, relation, down=None, motion=None, rpe=None, trim=None):
    a, b = load(ref + ".tum"), load(est + ".tum")
    for x in (a, b):
        if down:
            x.downsample(down)
        if motion:
            x.motion_filter(motion[0], motion[1], True)
    if trim:
        a.reduce_to_time_range(*trim)  # as evo_ape does: the reference alone
    a, b = sync.associate_trajectories(
        a, b, max_diff=md, sync_method=SyncMethod.interpolation if method else SyncMethod.nearest_time
    )
    if align != "none":
        b.align(a, correct_scale=align == "sim3", n=n if n else -1)
    m = (
        metrics.APE(REL[relation])
        if not rpe
        else metrics.RPE(REL[relation], delta=rpe, delta_unit=Unit.frames, all_pairs=False)
    )
    m.process_data((a, b))
    s = m.get_all_statistics()
    o = lambda v: "None" if v is None else f"Some({v})"
    f = lambda v: f"{v!r}"
    print(
        f'    ("{ref}", "{est}", {md!r}, {str(bool(method)).lower()}, "{align}", {o(n)}, "{relation}", {o(down)}, {o(motion if motion is None else str(tuple(map(float,motion))))}, {o(trim)}, {o(rpe)}, {len(m.error)}, [{float(s["rmse"])!r}, {float(s["median"])!r}, {float(s["max"])!r}]),'
    )


A, B = "repeated_reference", "repeated_estimate"
for md in (0.01, 0.03, 0.5):
    for rel in ("trans", "angle_deg"):
        row(A, B, md, 0, "sim3", None, rel)
row(A, B, 0.03, 1, "none", None, "full")
row(A, B, 0.01, 1, "se3", None, "trans")
row(A, B, 0.03, 1, "sim3", None, "angle_deg")
row(B, A, 0.03, 1, "sim3", None, "trans")
row(A, B, 0.5, 0, "se3", None, "trans", down=20)
row(A, B, 0.1, 0, "se3", None, "trans", motion=(0.3, 15.0))
row(A, B, 0.1, 0, "se3", None, "trans", down=37, motion=(0.2, 40.0))
row(A, B, 0.03, 0, "none", None, "trans", rpe=3)
row(A, B, 0.03, 0, "sim3", None, "full", trim=(1.0, 5.5))
row(A, B, 0.1, 0, "se3", None, "trans", trim=(1.0, 2.5))
row(A, B, 0.1, 0, "se3", None, "trans", down=37, trim=(1.0, 5.5))
C, D = "straight_reference", "straight_estimate"
row(C, D, 0.01, 0, "se3", 20, "trans")
row(C, D, 0.01, 0, "se3", 20, "angle_deg")
row(C, D, 0.01, 0, "se3", None, "trans")
