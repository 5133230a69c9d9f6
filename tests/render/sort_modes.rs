//! The two orders of blending: `z` as the spec image, `ray` for cameras that turn.

use cinesplat::geometry::{Camera, Pose};
use cinesplat::render::{Frame, Quality, RenderSettings, Renderer, SortMode};
use cinesplat::scene::Gaussians;
use glam::{DQuat, Quat, Vec3};
use strum::VariantArray;

use super::scenes::{camera, crowd, push};

/// Two thick overlapping splats of different color. Along the view axis of a camera that looks ahead the green one is
/// nearer, from the camera's center the red one; turned to the right the red one is nearer both ways.
fn rivals() -> Gaussians {
    let mut scene = Gaussians::default();
    let size = Vec3::splat(0.8);
    push(&mut scene, Vec3::new(0.0, 0.0, 4.0), size, Quat::IDENTITY, (0.95, Vec3::X));
    push(&mut scene, Vec3::new(1.4, 0.0, 3.9), size, Quat::IDENTITY, (0.95, Vec3::Y));
    scene
}

/// A camera at the origin, turned to its right.
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
fn a_pan_exchanges_overlapping_splats_by_depth_and_not_by_distance() {
    let scene = rivals();
    for quality in [Quality::Reference, Quality::Standard] {
        let along = |sort, degrees| {
            let view = panned(degrees);
            redness(&picture(&scene, &view, quality, sort), &view)
        };
        let steps = || (0..=20).map(f64::from);
        let by_depth: Vec<f32> = steps().map(|degrees| along(SortMode::Z, degrees)).collect();
        let by_distance: Vec<f32> = steps().map(|degrees| along(SortMode::Ray, degrees)).collect();
        let largest_step = |track: &[f32]| track.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
        assert!(largest_step(&by_depth) > 0.3, "{quality:?}: no pop by depth: {by_depth:?}");
        assert!(largest_step(&by_distance) < 0.05, "{quality:?}: pops by distance: {by_distance:?}");
        assert!(by_distance.iter().all(|&red| red > 0.5), "{quality:?}: red is nearer: {by_distance:?}");
    }
}

#[test]
fn fast_and_exact_agree_in_either_order() {
    let scene = crowd(2_000, 31);
    for &sort in SortMode::VARIANTS {
        let exact = picture(&scene, &panned(5.0), Quality::Reference, sort);
        let fast = picture(&scene, &panned(5.0), Quality::Final, sort);
        assert!(fast.psnr_db(&exact) > 60.0, "{sort:?}: {:.1} dB", fast.psnr_db(&exact));
    }
}

#[test]
fn the_order_is_a_choice_that_shows() {
    let scene = crowd(2_000, 32);
    let [by_depth, by_distance] =
        [SortMode::Z, SortMode::Ray].map(|sort| picture(&scene, &panned(0.0), Quality::Final, sort));
    assert!(by_depth.psnr_db(&by_distance) < 60.0);
}
