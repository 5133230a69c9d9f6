#!/usr/bin/env python3
"""Writes the golden scene `fruit.ply` and its two cameras files; with --rasterizer also the golden pictures.

The scene is a glass bowl of fruit on a wooden table before a tiled wall, in a world whose up is +y and whose unit is
one meter: 1,231 Gaussians with SH degree 2. One seeded generator draws all random numbers; every run writes the same
bytes. The scene contains the cases that are hard for a rasterizer:

- standard deviations from 0.4 mm to 1.3 m: needles (wood grain, stems, straws), disks (glass, tiles), sub-pixel dust,
  and one Gaussian larger than the frame;
- opacities from 0.004 (just above the threshold of 1/255) to above 0.998 (alpha is limited to 0.99);
- translucent layers: glass before fruit before glass, grapes, haze, and a stack of fifty faint sheets;
- equal depths: the wall's tiles in the level camera, and pairs of Gaussians at one point in every camera;
- Gaussians behind the cameras, in front of and behind the near plane, and on it within a rounding error;
- quaternions that are not normalized, and SH colors below 0 and above 1.

    python3 make_scene.py [--rasterizer FILE.py]

FILE.py is a module with a function `render(scene, camera, mode, near, compensate) -> (rgb, transmittance, _)`; see
README.md.
"""
import argparse
import importlib.util
import json
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
SH_C0 = 0.28209479177387814
SH_C1 = 0.4886025119029199
NUM_REST = 8  # Coefficients per channel above band 0, SH degree 2.
COLORS = dict(
    apple=(0.78, 0.08, 0.10), green_apple=(0.48, 0.70, 0.14), orange=(0.98, 0.50, 0.06), lemon=(0.98, 0.88, 0.15),
    banana=(0.96, 0.80, 0.20), grape=(0.36, 0.12, 0.48), stem=(0.26, 0.17, 0.08), leaf=(0.15, 0.45, 0.12),
    wood=(0.52, 0.31, 0.15), grain=(0.30, 0.16, 0.07), wall=(0.62, 0.72, 0.74), grout=(0.44, 0.55, 0.60),
    glass=(0.62, 0.85, 0.95), haze=(0.95, 0.88, 0.70), straw=(0.95, 0.25, 0.45),
)


def quaternion_to(normals):
    """Unit quaternions (wxyz) that turn +z to each of `normals`."""
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    w = 1 + normals[:, 2]
    xyz = np.cross([0.0, 0.0, 1.0], normals)
    xyz[w < 1e-9] = [1.0, 0.0, 0.0]
    q = np.concatenate([np.maximum(w, 0)[:, None], xyz], axis=1)
    return q / np.linalg.norm(q, axis=1, keepdims=True)


class Scene:
    """A list of Gaussians in the encoding of an INRIA file; `add` appends to it."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.parts = []

    def add(self, means, scales, rotations, opacity, color, sheen=0.12, normals=None):
        """Appends Gaussians. `scales` are standard deviations, `rotations` are wxyz; arguments broadcast over Gaussians.

        `sheen` brightens a Gaussian for a camera that looks against its normal (band 1) and tints band 2 at random.
        """
        means = np.asarray(means, float)
        n = len(means)
        color = np.broadcast_to(color, (n, 3)) * self.rng.uniform(0.88, 1.12, (n, 1))
        rest = np.zeros((n, 3, NUM_REST))
        toward = -(normals if normals is not None else np.tile([0.0, 0.6, 0.8], (n, 1)))
        # Band 1 is (-C1 y, C1 z, -C1 x) of the direction from the camera to the Gaussian.
        band = np.stack([-toward[:, 1], toward[:, 2], -toward[:, 0]], axis=1) / (3 * SH_C1)
        rest[:, :, :3] = sheen * 3 * band[:, None, :] * (0.5 + 0.5 * color[:, :, None])
        rest[:, :, 3:] = self.rng.normal(0, 0.25 * sheen, (n, 3, NUM_REST - 3))
        # The length of a quaternion does not change its rotation.
        rotations = np.broadcast_to(rotations, (n, 4)) * self.rng.uniform(0.5, 2.0, (n, 1))
        opacity = np.broadcast_to(opacity, (n,)).astype(float)
        self.parts.append(dict(
            xyz=means,
            dc=(color - 0.5) / SH_C0,
            rest=rest,
            opacity=np.log(opacity / (1 - opacity)),
            scale=np.log(np.broadcast_to(scales, (n, 3))),
            rot=rotations,
        ))

    def columns(self):
        """Returns the columns as the file stores them, float32."""
        return {key: np.concatenate([p[key] for p in self.parts]).astype(np.float32) for key in self.parts[0]}

    def ball(self, center, radii, count, size, color, opacity=(0.6, 0.99), sheen=0.25):
        """Appends `count` flat Gaussians on an ellipsoid, spaced by the golden angle."""
        i = np.arange(count) + 0.5
        up = 1 - 2 * i / count
        turn = np.pi * (1 + 5**0.5) * i
        ring = np.sqrt(1 - up * up)
        normals = np.stack([ring * np.cos(turn), up, ring * np.sin(turn)], axis=1)
        means = np.asarray(center) + normals * radii
        scales = np.array([size, size, 0.25 * size]) * self.rng.uniform(0.7, 1.3, (count, 1))
        self.add(means, scales, quaternion_to(normals), self.rng.uniform(*opacity, count), color, sheen, normals)


def table_and_wall(scene):
    rng = scene.rng
    x, z = np.meshgrid(np.linspace(-1.5, 1.5, 15), np.linspace(-0.9, 0.9, 9))
    means = np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)
    means[:, [0, 2]] += rng.normal(0, 0.02, (x.size, 2))
    flat = quaternion_to(np.array([[0.0, 1.0, 0.0]]))
    scene.add(means, [0.13, 0.13, 0.004], flat, rng.uniform(0.9, 0.999, x.size), COLORS["wood"], 0.2)
    grain = np.stack([rng.uniform(-1.4, 1.4, 70), np.full(70, 0.006), rng.uniform(-0.9, 0.9, 70)], axis=1)
    lengths = np.stack([rng.uniform(0.1, 0.4, 70), np.full(70, 0.0015), np.full(70, 0.003)], axis=1)
    scene.add(grain, lengths, [1.0, 0.0, 0.0, 0.0], rng.uniform(0.3, 0.9, 70), COLORS["grain"])
    # The tiles of the wall share one depth in a level camera: the order of the file decides.
    x, y = np.meshgrid(np.linspace(-1.8, 1.8, 13), np.linspace(-0.05, 1.55, 7))
    means = np.stack([x.ravel(), y.ravel(), np.full(x.size, -1.25)], axis=1)
    checks = (np.add.outer(np.arange(7), np.arange(13)) % 2).ravel()[:, None]
    color = np.where(checks == 1, COLORS["wall"], COLORS["grout"])
    scene.add(means, [0.15, 0.13, 0.01], [1.0, 0.0, 0.0, 0.0], rng.uniform(0.7, 0.97, x.size), color)


def bowl(scene, radius=0.42, height=0.45):
    rng = scene.rng
    count = 190
    i = np.arange(count) + 0.5
    down = -i / count
    turn = np.pi * (1 + 5**0.5) * i
    ring = np.sqrt(1 - down * down)
    normals = np.stack([ring * np.cos(turn), down, ring * np.sin(turn)], axis=1)
    means = [0, height, 0] + normals * radius
    scene.add(means, [0.05, 0.05, 0.004], quaternion_to(normals), rng.uniform(0.05, 0.22, count), COLORS["glass"], 0.3,
              normals)
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    means = np.stack([radius * np.cos(turn), np.full(48, height), radius * np.sin(turn)], axis=1)
    tangent = np.stack([-np.sin(turn), np.zeros(48), np.cos(turn)], axis=1)
    scene.add(means, [0.006, 0.006, 0.032], quaternion_to(tangent), 0.75, (0.85, 0.97, 1.0))
    scene.ball([0, 0.02, 0], [0.16, 0.02, 0.16], 30, 0.03, COLORS["glass"], (0.3, 0.6))


def fruit(scene):
    rng = scene.rng
    scene.ball([-0.16, 0.42, 0.12], [0.13, 0.12, 0.13], 85, 0.026, COLORS["apple"])
    scene.ball([0.17, 0.40, 0.14], [0.13, 0.13, 0.13], 85, 0.026, COLORS["orange"])
    scene.ball([0.02, 0.43, -0.16], [0.13, 0.13, 0.13], 70, 0.027, COLORS["green_apple"])
    scene.ball([0.0, 0.25, 0.02], [0.15, 0.10, 0.15], 50, 0.035, COLORS["lemon"])
    scene.ball([0.72, 0.09, 0.35], [0.13, 0.085, 0.085], 60, 0.022, COLORS["lemon"])
    # Two Gaussians of different color share each end of the banana: equal depth in every camera.
    t = np.linspace(-1.0, 1.0, 36)
    arc = np.stack([0.36 * np.sin(t) - 0.01, 0.74 - 0.22 * np.cos(t) ** 2, 0.04 - 0.14 * t * t], axis=1)
    along = np.gradient(arc, axis=0)
    thick = 0.008 + 0.026 * np.sqrt(1 - 0.95 * t * t)
    scales = np.stack([thick, thick, np.full(36, 0.022)], axis=1)
    scene.add(arc, scales, quaternion_to(along), 0.95, COLORS["banana"], 0.3)
    scene.add(arc[[0, 0, -1, -1]], 0.016, [1.0, 0.0, 0.0, 0.0], 0.7, [COLORS["stem"], COLORS["leaf"]] * 2)
    # One round Gaussian per grape and a bright fleck in front of it.
    grapes = np.array([-0.78, 0.06, 0.30]) + rng.normal(0, 1, (46, 3)) * [0.11, 0.035, 0.07]
    scene.add(grapes, 0.024, [1.0, 0.0, 0.0, 0.0], rng.uniform(0.5, 0.85, 46), COLORS["grape"], 0.4)
    scene.add(grapes + [-0.008, 0.018, 0.018], 0.004, [1.0, 0.0, 0.0, 0.0], 0.8, (1.5, 1.4, 1.6))
    stems = np.array([[-0.16, 0.55, 0.12], [0.02, 0.57, -0.16], [-0.78, 0.13, 0.30]])
    leaning = np.array([[0.2, 1.0, 0.1], [-0.3, 1.0, 0.0], [0.6, 0.8, 0.2]])
    scene.add(stems, [0.005, 0.005, 0.035], quaternion_to(leaning), 0.99, COLORS["stem"])
    scene.add(stems + [0.03, 0.02, 0.01], [0.045, 0.018, 0.002], quaternion_to(leaning), 0.9, COLORS["leaf"])
    # Two straws: needles 300 times as long as they are thick.
    straws = np.array([[0.45, 0.35, -0.2], [0.55, 0.30, -0.25]])
    scene.add(straws, [0.001, 0.001, 0.30], quaternion_to(np.array([[0.5, 1.0, 0.2], [-0.7, 1.0, 0.3]])), 0.97,
              COLORS["straw"])


def air(scene):
    """Appends a shadow, haze, dust, faint sheets, and Gaussians around the near planes and behind the cameras."""
    rng = scene.rng
    scene.add([[0.05, 0.012, 0.05]], [0.40, 0.28, 0.003], quaternion_to(np.array([[0.0, 1.0, 0.0]])), 0.45, 0.02)
    haze = np.array([[-0.9, 1.2, -0.4], [-0.5, 0.9, 0.0], [0.0, 0.6, 0.4], [0.4, 1.5, -0.8], [0.2, 0.3, 1.2]])
    beam = quaternion_to(np.array([[0.7, -0.6, 0.4]]))
    scene.add(haze, [0.25, 0.25, 0.9], beam, [0.05, 0.04, 0.03, 0.02, 0.012], COLORS["haze"])
    scene.add([[0.0, 0.5, 0.0]], [1.3, 1.3, 1.3], beam, 0.02, COLORS["haze"])
    dust = rng.uniform([-1.3, 0.1, -1.0], [1.3, 1.4, 1.2], (70, 3))
    sizes = np.exp(rng.uniform(np.log(0.0004), np.log(0.005), (70, 1)))
    scene.add(dust, sizes * [1.0, 1.0, 1.0], [1.0, 0.0, 0.0, 0.0], rng.uniform(0.2, 0.999, 70), (1.2, 1.15, 1.0))
    sheets = np.stack([np.full(50, 0.95), np.full(50, 0.55), np.linspace(-0.9, -0.5, 50)], axis=1)
    opacity = np.geomspace(0.004, 0.08, 50)
    scene.add(sheets, [0.14, 0.20, 0.002], [1.0, 0.0, 0.0, 0.0], opacity, (0.10, 0.55, 0.65), 0.4)
    for camera in (LEVEL, INSIDE):
        pose = np.array(camera["world_from_camera"])
        depths = np.concatenate([np.linspace(-1.2, -0.1, 8), np.linspace(0.02, 0.19, 6), [0.2], np.linspace(0.201, 0.6, 10)])
        side = rng.uniform(-0.2, 0.2, (25, 2)) * np.maximum(np.abs(depths), 0.1)[:, None]
        points = np.concatenate([side, depths[:, None]], axis=1) @ pose[:3, :3].T + pose[:3, 3]
        rotations = rng.normal(0, 1, (25, 4))
        scales = np.exp(rng.uniform(np.log(0.002), np.log(0.03), (25, 3)))
        scene.add(points, scales, rotations, rng.uniform(0.05, 0.5, 25), rng.uniform(0.2, 1.0, (25, 3)))


def camera(name, size, focal, principal, position, target=None, roll_deg=0.0):
    """Returns a camera of the cameras file. Without a target it is level and looks along -z."""
    position = np.array(position, float)
    forward = np.array([0.0, 0.0, -1.0]) if target is None else np.array(target) - position
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    c, s = np.cos(np.radians(roll_deg)), np.sin(np.radians(roll_deg))
    pose = np.eye(4)
    pose[:3, :3] = np.stack([c * right + s * down, c * down - s * right, forward], axis=1)
    pose[:3, 3] = position
    return dict(name=name, width=size[0], height=size[1], fx=focal[0], fy=focal[1], cx=principal[0], cy=principal[1],
                world_from_camera=pose.tolist())


# Level, so that the wall's tiles have equal depths; a principal point above the center replaces a downward tilt. The
# whole scene is inside the frame: rasterizers differ in where they clamp x/z and y/z beside an off-center picture.
LEVEL = camera("fruit_c0", (125, 70), (130.0, 130.0), (54.5, 20.25), [0.0, 1.0, 4.0])
# Close to the rim of the bowl, rolled, with a wide field of view and pixels that are not square.
INSIDE = camera("fruit_c1", (124, 69), (64.0, 58.0), (62.0, 34.5), [-0.52, 0.86, 0.62], [0.05, 0.35, -0.05], 11.0)
# Far away: most Gaussians are smaller than a pixel, which is where the filter `mip` matters.
FAR = camera("fruit_mip_c0", (96, 54), (150.0, 150.0), (48.0, 27.0), [2.3, 2.1, 3.4], [0.0, 0.35, -0.1])

SETS = {
    "fruit": dict(scene="fruit.ply", filter="classic", near=0.2, cameras=[LEVEL, INSIDE]),
    "fruit_mip": dict(scene="fruit.ply", filter="mip", near=0.1, cameras=[FAR]),
}


def write_ply(path, columns):
    """Writes the columns in the layout of the INRIA trainer: binary little-endian float32, normals zero."""
    n = len(columns["xyz"])
    table = {
        "xyz": ["x", "y", "z"], "normals": ["nx", "ny", "nz"], "dc": [f"f_dc_{i}" for i in range(3)],
        "rest": [f"f_rest_{i}" for i in range(3 * NUM_REST)], "opacity": ["opacity"],
        "scale": [f"scale_{i}" for i in range(3)], "rot": [f"rot_{i}" for i in range(4)],
    }
    columns = dict(columns, normals=np.zeros((n, 3)))
    rows = np.concatenate([columns[key].reshape(n, -1) for key in table], axis=1).astype("<f4")
    names = [name for group in table.values() for name in group]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {n}"]
    header += [f"property float {name}" for name in names] + ["end_header", ""]
    path.write_bytes("\n".join(header).encode() + rows.tobytes())


def render(rasterizer, columns):
    """Renders every camera; writes `NAME.npy` (RGB, not clamped from above) and `NAME.T.npy` (final transmittance)."""
    spec = importlib.util.spec_from_file_location("rasterizer", rasterizer)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for golden in SETS.values():
        for cam in golden["cameras"]:
            view = dict(cam, world_to_camera=np.linalg.inv(np.array(cam["world_from_camera"])).tolist())
            rgb, transmittance, _ = module.render(
                columns, view, mode="exact", near=golden["near"], compensate=golden["filter"] == "mip")
            np.save(HERE / f"{cam['name']}.npy", rgb.astype("<f4"))
            np.save(HERE / f"{cam['name']}.T.npy", transmittance.astype("<f4"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rasterizer", type=Path, help="module that renders the golden pictures")
    args = parser.parse_args()
    scene = Scene(seed=20)
    for part in (table_and_wall, bowl, fruit, air):
        part(scene)
    columns = scene.columns()
    write_ply(HERE / "fruit.ply", columns)
    for name, golden in SETS.items():
        (HERE / f"{name}.cameras.json").write_text(json.dumps(golden, indent=1) + "\n")
    if args.rasterizer:
        render(args.rasterizer, columns)
    print(f"{len(columns['xyz'])} Gaussians")


if __name__ == "__main__":
    main()
