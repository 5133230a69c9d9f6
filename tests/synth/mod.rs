//! Generated scenes: objects, boxes, free space and determinism, checked on the Gaussians.

mod layout;
mod objects;
mod surface;

use std::sync::LazyLock;

use cinesplat::synth::{SynthKind, SynthScene, SynthSettings, generate};
use glam::{DMat3, DVec3};

/// Sixteen rooms and eight still lifes at a low detail, shared by the tests.
static SCENES: LazyLock<Vec<(String, SynthScene)>> = LazyLock::new(|| {
    let of = |seed: u64, kind: SynthKind| {
        (format!("{kind:?} {seed}"), generate(&SynthSettings { seed, kind, detail: 0.05 }))
    };
    (0..16).map(|seed| of(seed, SynthKind::Room)).chain((0..8).map(|seed| of(seed, SynthKind::Tabletop))).collect()
});

/// Mean of a Gaussian in the frame of a box.
fn in_box(scene: &SynthScene, gaussian_idx: usize, object_idx: usize) -> DVec3 {
    let object = &scene.objects[object_idx];
    object.rotation.conjugate() * (scene.gaussians.mean_world(gaussian_idx) - object.center)
}

/// Half extents of the one-sigma ellipsoid of a Gaussian along the axes of a box.
fn spread_in_box(scene: &SynthScene, gaussian_idx: usize, object_idx: usize) -> DVec3 {
    let to_box = scene.objects[object_idx].rotation.conjugate();
    let own = DMat3::from_quat(to_box * scene.gaussians.rotations[gaussian_idx].as_dquat());
    let scaled = own * DMat3::from_diagonal(scene.gaussians.scales[gaussian_idx].as_dvec3());
    DVec3::new(scaled.row(0).length(), scaled.row(1).length(), scaled.row(2).length())
}
