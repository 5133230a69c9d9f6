//! Hard cases of lens and shutter: each has an oracle besides the effect itself.

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::lens::{CalledEffect, EffectChoice, EffectPlan, MAX_SAMPLES, Moment, OpticsTrack, Take};
use cinesplat::render::{Frame, Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{Easing, KeyOptics, Keyframe};
use glam::{DQuat, DVec3, Quat, Vec3};

use super::stand::{call, called, effect};

const SIZE: [u32; 2] = [96, 64];

fn settings() -> RenderSettings {
    RenderSettings { quality: Quality::Final, near: 0.05, ..RenderSettings::default() }
}

fn camera(fov_y_rad: f64) -> Camera {
    Camera { pose: Pose::IDENTITY, intrinsics: Intrinsics::from_fov_y(SIZE[0], SIZE[1], fov_y_rad) }
}

/// Walls of checkered splats across the view axis at these depths, each over a part of the picture.
fn walls(depths: &[f32]) -> Gaussians {
    let mut scene = Gaussians::default();
    for (idx, &depth) in depths.iter().enumerate() {
        for (row, column) in (-24..24_i16).flat_map(|row| (-36..36_i16).map(move |column| (row, column))) {
            // The first wall is on the left, the second on the right, the last one everywhere.
            let side = if idx + 1 == depths.len() { 0 } else { 1 - 2 * (idx as i16 % 2) };
            if side * column > 0 || depths.len() == 1 {
                continue;
            }
            let shade = if (row.div_euclid(3) + column.div_euclid(3)) % 2 == 0 { 0.6 } else { -0.6 };
            scene.means.push(Vec3::new(f32::from(column) * 0.02, f32::from(row) * 0.02, 1.0) * depth);
            scene.scales.push(Vec3::splat(0.012 * depth));
            scene.rotations.push(Quat::IDENTITY);
            scene.opacities.push(0.9);
            scene.sh_dc.push(Vec3::new(shade, 0.5 * shade, -shade));
        }
    }
    scene
}

/// A frame of 10 per second with effects, and how many samples it took.
fn exposed(
    effects: &[CalledEffect],
    camera_at: &(dyn Fn(f64) -> Camera + Sync),
    keys: &[Keyframe],
    (frame_idx, scene): (usize, &Gaussians),
) -> (Frame, EffectPlan) {
    let renderer = Renderer::new(scene);
    let optics = OpticsTrack::new(keys);
    let take = Take { camera_at, optics: &optics, up: None, fps: 10.0, seed: 7 };
    let plan = EffectPlan::of(effects, take, 0..4, (&renderer, &settings())).unwrap();
    let mut picture = plan.expose(&Moment::of_frame(take, frame_idx, &settings()), &renderer).unwrap();
    (picture.display().clone(), plan)
}

/// The mean light of sharp pictures of these cameras.
fn mean_light(scene: &Gaussians, cameras: impl Iterator<Item = Camera>) -> Frame {
    let renderer = Renderer::new(scene);
    let light = |value: f32| if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) };
    let signal = |light: f32| if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    let (mut sum, mut num) = (Frame::default(), 0.0);
    for camera in cameras {
        let frame = renderer.render(&camera, &settings()).unwrap();
        num += 1.0;
        if sum.rgb.is_empty() {
            sum = Frame { rgb: vec![0.0; frame.rgb.len()], ..frame.clone() };
        }
        sum.rgb.iter_mut().zip(&frame.rgb).for_each(|(sum, value)| *sum += light(value.clamp(0.0, 1.0)));
    }
    sum.rgb.iter_mut().for_each(|value| *value = signal(*value / num));
    sum
}

fn key(time_secs: f64, cut: bool) -> Keyframe {
    Keyframe {
        time_secs,
        pose: Pose::IDENTITY,
        fov_y_rad: 0.9,
        focus_distance: None,
        optics: KeyOptics::default(),
        easing: Easing::Linear,
        cut,
        intent: None,
    }
}

fn plain(scene: &Gaussians, camera: &Camera) -> Frame {
    Renderer::new(scene).render(camera, &settings()).unwrap()
}

#[test]
fn focus_at_behind_and_beyond_the_scene() {
    let scene = walls(&[2.0, 4.0]);
    let rest = |_: f64| camera(0.9);
    let with = |focus: f64, f_stop: f64| {
        let values = [("f_stop", f_stop), ("focus_x", 0.0), ("focus_y", 0.0), ("focus_z", focus)];
        let (frame, plan) = exposed(&effect("depth-of-field", &values), &rest, &[], (0, &scene));
        (frame, plan.effects[0].losses()[0].error)
    };
    let sharp = plain(&scene, &camera(0.9));
    let px = |depth: f64, focus: f64, f_stop: f64| {
        let own = camera(0.9).intrinsics;
        let aperture = 0.036 * own.fx_px / f64::from(own.width) / f_stop;
        own.fx_px * aperture * (1.0 / depth - 1.0 / focus).abs()
    };
    // At the nearer wall, at the farther one, and far beyond both: the thin lens says how large the circles are.
    for focus in [2.0, 4.0, 1e6] {
        let (frame, circle_px) = with(focus, 0.1);
        let wanted = px(2.0, focus, 0.1).max(px(4.0, focus, 0.1));
        assert!((circle_px / wanted - 1.0).abs() < 0.02, "{focus}: {circle_px} instead of {wanted}");
        assert!(frame.rgb.iter().all(|value| value.is_finite()) && frame != sharp);
    }
    // Behind the camera there is no focus: the picture is finite all the same.
    let (frame, circle_px) = with(-3.0, 0.1);
    assert!(frame.rgb.iter().all(|value| value.is_finite()) && circle_px.is_finite());
    // A pinhole of f/64 in a room is the plain picture, bit by bit.
    assert_eq!(with(2.0, 64.0).0.rgb, sharp.rgb);
    // An aperture of 0 is no effect.
    assert!(called(&[call("depth-of-field", &[("f_stop", 0.0)])], &EffectChoice::Auto).effects.is_empty());
}

/// Lens samples alone square the circles off and darken the picture: here against 1024 pinholes over a round aperture.
#[test]
fn samples_of_the_lens_have_no_bias_against_1024() {
    let scene = walls(&[1.5, 4.0]);
    let rest = |_: f64| camera(0.9);
    let f_stop = 0.06;
    let values = [("f_stop", f_stop), ("focus_x", 0.0), ("focus_y", 0.0), ("focus_z", 4.0)];
    let (frame, plan) = exposed(&effect("depth-of-field", &values), &rest, &[], (0, &scene));
    let own = camera(0.9).intrinsics;
    let radius = 0.5 * 0.036 * own.fx_px / f64::from(own.width) / f_stop;
    let pinhole = |idx: usize| {
        // A spiral of even density over the disk.
        let place = glam::DVec2::from_angle(2.399_963_23 * idx as f64) * ((idx as f64 + 0.5) / 1024.0).sqrt() * radius;
        let mut camera = camera(0.9);
        camera.pose.position += place.extend(0.0);
        camera.intrinsics.cx_px += own.fx_px * place.x / 4.0;
        camera.intrinsics.cy_px += own.fy_px * place.y / 4.0;
        camera
    };
    let exact = mean_light(&scene, (0..1024).map(pinhole));
    let sum = |frame: &Frame| frame.rgb.iter().map(|value| f64::from(*value)).sum::<f64>();
    let (psnr_db, brightness) = (frame.psnr_db(&exact), sum(&frame) / sum(&exact));
    assert!((brightness - 1.0).abs() < 0.01, "{brightness}");
    assert!(psnr_db > 38.0, "{psnr_db} dB, {:?}", plan.sentences());
}

#[test]
fn roll_and_zoom_are_blurred_as_200_sharp_pictures_say() {
    let scene = walls(&[2.0, 4.0]);
    let rolling =
        |secs: f64| Camera { pose: Pose::new(DVec3::ZERO, DQuat::from_rotation_z(1.2 * secs)), ..camera(0.9) };
    let zooming = |secs: f64| camera(0.9 - 0.8 * secs);
    let moves: [&(dyn Fn(f64) -> Camera + Sync); 2] = [&rolling, &zooming];
    for camera_at in moves {
        let shutter = effect("motion-blur", &[("shutter_angle_deg", 180.0)]);
        let (frame, plan) = exposed(&shutter, camera_at, &[], (2, &scene));
        let at = |sample: i32| camera_at(0.2 + ((f64::from(sample) + 0.5) / 200.0 - 0.5) * 0.05);
        let exact = mean_light(&scene, (0..200).map(at));
        let (psnr_db, sharp_db) = (frame.psnr_db(&exact), plain(&scene, &camera_at(0.2)).psnr_db(&exact));
        assert!(psnr_db > 42.0 && psnr_db > sharp_db + 8.0, "{psnr_db} dB, plain {sharp_db}, {:?}", plan.sentences());
    }
}

/// Projected from behind the camera, its motion would be without bound.
#[test]
fn a_splat_that_crosses_the_near_plane_inside_the_shutter_smears_nothing_over_the_frame() {
    let mut scene = walls(&[3.0, 4.0]);
    let far = scene.clone();
    scene.means.push(Vec3::new(0.01, 0.0, 0.52));
    scene.scales.push(Vec3::splat(0.02));
    scene.rotations.push(Quat::IDENTITY);
    scene.opacities.push(0.9);
    scene.sh_dc.push(Vec3::splat(1.5));
    // The camera passes the splat in the middle of the exposure of frame 1.
    let forward = |secs: f64| Camera { pose: Pose::new(DVec3::Z * (5.2 * secs), DQuat::IDENTITY), ..camera(0.9) };
    let shutter = effect("motion-blur", &[("shutter_angle_deg", 180.0)]);
    let (frame, plan) = exposed(&shutter, &forward, &[], (1, &scene));
    assert!(frame.rgb.iter().all(|value| value.is_finite()) && plan.num_samples(1) <= MAX_SAMPLES);
    let at = |sample: i32| forward(0.1 + ((f64::from(sample) + 0.5) / 200.0 - 0.5) * 0.05);
    let exact = mean_light(&scene, (0..200).map(at));
    let (without, _) = exposed(&shutter, &forward, &[], (1, &far));
    let exact_without = mean_light(&far, (0..200).map(at));
    // No worse than twice the error without the splat: it does not appear where it never was.
    let rms = |a: &Frame, b: &Frame| 10_f64.powf(-a.psnr_db(b) / 20.0);
    let (with, least) = (rms(&frame, &exact), rms(&without, &exact_without));
    assert!(with < 2.0 * least + 0.05, "{with} {least}");
}

#[test]
fn shutters_of_0_of_a_frame_and_across_a_cut() {
    let scene = walls(&[2.0, 4.0]);
    // A camera that jumps at 0.2 s and moves on both sides.
    let jumping = |secs: f64| {
        let x = if secs < 0.2 { secs } else { 0.6 + secs };
        Camera { pose: Pose::new(DVec3::X * x * 0.5, DQuat::IDENTITY), ..camera(0.9) }
    };
    let keys = [key(0.0, false), key(0.2, true), key(0.4, false)];
    let shut = called(&[call("motion-blur", &[("shutter_angle_deg", 0.0)])], &EffectChoice::Auto);
    assert!(shut.effects.is_empty(), "a shutter of 0 is no effect");
    let open = effect("motion-blur", &[("shutter_angle_deg", 360.0)]);
    let (_, plan) = exposed(&open, &jumping, &keys, (2, &scene));
    let motions: Vec<f64> = plan.effects[0].losses().iter().map(|loss| loss.error).collect();
    // Over a whole frame; the exposure of the frame at the cut begins there, and takes half of it.
    let whole = camera(0.9).intrinsics.fx_px * 0.05 / 2.0;
    assert!((motions[1] / whole - 1.0).abs() < 0.02, "{motions:?}");
    assert!((motions[2] / (0.5 * whole) - 1.0).abs() < 0.02, "no blend across the cut: {motions:?}");
}

#[test]
fn a_static_frame_in_a_moving_shot_takes_one_plain_picture() {
    let scene = walls(&[2.0, 4.0]);
    // Moves in the first tenth of a second and after three tenths.
    let resting = |secs: f64| {
        let x = secs.min(0.1) + (secs - 0.3).max(0.0);
        Camera { pose: Pose::new(DVec3::X * x * 2.0, DQuat::IDENTITY), ..camera(0.9) }
    };
    let shutter = effect("motion-blur", &[]);
    let (frame, plan) = exposed(&shutter, &resting, &[], (2, &scene));
    assert_eq!([0, 1, 2, 3].map(|idx| plan.is_plain(idx)), [false, false, true, false], "{:?}", plan.sentences());
    assert_eq!(plan.num_samples(2), 1);
    assert_eq!(frame.rgb, plain(&scene, &resting(0.2)).rgb);
    assert_eq!(frame.stats.counts.num_subframes, plain(&scene, &resting(0.2)).stats.counts.num_subframes);
}

#[test]
fn effects_do_not_depend_on_the_number_of_threads() {
    let scene = walls(&[2.0, 4.0]);
    let names = ["film-grain", "bloom", "lens-flare", "tilt-shift", "stereo", "motion-blur", "depth-of-field", "fog"];
    let calls = names.map(|name| call(name, &[]));
    let effects = called(&calls, &EffectChoice::Auto).effects;
    let moving = |secs: f64| Camera { pose: Pose::new(DVec3::X * secs, DQuat::from_rotation_y(secs)), ..camera(0.9) };
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| exposed(&effects, &moving, &[], (3, &scene)).0.rgb)
    };
    let one = of(1);
    assert!(one == of(2) && one == of(5));
    assert!(one.iter().all(|value| value.is_finite()));
}
