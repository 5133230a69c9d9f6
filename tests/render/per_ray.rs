//! Error of the affine projection against the Gaussian itself, evaluated exactly along each ray in `f64`.

use cinesplat::geometry::Camera;
use cinesplat::render::{Quality, RenderSettings, Renderer};
use glam::{DMat3, DVec2, DVec3, Quat};

use super::scenes::{camera, single};

const OPACITY: f32 = 0.9;

/// Opacity along the ray through a pixel: the largest value of the Gaussian on the ray. With P the inverse covariance,
/// m the mean and r the ray, the minimum of (t r - m)' P (t r - m) is m'Pm - (r'Pm)^2 / r'Pr.
fn alpha(view: &Camera, pixel: (u32, u32), mean: DVec3, scale: DVec3, rotation: Quat) -> f64 {
    let ray = view.ray(DVec2::new(f64::from(pixel.0) + 0.5, f64::from(pixel.1) + 0.5));
    let axes = DMat3::from_quat(rotation.as_dquat());
    let whiten = |v: DVec3| axes.transpose() * v / scale;
    let (r, m) = (whiten(ray), whiten(mean));
    let apart = m.length_squared() - r.dot(m).powi(2) / r.length_squared();
    f64::from(OPACITY) * (-0.5 * apart).exp()
}

/// Largest difference of opacity over the picture between the renderer and the exact rays.
fn largest_error(relative_scale: f64, slope: f64, quality: Quality) -> f64 {
    let view = camera(480, 360);
    let mean = DVec3::new(slope, 0.3 * slope, 1.0) * 4.0;
    let (scale, turned) = (DVec3::new(1.0, 0.8, 1.2) * relative_scale * 4.0, Quat::from_rotation_y(0.7));
    let scene = single(mean.as_vec3(), scale.as_vec3(), turned, OPACITY);
    let settings = RenderSettings { quality, near: 0.01, ..RenderSettings::default() };
    let frame = Renderer::new(&scene).render(&view, &settings).unwrap();
    let error = |(idx, rest): (usize, &f32)| {
        let pixel = (idx as u32 % 480, idx as u32 / 480);
        (1.0 - f64::from(*rest) - alpha(&view, pixel, mean, scale, turned)).abs()
    };
    frame.transmittance.iter().enumerate().map(error).fold(0.0, f64::max)
}

#[test]
fn the_affine_projection_is_close_to_exact_rays_for_small_splats() {
    // Bounds: the error of the approximation, calculated separately, plus the alpha cut of 1/255.
    for (relative_scale, bound) in [(0.02, 0.013), (0.05, 0.024), (0.1, 0.048)] {
        for slope in [0.0, 0.2, 0.4] {
            for quality in [Quality::Reference, Quality::Final] {
                let error = largest_error(relative_scale, slope, quality);
                assert!(error < bound, "scale {relative_scale} at slope {slope}, {quality:?}: off by {error:.4}");
            }
        }
    }
    // For a large splat the error is visible, so the test can fail.
    assert!(largest_error(0.2, 0.4, Quality::Reference) > 0.08);
}
