#!/usr/bin/env python3
"""Writes `reference.tum` and `estimate.tum`: a camera path and a faulty estimate of it, in the TUM format.

The reference is a walk along a bent figure of eight that climbs, stops once and looks about: 200 poses at uneven times.
The estimate has what a monocular tracker does to it: its own world frame, scale 1.1, positions and rotations that drift
and carry noise, times by another clock (2.5 s behind, jittered by up to 3 ms), two gaps and some single poses missing.
One seeded generator draws all random numbers; every run writes the same bytes.
"""
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
NUM_POSES = 200
SCALE = 1.1
CLOCK_OFFSET_SECS = 2.5  # To be added to the estimate's times.


def multiply(a, b):
    """Product of quaternions, xyzw, row by row."""
    a, b = np.broadcast_arrays(a, b)
    xyz = a[:, 3:] * b[:, :3] + b[:, 3:] * a[:, :3] + np.cross(a[:, :3], b[:, :3])
    w = a[:, 3] * b[:, 3] - np.sum(a[:, :3] * b[:, :3], axis=1)
    return np.concatenate([xyz, w[:, None]], axis=1)


def turn(vectors):
    """Quaternions (xyzw) of rotation vectors in rad."""
    vectors = np.atleast_2d(vectors)
    angle = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.concatenate([0.5 * np.sinc(angle / (2 * np.pi)) * vectors, np.cos(angle / 2)], axis=1)


def rotate(q, points):
    """Points rotated by the quaternions."""
    pure = np.concatenate([points, np.zeros((len(points), 1))], axis=1)
    return multiply(multiply(q, pure), q * [-1, -1, -1, 1])[:, :3]


def write_tum(path, times, positions, rotations):
    rows = np.column_stack([positions, rotations / np.linalg.norm(rotations, axis=1, keepdims=True)])
    lines = [f"{time:.4f} " + " ".join(f"{value:.7f}" for value in row) for time, row in zip(times, rows)]
    path.write_text("# time x y z qx qy qz qw\n" + "\n".join(lines) + "\n")


def main():
    rng = np.random.default_rng(11)
    # At least 25 ms apart: with 3 ms of jitter nearest neighbors are one to one.
    times = 1000.0 + np.cumsum(rng.uniform(0.025, 0.09, NUM_POSES))
    phase = np.linspace(0, 2 * np.pi, NUM_POSES)
    phase[120:] -= phase[120] - phase[110]
    phase[110:120] = phase[110]  # It stands still for ten poses.
    bend = np.stack([2.0 * np.sin(phase), 1.2 * np.sin(2 * phase), 0.15 * phase + 0.1 * np.cos(3 * phase)], axis=1)
    positions = bend + rng.normal(0, 0.002, bend.shape)
    pitch = np.stack([0.3 * np.sin(1.5 * phase), np.zeros(NUM_POSES), np.zeros(NUM_POSES)], axis=1)
    yaw = np.stack([np.zeros(NUM_POSES), np.zeros(NUM_POSES), 1.4 * phase + 0.2 * np.sin(5 * phase)], axis=1)
    rotations = multiply(turn(yaw), turn(pitch))
    write_tum(HERE / "reference.tum", times, positions, rotations)

    walk = np.cumsum(rng.normal(0, 0.004, (NUM_POSES, 3)), axis=0) + np.linspace(0, 0.12, NUM_POSES)[:, None]
    world = turn([0.4, -0.7, 1.1])
    moved = SCALE * rotate(world, positions + walk + rng.normal(0, 0.006, (NUM_POSES, 3))) + [3.0, -1.0, 0.5]
    wrong = np.cumsum(rng.normal(0, 0.002, (NUM_POSES, 3)), axis=0) + rng.normal(0, 0.008, (NUM_POSES, 3))
    turned = multiply(multiply(world, rotations), turn(wrong))
    clock = times - CLOCK_OFFSET_SECS + rng.uniform(-0.003, 0.003, NUM_POSES)
    kept = rng.uniform(size=NUM_POSES) > 0.05
    kept[[*range(40, 52), *range(150, 155)]] = False
    write_tum(HERE / "estimate.tum", clock[kept], moved[kept], turned[kept])


if __name__ == "__main__":
    main()
