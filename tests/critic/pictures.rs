//! What is measured on one picture.

use cinesplat::critic::holds_to;
use cinesplat::objects::Object;
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::ShotSize;
use glam::{DVec3, Vec3};

use super::{FOV_RAD, SIGMA, SIZE_PX, STEP, Stage, gray, sheet, state, wall};

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found}, expected {expected}");
}

#[test]
fn half_a_wall_leaves_half_a_void() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 0.0), 4.0, gray);
    let picture = Stage::new(scene, Vec::new()).picture();
    near(picture.void_frac, 0.5, 0.03);
    near(picture.brightness, 0.5, 0.03);
    assert_eq!(picture.blocked_frac, 0.0);
}

#[test]
fn a_wall_against_the_lens_blocks_its_share_of_the_frame() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 6.0), 6.0, gray);
    wall(&mut scene, (0.0, 1.0), 0.3, gray);
    let picture = Stage::new(scene, Vec::new()).picture();
    near(picture.blocked_frac, 0.5, 0.1);
    assert!(picture.void_frac < 0.01, "{}", picture.void_frac);
}

#[test]
fn a_thin_curtain_before_the_lens_is_haze_and_no_block() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 6.0), 6.0, gray);
    sheet(&mut scene, ([-1.0, -1.0], [1.0, 1.0]), (0.3, 0.1), gray);
    let picture = Stage::new(scene, Vec::new()).picture();
    assert!(picture.blocked_frac < 0.01, "{}", picture.blocked_frac);
    // Each Gaussian covers 0.1 pi sigma squared of its 0.06 by 0.06.
    near(picture.haze, 0.1 * std::f64::consts::PI * f64::from(SIGMA * SIGMA) / (STEP * STEP), 0.03);
}

#[test]
fn a_post_hides_half_of_a_subject() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 6.0), 6.0, gray);
    let subject = Object::from_box(7, "panel", DVec3::new(0.0, 0.0, 4.0), DVec3::new(0.5, 0.5, 0.1));
    sheet(&mut scene, ([-0.5, -0.5], [0.5, 0.5]), (4.0, 0.99), gray);
    // At half the depth, everything left of the view axis; its last Gaussians reach to the axis.
    sheet(&mut scene, ([-1.0, -1.0], [-0.08, 1.0]), (2.0, 0.99), gray);
    let picture = Stage::new(scene, vec![subject]).picture();
    let sight = picture.sights[0];
    assert_eq!(sight.object, 7);
    near(sight.seen_frac, 0.5, 0.05);
    // The margins to the sides are as wide, and half of all of it lies behind the post.
    near(sight.crowded_frac, 0.5, 0.1);
    // Height 1 at depth 4 over the frame's height 8 tan(25 degrees) there, and the box is nearer than its middle by 0.1.
    near(sight.height_frac.unwrap(), 1.0 / (2.0 * 3.9 * (FOV_RAD / 2.0).tan()), 1e-6);
    near(sight.area_frac, (1.0_f64 / (8.0 * (FOV_RAD / 2.0).tan())).powi(2) * 9.0 / 16.0, 0.01);
}

#[test]
fn splats_are_measured_in_pixels_of_the_film() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 6.0), 4.0, gray);
    let picture = Stage::new(scene, Vec::new()).picture();
    let focal_px = f64::from(SIZE_PX[1]) / 2.0 / (FOV_RAD / 2.0).tan();
    near(picture.splat_px, 2.0 * f64::from(SIGMA) / 4.0 * focal_px, 0.3);
}

#[test]
fn surfaces_face_the_camera_by_the_cosine() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 6.0), 6.0, gray);
    sheet(&mut scene, ([-0.1, -0.1], [0.1, 0.1]), (4.0, 0.99), gray);
    let panel = Object::from_box(1, "panel", DVec3::new(0.0, 0.0, 4.0), DVec3::new(0.2, 0.2, 0.1));
    let stage = Stage::new(scene, vec![panel]);
    let facing = |position: DVec3| {
        stage.judged(2, |critic| critic.look(&state(position), 0.0, SIZE_PX).unwrap()).sights[0].facing.unwrap()
    };
    near(facing(DVec3::ZERO), 1.0, 0.01);
    // From the side by 60 degrees: a cosine of a half.
    near(facing(DVec3::new(4.0 * 60_f64.to_radians().tan(), 0.0, 0.0)), 0.5, 0.02);
}

#[test]
fn depth_is_the_ratio_of_far_to_near() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-6.0, 0.0), 2.0, gray);
    wall(&mut scene, (-8.0, 8.0), 6.0, gray);
    near(Stage::new(scene, Vec::new()).picture().depth_ratio, 3.0, 0.05);
}

#[test]
fn detail_on_one_side_is_out_of_balance_and_a_bare_wall_has_none() {
    let checks = |column: i64, row: i64| Vec3::splat(if (column / 4 + row / 4) % 2 == 0 { 0.2 } else { 0.8 });
    let mut left = Gaussians::default();
    wall(&mut left, (-8.0, 0.0), 4.0, checks);
    wall(&mut left, (0.1, 8.0), 4.0, |_, _| Vec3::splat(0.5));
    let picture = Stage::new(left, Vec::new()).picture();
    assert!(picture.balance.x < -0.15 && picture.balance.y.abs() < 0.05, "{}", picture.balance);
    near(picture.interest_frac, 0.5, 0.13);
    let mut bare = Gaussians::default();
    wall(&mut bare, (-8.0, 8.0), 4.0, gray);
    assert_eq!(Stage::new(bare, Vec::new()).picture().interest_frac, 0.0);
}

#[test]
fn white_is_clipped_and_dark_is_black() {
    let of = |value: f32| {
        let mut scene = Gaussians::default();
        wall(&mut scene, (-8.0, 8.0), 4.0, |_, _| Vec3::splat(value));
        Stage::new(scene, Vec::new()).picture()
    };
    assert!(of(1.5).clipped_frac > 0.99 && of(1.5).black_frac == 0.0);
    assert!(of(0.0).black_frac > 0.99 && of(0.0).clipped_frac == 0.0);
}

#[test]
fn a_subject_holds_to_the_size_at_which_its_splats_are_small_enough() {
    // Splats of 16 px in 720 lines are twice as large as a picture holds: half the height does.
    assert_eq!(holds_to(1.7, 16.0, 720), ShotSize::MediumCloseUp);
    assert_eq!(holds_to(1.7, 16.0, 1440), ShotSize::ExtremeCloseUp);
    assert_eq!(holds_to(0.5, 80.0, 720), ShotSize::ExtremeLong);
}
