//! Blending: opacity 1, colors below 0 and above 1, colors as trained.

use std::ops::ControlFlow;

use cinesplat::files::Existing;
use cinesplat::pipeline::{FilmSettings, FrameRange, film};
use cinesplat::render::{ColorClamp, Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use cinesplat::video::VideoSettings;
use glam::{Quat, Vec3};
use strum::VariantArray;

use super::{picture, settings};
use crate::render::scenes::{camera, crowd, push, single};

/// Walls across the whole picture, nearest first.
fn walls(layers: &[(f32, Vec3)]) -> Gaussians {
    let mut scene = Gaussians::default();
    for (idx, layer) in layers.iter().enumerate() {
        push(&mut scene, Vec3::Z * (2.0 + idx as f32), Vec3::new(5e3, 5e3, 0.01), Quat::IDENTITY, *layer);
    }
    scene
}

#[test]
fn one_opaque_wall_transmits_one_hundredth_and_two_one_ten_thousandth() {
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
fn color_is_clamped_below_before_blending_and_above_after_it() {
    // A splat twice as bright as white in front of one darker than black.
    let bright = walls(&[(0.5, Vec3::new(2.0, 2.0, 0.4)), (0.8, Vec3::new(-3.0, 0.5, -3.0))]);
    for quality in [Quality::Final, Quality::Reference] {
        let frame = picture(&bright, &camera(24, 16), quality);
        let expected = [0.5 * 2.0, 0.5 * 2.0 + 0.5 * 0.8 * 0.5, 0.5 * 0.4];
        for rgb in frame.rgb.chunks(3) {
            let off = rgb.iter().zip(expected).map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f32::max);
            assert!(off < 1e-4, "{quality:?}: {rgb:?}, expected {expected:?}");
        }
        // Only the conversion to 8 bits clamps from above.
        assert_eq!(frame.to_rgb8()[..3], [255, 255, 51], "{quality:?}");
    }
}

#[test]
fn color_clamped_in_every_gaussian_makes_bright_ones_white_before_blending() {
    let bright = walls(&[(0.5, Vec3::new(2.0, 2.0, 0.4)), (0.8, Vec3::new(-3.0, 0.5, 3.0))]);
    let expected = Vec3::new(0.5, 0.5 + 0.5 * 0.8 * 0.5, 0.5 * 0.4 + 0.5 * 0.8);
    for quality in [Quality::Final, Quality::Reference] {
        let khr = RenderSettings { color_clamp: ColorClamp::Khr, ..settings(quality) };
        let frame = Renderer::new(&bright).render(&camera(24, 16), &khr).unwrap();
        for rgb in frame.rgb.chunks(3) {
            assert!((Vec3::from_slice(rgb) - expected).abs().max_element() < 1e-4, "{quality:?}: {rgb:?}");
        }
    }
}

#[test]
fn layers_blend_as_trained() {
    // Blended in linear light, the first channel would be 0.66.
    let (front, behind) = (Vec3::new(0.2, 0.9, 0.5), Vec3::new(0.9, 0.1, 0.5));
    let scene = walls(&[(0.5, front), (0.9, behind)]);
    let expected = front * 0.5 + behind * 0.5 * 0.9;
    for &quality in Quality::VARIANTS {
        let frame = picture(&scene, &camera(24, 16), quality);
        for rgb in frame.rgb.chunks(3) {
            // Opacities of `draft` and `standard` have a relative error up to 0.8 %.
            assert!((Vec3::from_slice(rgb) - expected).abs().max_element() < 0.012, "{quality:?}: {rgb:?}");
        }
    }
}

#[test]
fn a_film_without_blur_has_the_levels_of_the_still() {
    const SHOT: &str = r#"{"format":"cinesplat.shot","version":1,"width":64,"height":36,"fps":4,"duration_secs":0.5,"keyframes":[
        {"time_secs":0,"position":[0,0,0],"rotation_xyzw":[0,0,0,1],"fov_y_deg":50,"easing":"smooth"}]}"#;
    let shot = cinesplat::export::shot_json::read(SHOT).unwrap().shot;
    let scene = crowd(800, 42);
    let renderer = Renderer::new(&scene);
    let folder = tempfile::tempdir().unwrap();
    for quality in [Quality::Draft, Quality::Standard, Quality::Final] {
        let film_settings = FilmSettings {
            effects: cinesplat::lens::EffectChoice::Auto,
            render: settings(quality),
            video: VideoSettings { existing: Existing::Replace, ..VideoSettings::default() },
            frames: FrameRange::default(),
            sheet: None,
            job: None,
            promise: None,
        };
        let output = folder.path().join("%05d.png");
        film(&renderer, &shot, &output, &film_settings, &mut |_| ControlFlow::Continue(())).unwrap();
        let written = image::open(folder.path().join("00000.png")).unwrap().to_rgb8().into_raw();
        assert!(written == picture(&scene, &camera(64, 36), quality).to_rgb8(), "{quality:?}");
    }
}
