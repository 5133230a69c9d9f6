//! Small generated scenes.

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::scene::Gaussians;
use glam::{DVec3, Quat, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// One Gaussian of color `rgb`.
pub(crate) fn push(scene: &mut Gaussians, mean: Vec3, scale: Vec3, rotation: Quat, (opacity, rgb): (f32, Vec3)) {
    scene.means.push(mean);
    scene.scales.push(scale);
    scene.rotations.push(rotation);
    scene.opacities.push(opacity);
    scene.sh_dc.push((rgb - 0.5) / 0.282_094_8);
}

/// A scene of one white Gaussian.
pub(crate) fn single(mean: Vec3, scale: Vec3, rotation: Quat, opacity: f32) -> Gaussians {
    let mut scene = Gaussians::default();
    push(&mut scene, mean, scale, rotation, (opacity, Vec3::ONE));
    scene
}

/// A camera at the origin that looks along +z, with a vertical field of view of 50 degrees.
pub(crate) fn camera(width: u32, height: u32) -> Camera {
    Camera { pose: Pose::IDENTITY, intrinsics: Intrinsics::from_fov_y(width, height, 50_f64.to_radians()) }
}

/// Gaussians of all shapes in front of [`camera`], with view-dependent color.
pub(crate) fn crowd(num_gaussians: usize, seed: u64) -> Gaussians {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut scene = Gaussians { sh_degree: 3, ..Gaussians::default() };
    for _ in 0..num_gaussians {
        let mut unit = || rng.random::<f32>();
        let depth = 1.0 + 8.0 * unit();
        let mean = Vec3::new((unit() - 0.5) * 2.0 * depth, (unit() - 0.5) * 1.4 * depth, depth);
        let scale = Vec3::new(unit(), unit(), unit()).map(|u| 0.003 * (u * 5.0).exp());
        let rotation = Quat::from_xyzw(unit() - 0.5, unit() - 0.5, unit() - 0.5, unit() - 0.5).normalize();
        let look = (0.02 + 0.98 * unit(), Vec3::new(unit(), unit(), unit()));
        push(&mut scene, mean, scale, rotation, look);
        scene.sh_rest.extend((0..15).map(|_| Vec3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5) * 0.2));
    }
    scene
}

/// The same Gaussians in another order.
pub(crate) fn reordered(scene: &Gaussians, order: &[usize]) -> Gaussians {
    let num_rest = scene.sh_rest.len() / scene.len().max(1);
    Gaussians {
        origin: scene.origin,
        means: order.iter().map(|&idx| scene.means[idx]).collect(),
        scales: order.iter().map(|&idx| scene.scales[idx]).collect(),
        rotations: order.iter().map(|&idx| scene.rotations[idx]).collect(),
        opacities: order.iter().map(|&idx| scene.opacities[idx]).collect(),
        sh_dc: order.iter().map(|&idx| scene.sh_dc[idx]).collect(),
        sh_degree: scene.sh_degree,
        sh_rest: order.iter().flat_map(|&idx| &scene.sh_rest[idx * num_rest..][..num_rest]).copied().collect(),
        ids: Vec::new(),
    }
}

/// The camera at another position, with the same rotation.
pub(crate) fn moved(camera: &Camera, position: DVec3) -> Camera {
    Camera { pose: Pose::new(position, camera.pose.rotation), ..*camera }
}
