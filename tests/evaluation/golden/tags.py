#!/usr/bin/env python3
"""Writes `tags.txt`: the motion tags of 200 random paths by the two published systems.

    python3 -m venv target/tags && target/tags/bin/pip install evo scipy torch torchtyping torchmetrics
    target/tags/bin/python tests/evaluation/golden/tags.py ET.py GENDOP.py > tests/evaluation/golden/tags.txt

ET.py is `src/metrics/modules/caption.py` of robincourant/DIRECTOR (MIT), GENDOP.py is
`dataset/scripts/processing/segmentation.py` of 3DTopia/GenDoP (Apache-2.0). No part of either is in this repository.
`tests/evaluation/taggers.rs` makes the same paths.
"""

import importlib.util
import sys

import numpy as np
import torch


def module(name, path):
    spec = importlib.util.spec_from_file_location(name, path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


class Lcg:
    """The upper 53 bits of a linear congruential generator."""

    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) & ((1 << 64) - 1)
        return (self.state >> 11) / float(1 << 53)


def turn(vector):
    angle = np.linalg.norm(vector)
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = vector / angle
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def path(seed):
    """Poses world_from_camera with OpenCV axes: pieces of constant motion with a little noise."""
    random = Lcg(seed)
    for _ in range(8):
        random.next()
    count = 30 + int(random.next() * 270)
    rotation, position, left, poses = np.eye(3), np.zeros(3), 0, []
    moved, turned = [0.0] * 3, [0.0] * 3
    for _ in range(count):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation, position
        poses.append(pose)
        if left == 0:
            left = 3 + int(random.next() * 57)
            for motion, share, scale in ((moved, 0.5, 0.4), (turned, 0.4, 0.06)):
                for axis in range(3):
                    is_on = random.next() < share
                    value = random.next()
                    motion[axis] = (value - 0.5) * scale if is_on else 0.0
        left -= 1
        step = np.array([axis + (random.next() - 0.5) * 0.03 for axis in moved]) / 25.0
        twist = np.array([axis + (random.next() - 0.5) * 0.004 for axis in turned])
        position = position + rotation @ step
        rotation = rotation @ turn(twist)
    return np.array(poses)


def runs(classes):
    out, start = [], 0
    for idx in range(1, len(classes) + 1):
        if idx == len(classes) or classes[idx] != classes[start]:
            out.append(f"{start}-{idx}:{classes[start]}")
            start = idx
    return " ".join(out)


def main():
    et_file, gendop = module("et", sys.argv[1]), module("gendop", sys.argv[2])
    et = et_file.CaptionMetrics.__new__(et_file.CaptionMetrics)
    for name, value in {
        "fps": 25.0,
        "cam_static_threshold": 0.02,
        "cam_diff_threshold": 0.4,
        "smoothing_window_size": 56,
        "min_chunk_size": 25,
    }.items():
        object.__setattr__(et, name, value)
    opengl = np.diag([1.0, -1.0, -1.0, 1.0])
    for seed in range(1, 201):
        poses = path(seed)
        tags = et.segment_camera_trajectories(torch.from_numpy(poses))
        print(f"{seed} et {runs([int(tag) for tag in tags])}")
        tags = gendop.segment_rigidbody_trajectories(torch.from_numpy(poses @ opengl), 30.0, 0.02, 0.4, 0.005, 15, 10)
        print(f"{seed} gendop {runs([int(tag) for tag in tags])}")


if __name__ == "__main__":
    main()
