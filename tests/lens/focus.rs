//! Depth of field, rack focus and motion blur as effects of a shot.

use std::f64::consts::PI;

use cinesplat::lens::{Call, Called, CalledEffect, Calls, EffectChoice, EffectPlan, Moment, OpticsTrack, Take};
use cinesplat::render::{Frame, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{Easing, KeyOptics, Keyframe};
use glam::{DVec3, Quat, Vec3};

use super::stand::{call, called, camera, effect};

const SIZE: [u32; 2] = [160, 90];

/// A small board at a depth of 2 in front of a wall at a depth of 6, as [`camera`] sees them.
fn board() -> Gaussians {
    let mut scene = Gaussians::default();
    let mut add = |x: f32, y: f32, z: f32, scale: f32| {
        scene.means.push(Vec3::new(x, y, z));
        scene.scales.push(Vec3::splat(scale));
        scene.rotations.push(Quat::IDENTITY);
        scene.opacities.push(0.9);
        // Stripes of four splats. Their contrast is low: the mean of their light is nearly that of their colors.
        let is_bright = ((x / scale / 6.6).floor() + (y / scale / 6.6).floor()) as i32 % 2 == 0;
        let shade = if is_bright { 0.5 } else { -0.5 };
        scene.sh_dc.push(Vec3::new(shade, -shade, 0.3));
    };
    for row in -40..40_i16 {
        for column in -60..60_i16 {
            add(f32::from(column) * 0.1, f32::from(row) * 0.1, 4.0, 0.06);
            if row.abs() < 20 && column.abs() < 20 {
                add(f32::from(column) * 0.02, f32::from(row) * 0.02, 0.0, 0.012);
            }
        }
    }
    scene
}

fn key(time_secs: f64, cut: bool, focus_distance: Option<f64>) -> Keyframe {
    Keyframe {
        time_secs,
        pose: camera(SIZE).pose,
        fov_y_rad: 0.9,
        focus_distance,
        optics: KeyOptics::default(),
        easing: Easing::Linear,
        cut,
        intent: None,
    }
}

/// Calls `work` with a shot of 10 frames per second whose camera moves to the right at this speed.
fn with_shot<T>(speed: f64, keys: &[Keyframe], work: impl FnOnce(Take<'_>) -> T) -> T {
    let camera_at = |secs: f64| {
        let mut camera = camera(SIZE);
        camera.pose.position += DVec3::X * speed * secs;
        camera
    };
    let optics = OpticsTrack::new(keys);
    work(Take { camera_at: &camera_at, optics: &optics, up: None, fps: 10.0, seed: 7 })
}

fn plan_of(effects: &[CalledEffect], take: Take<'_>, renderer: &Renderer<'_>) -> EffectPlan {
    EffectPlan::of(effects, take, 0..3, (renderer, &RenderSettings::default())).unwrap()
}

fn frame_of(plan: &EffectPlan, take: Take<'_>, frame_idx: usize, renderer: &Renderer<'_>) -> Frame {
    let moment = Moment::of_frame(take, frame_idx, &RenderSettings::default());
    plan.expose(&moment, renderer).unwrap().frame().clone()
}

/// Mean absolute difference of a picture from the plain one, in the board and in the wall.
fn changes(frame: &Frame, plain: &Frame) -> [f64; 2] {
    let mut sums = [(0.0, 0); 2];
    for (idx, (a, b)) in frame.rgb.chunks(3).zip(plain.rgb.chunks(3)).enumerate() {
        let (x, y) = ((idx % SIZE[0] as usize) as f64 - 80.0, (idx / SIZE[0] as usize) as f64 - 45.0);
        let off_middle = f64::max(x.abs(), y.abs());
        // The board covers 18 px about the middle.
        let area = if off_middle < 12.0 {
            0
        } else if off_middle > 30.0 {
            1
        } else {
            continue;
        };
        sums[area].0 += a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
        sums[area].1 += 3;
    }
    sums.map(|(sum, num)| sum / f64::from(num))
}

#[test]
fn focus_lies_on_the_middle_of_the_first_frame_where_nothing_is_said() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    with_shot(0.0, &[], |take| {
        let plan = plan_of(&effect("depth-of-field", &[]), take, &renderer);
        let settings = plan.effects[0].settings();
        let value = |name: &str| settings.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).unwrap();
        assert!(value("focus_z").abs() < 0.02 && value("f_stop") > 0.1, "{settings:?}");
        let plain = renderer.render(&camera(SIZE), &RenderSettings::default()).unwrap();
        let [board, wall] = changes(&frame_of(&plan, take, 0, &renderer), &plain);
        assert!(board < 0.004 && wall > 4.0 * board, "{board} {wall}");
        // The words promise a circle of 1.8 % of the height at twice the focus distance, and 2.4 % at three times.
        let circle_px = plan.effects[0].losses()[0].error;
        assert!((circle_px / (0.024 * 90.0) - 1.0).abs() < 0.05, "{circle_px}");
    });
}

/// In a scene a hundred times as large, where a lens of f/0.1 on a sensor of 36 mm blurs nothing.
#[test]
fn a_very_shallow_focus_blurs_nothing_in_a_large_scene() {
    let mut scene = board();
    scene.means.iter_mut().for_each(|mean| *mean = (*mean + Vec3::Z * 2.0) * 300.0);
    scene.scales.iter_mut().for_each(|scale| *scale *= 300.0);
    let renderer = Renderer::new(&scene);
    let camera_at = |_: f64| cinesplat::geometry::Camera {
        pose: cinesplat::geometry::Pose::IDENTITY,
        intrinsics: camera(SIZE).intrinsics,
    };
    let optics = OpticsTrack::default();
    let take = Take { camera_at: &camera_at, optics: &optics, up: None, fps: 10.0, seed: 7 };
    let effects = effect("depth-of-field", &[]);
    let plan = plan_of(&effects, take, &renderer);
    // As in the small scene: 1.8 % of the height at twice the distance in focus, 2.4 % at three times.
    let circle_px = plan.effects[0].losses()[0].error;
    assert!((circle_px / (0.024 * 90.0) - 1.0).abs() < 0.05, "{circle_px}");
    let said = &plan.effects[0].because;
    assert!(said.starts_with("the test: f/0.0") && said.ends_with("of 3.2 px infinitely far away"), "{said}");
}

#[test]
fn keyframes_pull_the_focus_with_easing_and_not_across_a_cut() {
    let track = OpticsTrack::new(&[key(0.0, false, Some(2.0)), key(1.0, false, Some(6.0)), key(2.0, true, Some(4.0))]);
    let at = |secs: f64| track.focus_distance(secs).unwrap();
    assert_eq!((at(0.0), at(2.0), at(9.0)), (2.0, 4.0, 4.0));
    assert!((at(1.0) - 6.0).abs() < 1e-12 && (at(1.9) - 6.0).abs() < 1e-12);
    // Half way on the ring of the lens.
    assert!((at(0.5) - 3.0).abs() < 1e-12);
    // It starts and ends gently.
    assert!(at(0.01) - 2.0 < 0.001 && 6.0 - at(0.99) < 0.01);
    assert!((0..100).all(|step| at(f64::from(step) / 100.0) <= at(f64::from(step + 1) / 100.0)));
}

#[test]
fn a_rack_focus_sharpens_the_wall_and_blurs_the_board() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    let keys = [key(0.0, false, Some(2.0)), key(0.2, false, Some(6.0))];
    let calls = [call("rack-focus", &[]), call("depth-of-field", &[("f_stop", 0.5)])];
    let effects = called(&calls, &EffectChoice::Auto).effects;
    assert_eq!(effects.iter().map(|effect| effect.name).collect::<Vec<_>>(), ["rack-focus"]);
    with_shot(0.0, &keys, |take| {
        let plan = plan_of(&effects, take, &renderer);
        assert!(plan.effects[0].settings().contains(&("f_stop", 0.5)));
        let plain = renderer.render(&camera(SIZE), &RenderSettings::default()).unwrap();
        let [near_board, near_wall] = changes(&frame_of(&plan, take, 0, &renderer), &plain);
        let [far_board, far_wall] = changes(&frame_of(&plan, take, 2, &renderer), &plain);
        assert!(
            near_board < 0.25 * far_board && far_wall < 0.25 * near_wall,
            "{near_board} {near_wall} {far_board} {far_wall}"
        );
    });
}

#[test]
fn fields_of_keyframes_call_for_the_lens_and_the_shutter() {
    let names = |optics: KeyOptics, focus_distance: Option<f64>| {
        let keys = [Keyframe { optics, ..key(0.0, false, focus_distance) }];
        let calls = cinesplat::lens::Calls {
            calls: &[],
            forbidden: &[],
            moves: &[],
            keyframes: &keys,
            scene_size: 1.0,
            seed: 0,
        };
        let called = cinesplat::lens::Called::of(&EffectChoice::Auto, &calls);
        called.effects.iter().map(|effect| effect.name).collect::<Vec<_>>()
    };
    let none = KeyOptics::default();
    assert!(names(none, None).is_empty());
    assert_eq!(names(none, Some(2.0)), ["depth-of-field"]);
    assert_eq!(names(KeyOptics { f_stop: Some(2.0), ..none }, None), ["depth-of-field"]);
    assert_eq!(names(KeyOptics { shutter_angle_rad: Some(PI), ..none }, None), ["motion-blur"]);
    assert!(names(KeyOptics { shutter_angle_rad: Some(0.0), ..none }, None).is_empty());
    let closed = called(&[call("motion-blur", &[("shutter_angle_deg", 0.0)])], &EffectChoice::Auto);
    assert!(closed.effects.is_empty() && closed.unmet.len() == 1);
}

#[test]
fn a_shutter_ends_at_cuts() {
    let track = OpticsTrack::new(&[key(0.0, false, None), key(1.0, true, None), key(2.0, false, None)]);
    assert_eq!(track.uncut(0.5, [0.4, 0.6]), [0.4, 0.6]);
    assert_eq!(track.uncut(1.0, [0.9, 1.1]), [1.0, 1.1]);
    let [opens, closes] = track.uncut(0.95, [0.85, 1.05]);
    assert!(opens == 0.85 && closes < 1.0 && closes > 0.999_999);
    assert_eq!(track.uncut(2.0, [1.9, 2.1]), [1.9, 2.1]);
}

#[test]
fn a_camera_at_rest_has_no_motion_blur_and_a_moving_one_that_of_its_shutter() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    let angle = |angle_deg: f64| effect("motion-blur", &[("shutter_angle_deg", angle_deg)]);
    with_shot(0.0, &[], |take| assert!(plan_of(&angle(180.0), take, &renderer).is_plain(1)));
    let focal_px = camera(SIZE).intrinsics.fx_px;
    for angle_deg in [90.0, 180.0, 360.0] {
        let effects = angle(angle_deg);
        with_shot(1.0, &[], |take| {
            let plan = plan_of(&effects, take, &renderer);
            // The board at a depth of 2 moves farthest.
            let expected = focal_px / 2.0 * 0.1 * angle_deg / 360.0;
            let found = plan.effects[0].losses()[1].error;
            assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
            // Against 200 sharp pictures.
            let mut mean = vec![0.0; (SIZE[0] * SIZE[1] * 3) as usize];
            for sample in 0..200 {
                let time_secs = 0.1 + (f64::from(sample) + 0.5 - 100.0) / 200.0 * 0.1 * angle_deg / 360.0;
                let sharp = renderer.render(&(take.camera_at)(time_secs), &RenderSettings::default()).unwrap();
                mean.iter_mut().zip(&sharp.rgb).for_each(|(sum, value)| *sum += f64::from(*value) / 200.0);
            }
            let apart = |frame: &Frame| {
                let squares = frame.rgb.iter().zip(&mean).map(|(a, b)| (f64::from(*a) - b).powi(2));
                (squares.sum::<f64>() / mean.len() as f64).sqrt()
            };
            let plain = renderer.render(&(take.camera_at)(0.1), &RenderSettings::default()).unwrap();
            let blurred = apart(&frame_of(&plan, take, 1, &renderer));
            // The noise of the preset is a good half of what a motion of one pixel changes.
            let most = if expected > 2.0 { 0.4 } else { 0.8 };
            assert!(blurred < most * apart(&plain), "{blurred}, plain {}", apart(&plain));
        });
    }
}

#[test]
fn a_frame_with_lens_and_shutter_takes_the_samples_of_the_one_that_needs_more() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    let calls = [call("motion-blur", &[("shutter_angle_deg", 360.0)]), call("depth-of-field", &[("f_stop", 0.04)])];
    let effects = called(&calls, &EffectChoice::Auto).effects;
    with_shot(4.0, &[], |take| {
        let plan = plan_of(&effects, take, &renderer);
        let samples: Vec<u32> = plan.effects.iter().map(|effect| effect.losses()[1].samples).collect();
        let frame = frame_of(&plan, take, 1, &renderer);
        assert_eq!(frame.stats.counts.num_subframes, u64::from(*samples.iter().max().unwrap()), "{samples:?}");
        assert!(samples.iter().all(|samples| *samples > 1));
        // A forecast counts the same pictures.
        assert_eq!(u64::from(plan.num_samples(1)), frame.stats.counts.num_subframes);
    });
}

#[test]
fn an_empty_scene_has_no_blur() {
    let nothing = Gaussians::default();
    let renderer = Renderer::new(&nothing);
    let calls = [call("motion-blur", &[]), call("depth-of-field", &[])];
    let effects = called(&calls, &EffectChoice::Auto).effects;
    with_shot(1.0, &[], |take| assert!(plan_of(&effects, take, &renderer).is_plain(1)));
}

/// Every frame of a resting camera was rendered anew as soon as its lens was open.
#[test]
fn a_resting_frame_through_an_open_lens_is_repeated_until_its_focus_moves() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    let keys = [key(0.0, false, Some(1.0)), key(0.1, false, Some(1.0)), key(0.3, false, Some(4.0))];
    let effects = called(&[call("depth-of-field", &[("f_stop", 0.04)])], &EffectChoice::Auto).effects;
    with_shot(0.0, &keys, |take| {
        let plan = plan_of(&effects, take, &renderer);
        for loss in plan.effects[0].losses() {
            assert!(loss.shows());
        }
        assert!(plan.repeats(1, 0) && !plan.repeats(2, 1));
        assert_eq!(frame_of(&plan, take, 0, &renderer).rgb, frame_of(&plan, take, 1, &renderer).rgb);
        assert_ne!(frame_of(&plan, take, 1, &renderer).rgb, frame_of(&plan, take, 2, &renderer).rgb);
    });
}

/// The plan chose an f-stop that the film did not use, and the saved shot stated it.
#[test]
fn the_f_stop_of_keyframes_is_overruled_in_the_reason_by_one_that_is_chosen() {
    let scene = board();
    let renderer = Renderer::new(&scene);
    let optics = KeyOptics { f_stop: Some(0.3), ..KeyOptics::default() };
    let open = |secs: f64, focus_distance: f64| Keyframe { optics, ..key(secs, false, Some(focus_distance)) };
    let keys = [open(0.0, 2.0), open(0.2, 6.0)];
    let earlier = Call {
        because: "shallow focus: f/1.37 for a circle of confusion of 3.2 px infinitely far away".to_owned(),
        ..call("depth-of-field", &[("f_stop", 1.37), ("meters_per_unit", 1.0)])
    };
    for (calls, because) in [
        (vec![], "f_stop of keyframe 0"),
        (vec![call("depth-of-field", &[])], "the test"),
        (vec![call("rack-focus", &[])], "the test"),
        (vec![earlier], "shallow focus"),
    ] {
        let calls = Calls { calls: &calls, forbidden: &[], moves: &[], keyframes: &keys, scene_size: 1.0, seed: 0 };
        let effects = Called::of(&EffectChoice::Auto, &calls).effects;
        with_shot(0.0, &keys, |take| {
            let plan = plan_of(&effects, take, &renderer);
            assert_eq!((plan.effects.len(), plan.effects[0].because.as_str()), (1, because));
            let settings = plan.effects[0].settings();
            assert!(settings.iter().all(|(name, _)| !["f_stop", "background_blur"].contains(name)), "{settings:?}");
            // The circle of the wall is that of the keyframes' f-stop.
            let own = camera(SIZE).intrinsics;
            let aperture = 0.036 * own.fx_px / f64::from(own.width) / 0.3;
            let wanted = own.fx_px * aperture * (1.0 / 2.0 - 1.0 / 6.0);
            let circle_px = plan.effects[0].losses()[0].error;
            assert!((circle_px / wanted - 1.0).abs() < 0.05, "{circle_px} instead of {wanted}");
        });
    }
}
