//! Popping: how much more a picture changes over a small pan than the same Gaussians evaluated along rays.

use cinesplat::geometry::{Camera, Pose};
use cinesplat::render::{Quality, RenderSettings, Renderer, SortMode};
use cinesplat::scene::Gaussians;
use glam::{DMat3, DQuat, DVec2, DVec3, Quat, Vec3};

use super::settings;
use crate::render::scenes::{camera, crowd, push};

/// Step of the pan.
const STEP_DEG: f64 = 0.1;

/// The picture by rays: blends the largest value of each Gaussian along the ray, in the order of these maxima. With P
/// the inverse covariance and m the mean, the maximum is at t = r'Pm / r'Pr with squared distance m'Pm - t r'Pm.
fn by_rays(scene: &Gaussians, view: &Camera) -> Vec<f32> {
    let axes: Vec<DMat3> = scene.rotations.iter().map(|q| DMat3::from_quat(q.as_dquat()).transpose()).collect();
    let whiten = |idx: usize, v: DVec3| axes[idx] * v / scene.scales[idx].as_dvec3();
    let means: Vec<DVec3> =
        (0..scene.len()).map(|idx| whiten(idx, scene.mean_world(idx) - view.pose.position)).collect();
    let (width, height) = (view.intrinsics.width, view.intrinsics.height);
    let mut rgb = Vec::new();
    for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let ray = view.ray(DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5)).normalize();
        let mut met: Vec<(f64, f64, usize)> = Vec::new();
        for (idx, mean) in means.iter().enumerate() {
            let r = whiten(idx, ray);
            let t = r.dot(*mean) / r.length_squared();
            let alpha = f64::from(scene.opacities[idx]) * (-0.5 * (*mean - r * t).length_squared()).exp();
            if t > 0.0 && alpha >= 1.0 / 255.0 {
                met.push((t, alpha.min(0.99), idx));
            }
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut color, mut rest) = (DVec3::ZERO, 1.0);
        for (_, alpha, idx) in met {
            color += scene.sh_dc[idx].as_dvec3().mul_add(DVec3::splat(0.282_094_8), DVec3::splat(0.5)) * alpha * rest;
            rest *= 1.0 - alpha;
        }
        rgb.extend(color.as_vec3().to_array());
    }
    rgb
}

/// The largest change of a pixel between successive pictures of a pan, less the change of the same pixel by rays: in
/// mode z and in mode ray.
fn pops(scene: &Gaussians, num_steps: u32) -> [f32; 2] {
    let renderer = Renderer::new(scene);
    let mut pops = [0.0_f32; 2];
    let mut before: Option<[Vec<f32>; 3]> = None;
    for step in 0..=num_steps {
        let turn = DQuat::from_rotation_y((f64::from(step) * STEP_DEG).to_radians());
        let view = Camera { pose: Pose::new(DVec3::ZERO, turn), ..camera(80, 60) };
        let drawn = |sort| renderer.render(&view, &RenderSettings { sort, ..settings(Quality::Final) }).unwrap().rgb;
        let now = [by_rays(scene, &view), drawn(SortMode::Z), drawn(SortMode::Ray)];
        if let Some(before) = before {
            let change = |picture: usize, idx: usize| (now[picture][idx] - before[picture][idx]).abs();
            for idx in 0..now[0].len() {
                pops[0] = pops[0].max(change(1, idx) - change(0, idx));
                pops[1] = pops[1].max(change(2, idx) - change(0, idx));
            }
        }
        before = Some(now);
    }
    pops
}

#[test]
fn a_pan_pops_in_mode_z_and_not_in_mode_ray() {
    // The green splat is nearer along the view axis, the red one from the camera's center.
    let mut scene = Gaussians::default();
    for (mean, rgb) in [(Vec3::new(0.0, 0.0, 4.0), Vec3::X), (Vec3::new(1.4, 0.0, 3.9), Vec3::Y)] {
        push(&mut scene, mean, Vec3::splat(0.8), Quat::IDENTITY, (0.95, rgb));
    }
    let [in_mode_z, in_mode_ray] = pops(&scene, 100);
    assert!(in_mode_z > 0.2, "no pop in mode z: {in_mode_z}");
    assert!(in_mode_ray < 0.02, "pop in mode ray: {in_mode_ray}");
}

#[test]
fn a_crowd_pops_less_in_mode_ray_than_in_mode_z() {
    // Round and small relative to their distance, so that the affine projection is close to the rays; similar depths.
    let mut scene = crowd(150, 49);
    (scene.sh_degree, scene.sh_rest) = (0, Vec::new());
    scene.means.iter_mut().for_each(|mean| *mean = *mean / mean.z * (4.0 + 0.1 * mean.z));
    scene.scales.fill(Vec3::splat(0.25));
    scene.opacities.fill(0.95);
    let [in_mode_z, in_mode_ray] = pops(&scene, 60);
    assert!(in_mode_z > 0.1 && in_mode_z > 4.0 * in_mode_ray, "mode z {in_mode_z}, mode ray {in_mode_ray}");
}
