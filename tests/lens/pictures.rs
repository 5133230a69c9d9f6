use cinesplat::lens::{EffectChoice, EffectPlan};
use cinesplat::render::{RenderSettings, Renderer, Rgb8Frame};
use cinesplat::scene::Gaussians;

use super::stand::{call, called, camera, effect, exposed, with_take};

const SIZE: [u32; 2] = [96, 54];

fn settings() -> RenderSettings {
    RenderSettings { background: glam::Vec3::splat(0.5), ..RenderSettings::default() }
}

fn rgb8(picture: cinesplat::lens::Picture) -> Vec<u8> {
    let mut frame = Rgb8Frame::default();
    picture.into_rgb8(&mut frame);
    frame.rgb8
}

/// A picture of the gray background alone.
fn of_nothing(name: &str, values: &[(&str, f64)], frame_idx: usize) -> cinesplat::lens::Picture {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    exposed(&effect(name, values), SIZE, frame_idx, (&renderer, &settings()))
}

#[test]
fn a_frame_without_effects_is_plain() {
    let nothing = Gaussians::default();
    let (renderer, render) = (Renderer::new(&nothing), settings());
    let plan = |effects: &[_]| {
        with_take(effects, SIZE, |take| EffectPlan::of(effects, take, 0..3, (&renderer, &render)).unwrap())
    };
    assert!(plan(&[]).is_plain(0));
    // A vignette that darkens the corners by a fifth of a level cannot be seen.
    let faint = effect("vignette", &[("stops", 0.001)]);
    assert!(plan(&faint).is_plain(1));
    assert!(!plan(&effect("vignette", &[])).is_plain(1));
    // A hand moves the camera; the frame itself is plain.
    assert!(plan(&effect("handheld", &[])).is_plain(1));
    insta::assert_snapshot!(plan(&faint).sentences()[0], @"vignette: skipped on 3 of 3 frames, light lost in the corners 0.0007 of 1 < 0.0020 ('the test')");
}

#[test]
fn a_vignette_takes_its_stops_from_the_corners_and_nothing_from_the_middle() {
    let mut picture = of_nothing("vignette", &[("stops", 1.0)], 0);
    let light = picture.linear();
    let at = |row: usize, column: usize| f64::from(light.rgb[(row * SIZE[0] as usize + column) * 3]);
    let (corner, middle) = (at(0, 0), at(27, 48));
    assert!((corner / middle - 0.5).abs() < 0.02, "{corner} {middle}");
    assert!((at(0, 0) - at(53, 95)).abs() < 1e-6 && (at(0, 95) - at(53, 0)).abs() < 1e-6);
}

#[test]
fn grain_is_the_same_for_any_number_of_threads_and_new_in_every_frame() {
    let of = |threads: usize, frame_idx: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| rgb8(of_nothing("film-grain", &[], frame_idx)))
    };
    assert_eq!(of(1, 5), of(3, 5));
    assert_ne!(of(1, 5), of(1, 6));
}

#[test]
fn grain_has_the_strength_it_says_and_no_bias() {
    let mut picture = of_nothing("film-grain", &[("strength", 0.05), ("size_px", 4.0)], 0);
    let values: Vec<f64> = picture.display().rgb.iter().map(|&value| f64::from(value)).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let deviation = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
    assert!((mean - 0.5).abs() < 0.01 && (deviation / 0.05 - 1.0).abs() < 0.15, "{mean} {deviation}");
    // Black stays black, as on a print.
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let black = exposed(&effect("film-grain", &[]), SIZE, 0, (&renderer, &RenderSettings::default()));
    assert!(rgb8(black).iter().all(|&level| level == 0));
}

#[test]
fn settings_beyond_reason_are_bounded() {
    let wild = called(&[call("film-grain", &[("strength", 1e9), ("size_px", 1e9)])], &EffectChoice::Auto);
    let settings: Vec<_> = wild.effects[0].effect.settings();
    assert_eq!(settings, [("strength", 0.5), ("size_px", 8.0)]);
    assert_eq!(camera(SIZE).intrinsics.width, 96);
}
