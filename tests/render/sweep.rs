//! Exposures of one projection. The oracle: the same pictures, each rendered by itself.

use cinesplat::geometry::Camera;
use cinesplat::lens::{Between, Budget, LensAndShutter, Sampling};
use cinesplat::render::{
    Frame, InstructionSet, Limits, Quality, RenderError, RenderSettings, Renderer, Rgb8Frame, SplatBlur, SubFrame,
    Sweep, SweepPattern, ThinLens,
};
use cinesplat::scene::Gaussians;
use glam::{DQuat, DVec3};

use super::pictures::psnr_db;
use super::scenes::{camera, crowd};

fn settings(quality: Quality) -> RenderSettings {
    RenderSettings { quality, near: 0.01, ..RenderSettings::default() }
}

fn swept(scene: &Gaussians, sweep: &Sweep, settings: &RenderSettings) -> Frame {
    let mut frame = Frame::default();
    Renderer::new(scene).sweep_into(sweep, settings, &mut frame).unwrap();
    frame
}

fn exposed(scene: &Gaussians, subframes: &[SubFrame], settings: &RenderSettings) -> Frame {
    let mut frame = Frame::default();
    Renderer::new(scene).expose_into(subframes, settings, &mut frame).unwrap();
    frame
}

const LENS: ThinLens = ThinLens { aperture_diameter: 0.05, focus_distance: 2.5, squeeze: 1.0 };

/// Motions over the shutter of a camera by some pixels.
fn at(camera: &Camera, motion: &str, fraction: f64) -> Camera {
    let amount = fraction - 0.5;
    let mut at = *camera;
    match motion {
        "truck" => at.pose.position += DVec3::X * 0.06 * amount,
        "dolly" => at.pose.position += DVec3::Z * 0.1 * amount,
        "pan" => at.pose.rotation *= DQuat::from_rotation_y(0.02 * amount),
        "roll" => at.pose.rotation *= DQuat::from_rotation_z(0.04 * amount),
        "zoom" => {
            at.intrinsics.fx_px *= (0.04 * amount).exp();
            at.intrinsics.fy_px *= (0.04 * amount).exp();
        }
        _ => {}
    }
    at
}

/// The samples of the exposure for a whole picture, shared and each by itself.
fn both(taken: &LensAndShutter<'_>, num: usize, moves: bool) -> (Sweep, Vec<SubFrame>) {
    let sweep = taken.even_sweep(num, moves);
    let pattern = &sweep.patterns[0];
    let center = (pattern.center_weight > 0.0).then_some(sweep.center);
    let cameras = center.into_iter().chain(pattern.around.iter().map(|(camera, _)| *camera));
    let subframes = cameras.map(SubFrame::from).collect();
    (sweep, subframes)
}

#[test]
fn pictures_of_one_projection_are_those_rendered_one_by_one() {
    let scene = crowd(4000, 21);
    let view = camera(203, 117);
    for motion in ["truck", "dolly", "pan", "roll", "zoom"] {
        let camera_at = |fraction: f64| at(&view, motion, fraction);
        let (sweep, subframes) = both(&LensAndShutter { camera_at: &camera_at, lens: None }, 5, true);
        let shared = swept(&scene, &sweep, &settings(Quality::Final));
        let apart = exposed(&scene, &subframes, &settings(Quality::Final));
        let plain = exposed(&scene, &[SubFrame::from(view)], &settings(Quality::Final));
        let (found, least) = (psnr_db(&shared.rgb, &apart.rgb), psnr_db(&plain.rgb, &apart.rgb));
        // The splats themselves do not turn within a roll.
        let gain_db = if motion == "roll" { 5.0 } else { 8.0 };
        assert!(found > 44.0 && found > least + gain_db, "{motion}: {found} dB, without blur {least}");
    }
    let still = |_: f64| view;
    for num in [3, 9, 16] {
        let (sweep, subframes) = both(&LensAndShutter { camera_at: &still, lens: Some(LENS) }, num, false);
        let shared = swept(&scene, &sweep, &settings(Quality::Final));
        let found = psnr_db(&shared.rgb, &exposed(&scene, &subframes, &settings(Quality::Final)).rgb);
        assert!(found > 48.0, "{num}: {found} dB");
    }
}

/// They used to be missing in all pictures, or cut at the borders of tiles.
#[test]
fn splats_that_a_dolly_passes_closely_are_in_the_pictures_that_show_them() {
    let mut scene = crowd(500, 4);
    let view = camera(203, 117);
    for depth in [0.03, 0.08, 0.14, 0.2] {
        let ahead = view.pose.rotation * DVec3::new(0.01, 0.005, depth);
        scene.means[0] = (view.pose.position + ahead - scene.origin).as_vec3();
        (scene.scales[0], scene.opacities[0]) = (glam::Vec3::splat(0.008), 0.9);
        let camera_at = |fraction: f64| {
            let mut camera = view;
            camera.pose.position += view.pose.rotation * DVec3::Z * 0.12 * (fraction - 0.5);
            camera
        };
        let (sweep, subframes) = both(&LensAndShutter { camera_at: &camera_at, lens: None }, 9, true);
        let settings = RenderSettings { near: 0.06, ..settings(Quality::Final) };
        let found = psnr_db(&swept(&scene, &sweep, &settings).rgb, &exposed(&scene, &subframes, &settings).rgb);
        assert!(found > 60.0, "{depth}: {found} dB");
    }
}

#[test]
fn the_spec_image_of_a_sweep_renders_every_picture_by_itself() {
    let scene = crowd(600, 3);
    let view = camera(64, 40);
    let camera_at = |fraction: f64| at(&view, "roll", fraction);
    let (sweep, subframes) = both(&LensAndShutter { camera_at: &camera_at, lens: None }, 3, true);
    let of =
        |quality: Quality| [swept(&scene, &sweep, &settings(quality)), exposed(&scene, &subframes, &settings(quality))];
    let [shared, apart] = of(Quality::Reference);
    // The middle comes first, so that the sums are rounded in another order.
    assert!(shared.rgb.iter().zip(&apart.rgb).all(|(a, b)| (a - b).abs() < 1e-5));
}

#[test]
fn a_sweep_without_motion_is_the_plain_picture() {
    let scene = crowd(2000, 5);
    let view = camera(150, 90);
    let still = |_: f64| view;
    let taken = LensAndShutter { camera_at: &still, lens: None };
    let plain = exposed(&scene, &[SubFrame::from(view)], &settings(Quality::Standard));
    let budget = Budget::of(Quality::Standard);
    let Sampling::Sweep(adaptive) = taken.sampling(9, (Between::Sharp, true), &budget) else {
        panic!("sharp samples share their projection")
    };
    let shared = swept(&scene, &adaptive, &settings(Quality::Standard));
    let clamped: Vec<f32> = plain.rgb.iter().map(|value| value.min(1.0)).collect();
    assert!(psnr_db(&shared.rgb, &clamped) > 80.0);
    // Every tile takes the middle alone. Splats at the borders of tiles have slack.
    let [shared, alone] = [&shared, &plain].map(|frame| frame.stats.counts.num_block_blends as f64);
    assert!(shared / alone < 1.01, "{shared} {alone}");
}

#[test]
fn tiles_take_as_many_samples_as_their_splats_move() {
    let near = crowd(1500, 8);
    // Looks the same, and moves less.
    let mut far = near.clone();
    far.means.iter_mut().chain(&mut far.scales).for_each(|value| *value *= 40.0);
    let view = camera(256, 128);
    let camera_at = |fraction: f64| at(&view, "truck", fraction);
    let taken = LensAndShutter { camera_at: &camera_at, lens: None };
    let budget = Budget::of(Quality::Standard);
    let Sampling::Sweep(adaptive) = taken.sampling(9, (Between::Sharp, true), &budget) else {
        panic!("sharp samples share their projection")
    };
    let even = taken.even_sweep(9, true);
    let blends = |scene: &Gaussians, sweep: &Sweep| {
        swept(scene, sweep, &settings(Quality::Standard)).stats.counts.num_block_blends as f64
    };
    let [of_near, of_far] = [&near, &far].map(|scene| blends(scene, &adaptive) / blends(scene, &even));
    assert!(of_far < 0.15 && of_near > 0.3, "{of_far} {of_near}");
}

#[test]
fn sweeps_have_the_same_bits_on_any_threads_and_instructions_and_in_bands() {
    let scene = crowd(4000, 11);
    let view = camera(203, 117);
    let camera_at = |fraction: f64| at(&view, "roll", fraction);
    let taken = LensAndShutter { camera_at: &camera_at, lens: Some(LENS) };
    let Sampling::Sweep(mut sweep) = taken.sampling(7, (Between::Sharp, true), &Budget::of(Quality::Standard)) else {
        panic!("sharp samples share their projection")
    };
    for blur in [SplatBlur::default(), SplatBlur { lens: Some(LENS), motion: None }] {
        sweep.blur = blur;
        let expected = swept(&scene, &sweep, &settings(Quality::Standard));
        for num_threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
            let frame = pool.install(|| swept(&scene, &sweep, &settings(Quality::Standard)));
            assert!(
                frame.rgb == expected.rgb && frame.transmittance == expected.transmittance,
                "{num_threads} threads"
            );
        }
        let scalar = RenderSettings { instructions: InstructionSet::Scalar, ..settings(Quality::Standard) };
        assert!(swept(&scene, &sweep, &scalar).rgb == expected.rgb);
        let mut rgb8 = Rgb8Frame::default();
        Renderer::new(&scene).sweep_rgb8_into(&sweep, &settings(Quality::Standard), &mut rgb8).unwrap();
        assert_eq!(rgb8.rgb8, expected.to_rgb8());
        assert_eq!(rgb8.stats.counts.num_subframes, 7);
        // The least memory that does not fail: half of what the picture takes at once is rendered in bands.
        let limits = |max_memory_bytes: u64| Limits { max_memory_bytes, ..Limits::default() };
        let tight = (16..40).find_map(|shift| {
            let settings = RenderSettings { limits: limits(3 << (shift - 1)), ..settings(Quality::Standard) };
            let mut frame = Frame::default();
            Renderer::new(&scene).sweep_into(&sweep, &settings, &mut frame).ok().map(|()| frame)
        });
        assert!(tight.unwrap().rgb == expected.rgb);
    }
}

#[test]
fn less_memory_or_more_threads_never_change_the_bytes_of_a_sweep() {
    let (scene, view) = (crowd(4000, 11), camera(203, 117));
    let camera_at = |fraction: f64| at(&view, "truck", fraction);
    let (sweep, _) = both(&LensAndShutter { camera_at: &camera_at, lens: Some(LENS) }, 7, true);
    let expected = swept(&scene, &sweep, &settings(Quality::Standard));
    let mut refused = 0;
    for num_threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
        // In steps of 2 %, so that some limits lie between what this picture takes and what each of its samples would
        // take.
        let mut bytes = 64e6;
        while bytes > 1e6 {
            bytes *= 0.98;
            let limits = Limits { max_memory_bytes: bytes as u64, ..Limits::default() };
            let settings = RenderSettings { limits, ..settings(Quality::Standard) };
            let mut frame = Frame::default();
            match pool.install(|| Renderer::new(&scene).sweep_into(&sweep, &settings, &mut frame)) {
                Ok(()) => assert!(frame.rgb == expected.rgb, "{bytes} bytes, {num_threads} threads"),
                Err(RenderError::Memory { .. }) => refused += 1,
                Err(error) => panic!("{error}"),
            }
        }
    }
    assert!(refused > 0);
}

#[test]
fn unusable_sweeps_are_errors() {
    let scene = crowd(10, 1);
    let (renderer, view) = (Renderer::new(&scene), camera(32, 32));
    let around = |camera: Camera| {
        let pattern = SweepPattern { up_to_px: 0.0, center_weight: 0.5, around: vec![(camera, 0.5)] };
        let sweep = Sweep { center: view, blur: SplatBlur::default(), ends: vec![camera], patterns: vec![pattern] };
        renderer.sweep_into(&sweep, &settings(Quality::Standard), &mut Frame::default())
    };
    let mut nowhere = view;
    nowhere.pose.position.x = f64::INFINITY;
    assert!(matches!(around(nowhere), Err(RenderError::Setting { .. })));
    assert!(matches!(around(camera(33, 32)), Err(RenderError::Length { .. })));
    assert!(around(view).is_ok());
}
