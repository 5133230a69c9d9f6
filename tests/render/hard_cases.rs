//! Where rasterizers go wrong: needles, flat and huge splats, poison, the near plane, opaque walls. Judged by a
//! second renderer in `f64` (see `oracle`) or by a property that must hold.

use cinesplat::geometry::Camera;
use cinesplat::render::{Frame, Limits, Quality, RenderSettings, Renderer};
use cinesplat::scene::{Gaussians, SplatFilter};
use glam::{DVec3, Quat, Vec3};

use super::oracle;
use super::pictures::{max_difference, psnr_db};
use super::scenes::{camera, crowd, moved, push, single};

fn settings(quality: Quality) -> RenderSettings {
    RenderSettings { quality, near: 0.01, ..RenderSettings::default() }
}

fn picture(scene: &Gaussians, camera: &Camera, quality: Quality) -> Frame {
    Renderer::new(scene).render(camera, &settings(quality)).unwrap()
}

#[test]
fn a_crowd_of_all_shapes_is_that_of_the_second_renderer() {
    let scene = crowd(400, 1);
    // Neither side a multiple of a tile or block; principal point off the middle.
    let mut view = camera(131, 77);
    view.intrinsics.cx_px += 9.25;
    for filter in [SplatFilter::Classic, SplatFilter::Mip, SplatFilter::MipSmall] {
        let (rgb, rest) = oracle::render(&scene, &view, filter, 0.01);
        for (quality, least_db) in [(Quality::Reference, 80.0), (Quality::Final, 70.0), (Quality::Standard, 50.0)] {
            let frame = Renderer::new(&scene).render(&view, &RenderSettings { filter, ..settings(quality) }).unwrap();
            let (color, transmittance) = (psnr_db(&frame.rgb, &rgb), psnr_db(&frame.transmittance, &rest));
            assert!(color > least_db && transmittance > least_db, "{filter:?} {quality:?}: {color} {transmittance}");
        }
    }
}

#[test]
fn needles_keep_their_opacity_up_to_a_hundred_thousand_pixels() {
    let view = camera(160, 120);
    let focal = view.intrinsics.fx_px as f32;
    for exponent in -3..=5 {
        let length = 10_f32.powi(exponent) * 4.0 / focal;
        for angle in [0.0_f32, 0.3, std::f32::consts::FRAC_PI_4, 1.2] {
            let scene = single(Vec3::Z * 4.0, Vec3::new(length, 1e-6, 1e-6), Quat::from_rotation_z(angle), 0.9);
            let (_, rest) = oracle::render(&scene, &view, SplatFilter::Classic, 0.01);
            for quality in [Quality::Reference, Quality::Final] {
                let off = max_difference(&picture(&scene, &view, quality).transmittance, &rest);
                assert!(off <= 1e-3, "sd 1e{exponent} px, {angle} rad, {quality:?}: off by {off}");
            }
        }
    }
}

#[test]
fn flat_and_point_gaussians_are_the_limit_of_thin_ones() {
    let view = camera(96, 64);
    let edge_on = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    for (scale, rotation) in
        [(Vec3::new(0.5, 0.5, 0.0), edge_on), (Vec3::new(0.5, 0.0, 0.0), edge_on), (Vec3::ZERO, Quat::IDENTITY)]
    {
        for quality in [Quality::Reference, Quality::Final] {
            let exact = picture(&single(Vec3::Z * 3.0, scale, rotation, 0.8), &view, quality);
            let thin = picture(&single(Vec3::Z * 3.0, scale.max(Vec3::splat(1e-12)), rotation, 0.8), &view, quality);
            assert!(max_difference(&exact.rgb, &thin.rgb) <= 1e-6);
            assert!(exact.transmittance.iter().any(|&rest| rest < 0.7), "nothing drawn for {scale}");
        }
    }
}

#[test]
fn poisoned_gaussians_change_nothing() {
    let clean = crowd(500, 2);
    let view = camera(160, 90);
    let poison = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for quality in [Quality::Final, Quality::Reference] {
        let expected = picture(&clean, &view, quality);
        for (slot, &value) in (0..6).flat_map(|slot| poison.iter().map(move |value| (slot, value))) {
            let mut scene = clean.clone();
            push(&mut scene, Vec3::Z * 2.0, Vec3::splat(0.3), Quat::IDENTITY, (0.9, Vec3::ONE));
            scene.sh_rest.extend([Vec3::ZERO; 15]);
            let last = scene.len() - 1;
            match slot {
                0 => scene.means[last].x = value,
                1 => scene.scales[last].y = value,
                2 => scene.rotations[last].z = value,
                3 => scene.opacities[last] = value,
                4 => scene.sh_dc[last].x = value,
                _ => scene.sh_rest[last * 15 + 4].y = value,
            }
            assert!(picture(&scene, &view, quality).rgb == expected.rgb, "slot {slot}, {value}, {quality:?}");
        }
    }
}

#[test]
fn extreme_but_valid_gaussians_stay_visible() {
    let view = camera(64, 48);
    for scale in [1e3_f32, 1e8, 1e15, 1e19] {
        let scene = single(Vec3::Z * 2.0, Vec3::splat(scale), Quat::IDENTITY, 0.5);
        for quality in [Quality::Final, Quality::Reference] {
            let frame = picture(&scene, &view, quality);
            assert!(frame.transmittance.iter().all(|rest| (rest - 0.5).abs() < 1e-3), "{scale} {quality:?}");
        }
    }
}

#[test]
fn a_camera_that_flies_through_a_splat_sees_only_finite_numbers() {
    let scene = single(Vec3::ZERO, Vec3::new(0.3, 0.1, 0.2), Quat::from_rotation_z(0.4), 0.6);
    let renderer = Renderer::new(&scene);
    let mut before: Option<f32> = None;
    for step in 0..1000 {
        let position = DVec3::new(0.0, 0.0, -1.0 + f64::from(step) * 0.002);
        let frame = renderer.render(&moved(&camera(24, 16), position), &settings(Quality::Final)).unwrap();
        assert!(frame.rgb.iter().chain(&frame.transmittance).all(|value| value.is_finite()));
        let mean = frame.transmittance.iter().sum::<f32>() / frame.transmittance.len() as f32;
        assert!(before.is_none_or(|before| (before - mean).abs() <= 0.6001));
        before = Some(mean);
    }
}

#[test]
fn what_is_behind_the_camera_leaves_no_ghost() {
    let mut scene = crowd(300, 3);
    scene.means.iter_mut().for_each(|mean| mean.z = -mean.z);
    scene.scales.iter_mut().for_each(|scale| *scale *= 30.0);
    let background = Vec3::new(0.2, 0.4, 0.6);
    for quality in Quality::ALL {
        let settings = RenderSettings { background, ..settings(quality) };
        let frame = Renderer::new(&scene).render(&camera(100, 60), &settings).unwrap();
        assert!(frame.rgb.chunks(3).all(|rgb| rgb == background.to_array()), "{quality:?}");
        assert!(frame.transmittance.iter().all(|&rest| rest.to_bits() == 1.0_f32.to_bits()));
    }
}

#[test]
fn a_principal_point_off_the_middle_is_a_crop_of_a_wider_picture() {
    // Not larger than a tenth of the picture: where a splat beside the picture is linearized follows the picture's own
    // border by contract, and the two borders differ.
    let mut scene = crowd(2_000, 4);
    scene.scales.iter_mut().for_each(|scale| *scale *= 0.25);
    let wide = camera(256, 128);
    let mut crop = wide;
    crop.intrinsics.width = 128;
    crop.intrinsics.cx_px = 128.0 - 96.0;
    let (wide, crop) = (picture(&scene, &wide, Quality::Final), picture(&scene, &crop, Quality::Final));
    let cut: Vec<f32> = wide.rgb.chunks(256 * 3).flat_map(|row| &row[96 * 3..224 * 3]).copied().collect();
    let db = psnr_db(&cut, &crop.rgb);
    assert!(db >= 50.0, "{db:.1} dB");
}

#[test]
fn a_hundred_thousand_full_screen_splats_lose_no_tile_and_stay_under_the_cap() {
    let mut scene = Gaussians::default();
    for idx in 0..100_000 {
        let mean = Vec3::new(0.0, 0.0, 2.0 + idx as f32 * 1e-5);
        push(&mut scene, mean, Vec3::splat(50.0), Quat::IDENTITY, (0.05, Vec3::splat(0.5)));
    }
    let limits = Limits { max_memory_bytes: 64 << 20, ..Limits::default() };
    let frame =
        Renderer::new(&scene).render(&camera(512, 512), &RenderSettings { limits, ..settings(Quality::Standard) });
    let frame = frame.unwrap();
    assert!(frame.transmittance.iter().all(|&rest| rest > 0.0 && rest < 2e-3));
    assert!(frame.rgb.iter().all(|value| (value - 0.5).abs() < 1e-3));
}

#[test]
fn too_much_work_ends_in_one_error_before_anything_is_allocated() {
    let mut scene = Gaussians::default();
    for _ in 0..2_000 {
        push(&mut scene, Vec3::Z * 2.0, Vec3::splat(50.0), Quat::IDENTITY, (0.5, Vec3::ONE));
    }
    for quality in [Quality::Standard, Quality::Reference] {
        let render =
            |limits| Renderer::new(&scene).render(&camera(640, 360), &RenderSettings { limits, ..settings(quality) });
        let cost = render(Limits { max_pairs: 1_000, ..Limits::default() }).unwrap_err();
        assert_eq!((cost.code(), cost.exit_code()), ("RENDER-COST", 71));
        let memory = render(Limits { max_memory_bytes: 10_000, ..Limits::default() }).unwrap_err();
        assert_eq!((memory.code(), memory.exit_code()), ("RENDER-MEMORY", 71));
    }
}

#[test]
fn an_opaque_wall_lets_a_hundredth_through_and_two_a_ten_thousandth() {
    for quality in [Quality::Final, Quality::Reference] {
        let mut scene = single(Vec3::Z * 2.0, Vec3::new(50.0, 50.0, 0.01), Quat::IDENTITY, 1.0);
        let view = camera(32, 32);
        let one = picture(&scene, &view, quality).transmittance;
        assert!(one.iter().all(|&rest| (rest - 0.01).abs() < 1e-6));
        push(&mut scene, Vec3::Z * 3.0, Vec3::new(50.0, 50.0, 0.01), Quat::IDENTITY, (1.0, Vec3::ONE));
        let two = picture(&scene, &view, quality).transmittance;
        assert!(two.iter().all(|&rest| rest <= 1.001e-4), "{quality:?} {:?}", two[0]);
    }
}

#[test]
fn a_splat_a_million_units_away_changes_no_level() {
    let scene = crowd(1_000, 14);
    let mut with_far = scene.clone();
    // Faint enough that it may itself add no more than a level where the crowd leaves a gap.
    push(&mut with_far, Vec3::new(0.0, 0.0, 1e6), Vec3::splat(0.1), Quat::IDENTITY, (0.004, Vec3::splat(0.5)));
    with_far.sh_rest.extend([Vec3::ZERO; 15]);
    let view = camera(160, 90);
    let (a, b) = (picture(&scene, &view, Quality::Final), picture(&with_far, &view, Quality::Final));
    let levels = a.to_rgb8().into_iter().zip(b.to_rgb8()).map(|(a, b)| a.abs_diff(b)).max();
    assert!(levels.unwrap() <= 1);
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
fn mip_keeps_the_light_of_a_splat_that_moves_away() {
    let light = |distance: f64, filter: SplatFilter| {
        let scene = single(Vec3::ZERO, Vec3::splat(0.02), Quat::IDENTITY, 0.3);
        let view = moved(&camera(200, 200), DVec3::new(0.003, 0.002, -distance));
        let settings = RenderSettings { filter, ..settings(Quality::Reference) };
        let accuracy = cinesplat::render::Accuracy { alpha_cut: 1e-6, ..cinesplat::render::Accuracy::SPEC };
        let frame =
            Renderer::new(&scene).render(&view, &RenderSettings { accuracy: Some(accuracy), ..settings }).unwrap();
        frame.transmittance.iter().map(|&rest| 1.0 - f64::from(rest)).sum::<f64>() * distance * distance
    };
    let near = light(1.0, SplatFilter::Mip);
    for distance in [2.0, 4.0, 8.0] {
        let far = light(distance, SplatFilter::Mip);
        assert!((far / near - 1.0).abs() < 0.01, "at {distance}: {far} of {near}");
    }
    assert!(light(8.0, SplatFilter::Classic) > 1.2 * near);
}

#[test]
fn bad_cameras_and_settings_are_refused_by_name() {
    let scene = crowd(10, 16);
    let renderer = Renderer::new(&scene);
    let bad_near = renderer.render(&camera(8, 8), &RenderSettings { near: f64::NAN, ..RenderSettings::default() });
    assert_eq!(bad_near.unwrap_err().code(), "RENDER-SETTING");
    let empty = renderer.render(&camera(0, 8), &RenderSettings::default());
    assert_eq!(empty.unwrap_err().code(), "RENDER-CAMERA");
    let lost = renderer.render(&moved(&camera(8, 8), DVec3::splat(f64::NAN)), &RenderSettings::default());
    assert!(lost.is_err());
}
