//! The two sort modes: `z` as in the spec image, `ray` for cameras that turn.

use cinesplat::geometry::{Camera, Pose};
use cinesplat::render::{Frame, Quality, RenderSettings, Renderer, SortMode};
use cinesplat::scene::Gaussians;
use glam::{DQuat, Quat, Vec3};
use strum::VariantArray;

use super::scenes::{camera, crowd, push};

/// Two thick overlapping splats of different colors. For a camera that looks along +z the green one is nearer along the
/// view axis, the red one from the camera's center. After a pan to the right the red one is nearer by both.
fn rivals() -> Gaussians {
    let mut scene = Gaussians::default();
    let size = Vec3::splat(0.8);
    push(&mut scene, Vec3::new(0.0, 0.0, 4.0), size, Quat::IDENTITY, (0.95, Vec3::X));
    push(&mut scene, Vec3::new(1.4, 0.0, 3.9), size, Quat::IDENTITY, (0.95, Vec3::Y));
    scene
}

/// A camera at the origin, panned to the right.
fn panned(degrees: f64) -> Camera {
    let view = camera(160, 120);
    Camera { pose: Pose::new(view.pose.position, DQuat::from_rotation_y(degrees.to_radians())), ..view }
}

fn picture(scene: &Gaussians, view: &Camera, quality: Quality, sort: SortMode) -> Frame {
    let settings = RenderSettings { quality, sort, near: 0.01, ..RenderSettings::default() };
    Renderer::new(scene).render(view, &settings).unwrap()
}

/// Red over red plus green in the middle between the two splats.
fn redness(frame: &Frame, view: &Camera) -> f32 {
    let (between, _) = view.project(glam::DVec3::new(0.7, 0.0, 3.95)).unwrap();
    let pixel = between.y as usize * frame.width as usize + between.x as usize;
    let [red, green] = [frame.rgb[pixel * 3], frame.rgb[pixel * 3 + 1]];
    red / (red + green)
}

#[test]
fn a_pan_swaps_overlapping_splats_in_mode_z_and_not_in_mode_ray() {
    let scene = rivals();
    for quality in [Quality::Reference, Quality::Standard] {
        let along = |sort, degrees| {
            let view = panned(degrees);
            redness(&picture(&scene, &view, quality, sort), &view)
        };
        let steps = || (0..=20).map(f64::from);
        let in_mode_z: Vec<f32> = steps().map(|degrees| along(SortMode::Z, degrees)).collect();
        let in_mode_ray: Vec<f32> = steps().map(|degrees| along(SortMode::Ray, degrees)).collect();
        let largest_step = |track: &[f32]| track.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
        assert!(largest_step(&in_mode_z) > 0.3, "{quality:?}: no pop in mode z: {in_mode_z:?}");
        assert!(largest_step(&in_mode_ray) < 0.05, "{quality:?}: pops in mode ray: {in_mode_ray:?}");
        assert!(in_mode_ray.iter().all(|&red| red > 0.5), "{quality:?}: red is nearer: {in_mode_ray:?}");
    }
}

#[test]
fn final_and_reference_agree_in_either_sort_mode() {
    let scene = crowd(2_000, 31);
    for &sort in SortMode::VARIANTS {
        let exact = picture(&scene, &panned(5.0), Quality::Reference, sort);
        let fast = picture(&scene, &panned(5.0), Quality::Final, sort);
        assert!(fast.psnr_db(&exact) > 100.0, "{sort:?}: {:.1} dB", fast.psnr_db(&exact));
    }
}

#[test]
fn the_sort_modes_give_different_pictures() {
    let scene = crowd(2_000, 32);
    let [in_mode_z, in_mode_ray] =
        [SortMode::Z, SortMode::Ray].map(|sort| picture(&scene, &panned(0.0), Quality::Final, sort));
    assert!(in_mode_z.psnr_db(&in_mode_ray) < 60.0);
}
