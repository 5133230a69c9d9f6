//! Needles, disks, points and small splats: the projected covariance.

use cinesplat::render::{Accuracy, Quality, RenderSettings, Renderer};
use cinesplat::scene::{Gaussians, SplatFilter};
use glam::{DVec3, Quat, Vec3};

use super::{picture, settings};
use crate::render::oracle;
use crate::render::pictures::{max_difference, psnr_db};
use crate::render::scenes::{camera, crowd, moved, single};

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

/// `mip` multiplies the opacity by the root of the quotient of two determinants, without and with the dilation. The
/// middle pixel of a needle shows that factor; the expected value is computed from the variances along its axes.
#[test]
fn determinants_of_needles_are_those_of_the_formula() {
    // The mean falls on the center of a pixel.
    let view = camera(161, 121);
    let focal = view.intrinsics.fx_px;
    let accuracy = Accuracy { alpha_cut: 1e-6, ..Accuracy::SPEC };
    for (exponent, angle) in (-3..=5).flat_map(|exponent| [0.0_f32, 0.3, 0.785, 1.2].map(|angle| (exponent, angle))) {
        let (long_px, thick_px) = (10_f64.powi(exponent), 0.7);
        let scale = DVec3::new(long_px, thick_px, thick_px) * 4.0 / focal;
        let scene = single(Vec3::Z * 4.0, scale.as_vec3(), Quat::from_rotation_z(angle), 0.9);
        let (raw_long, raw_thick) =
            (f64::from(scene.scales[0].x) * focal / 4.0, f64::from(scene.scales[0].y) * focal / 4.0);
        let kept = |sd: f64| sd * sd / (sd * sd + 0.3);
        let expected = kept(raw_long) * kept(raw_thick);
        for quality in [Quality::Reference, Quality::Final] {
            let settings = RenderSettings { filter: SplatFilter::Mip, accuracy: Some(accuracy), ..settings(quality) };
            let frame = Renderer::new(&scene).render(&view, &settings).unwrap();
            let middle = f64::from(frame.rgb[(60 * 161 + 80) * 3]) / f64::from(0.9_f32);
            // In `f32` opacities have an error up to 2.5e-5.
            let (off, allowed) = match quality {
                Quality::Reference => ((middle * middle / expected - 1.0).abs(), 1e-5),
                _ => ((middle - expected.sqrt()).abs(), 2.6e-5),
            };
            assert!(middle > 0.0 && off <= allowed, "sd 1e{exponent} px at {angle}, {quality:?}: off by {off:e}");
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
fn a_disk_seen_from_its_edge_is_a_line_as_wide_as_the_dilation() {
    let view = camera(97, 65);
    let edge_on = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    let scene = single(Vec3::Z * 3.0, Vec3::new(0.5, 0.5, 0.0), edge_on, 0.8);
    for quality in [Quality::Final, Quality::Reference] {
        let rest = picture(&scene, &view, quality).transmittance;
        for across in -1_i32..=1 {
            let alpha = 1.0 - f64::from(rest[32 * 97 + (48 + across) as usize]);
            let expected = f64::from(0.8_f32) * (-f64::from(across * across) / (2.0 * 0.3)).exp();
            assert!((alpha - expected).abs() < 1e-4, "{across} px off: {alpha}, expected {expected}");
        }
    }
}

/// The nearest number of half precision (10 bits of mantissa, multiples of 2^-24 below 2^-14).
fn half(value: f32) -> f32 {
    let step = 2_f64.powi((f64::from(value).abs().log2().floor() as i32).max(-14) - 10);
    ((f64::from(value) / step).round_ties_even() * step) as f32
}

/// Needles a hundred times as long as thick, at many positions and angles.
fn needles() -> Gaussians {
    let mut scene = crowd(400, 40);
    scene.scales = (0..scene.len()).map(|idx| Vec3::new(0.3 + 0.001 * idx as f32, 0.003, 0.0025)).collect();
    scene
}

#[test]
fn needles_survive_scales_and_rotations_in_half_precision() {
    let scene = needles();
    let mut rounded = scene.clone();
    for (scale, rotation) in rounded.scales.iter_mut().zip(&mut rounded.rotations) {
        *scale = scale.map(half);
        *rotation = Quat::from_array(rotation.to_array().map(half)).normalize();
    }
    assert_ne!(scene.rotations, rounded.rotations);
    for quality in [Quality::Final, Quality::Reference] {
        let view = camera(320, 180);
        let db = psnr_db(&picture(&scene, &view, quality).rgb, &picture(&rounded, &view, quality).rgb);
        assert!(db >= 60.0, "{quality:?}: {db:.1} dB");
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
    // `classic` adds light as the splat gets small: by the formula, the dilated area over the area, here at 50 degrees.
    let focal = camera(200, 200).intrinsics.fy_px;
    let grown = |distance: f64| 1.0 + 0.3 / (0.02 * focal / distance).powi(2);
    let drift = light(8.0, SplatFilter::Classic) / light(1.0, SplatFilter::Classic);
    assert!((drift / (grown(8.0) / grown(1.0)) - 1.0).abs() < 0.01, "{drift}");
}
