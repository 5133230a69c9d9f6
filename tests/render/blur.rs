//! Depth of field and motion blur. The oracles: 1024 sharp pictures, the second renderer in `f64`, moments of one splat's
//! picture, and formulas of optics.

use cinesplat::geometry::{Camera, Pose};
use cinesplat::lens::{Between, LensAndShutter};
use cinesplat::render::{
    Accuracy, Frame, InstructionSet, Quality, RenderError, RenderSettings, Renderer, Rgb8Frame, SplatBlur, SubFrame,
    ThinLens,
};
use cinesplat::scene::{Gaussians, SplatFilter};
use glam::{DQuat, DVec2, DVec3, Quat, Vec3};

use super::pictures::{max_difference, psnr_db};
use super::scenes::{camera, crowd, moved, push, single};

fn settings(quality: Quality) -> RenderSettings {
    RenderSettings { quality, near: 0.01, ..RenderSettings::default() }
}

fn exposed(scene: &Gaussians, subframes: &[SubFrame], settings: &RenderSettings) -> Frame {
    let mut frame = Frame::default();
    Renderer::new(scene).expose_into(subframes, settings, &mut frame).unwrap();
    frame
}

fn lens(aperture_diameter: f64, focus_distance: f64) -> ThinLens {
    ThinLens { aperture_diameter, focus_distance, squeeze: 1.0 }
}

fn through(lens: ThinLens) -> SplatBlur {
    SplatBlur { lens: Some(lens), motion: None }
}

/// Motion over the shutter of a camera: truck, turn, roll and zoom.
fn at(camera: &Camera, motion: &str, fraction: f64) -> Camera {
    let amount = fraction - 0.5;
    let mut at = *camera;
    match motion {
        "truck" => at.pose.position += DVec3::X * 0.1 * amount,
        "dolly" => at.pose.position += DVec3::Z * 0.2 * amount,
        "pan" => at.pose.rotation *= DQuat::from_rotation_y(0.04 * amount),
        "roll" => at.pose.rotation *= DQuat::from_rotation_z(0.08 * amount),
        "zoom" => {
            at.intrinsics.fx_px *= (0.08 * amount).exp();
            at.intrinsics.fy_px *= (0.08 * amount).exp();
        }
        _ => {}
    }
    at
}

const MOTIONS: [&str; 5] = ["truck", "dolly", "pan", "roll", "zoom"];

/// A wall of splats of opacity 0.9, 1.5 standard deviations apart, that fills the view of [`camera`].
fn wall() -> Gaussians {
    let mut scene = Gaussians::default();
    let deviation = 0.02;
    for row in -80..80 {
        for column in -120..120 {
            let mean = Vec3::new(column as f32, row as f32, 0.0) * 1.5 * deviation + Vec3::Z * 2.0;
            push(&mut scene, mean, Vec3::splat(deviation), Quat::IDENTITY, (0.9, Vec3::ZERO));
        }
    }
    scene
}

#[test]
fn blur_of_nothing_is_the_plain_picture_bit_by_bit_with_the_same_work() {
    let scene = crowd(3000, 5);
    let (renderer, view) = (Renderer::new(&scene), camera(203, 117));
    let same = Some([view, view]);
    let blurs = [
        SplatBlur::default(),
        through(lens(0.0, 2.0)),
        SplatBlur { lens: None, motion: same },
        SplatBlur { lens: Some(lens(0.0, f64::INFINITY)), motion: same },
    ];
    for quality in [Quality::Draft, Quality::Standard, Quality::Final, Quality::Reference] {
        let plain = renderer.render(&view, &settings(quality)).unwrap();
        let mut rgb8 = Rgb8Frame::default();
        for blur in blurs {
            let subframes = [SubFrame { camera: view, blur }];
            let mut frame = Frame::default();
            renderer.expose_into(&subframes, &settings(quality), &mut frame).unwrap();
            renderer.expose_rgb8_into(&subframes, &settings(quality), &mut rgb8).unwrap();
            assert!(frame.rgb == plain.rgb && frame.transmittance == plain.transmittance, "{quality} {blur:?}");
            assert_eq!(rgb8.rgb8, plain.to_rgb8());
            assert_eq!(frame.stats.counts, plain.stats.counts);
            assert_eq!(rgb8.stats.counts, plain.stats.counts);
        }
        assert_eq!(plain.stats.counts.num_subframes, 1);
    }
}

#[test]
fn blurred_splats_match_those_of_the_renderer_in_f64() {
    let scene = crowd(600, 2);
    let view = camera(131, 77);
    let ends = |motion| Some([at(&view, motion, 0.0), at(&view, motion, 1.0)]);
    for filter in [SplatFilter::Classic, SplatFilter::MipSmall] {
        for motion in [None, ends("truck"), ends("roll"), ends("zoom"), ends("dolly")] {
            for lens in [None, Some(lens(0.05, 3.0)), Some(lens(0.6, f64::INFINITY))] {
                let subframes = [SubFrame { camera: view, blur: SplatBlur { lens, motion } }];
                let with = |quality| exposed(&scene, &subframes, &RenderSettings { filter, ..settings(quality) });
                let exact = with(Quality::Reference);
                for (quality, least_db) in [(Quality::Final, 80.0), (Quality::Standard, 50.0)] {
                    let found = psnr_db(&with(quality).rgb, &exact.rgb);
                    assert!(found > least_db, "{filter:?} {quality} {lens:?} {}: {found}", motion.is_some());
                }
            }
        }
    }
}

#[test]
fn an_opaque_wall_out_of_focus_does_not_let_the_background_through() {
    let scene = wall();
    let view = camera(160, 90);
    let behind = |quality| RenderSettings { background: Vec3::ONE, ..settings(quality) };
    // The wall's mean transmittance without blur, and its largest one.
    let leak = |frame: &Frame| {
        let sum: f32 = frame.transmittance.iter().sum();
        (sum / frame.transmittance.len() as f32, frame.transmittance.iter().copied().fold(0.0, f32::max))
    };
    for quality in [Quality::Standard, Quality::Final] {
        let (sharp, sharp_most) = leak(&exposed(&scene, &[SubFrame::from(view)], &behind(quality)));
        for circle_px in [1.0, 4.0, 12.0, 40.0] {
            let aperture = circle_px * 2.0 / view.intrinsics.fx_px;
            let blur = through(lens(aperture, f64::INFINITY));
            let (mean, most) = leak(&exposed(&scene, &[SubFrame { camera: view, blur }], &behind(quality)));
            assert!(mean <= sharp + 0.002, "{quality} {circle_px} px: {mean} through a wall of {sharp}");
            assert!(most <= sharp_most + 0.01, "{quality} {circle_px} px: {most} through a wall of {sharp_most}");
        }
        for motion in MOTIONS {
            let blur = SplatBlur { lens: None, motion: Some([at(&view, motion, 0.0), at(&view, motion, 1.0)]) };
            let (mean, _) = leak(&exposed(&scene, &[SubFrame { camera: view, blur }], &behind(quality)));
            assert!(mean <= sharp + 0.002, "{quality} {motion}: {mean} through a wall of {sharp}");
        }
    }
}

/// Total, mean and variances (x, y, covariance) of the optical depth of a picture.
fn moments(frame: &Frame) -> (f64, DVec2, [f64; 3]) {
    let depth = |idx: usize| -f64::from(frame.transmittance[idx]).ln();
    let place = |idx: usize| DVec2::new(f64::from(idx as u32 % frame.width), f64::from(idx as u32 / frame.width)) + 0.5;
    let all = || (0..frame.transmittance.len()).map(|idx| (depth(idx), place(idx)));
    let total: f64 = all().map(|(depth, _)| depth).sum();
    let mean = all().map(|(depth, place)| place * depth).sum::<DVec2>() / total;
    let of = |product: fn(DVec2) -> f64| all().map(|(depth, place)| product(place - mean) * depth).sum::<f64>() / total;
    (total, mean, [of(|p| p.x * p.x), of(|p| p.y * p.y), of(|p| p.x * p.y)])
}

#[test]
fn a_splat_out_of_focus_keeps_its_optical_depth() {
    let view = camera(240, 240);
    for (opacity, scale) in [(0.99, 0.02), (0.9, 0.05), (0.3, 0.03)] {
        let scene = single(Vec3::new(0.0, 0.0, 2.0), Vec3::new(scale, scale * 0.4, scale), Quat::IDENTITY, opacity);
        let picture = |blur| exposed(&scene, &[SubFrame { camera: view, blur }], &settings(Quality::Final));
        let (sharp, ..) = moments(&picture(SplatBlur::default()));
        for aperture in [0.01, 0.05, 0.2] {
            let (total, ..) = moments(&picture(through(lens(aperture, f64::INFINITY))));
            assert!((total / sharp - 1.0).abs() < 0.04, "opacity {opacity}, aperture {aperture}: {total} of {sharp}");
        }
    }
}

#[test]
fn blur_has_the_variance_of_its_disk_and_of_its_line() {
    let view = camera(160, 160);
    let scene = single(Vec3::new(0.1, -0.05, 2.0), Vec3::splat(0.01), Quat::IDENTITY, 0.05);
    let accuracy = Some(Accuracy { alpha_cut: 1e-6, ..Accuracy::SPEC });
    let fine = RenderSettings { accuracy, ..settings(Quality::Final) };
    let of = |blur| moments(&exposed(&scene, &[SubFrame { camera: view, blur }], &fine));
    let (_, center, [x, y, xy]) = of(SplatBlur::default());
    let focal = view.intrinsics.fx_px;

    let circle = focal * 0.08 * (1.0 / 2.0 - 1.0 / 5.0);
    let (_, mean, [blurred_x, blurred_y, _]) = of(through(lens(0.08, 5.0)));
    assert!((mean - center).length() < 1e-3);
    assert!((blurred_x - x - circle * circle / 16.0).abs() < 0.01, "{blurred_x} {x} {circle}");
    assert!((blurred_y - y - circle * circle / 16.0).abs() < 0.01);

    let ends = [DVec3::new(-0.05, -0.02, 0.0), DVec3::new(0.05, 0.02, 0.0)].map(|place| moved(&view, place));
    let motion = DVec2::new(0.1, 0.04) * focal / 2.0;
    let (_, mean, found) = of(SplatBlur { lens: None, motion: Some(ends) });
    assert!((mean - center).length() < 1e-3);
    let expected = [x + motion.x * motion.x / 12.0, y + motion.y * motion.y / 12.0, xy + motion.x * motion.y / 12.0];
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 0.03),
        "{found:?} {expected:?}"
    );
}

#[test]
fn what_is_in_focus_stays_sharp() {
    let view = camera(160, 90);
    let scene = crowd(400, 9);
    let flat = Gaussians {
        means: scene.means.iter().map(|mean| Vec3::new(mean.x / mean.z * 3.0, mean.y / mean.z * 3.0, 3.0)).collect(),
        ..scene
    };
    let picture = |blur| exposed(&flat, &[SubFrame { camera: view, blur }], &settings(Quality::Final));
    let difference = max_difference(&picture(through(lens(0.5, 3.0))).rgb, &picture(SplatBlur::default()).rgb);
    assert!(difference < 2e-3, "{difference}");
}

#[test]
fn blurred_splats_come_close_to_a_thousand_sharp_pictures() {
    let scene = crowd(1200, 3);
    let view = camera(160, 90);
    let renderer = Renderer::new(&scene);
    let picture = |subframes: &[SubFrame], quality| {
        let mut frame = Frame::default();
        renderer.expose_into(subframes, &settings(quality), &mut frame).unwrap();
        frame
    };
    let compare = |name: &str, exposure: &LensAndShutter<'_>, least_db: [f64; 2]| {
        let reference = picture(&exposure.subframes(1024, Between::Sharp), Quality::Final);
        let plain = picture(&[SubFrame::from(exposure.camera())], Quality::Final);
        for (num_samples, least_db) in [1, 8].into_iter().zip(least_db) {
            let blurred = picture(&exposure.subframes(num_samples, Between::Blurred), Quality::Final);
            let (found, without) = (blurred.psnr_db(&reference), plain.psnr_db(&reference));
            assert!(found > least_db && found > without + 3.0, "{name} {num_samples}: {found} dB, plain {without} dB");
            // No darkening.
            let mean = |frame: &Frame| frame.rgb.iter().sum::<f32>() / frame.rgb.len() as f32;
            let (bright, expected) = (mean(&blurred), mean(&reference));
            assert!((bright - expected).abs() < 0.01, "{name} {num_samples}: mean {bright}, expected {expected}");
        }
    };
    for motion in MOTIONS {
        let camera_at = |fraction: f64| at(&view, motion, fraction);
        compare(motion, &LensAndShutter { camera_at: &camera_at, lens: None }, [34.0, 46.0]);
    }
    let still = |_: f64| view;
    compare("lens", &LensAndShutter { camera_at: &still, lens: Some(lens(0.05, 3.0)) }, [34.0, 40.0]);
    let camera_at = |fraction: f64| at(&view, "pan", fraction);
    compare("both", &LensAndShutter { camera_at: &camera_at, lens: Some(lens(0.05, 3.0)) }, [33.0, 40.0]);
}

#[test]
fn a_point_out_of_focus_is_a_round_disk_of_lens_samples() {
    let view = camera(160, 160);
    let scene = single(Vec3::new(0.0, 0.0, 2.0), Vec3::splat(0.002), Quat::IDENTITY, 0.9);
    let still = |_: f64| view;
    let exposure = LensAndShutter { camera_at: &still, lens: Some(lens(0.3, 8.0)) };
    let radius = view.intrinsics.fx_px * 0.3 * (1.0 / 2.0 - 1.0 / 8.0) / 2.0;
    let frame = exposed(&scene, &exposure.subframes(1024, Between::Sharp), &settings(Quality::Final));
    let covered = |idx: usize| 1.0 - f64::from(frame.transmittance[idx]);
    let place = |idx: usize| DVec2::new((idx % 160) as f64, (idx / 160) as f64) + 0.5 - 80.0;
    let sum = |of: &dyn Fn(DVec2) -> f64| (0..160 * 160).map(|idx| covered(idx) * of(place(idx))).sum::<f64>();
    let total = sum(&|_| 1.0);
    let mean = DVec2::new(sum(&|p| p.x), sum(&|p| p.y)) / total;
    assert!(mean.length() < 0.05, "{mean}");
    let variance = sum(&|p| p.x * p.x) / total;
    assert!((variance / (radius * radius / 4.0) - 1.0).abs() < 0.03, "{variance} {radius}");
    assert!((sum(&|p| p.y * p.y) / total / variance - 1.0).abs() < 0.01);
    // A square has cos(4 angle) of -0.2 or 0.2 in this moment.
    let four = sum(&|p| p.x.powi(4) - 6.0 * (p.x * p.y).powi(2) + p.y.powi(4)) / sum(&|p| p.length_squared().powi(2));
    assert!(four.abs() < 0.02, "{four}");
    // Uniform: no bright rim or center.
    let inside = sum(&|p| f64::from(u8::from(p.length() < radius / 2.0))) / total;
    assert!((inside - 0.25).abs() < 0.02, "{inside}");
}

#[test]
fn extreme_lenses_and_shutters_give_finite_pictures() {
    let scene = crowd(500, 7);
    let view = camera(97, 55);
    let lenses = [1e-9, 0.0005, 0.5, 50.0, 1e6]
        .into_iter()
        .flat_map(|aperture| [1e-6, 0.01, 0.5, 4.0, 1e4, f64::INFINITY].map(|focus| lens(aperture, focus)));
    let mut blurs: Vec<SplatBlur> = lenses.map(through).collect();
    let far = |distance: f64| Some([moved(&view, DVec3::Z * -distance), moved(&view, DVec3::Z * distance)]);
    // From 3 on, splats cross the near plane.
    blurs.extend([0.01, 3.0, 100.0, 1e9].map(|distance| SplatBlur { lens: None, motion: far(distance) }));
    let turned = Camera { pose: Pose::new(DVec3::ZERO, DQuat::from_rotation_y(3.0)), ..view };
    blurs.push(SplatBlur { lens: Some(lens(0.1, 2.0)), motion: Some([view, turned]) });
    for near in [0.0, 0.01] {
        for blur in &blurs {
            for quality in [Quality::Standard, Quality::Final, Quality::Reference] {
                let subframes = [SubFrame { camera: view, blur: *blur }];
                let frame = exposed(&scene, &subframes, &RenderSettings { near, ..settings(quality) });
                let is_fine = |value: &f32| value.is_finite() && *value >= 0.0;
                assert!(frame.rgb.iter().all(is_fine), "{quality} {blur:?}");
                let rest = frame.transmittance.iter();
                assert!(rest.clone().all(|rest| (0.0..=1.0).contains(rest)), "{quality} {blur:?}");
            }
        }
    }
}

#[test]
fn exposures_have_the_same_bits_on_any_threads_and_instructions() {
    let scene = crowd(4000, 11);
    let view = camera(203, 117);
    let camera_at = |fraction: f64| at(&view, "roll", fraction);
    let subframes =
        LensAndShutter { camera_at: &camera_at, lens: Some(lens(0.03, 2.5)) }.subframes(3, Between::Blurred);
    let expected = exposed(&scene, &subframes, &settings(Quality::Standard));
    for num_threads in [1, 2, 3, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
        let frame = pool.install(|| exposed(&scene, &subframes, &settings(Quality::Standard)));
        assert!(frame.rgb == expected.rgb && frame.transmittance == expected.transmittance, "{num_threads} threads");
    }
    for instructions in [InstructionSet::Avx2, InstructionSet::Scalar] {
        let frame = exposed(&scene, &subframes, &RenderSettings { instructions, ..settings(Quality::Standard) });
        assert!(frame.rgb == expected.rgb && frame.transmittance == expected.transmittance, "{instructions}");
    }
    let mut rgb8 = Rgb8Frame::default();
    Renderer::new(&scene).expose_rgb8_into(&subframes, &settings(Quality::Standard), &mut rgb8).unwrap();
    assert_eq!(rgb8.rgb8, expected.to_rgb8());
    assert_eq!(rgb8.stats.counts.num_subframes, 3);
}

#[test]
fn pictures_average_as_light() {
    // One camera sees a white splat, the other one nothing.
    let scene = single(Vec3::new(0.0, 0.0, 2.0), Vec3::splat(5.0), Quat::IDENTITY, 1.0);
    let view = camera(32, 32);
    let away = Camera { pose: Pose::new(DVec3::new(0.0, 0.0, 100.0), DQuat::IDENTITY), ..view };
    let subframes = [SubFrame::from(view), SubFrame::from(away)];
    let to_light = |value: f64| ((value + 0.055) / 1.055).powf(2.4);
    let from_light = |light: f64| 1.055 * light.powf(1.0 / 2.4) - 0.055;
    for quality in [Quality::Final, Quality::Reference] {
        let white = f64::from(exposed(&scene, &subframes[..1], &settings(quality)).rgb[0]);
        let found = f64::from(exposed(&scene, &subframes, &settings(quality)).rgb[0]);
        assert!((found - from_light(to_light(white) / 2.0)).abs() < 1e-4, "{found} of {white}");
    }
    // The mean of equal pictures is the picture.
    let scene = crowd(500, 4);
    for resolution_frac in [1.0, 0.5] {
        let accuracy = Some(Accuracy { resolution_frac, ..Accuracy::SPEC });
        let settings = RenderSettings { accuracy, ..settings(Quality::Final) };
        let one = exposed(&scene, &[SubFrame::from(view)], &settings);
        let three = exposed(&scene, &[SubFrame::from(view); 3], &settings);
        let clamped: Vec<f32> = one.rgb.iter().map(|value| value.min(1.0)).collect();
        assert!(max_difference(&three.rgb, &clamped) < 2e-4 && three.rgb.iter().any(|value| *value > 0.5));
    }
}

#[test]
fn unusable_lenses_and_exposures_are_errors() {
    let scene = crowd(10, 1);
    let (renderer, view) = (Renderer::new(&scene), camera(32, 32));
    let expose =
        |subframes: &[SubFrame]| renderer.expose_into(subframes, &settings(Quality::Standard), &mut Frame::default());
    let apertures = [lens(f64::NAN, 1.0), lens(-1.0, 1.0), lens(f64::INFINITY, 1.0)];
    for lens in apertures.into_iter().chain([lens(1.0, 0.0), lens(1.0, -1.0), lens(1.0, f64::NAN)]) {
        let found = expose(&[SubFrame { camera: view, blur: through(lens) }]);
        assert!(matches!(found, Err(RenderError::Setting { .. })), "{lens:?}: {found:?}");
    }
    assert!(matches!(expose(&[]), Err(RenderError::Length { .. })));
    let subframes = [SubFrame::from(view), SubFrame::from(camera(33, 32))];
    assert!(matches!(expose(&subframes), Err(RenderError::Length { .. })));
}

#[test]
fn the_extent_of_blur_is_that_of_the_splats_in_the_picture() {
    let scene = crowd(20_000, 6);
    let (renderer, view) = (Renderer::new(&scene), camera(320, 180));
    let still = SplatBlur { lens: None, motion: Some([view, view]) };
    let extent = |blur: &SplatBlur| renderer.blur_extent(&view, blur, &settings(Quality::Standard)).unwrap();
    assert_eq!((extent(&still).circle_px, extent(&still).motion_px), (0.0, 0.0));
    let blur =
        SplatBlur { lens: Some(lens(0.02, 3.0)), motion: Some([at(&view, "truck", 0.0), at(&view, "truck", 1.0)]) };
    // By brute force over all means in the picture.
    let mut lengths: Vec<[f64; 2]> = Vec::new();
    for mean in scene.means.iter().map(glam::Vec3::as_dvec3) {
        let Some((px, depth)) = view.project(mean) else { continue };
        if px.x > 0.0 && px.x < 320.0 && px.y > 0.0 && px.y < 180.0 {
            let circle = view.intrinsics.fx_px * 0.02 * (1.0 / depth - 1.0 / 3.0).abs();
            lengths.push([circle, view.intrinsics.fx_px * 0.1 / depth]);
        }
    }
    let found = extent(&blur);
    for (axis, found) in [found.circle_px, found.motion_px].into_iter().enumerate() {
        let mut all: Vec<f64> = lengths.iter().map(|lengths| lengths[axis]).collect();
        all.sort_by(f64::total_cmp);
        let expected = all[all.len() * 99 / 100];
        assert!((found / expected - 1.0).abs() < 0.1, "{found}, expected {expected}");
    }
    assert!(found.num_splats > 1000);
}
