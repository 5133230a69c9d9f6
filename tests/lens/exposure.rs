//! The samples of shutter and lens.

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::lens::{
    Aperture, Between, Budget, LensAndShutter, MAX_SAMPLES, PlannedExposure, SENSOR_M, Sampling, focal_length_m,
};
use cinesplat::render::{Quality, RenderSettings, Renderer, SubFrame, ThinLens};
use cinesplat::scene::Gaussians;
use glam::{DVec2, DVec3, Quat, Vec3};

/// The view of a lens of 50 mm.
fn normal_lens() -> Camera {
    let fov_y_rad = 2.0 * (SENSOR_M * 9.0 / 16.0 / 2.0 / 0.05).atan();
    Camera { pose: Pose::IDENTITY, intrinsics: Intrinsics::from_fov_y(640, 360, fov_y_rad) }
}

/// A wall of splats at a depth of 2.
fn wall() -> Gaussians {
    let mut scene = Gaussians::default();
    for idx in 0..2500 {
        scene.means.push(Vec3::new((idx % 50 - 25) as f32 * 0.02, (idx / 50 - 25) as f32 * 0.02, 2.0));
        scene.scales.push(Vec3::splat(0.01));
        scene.rotations.push(Quat::IDENTITY);
        scene.opacities.push(0.9);
        scene.sh_dc.push(Vec3::ZERO);
    }
    scene
}

#[test]
fn circles_of_confusion_are_those_of_the_thin_lens() {
    let image = normal_lens().intrinsics;
    assert!((focal_length_m(&image) - 0.05).abs() < 1e-9);
    for (f_stop, focus, depth) in [(1.4, 2.0, 4.0), (2.8, 2.0, 1.5), (8.0, 5.0, 100.0)] {
        let lens = Aperture { f_stop, meters_per_unit: 1.0 }.lens(&image, focus);
        let found = lens.circle_px(image.fx_px, depth);
        // A textbook's circle on the sensor: f^2 / N |depth - focus| / (depth (focus - f)). This one has the sensor at
        // the distance f from the lens, not at that of the image of the plane of focus.
        let circle_m = 0.05 * 0.05 / f_stop * f64::abs(depth - focus) / (depth * (focus - 0.05));
        let expected = circle_m / SENSOR_M * 640.0;
        assert!((found / expected - 1.0).abs() < 0.03, "f/{f_stop}: {found}, expected {expected}");
    }
    // In units of 0.5 m all distances are twice as large, the circle is the same.
    let meters = Aperture { f_stop: 2.0, meters_per_unit: 1.0 }.lens(&image, 2.0).circle_px(image.fx_px, 3.0);
    let halves = Aperture { f_stop: 2.0, meters_per_unit: 0.5 }.lens(&image, 4.0).circle_px(image.fx_px, 6.0);
    assert!((meters - halves).abs() < 1e-9);
    assert_eq!(Aperture { f_stop: f64::INFINITY, meters_per_unit: 1.0 }.lens(&image, 2.0).aperture_diameter, 0.0);
}

#[test]
fn a_pinhole_of_the_lens_keeps_the_plane_of_focus_in_place() {
    let camera = Camera {
        pose: Pose::look_at(DVec3::new(1.0, 2.0, -3.0), DVec3::ZERO, DVec3::Y, None).unwrap(),
        ..normal_lens()
    };
    let lens = ThinLens { aperture_diameter: 0.3, focus_distance: 3.0, squeeze: 1.0 };
    let point_at = |depth: f64| camera.pose.position + camera.pose.rotation * DVec3::new(0.2, -0.1, depth);
    for point in [DVec2::X, DVec2::new(-0.3, 0.6)] {
        let seen = lens.pinhole(&camera, point);
        let offset =
            |depth| (seen.project(point_at(depth)).unwrap().0 - camera.project(point_at(depth)).unwrap().0).length();
        assert!(offset(3.0) < 1e-9);
        let expected = lens.circle_px(camera.intrinsics.fx_px, 1.5) / 2.0 * point.length();
        assert!((offset(1.5) / expected - 1.0).abs() < 1e-9);
    }
}

#[test]
fn moments_are_midpoints_and_blurred_parts_meet() {
    let camera_at =
        |fraction: f64| Camera { pose: Pose { position: DVec3::X * fraction, ..Pose::IDENTITY }, ..normal_lens() };
    let exposure = LensAndShutter { camera_at: &camera_at, lens: None };
    let places =
        |subframes: &[SubFrame]| subframes.iter().map(|frame| frame.camera.pose.position.x).collect::<Vec<_>>();
    assert_eq!(places(&exposure.subframes(4, Between::Sharp)), [0.125, 0.375, 0.625, 0.875]);
    assert_eq!(places(&exposure.subframes(1, Between::Blurred)), [0.5]);
    assert_eq!(places(&exposure.subframes(0, Between::Blurred)), [0.5]);
    let parts: Vec<[f64; 2]> = exposure
        .subframes(3, Between::Blurred)
        .iter()
        .map(|frame| frame.blur.motion.unwrap().map(|camera| camera.pose.position.x))
        .collect();
    assert_eq!((parts[0][0], parts[2][1]), (0.0, 1.0));
    assert!(parts.windows(2).all(|pair| pair[0][1] == pair[1][0]));
}

#[test]
fn lens_points_have_the_mean_and_variance_of_the_aperture() {
    let still = |_: f64| normal_lens();
    let lens = ThinLens { aperture_diameter: 2.0, focus_distance: f64::INFINITY, squeeze: 1.0 };
    let exposure = LensAndShutter { camera_at: &still, lens: Some(lens) };
    for num in [1, 3, 4, 5, 8, 16, 37, 256] {
        for between in [Between::Sharp, Between::Blurred] {
            let subframes = exposure.subframes(num, between);
            let points: Vec<DVec2> = subframes.iter().map(|frame| frame.camera.pose.position.truncate()).collect();
            let mean = points.iter().sum::<DVec2>() / num as f64;
            assert!(mean.length() < 1e-9, "{num}");
            // With the blur of each part, the variance of a disk of radius 1: 1 / 4 along any axis.
            let part = subframes[0].blur.lens.map_or(0.0, |lens| lens.aperture_diameter.powi(2) / 16.0);
            let of = |product: fn(&DVec2) -> f64| points.iter().map(product).sum::<f64>() / num as f64;
            let found = [of(|p| p.x * p.x) + part, of(|p| p.y * p.y) + part, of(|p| p.x * p.y)];
            if num > 1 || between == Between::Blurred {
                assert!((found[0] - 0.25).abs() + (found[1] - 0.25).abs() + found[2].abs() < 1e-9, "{num} {found:?}");
            }
            assert!(points.iter().all(|point| point.length() < 1.3), "{num}");
        }
    }
}

#[test]
fn a_static_frame_takes_one_plain_picture_and_blur_as_many_samples_as_it_needs() {
    let scene = wall();
    let renderer = Renderer::new(&scene);
    let camera = normal_lens();
    let is_sharp = |plan: &PlannedExposure| match &plan.sampling {
        Sampling::SubFrames(subframes) => subframes.iter().all(|subframe| subframe.blur.is_none()),
        Sampling::Sweep(sweep) => sweep.blur.is_none(),
    };
    for quality in [Quality::Draft, Quality::Standard, Quality::Final] {
        let settings = RenderSettings { quality, ..RenderSettings::default() };
        let budget = Budget::of(quality);
        // Blur of `motion_px` and `circle_px` on the wall.
        let plan = |motion_px: f64, circle_px: f64| {
            let camera_at = |fraction: f64| {
                let shift = DVec3::X * (fraction - 0.5) * motion_px * 2.0 / camera.intrinsics.fx_px;
                Camera { pose: Pose { position: shift, ..camera.pose }, ..camera }
            };
            let aperture_diameter = circle_px * 2.0 / camera.intrinsics.fx_px;
            let lens = Some(ThinLens { aperture_diameter, focus_distance: f64::INFINITY, squeeze: 1.0 });
            LensAndShutter { camera_at: &camera_at, lens }.plan(&renderer, &settings).unwrap()
        };
        let plain = Sampling::SubFrames(vec![SubFrame::from(camera)]);
        assert_eq!(plan(0.0, 0.0).sampling, plain);
        let below = budget.blur_px * 0.98;
        assert_eq!(plan(below, below).sampling, plain);
        let above = budget.blur_px * 1.02;
        let moving = plan(above, below);
        // One step takes two samples, and one in the middle. All are sharp.
        assert_eq!((moving.sampling.num_samples(), moving.blurs), (3, [true, false]));
        assert!((moving.extent.motion_px / above - 1.0).abs() < 0.01);
        assert!(is_sharp(&moving));
        let open = plan(below, above);
        assert_eq!((open.sampling.num_samples(), open.blurs), (4, [false, true]));
        assert!(is_sharp(&open));
        // The largest numbers of samples leave gaps, over which the splats are blurred.
        let [most_motion, most_lens] = budget.max_samples;
        let wide = plan(1e6, 0.0);
        assert_eq!((wide.sampling.num_samples(), is_sharp(&wide)), (most_motion as usize, false));
        let open = plan(0.0, 300.0);
        assert_eq!((open.sampling.num_samples(), is_sharp(&open)), (most_lens as usize, false));
        assert!(most_motion.max(most_lens) <= MAX_SAMPLES);
        if quality != Quality::Draft {
            let few = plan(budget.motion_step_px * 3.5, 0.0);
            assert_eq!((few.sampling.num_samples(), is_sharp(&few)), (5, true));
            let few = plan(0.0, budget.circle_step_px * 2.9);
            assert_eq!((few.sampling.num_samples(), is_sharp(&few)), (9, true));
        }
    }
}

/// A ring integrates polynomials over the disk: the mean of x^i y^j is that of the disk, to the third degree with five
/// points, and to the fifth with seven.
#[test]
fn rings_of_samples_have_the_moments_of_the_aperture() {
    let still = |_: f64| normal_lens();
    let lens = ThinLens { aperture_diameter: 2.0, focus_distance: f64::INFINITY, squeeze: 1.0 };
    let exposure = LensAndShutter { camera_at: &still, lens: Some(lens) };
    for (num, degree) in [(4, 2), (5, 3), (6, 4), (7, 5)] {
        let sweep = exposure.even_sweep(num, false);
        let pattern = &sweep.patterns[0];
        let points = pattern.around.iter().map(|(camera, weight)| (camera.pose.position.truncate(), *weight));
        let points: Vec<(DVec2, f64)> = points.chain([(DVec2::ZERO, pattern.center_weight)]).collect();
        assert_eq!(points.len(), num);
        for (i, j) in (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j))) {
            // Means of x^i y^j over the unit disk; odd ones are 0.
            let wanted = match (i, j) {
                (0, 0) => 1.0,
                (2, 0) | (0, 2) => 0.25,
                (4, 0) | (0, 4) => 0.125,
                (2, 2) => 1.0 / 24.0,
                _ => 0.0,
            };
            let found: f64 = points.iter().map(|(p, weight)| weight * p.x.powi(i) * p.y.powi(j)).sum();
            assert!((found - wanted).abs() < 1e-9, "{num}: x^{i} y^{j} {found}");
        }
    }
}
