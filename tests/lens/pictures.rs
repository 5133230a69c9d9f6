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

/// Dither turned black pixels into gray ones.
#[test]
fn black_and_white_pixels_get_no_dither() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    for level in [0_u8, 255] {
        let render = RenderSettings { background: glam::Vec3::splat(f32::from(level) / 255.0), ..settings() };
        let picture = exposed(&effect("bloom", &[]), SIZE, 0, (&renderer, &render));
        assert!(rgb8(picture).iter().all(|found| *found == level), "{level}");
    }
    // In between it keeps the mean.
    let render = RenderSettings { background: glam::Vec3::splat(0.45 / 255.0), ..settings() };
    let levels = rgb8(exposed(&effect("bloom", &[]), SIZE, 0, (&renderer, &render)));
    let mean = levels.iter().map(|level| f64::from(*level)).sum::<f64>() / levels.len() as f64;
    assert!((mean - 0.45).abs() < 0.25 && levels.contains(&0) && levels.contains(&1), "{mean}");
}

#[test]
fn the_film_of_fog_is_opaque() {
    let picture = of_nothing("fog", &[], 0);
    assert!(picture.frame().transmittance.iter().all(|rest| *rest == 0.0));
    assert!(picture.to_rgba8().chunks(4).all(|rgba| rgba[3] == 255 && rgba[0] > 150));
}

/// It was reported as skipped, although it moves the camera.
#[test]
fn a_hand_below_the_budget_still_moves_the_camera_and_says_so() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let gentle = effect("handheld", &[("turn_deg", 0.001), ("shift", 0.0)]);
    let plan = with_take(&gentle, SIZE, |take| EffectPlan::of(&gentle, take, 0..3, (&renderer, &settings())).unwrap());
    assert!(plan.is_plain(1));
    insta::assert_snapshot!(plan.sentences()[0], @"handheld: on 3 of 3 frames, displacement of the middle of the picture 0.0010 px < 0.40 ('the test')");
    assert_ne!(EffectPlan::moved(&gentle, camera(SIZE), 0.7), camera(SIZE));
}

/// A film of four frames of which one moves: forced-on, every frame takes what that one needs.
#[test]
fn effects_forced_on_run_on_every_frame_with_the_samples_of_the_worst() {
    let gray = Gaussians::default();
    let renderer = Renderer::new(&gray);
    let faint = effect("vignette", &[("stops", 0.001)]);
    let plan = with_take(&faint, SIZE, |take| EffectPlan::of(&faint, take, 0..3, (&renderer, &settings())).unwrap());
    assert!(plan.is_plain(2) && !plan.clone().forced().is_plain(2));
}

/// Nothing called for, everything switched off, and effects too small to show: bytes, work and memory are those of the plain
/// renderer.
#[test]
fn off_is_free() {
    // Each thread that renders keeps buffers, so one thread does all.
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    one_thread.install(plain_frames_without_effects);
}

fn plain_frames_without_effects() {
    let scene = crate::render::scenes::crowd(3000, 4);
    let render = RenderSettings { near: 0.01, ..settings() };
    let plain = || {
        let renderer = Renderer::new(&scene);
        let mut frames: Vec<Rgb8Frame> = Vec::new();
        for frame_idx in 0..3 {
            let mut frame = Rgb8Frame::default();
            let seen = with_take(&[], SIZE, |take| (take.camera_at)(f64::from(frame_idx) / take.fps));
            renderer.render_rgb8_into(&seen, &render, &mut frame).unwrap();
            frames.push(frame);
        }
        (frames, renderer.memory_bytes())
    };
    let (wanted, wanted_bytes) = plain();
    let all =
        ["motion-blur", "depth-of-field", "fog", "film-grain", "bloom", "rolling-shutter"].map(|name| call(name, &[]));
    let faint = [call("vignette", &[("stops", 0.001)]), call("exposure", &[("stops", 0.0001)])];
    let off = called(&all, &EffectChoice::Off).effects;
    assert!(off.is_empty());
    for effects in [Vec::new(), off, called(&faint, &EffectChoice::Auto).effects] {
        let renderer = Renderer::new(&scene);
        for (frame_idx, wanted) in wanted.iter().enumerate() {
            let mut frame = Rgb8Frame::default();
            with_take(&effects, SIZE, |take| {
                let plan = EffectPlan::of(&effects, take, 0..3, (&renderer, &render)).unwrap();
                assert!(plan.is_plain(frame_idx) && plan.num_samples(frame_idx) == 1);
                let picture =
                    plan.expose(&cinesplat::lens::Moment::of_frame(take, frame_idx, &render), &renderer).unwrap();
                // Splats, pairs, blends, and sub-frames, of which each is sorted once.
                assert_eq!(picture.frame().stats.counts, wanted.stats.counts);
                picture.into_rgb8(&mut frame);
            });
            assert_eq!(frame.rgb8, wanted.rgb8);
        }
        assert_eq!(renderer.memory_bytes(), wanted_bytes);
    }
}

/// Each row of a tilted lens is blurred as far as it says; what is even stays even, up to the borders.
#[test]
fn a_tilted_lens_blurs_the_borders_and_leaves_the_band_and_even_pictures_alone() {
    let mut even = of_nothing("tilt-shift", &[("blur", 0.05)], 0);
    assert!(even.display().rgb.iter().all(|value| (value - 0.5).abs() < 1e-4));
    // A board of one-pixel columns: the band keeps its contrast, the borders lose it.
    let scene = Gaussians {
        means: (0..24).map(|i| glam::Vec3::new((i as f32 - 11.5) * 0.09, 0.0, 0.0)).collect(),
        scales: vec![glam::Vec3::new(0.012, 3.0, 0.01); 24],
        rotations: vec![glam::Quat::IDENTITY; 24],
        opacities: vec![0.99; 24],
        sh_dc: vec![glam::Vec3::splat(1.5); 24],
        ..Gaussians::default()
    };
    let renderer = Renderer::new(&scene);
    let contrast = |picture: &mut cinesplat::lens::Picture, row: usize| {
        let row = &picture.display().rgb[row * 288..(row + 1) * 288];
        let (low, high) = row[90..200].iter().fold((1.0_f32, 0.0_f32), |(low, high), v| (low.min(*v), high.max(*v)));
        high - low
    };
    let render = RenderSettings::default();
    let mut plain = exposed(&[], SIZE, 0, (&renderer, &render));
    let mut tilted = exposed(&effect("tilt-shift", &[("blur", 0.08), ("middle", 0.5)]), SIZE, 0, (&renderer, &render));
    let ratio = |row: usize| contrast(&mut tilted.clone(), row) / contrast(&mut plain.clone(), row);
    assert!((ratio(27) - 1.0).abs() < 0.01 && ratio(1) < 0.4, "{} {}", ratio(27), ratio(1));
    // No light is lost in the middle columns.
    let sum = |picture: &mut cinesplat::lens::Picture| picture.linear().rgb[27 * 288..28 * 288].iter().sum::<f32>();
    assert!((sum(&mut tilted) / sum(&mut plain) - 1.0).abs() < 1e-3);
}

#[test]
fn a_lens_flares_only_where_something_is_really_bright() {
    let lamp = |brightness: f32| Gaussians {
        means: vec![glam::Vec3::new(0.35, 0.2, 0.0)],
        scales: vec![glam::Vec3::splat(0.12)],
        rotations: vec![glam::Quat::IDENTITY],
        opacities: vec![0.99],
        sh_dc: vec![glam::Vec3::splat((brightness - 0.5) / 0.282_094_8)],
        ..Gaussians::default()
    };
    let flare = effect("lens-flare", &[]);
    let render = RenderSettings::default();
    let dim = lamp(0.7);
    let renderer = Renderer::new(&dim);
    let plan = with_take(&flare, SIZE, |take| EffectPlan::of(&flare, take, 0..1, (&renderer, &render)).unwrap());
    assert!(plan.is_plain(0), "nothing is bright: {:?}", plan.sentences());
    let bright = lamp(1.0);
    let renderer = Renderer::new(&bright);
    let mut with = exposed(&flare, SIZE, 0, (&renderer, &render));
    let mut without = exposed(&[], SIZE, 0, (&renderer, &render));
    // The lamp is right of the middle and below it: a ghost is left of it and above, where nothing else is.
    let left_above = |picture: &mut cinesplat::lens::Picture| -> f32 {
        let frame = picture.linear();
        (0..24).flat_map(|row| (0..40).map(move |column| (row * 96 + column) * 3)).map(|at| frame.rgb[at]).sum()
    };
    assert!(left_above(&mut with) > left_above(&mut without) + 0.01);
}

/// The pictures had their alpha, and the report said that nothing was done.
#[test]
fn a_transparent_background_is_reported_as_skipped() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let plan = |effects: &[_]| {
        with_take(effects, SIZE, |take| {
            EffectPlan::of(effects, take, 0..3, (&renderer, &RenderSettings::default())).unwrap()
        })
    };
    let clear = plan(&effect("background", &[("alpha", 1.0)]));
    insta::assert_snapshot!(clear.sentences()[0], @"background: on 3 of 3 frames, largest change of the background 1.00 of 1 > 0.0020 ('the test')");
    assert!(clear.is_transparent());
    // Black over black is nothing.
    let black = plan(&effect("background", &[]));
    assert!(black.is_plain(1) && black.sentences()[0].contains("skipped on 3 of 3 frames"), "{:?}", black.sentences());
}

/// Beyond half a turn it was infinite, and a little below some thousand pixels.
#[test]
fn a_fisheye_shifts_the_corners_by_infinity() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let half_diagonal = 0.5 * f64::from(SIZE[0]).hypot(f64::from(SIZE[1]));
    let plain_deg = 2.0 * (half_diagonal / camera(SIZE).intrinsics.fx_px).atan().to_degrees();
    for fov_deg in [1.0, plain_deg, 140.0, 179.9, 180.0, 220.0, 360.0] {
        let fisheye = effect("fisheye", &[("fov_deg", fov_deg)]);
        let plan =
            with_take(&fisheye, SIZE, |take| EffectPlan::of(&fisheye, take, 0..1, (&renderer, &settings())).unwrap());
        let shift_px = plan.effects[0].losses()[0].error;
        assert!(!plan.is_plain(0) && shift_px > 1.0 && shift_px < half_diagonal, "{fov_deg} degrees: {shift_px} px");
    }
}
