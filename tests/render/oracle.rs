//! A second renderer, written from the contract alone: in `f64`, with matrices, every Gaussian in every pixel.

use cinesplat::geometry::Camera;
use cinesplat::scene::{Gaussians, SplatFilter};
use glam::{DMat2, DMat3, DVec2, DVec3, Vec3};

/// One Gaussian on the image plane.
struct Projected {
    mean_px: DVec2,
    inverse: DMat2,
    depth_key: f32,
    opacity: f64,
    color: DVec3,
}

/// Color and transmittance of every pixel, row-major, black background.
pub(crate) fn render(scene: &Gaussians, camera: &Camera, filter: SplatFilter, near: f64) -> (Vec<f32>, Vec<f32>) {
    let mut splats: Vec<Projected> =
        (0..scene.len()).filter_map(|idx| project(scene, idx, camera, filter, near)).collect();
    splats.sort_by(|a, b| a.depth_key.total_cmp(&b.depth_key));
    let (mut rgb, mut rest) = (Vec::new(), Vec::new());
    for row in 0..camera.intrinsics.height {
        for column in 0..camera.intrinsics.width {
            let center = DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
            let (color, transmittance) = pixel(&splats, center);
            rgb.extend(color.as_vec3().to_array());
            rest.push(transmittance as f32);
        }
    }
    (rgb, rest)
}

fn pixel(splats: &[Projected], center: DVec2) -> (DVec3, f64) {
    let (mut color, mut transmittance) = (DVec3::ZERO, 1.0);
    for splat in splats {
        let offset = center - splat.mean_px;
        let alpha = (splat.opacity * (-0.5 * offset.dot(splat.inverse * offset)).exp()).min(0.99);
        if alpha < 1.0 / 255.0 {
            continue;
        }
        if transmittance * (1.0 - alpha) < 1e-4 {
            break;
        }
        color += splat.color * alpha * transmittance;
        transmittance *= 1.0 - alpha;
    }
    (color, transmittance)
}

fn project(scene: &Gaussians, idx: usize, camera: &Camera, filter: SplatFilter, near: f64) -> Option<Projected> {
    let k = camera.intrinsics;
    let p = camera.pose.to_camera(scene.mean_world(idx));
    if p.z <= near {
        return None;
    }
    let (width, height) = (f64::from(k.width), f64::from(k.height));
    let bound = |slope: f64, size: f64, focal: f64, center: f64| {
        let margin = 0.3 * size / 2.0 / focal;
        slope.clamp(-center / focal - margin, (size - center) / focal + margin)
    };
    let (x, y) = (bound(p.x / p.z, width, k.fx_px, k.cx_px), bound(p.y / p.z, height, k.fy_px, k.cy_px));
    let jacobian = DMat3::from_cols(
        DVec3::new(k.fx_px / p.z, 0.0, 0.0),
        DVec3::new(0.0, k.fy_px / p.z, 0.0),
        DVec3::new(-k.fx_px * x / p.z, -k.fy_px * y / p.z, 0.0),
    );
    let axes = DMat3::from_quat(camera.pose.rotation.conjugate() * scene.rotations[idx].as_dquat().normalize());
    let v = jacobian * axes * DMat3::from_diagonal(scene.scales[idx].as_dvec3());
    let c = v * v.transpose();
    let raw = DMat2::from_cols(DVec2::new(c.x_axis.x, c.x_axis.y), DVec2::new(c.y_axis.x, c.y_axis.y));
    let dilated = raw + DMat2::from_diagonal(DVec2::splat(if filter == SplatFilter::MipSmall { 0.1 } else { 0.3 }));
    let kept =
        if filter == SplatFilter::Classic { 1.0 } else { (raw.determinant() / dilated.determinant()).max(0.0).sqrt() };
    Some(Projected {
        mean_px: DVec2::new(k.fx_px * p.x / p.z + k.cx_px, k.fy_px * p.y / p.z + k.cy_px),
        inverse: dilated.inverse(),
        depth_key: p.z as f32,
        opacity: f64::from(scene.opacities[idx]) * kept,
        color: color(scene, idx, scene.mean_world(idx) - camera.pose.position),
    })
}

/// Spherical harmonics computed from associated Legendre functions instead of a table of polynomials.
fn color(scene: &Gaussians, idx: usize, offset: DVec3) -> DVec3 {
    let d = offset.normalize_or_zero();
    let (cos_theta, phi) = (d.z, d.y.atan2(d.x));
    let mut sum = scene.sh_dc[idx].as_dvec3() * harmonic(0, 0, cos_theta, phi) + 0.5;
    let rest: &[Vec3] = scene.sh_rest_of(idx);
    let orders = (1..=3_i32).flat_map(|l| (-l..=l).map(move |m| (l, m)));
    for (coefficient, (l, m)) in rest.iter().zip(orders) {
        sum += coefficient.as_dvec3() * harmonic(l, m, cos_theta, phi);
    }
    sum.max(DVec3::ZERO)
}

/// Real spherical harmonic of degree `l` and order `m` with the Condon-Shortley phase.
fn harmonic(l: i32, m: i32, cos_theta: f64, phi: f64) -> f64 {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    let order = m.abs();
    let norm =
        (f64::from(2 * l + 1) / (4.0 * std::f64::consts::PI) * factorial(l - order) / factorial(l + order)).sqrt();
    let legendre = legendre(l, order, cos_theta);
    match m {
        0 => norm * legendre,
        _ if m > 0 => 2_f64.sqrt() * norm * (f64::from(order) * phi).cos() * legendre,
        _ => 2_f64.sqrt() * norm * (f64::from(order) * phi).sin() * legendre,
    }
}

/// Associated Legendre function by recurrence, with the phase (-1)^m.
fn legendre(l: i32, m: i32, x: f64) -> f64 {
    let sine = (1.0 - x * x).max(0.0).sqrt();
    let diagonal = (1..=m).map(|k| -f64::from(2 * k - 1) * sine).product::<f64>();
    let (mut before, mut now) = (0.0, diagonal);
    for degree in m + 1..=l {
        let next = (f64::from(2 * degree - 1) * x * now - f64::from(degree + m - 1) * before) / f64::from(degree - m);
        (before, now) = (now, next);
    }
    now
}
