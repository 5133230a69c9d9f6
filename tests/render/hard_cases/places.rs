//! Positions of the camera and of splats: inside a splat, at a mean, behind the camera, far away; off-center principal
//! points.

use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::SplatFilter;
use glam::{DVec3, Quat, Vec3};
use strum::VariantArray;

use super::{picture, settings};
use crate::render::oracle;
use crate::render::pictures::psnr_db;
use crate::render::scenes::{camera, crowd, moved, push, single};

#[test]
fn a_camera_that_flies_through_a_splat_sees_only_finite_numbers() {
    const OPACITY: f32 = 0.6;
    let mut scene = single(Vec3::ZERO, Vec3::new(0.3, 0.1, 0.2), Quat::from_rotation_z(0.4), OPACITY);
    scene.sh_degree = 3;
    scene.sh_rest = (0..15).map(|idx| Vec3::new(0.2, -0.1, 0.03 * idx as f32)).collect();
    let brightest = 0.5 / 0.282_094_8 + 15.0 * 0.5;
    let renderer = Renderer::new(&scene);
    // Through the mean itself, and close to it.
    for (quality, aside) in [(Quality::Final, 0.0), (Quality::Final, 1e-3), (Quality::Reference, 0.0)] {
        let mut before: Option<(f32, f32)> = None;
        for step in 0..1000 {
            let position = DVec3::new(aside, 0.0, -1.0 + f64::from(step) * 0.002);
            let frame = renderer.render(&moved(&camera(24, 16), position), &settings(quality)).unwrap();
            assert!(frame.rgb.iter().chain(&frame.transmittance).all(|value| value.is_finite()));
            let mean = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
            let (color, rest) = (mean(&frame.rgb), mean(&frame.transmittance));
            // One splat can change the transmittance by its opacity, and the color by its opacity times its color.
            let is_bounded = |(old_color, old_rest): (f32, f32)| {
                (old_rest - rest).abs() <= OPACITY + 1e-4 && (old_color - color).abs() <= OPACITY * brightest
            };
            assert!(before.is_none_or(is_bounded), "step {step}: {before:?} to {color} {rest}");
            before = Some((color, rest));
        }
    }
}

#[test]
fn a_camera_at_a_mean_sees_the_color_without_direction() {
    // The camera is 1e-300 in front of the mean: the squared length of the offset underflows, so there is no direction.
    let mut scene = single(Vec3::ZERO, Vec3::splat(0.3), Quat::IDENTITY, 0.6);
    scene.sh_degree = 1;
    scene.sh_rest = vec![Vec3::splat(0.4), Vec3::splat(-0.3), Vec3::splat(0.2)];
    let renderer = Renderer::new(&scene);
    for quality in [Quality::Final, Quality::Reference] {
        let view = moved(&camera(24, 16), DVec3::new(0.0, 0.0, -1e-300));
        let frame = renderer.render(&view, &RenderSettings { near: 0.0, ..settings(quality) }).unwrap();
        for (rgb, rest) in frame.rgb.chunks(3).zip(&frame.transmittance) {
            assert!((rgb[0] - (1.0 - rest)).abs() < 1e-4, "{quality:?}: {rgb:?} at {rest}");
        }
    }
}

#[test]
fn gaussians_behind_the_camera_are_not_drawn() {
    let mut scene = crowd(300, 3);
    scene.means.iter_mut().for_each(|mean| mean.z = -mean.z);
    scene.scales.iter_mut().for_each(|scale| *scale *= 30.0);
    let background = Vec3::new(0.2, 0.4, 0.6);
    for &quality in Quality::VARIANTS {
        let settings = RenderSettings { background, ..settings(quality) };
        let frame = Renderer::new(&scene).render(&camera(100, 60), &settings).unwrap();
        assert!(frame.rgb.chunks(3).all(|rgb| rgb == background.to_array()), "{quality:?}");
        assert!(frame.transmittance.iter().all(|&rest| rest.to_bits() == 1.0_f32.to_bits()));
    }
}

#[test]
fn a_principal_point_off_the_middle_is_a_crop_of_a_wider_picture() {
    // Small splats: for a splat outside the picture the point of linearization depends on the border of the picture (by
    // contract), and the two pictures have different borders.
    let mut scene = crowd(2_000, 4);
    scene.scales.iter_mut().for_each(|scale| *scale *= 0.25);
    let wide = camera(256, 128);
    let mut crop = wide;
    crop.intrinsics.width = 128;
    crop.intrinsics.cx_px = 128.0 - 96.0;
    let (wide, crop) = (picture(&scene, &wide, Quality::Final), picture(&scene, &crop, Quality::Final));
    let cut: Vec<f32> = wide.rgb.chunks(256 * 3).flat_map(|row| &row[96 * 3..224 * 3]).copied().collect();
    let db = psnr_db(&cut, &crop.rgb);
    assert!(db >= 85.0, "{db:.1} dB");
}

#[test]
fn a_picture_with_an_extreme_principal_point_matches_the_second_renderer() {
    let scene = crowd(300, 41);
    let mut view = camera(120, 80);
    (view.intrinsics.cx_px, view.intrinsics.cy_px) = (20.0, 71.5);
    let (rgb, rest) = oracle::render(&scene, &view, SplatFilter::Classic, 0.01);
    for (quality, least_db) in [(Quality::Reference, 140.0), (Quality::Final, 100.0)] {
        let frame = picture(&scene, &view, quality);
        let (color, transmittance) = (psnr_db(&frame.rgb, &rgb), psnr_db(&frame.transmittance, &rest));
        assert!(color > least_db && transmittance > least_db, "{quality:?}: {color:.1} {transmittance:.1} dB");
    }
}

#[test]
fn a_splat_a_million_units_away_changes_levels_by_at_most_one() {
    let mut scene = crowd(1_000, 14);
    // Two walls behind the crowd hide everything behind them.
    for depth in [20.0, 30.0] {
        push(&mut scene, Vec3::Z * depth, Vec3::new(500.0, 500.0, 0.01), Quat::IDENTITY, (1.0, Vec3::splat(0.3)));
        scene.sh_rest.extend([Vec3::ZERO; 15]);
    }
    let mut with_far = scene.clone();
    push(&mut with_far, Vec3::new(0.0, 0.0, 1e6), Vec3::splat(1e5), Quat::IDENTITY, (1.0, Vec3::ONE));
    with_far.sh_rest.extend([Vec3::ZERO; 15]);
    let view = camera(160, 90);
    for &quality in Quality::VARIANTS {
        let (without, with) = (picture(&scene, &view, quality), picture(&with_far, &view, quality));
        if quality != Quality::Reference {
            assert_eq!(with.stats.counts.num_splats, without.stats.counts.num_splats + 1, "the far splat is not drawn");
        }
        let levels = without.to_rgb8().into_iter().zip(with.to_rgb8()).map(|(a, b)| a.abs_diff(b)).max();
        assert!(levels.unwrap() <= 1, "{quality:?}: {levels:?}");
    }
}

#[test]
fn the_sign_of_a_quaternion_does_not_matter() {
    let scene = crowd(500, 15);
    let mut negated = scene.clone();
    negated.rotations.iter_mut().for_each(|rotation| *rotation = -*rotation);
    let view = camera(160, 90);
    for quality in [Quality::Final, Quality::Reference] {
        assert_eq!(picture(&scene, &view, quality).rgb, picture(&negated, &view, quality).rgb);
    }
}

#[test]
fn bad_cameras_and_settings_are_rejected() {
    let scene = crowd(10, 16);
    let renderer = Renderer::new(&scene);
    let bad_near = renderer.render(&camera(8, 8), &RenderSettings { near: f64::NAN, ..RenderSettings::default() });
    assert_eq!(bad_near.unwrap_err().code(), "RENDER-SETTING");
    let empty = renderer.render(&camera(0, 8), &RenderSettings::default());
    assert_eq!(empty.unwrap_err().code(), "RENDER-CAMERA");
    let lost = renderer.render(&moved(&camera(8, 8), DVec3::splat(f64::NAN)), &RenderSettings::default());
    assert!(lost.is_err());
}
