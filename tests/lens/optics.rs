use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::lens::{CalledEffect, EffectPlan, Moment, OpticsTrack, Picture, Take};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use glam::{DQuat, DVec3, Quat, Vec3};

use super::stand::{camera, effect, exposed, with_take};

fn settings() -> RenderSettings {
    RenderSettings { quality: Quality::Final, near: 0.01, ..RenderSettings::default() }
}

/// Small opaque balls of these colors at these places.
fn balls(places: &[(DVec3, Vec3)], radius: f32) -> Gaussians {
    let num = places.len();
    Gaussians {
        means: places.iter().map(|(place, _)| place.as_vec3()).collect(),
        scales: vec![Vec3::splat(radius); num],
        rotations: vec![Quat::IDENTITY; num],
        opacities: vec![0.99; num],
        sh_dc: places.iter().map(|(_, color)| (*color - 0.5) / 0.282_094_8).collect(),
        ..Gaussians::default()
    }
}

/// A frame of a camera at the origin that looks along z, with the world's up along -y.
fn seen(gaussians: &Gaussians, effects: &[CalledEffect], size_px: [u32; 2], rotation: DQuat) -> Picture {
    let renderer = Renderer::new(gaussians);
    let intrinsics = Intrinsics::from_fov_y(size_px[0], size_px[1], 0.9);
    let camera_at = |_: f64| Camera { pose: Pose::new(DVec3::ZERO, rotation), intrinsics };
    let optics = OpticsTrack::default();
    let take = Take { camera_at: &camera_at, optics: &optics, up: Some(DVec3::NEG_Y), fps: 10.0, seed: 0 };
    let plan = EffectPlan::of(effects, take, 0..1, (&renderer, &settings())).unwrap();
    plan.expose(&Moment::of_frame(take, 0, &settings()), &renderer).unwrap()
}

/// Mean position of the light of a channel, and its sum.
fn center(picture: &Picture, channel: usize) -> ([f64; 2], f64) {
    let frame = picture.frame();
    let (mut sum, mut at) = (0.0, [0.0, 0.0]);
    for (pixel, rgb) in frame.rgb.chunks_exact(3).enumerate() {
        let value = f64::from(rgb[channel]);
        sum += value;
        at[0] += value * ((pixel % frame.width as usize) as f64 + 0.5);
        at[1] += value * ((pixel / frame.width as usize) as f64 + 0.5);
    }
    (at.map(|part| part / sum), sum)
}

const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;
const BLUE: Vec3 = Vec3::Z;

#[test]
fn a_panorama_puts_every_direction_in_its_place() {
    let places = [(DVec3::X * 3.0, RED), (DVec3::Z * 3.0, GREEN), (-DVec3::X * 3.0, BLUE)];
    // A camera that looks down by 20 degrees and rolls: the horizon is level all the same.
    let tilted = DQuat::from_rotation_x(-0.35) * DQuat::from_rotation_z(0.2);
    for rotation in [DQuat::IDENTITY, tilted] {
        let picture = seen(&balls(&places, 0.05), &effect("panorama", &[]), [256, 128], rotation);
        for (channel, x) in [(0, 192.0), (1, 128.0), (2, 64.0)] {
            let ([found_x, found_y], _) = center(&picture, channel);
            assert!((found_x - x).abs() < 0.3 && (found_y - 64.0).abs() < 0.3, "{channel}: {found_x} {found_y}");
        }
    }
}

#[test]
fn a_panorama_has_no_seam_behind_and_covers_the_poles() {
    // A shell of balls all around: its picture is even everywhere.
    let mut places = Vec::new();
    for i in 0..6000 {
        let (z, turn) = (1.0 - 2.0 * (f64::from(i) + 0.5) / 6000.0, 2.399_963_23 * f64::from(i));
        let ring = (1.0 - z * z).sqrt();
        places.push((DVec3::new(ring * turn.cos(), ring * turn.sin(), z) * 2.0, Vec3::splat(0.6)));
    }
    let picture = seen(&balls(&places, 0.06), &effect("panorama", &[]), [256, 128], DQuat::IDENTITY);
    let at = |row: usize, column: usize| picture.frame().rgb[(row * 256 + column) * 3];
    for row in 0..128 {
        let (left, right) = (at(row, 0), at(row, 255));
        assert!((left - right).abs() < 0.02, "row {row}: {left} beside {right}");
        for column in 0..256 {
            assert!((at(row, column) - 0.6).abs() < 0.03, "{row} {column}: {}", at(row, column));
        }
    }
}

#[test]
fn a_fisheye_of_175_degrees_keeps_angles() {
    // Red 40 degrees to the right, green 80 degrees to the left: distances in the ratio of the angles.
    let at = |deg: f64| DVec3::new(deg.to_radians().sin(), 0.0, deg.to_radians().cos()) * 3.0;
    let picture = seen(
        &balls(&[(at(40.0), RED), (at(-80.0), GREEN)], 0.03),
        &effect("fisheye", &[("fov_deg", 175.0)]),
        [320, 96],
        DQuat::IDENTITY,
    );
    let corner = 0.5 * 320.0_f64.hypot(96.0);
    for (channel, deg) in [(0, 40.0), (1, -80.0)] {
        let ([x, y], _) = center(&picture, channel);
        let wanted = 160.0 + deg / 87.5 * corner;
        assert!((x - wanted).abs() < 0.5 && (y - 48.0).abs() < 0.5, "{x} instead of {wanted}");
    }
}

#[test]
fn opencv_distortion_shows_points_where_opencv_does() {
    // cv::projectPoints for k1 -0.1, k2 0.02, p1 0.003, p2 -0.002, k3 0.01: computed by hand from its equations.
    let point = DVec3::new(0.4, 0.25, 1.0);
    let (x, y) = (point.x, point.y);
    let r2: f64 = x * x + y * y;
    let radial = 1.0 - 0.1 * r2 + 0.02 * r2 * r2 + 0.01 * r2.powi(3);
    let shown = [
        x * radial + 2.0 * 0.003 * x * y - 0.002 * (r2 + 2.0 * x * x),
        y * radial + 0.003 * (r2 + 2.0 * y * y) - 2.0 * 0.002 * x * y,
    ];
    let lens = effect("lens-distortion", &[("k1", -0.1), ("k2", 0.02), ("p1", 0.003), ("p2", -0.002), ("k3", 0.01)]);
    let picture = seen(&balls(&[(point * 4.0, RED)], 0.02), &lens, [320, 180], DQuat::IDENTITY);
    let focal = Intrinsics::from_fov_y(320, 180, 0.9).fx_px;
    let ([found_x, found_y], _) = center(&picture, 0);
    let (wanted_x, wanted_y) = (160.0 + focal * shown[0], 90.0 + focal * shown[1]);
    assert!(
        (found_x - wanted_x).abs() < 0.3 && (found_y - wanted_y).abs() < 0.3,
        "{found_x} {found_y}, {wanted_x} {wanted_y}"
    );
}

#[test]
fn a_distortion_that_folds_the_picture_is_refused() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let folding = effect("lens-distortion", &[("k1", -0.9)]);
    let plan = with_take(&folding, [320, 180], |take| EffectPlan::of(&folding, take, 0..1, (&renderer, &settings())));
    assert!(plan.unwrap_err().to_string().contains("fold"));
}

#[test]
fn fog_mixes_by_distance_and_hides_what_is_infinitely_far() {
    let fog = effect("fog", &[("density", 0.5), ("red", 1.0), ("green", 1.0), ("blue", 1.0)]);
    let wall = |distance: f64| {
        let picture =
            seen(&balls(&[(DVec3::Z * distance, Vec3::ZERO)], 40.0 * distance as f32), &fog, [33, 33], DQuat::IDENTITY);
        f64::from(picture.frame().rgb[(16 * 33 + 16) * 3])
    };
    for distance in [0.5_f64, 2.0, 8.0] {
        // The wall covers 0.99 of the fog behind it.
        let wanted = 0.99 * (1.0 - (-0.5 * distance).exp()) + 0.01;
        assert!((wall(distance) - wanted).abs() < 2e-3, "{} at {distance}, expected {wanted}", wall(distance));
    }
    let nothing = seen(&Gaussians::default(), &fog, [8, 8], DQuat::IDENTITY);
    assert!(nothing.frame().rgb.iter().all(|value| (value - 1.0).abs() < 1e-6), "an empty view is all fog");
}

#[test]
fn fog_is_the_same_in_single_and_double_precision() {
    let scene = balls(&[(DVec3::Z * 2.0, RED), (DVec3::new(0.3, 0.2, 5.0), GREEN)], 0.3);
    let renderer = Renderer::new(&scene);
    let fog = Some(cinesplat::render::Fog { color: Vec3::new(0.7, 0.8, 0.9), density: 0.3 });
    let camera = Camera { pose: Pose::IDENTITY, ..camera([64, 36]) };
    let at = |quality| renderer.render(&camera, &RenderSettings { quality, fog, ..settings() }).unwrap();
    assert!(at(Quality::Final).psnr_db(&at(Quality::Reference)) > 100.0);
}

#[test]
fn a_rolling_shutter_skews_a_pan_and_leaves_a_still_camera_alone() {
    // An upright line of small balls.
    let line: Vec<(DVec3, Vec3)> = (-20..=20).map(|i| (DVec3::new(0.0, f64::from(i) * 0.05, 3.0), Vec3::ONE)).collect();
    let scene = balls(&line, 0.04);
    let renderer = Renderer::new(&scene);
    let shutter = effect("rolling-shutter", &[("readout", 1.0)]);
    let intrinsics = Intrinsics::from_fov_y(160, 120, 0.9);
    let optics = OpticsTrack::default();
    let planned = |speed: f64| {
        let camera_at =
            move |secs: f64| Camera { pose: Pose::new(DVec3::ZERO, DQuat::from_rotation_y(speed * secs)), intrinsics };
        let take = Take { camera_at: &camera_at, optics: &optics, up: None, fps: 10.0, seed: 0 };
        let plan = EffectPlan::of(&shutter, take, 0..1, (&renderer, &settings())).unwrap();
        let picture = plan.expose(&Moment::of_frame(take, 0, &settings()), &renderer).unwrap();
        (plan, picture)
    };
    let (still, _) = planned(0.0);
    assert!(still.is_plain(0), "a camera at rest has no skew");
    let (plan, picture) = planned(1.0);
    assert!(plan.num_samples(0) == 1 && plan.effects[0].losses()[0].samples > 10);
    // The camera turns right: the ball moves left, and further down it has moved further. 0.1 rad over the height.
    let middle_of = |row: usize| {
        let values = &picture.frame().rgb[row * 480..(row + 1) * 480];
        let sum: f64 = values.iter().step_by(3).map(|&v| f64::from(v)).sum();
        values.iter().step_by(3).enumerate().map(|(x, &v)| (x as f64 + 0.5) * f64::from(v)).sum::<f64>() / sum
    };
    let skew = middle_of(80) - middle_of(40);
    let wanted = -0.1 * 40.0 / 120.0 * intrinsics.fx_px;
    assert!((skew / wanted - 1.0).abs() < 0.1, "{skew} instead of {wanted}");
}

#[test]
fn color_fringes_point_outward() {
    let scene = balls(&[(DVec3::new(1.2, 0.0, 3.0), Vec3::ONE)], 0.02);
    let picture = seen(&scene, &effect("chromatic-aberration", &[("shift_px", 12.0)]), [320, 180], DQuat::IDENTITY);
    let [red, green, blue] = [0, 1, 2].map(|channel| center(&picture, channel).0[0]);
    assert!(red + 0.5 < green && green + 0.5 < blue, "{red} {green} {blue}");
}

#[test]
fn bloom_adds_light_around_bright_areas_and_none_to_dark_pictures() {
    let lamp = |brightness: f32| balls(&[(DVec3::Z * 3.0, Vec3::splat(brightness))], 0.1);
    let glow = |scene: &Gaussians| {
        let renderer = Renderer::new(scene);
        let light = |effects: &[CalledEffect]| -> f32 {
            exposed(effects, [160, 90], 0, (&renderer, &settings())).linear().rgb.iter().sum()
        };
        light(&effect("bloom", &[])) / light(&[])
    };
    assert!((glow(&lamp(0.4)) - 1.0).abs() < 1e-4);
    assert!(glow(&lamp(1.0)) > 1.05);
}

/// A film of all directions shows no pitch, roll or zoom: they used to blur it, and to be judged.
#[test]
fn a_360_film_is_blurred_by_a_pitch_that_it_does_not_show() {
    let scene = balls(&[(DVec3::Z * 3.0, RED), (DVec3::X * 3.0, GREEN), (DVec3::NEG_Z * 3.0, BLUE)], 0.05);
    let renderer = Renderer::new(&scene);
    let optics = OpticsTrack::default();
    let calls = ["panorama", "motion-blur"].map(|name| super::stand::call(name, &[]));
    let effects = super::stand::called(&calls, &cinesplat::lens::EffectChoice::Auto).effects;
    let still = effect("panorama", &[]);
    let frame = |effects: &[CalledEffect], turn: &(dyn Fn(f64) -> Camera + Sync)| {
        let take = Take { camera_at: turn, optics: &optics, up: Some(DVec3::NEG_Y), fps: 10.0, seed: 0 };
        let plan = EffectPlan::of(effects, take, 1..2, (&renderer, &settings())).unwrap();
        let picture = plan.expose(&Moment::of_frame(take, 1, &settings()), &renderer).unwrap();
        (plan, picture.frame().clone())
    };
    let camera = |rotation: DQuat, fov: f64| Camera {
        pose: Pose::new(DVec3::ZERO, rotation),
        intrinsics: Intrinsics::from_fov_y(256, 128, fov),
    };
    let pitching = |secs: f64| camera(DQuat::from_rotation_x(secs) * DQuat::from_rotation_z(2.0 * secs), 0.9);
    let zooming = |secs: f64| camera(DQuat::IDENTITY, 0.9 + secs);
    let panning = |secs: f64| camera(DQuat::from_rotation_y(secs), 0.9);
    for (motion, shows) in [
        (&pitching as &(dyn Fn(f64) -> Camera + Sync), false),
        (&zooming as &(dyn Fn(f64) -> Camera + Sync), false),
        (&panning as &(dyn Fn(f64) -> Camera + Sync), true),
    ] {
        let (plan, blurred) = frame(&effects, motion);
        let (_, sharp) = frame(&still, motion);
        assert_eq!(plan.effects[1].losses()[0].shows(), shows, "{:?}", plan.sentences());
        assert_eq!(blurred == sharp, !shows);
    }
    // Half a turn of 0.1 rad while the shutter is open, in pixels of the panorama.
    let (plan, _) = frame(&effects, &panning);
    let found = plan.effects[1].losses()[0].error;
    assert!((found / (0.05 * 256.0 / std::f64::consts::TAU) - 1.0).abs() < 0.05, "{found}");
}

/// A fisheye has a lens of its own: a zoom of the shot blurs nothing.
#[test]
fn a_fisheye_is_not_blurred_by_a_zoom() {
    let scene = balls(&[(DVec3::new(1.0, 0.5, 3.0), RED)], 0.05);
    let renderer = Renderer::new(&scene);
    let calls = ["fisheye", "motion-blur"].map(|name| super::stand::call(name, &[]));
    let effects = super::stand::called(&calls, &cinesplat::lens::EffectChoice::Auto).effects;
    let zooming =
        |secs: f64| Camera { pose: Pose::IDENTITY, intrinsics: Intrinsics::from_fov_y(160, 90, 0.5 + 0.5 * secs) };
    let optics = OpticsTrack::default();
    let take = Take { camera_at: &zooming, optics: &optics, up: None, fps: 10.0, seed: 0 };
    let plan = EffectPlan::of(&effects, take, 0..1, (&renderer, &settings())).unwrap();
    assert!(!plan.effects[1].losses()[0].shows(), "{:?}", plan.sentences());
}

#[test]
fn the_eyes_of_a_stereo_film_agree_at_the_distance_of_the_screen() {
    for (over_under, size) in [(0.0, [320, 90]), (1.0, [160, 180])] {
        let settings = [("over_under", over_under), ("screen_distance", 3.0), ("eye_distance", 0.1)];
        let stereo = effect("stereo", &settings);
        // One ball at the screen, one nearer, one farther; each has a channel of its own.
        let scene = balls(
            &[(DVec3::Z * 3.0, RED), (DVec3::new(0.0, 0.3, 1.5), GREEN), (DVec3::new(0.0, -1.2, 6.0), BLUE)],
            0.01,
        );
        let picture = seen(&scene, &stereo, size, DQuat::IDENTITY);
        let [width, height] = size.map(|len| len as usize);
        assert_eq!((picture.frame().width, picture.frame().height), (size[0], size[1]));
        let eyes = if over_under > 0.0 { [(0, 0), (0, height / 2)] } else { [(0, 0), (width / 2, 0)] };
        let part = if over_under > 0.0 { [width, height / 2] } else { [width / 2, height] };
        let places = eyes.map(|(left, top)| {
            [0, 1, 2].map(|channel| {
                let (mut sum, mut at) = (0.0, 0.0);
                for (y, x) in (0..part[1]).flat_map(|y| (0..part[0]).map(move |x| (y, x))) {
                    let value = f64::from(picture.frame().rgb[((top + y) * width + left + x) * 3 + channel]);
                    (sum, at) = (sum + value, at + value * (x as f64 + 0.5));
                }
                at / sum
            })
        });
        // What is nearer than the screen is farther right for the left eye: it stands out of the screen.
        let disparity = [0, 1, 2].map(|channel| places[0][channel] - places[1][channel]);
        let focal = Intrinsics::from_fov_y(size[0], size[1], 0.9).fx_px * part[0] as f64 / width as f64;
        for (found, distance) in disparity.into_iter().zip([3.0, 1.5, 6.0]) {
            let wanted = focal * 0.1 * (1.0 / distance - 1.0 / 3.0);
            assert!((found - wanted).abs() < 0.1, "{found} instead of {wanted} at {distance}");
        }
    }
}

/// The film of an anamorphic lens had round circles of confusion, whatever its documentation said.
#[test]
fn circles_of_confusion_of_an_anamorphic_lens_are_oval() {
    let scene = balls(&[(DVec3::Z * 4.0, Vec3::splat(0.3))], 0.01);
    let spread = |names: &[(&str, &[(&str, f64)])]| {
        let calls: Vec<_> = names.iter().map(|(name, values)| super::stand::call(name, values)).collect();
        let effects = super::stand::called(&calls, &cinesplat::lens::EffectChoice::Auto).effects;
        let picture = seen(&scene, &effects, [161, 161], DQuat::IDENTITY);
        let frame = picture.frame();
        let (mut sum, mut squares) = (0.0, [0.0; 2]);
        for (idx, rgb) in frame.rgb.chunks(3).enumerate() {
            let light = f64::from(rgb[0]).powf(2.2);
            sum += light;
            squares[0] += light * ((idx % 161) as f64 - 80.0).powi(2);
            squares[1] += light * ((idx / 161) as f64 - 80.0).powi(2);
        }
        squares.map(|square| (square / sum).sqrt())
    };
    let lens: (&str, &[(&str, f64)]) =
        ("depth-of-field", &[("f_stop", 0.3), ("focus_x", 0.0), ("focus_y", 0.0), ("focus_z", 1.0)]);
    let [width, height] = spread(&[lens]);
    assert!((width / height - 1.0).abs() < 0.05 && height > 3.0, "round: {width} {height}");
    let [width, height] = spread(&[lens, ("anamorphic", &[("squeeze", 2.0), ("streaks", 0.0)])]);
    assert!((height / width / 2.0 - 1.0).abs() < 0.15, "oval: {width} {height}");
}
