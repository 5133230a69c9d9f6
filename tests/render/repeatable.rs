//! Equal bits for any number of threads, instruction set, order of the file, and reused memory.

use cinesplat::render::{Accuracy, Frame, InstructionSet, Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use glam::DVec3;
use strum::VariantArray;

use super::pictures::max_difference;
use super::scenes::{camera, crowd, moved, reordered};

fn on_threads(num_threads: usize, scene: &Gaussians, settings: &RenderSettings) -> Frame {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
    pool.install(|| Renderer::new(scene).render(&camera(333, 201), settings).unwrap())
}

#[test]
fn one_two_three_and_seven_threads_give_the_same_bits() {
    let scene = crowd(20_000, 5);
    for &quality in Quality::VARIANTS {
        let settings = RenderSettings { quality, ..RenderSettings::default() };
        let one = on_threads(1, &scene, &settings);
        for num_threads in [2, 3, 7] {
            let many = on_threads(num_threads, &scene, &settings);
            assert!(
                one.rgb == many.rgb && one.transmittance == many.transmittance,
                "{} {num_threads}",
                quality.as_ref()
            );
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let scene = crowd(1_500, 10);
    let half = Accuracy { resolution_frac: 0.5, ..Accuracy::SPEC };
    let all = [Quality::Draft, Quality::Standard, Quality::Final].map(|quality| (quality, None));
    for (quality, accuracy) in all.into_iter().chain([(Quality::Final, Some(half))]) {
        let settings = |instructions| RenderSettings { quality, accuracy, instructions, ..RenderSettings::default() };
        let scalar = on_threads(2, &scene, &settings(InstructionSet::Scalar));
        for wider in [InstructionSet::Avx2, InstructionSet::Widest] {
            let wide = on_threads(2, &scene, &settings(wider));
            assert!(scalar.rgb == wide.rgb && scalar.transmittance == wide.transmittance, "{quality:?} {wider:?}");
        }
    }
}

#[test]
fn shuffling_a_file_without_equal_depths_changes_nothing() {
    let scene = crowd(3_000, 6);
    let order: Vec<usize> = (0..scene.len()).map(|position| position * 1_009 % scene.len()).collect();
    let shuffled = reordered(&scene, &order);
    let settings = RenderSettings::default();
    let (a, b) = (on_threads(2, &scene, &settings), on_threads(2, &shuffled, &settings));
    assert_eq!(a.rgb, b.rgb);
}

#[test]
fn equal_depths_blend_in_the_order_of_the_file() {
    let mut scene = crowd(2, 7);
    scene.means[1] = scene.means[0];
    scene.scales = vec![glam::Vec3::splat(0.5); 2];
    scene.opacities = vec![0.9; 2];
    scene.sh_rest.fill(glam::Vec3::ZERO);
    scene.sh_dc = vec![glam::Vec3::X, glam::Vec3::Y];
    let settings = RenderSettings::default();
    let first_red = on_threads(2, &scene, &settings);
    let first_green = on_threads(2, &reordered(&scene, &[1, 0]), &settings);
    let total = |frame: &Frame, channel: usize| frame.rgb.iter().skip(channel).step_by(3).sum::<f32>();
    assert!(total(&first_red, 0) > total(&first_red, 1));
    assert!(total(&first_green, 1) > total(&first_green, 0));
}

#[test]
fn a_used_renderer_and_frame_give_the_picture_of_new_ones() {
    let scene = crowd(5_000, 8);
    let renderer = Renderer::new(&scene);
    let (near, far) = (camera(320, 180), moved(&camera(97, 211), DVec3::new(0.3, 0.0, -2.0)));
    for &quality in Quality::VARIANTS {
        let settings = RenderSettings { quality, ..RenderSettings::default() };
        let mut frame = Frame::default();
        renderer.render_into(&near, &settings, &mut frame).unwrap();
        renderer.render_into(&far, &settings, &mut frame).unwrap();
        let fresh = Renderer::new(&scene).render(&far, &settings).unwrap();
        assert!(frame.rgb == fresh.rgb && frame.transmittance == fresh.transmittance, "{}", quality.as_ref());
        assert_eq!((frame.width, frame.height), (97, 211));
    }
}

#[test]
fn large_coordinates_give_the_picture_of_small_ones() {
    let scene = crowd(3_000, 9);
    let offset = DVec3::new(5e5, 5e6, 100.0);
    let far = Gaussians { origin: offset, ..scene.clone() };
    let settings = RenderSettings { quality: Quality::Final, ..RenderSettings::default() };
    let here = Renderer::new(&scene).render(&camera(320, 180), &settings).unwrap();
    let there = Renderer::new(&far).render(&moved(&camera(320, 180), offset), &settings).unwrap();
    assert!(max_difference(&here.rgb, &there.rgb) < 1e-5);
}

#[test]
fn reusing_the_depth_order_changes_no_bit_of_dollies_holds_and_pans() {
    let scene = crowd(6_000, 11);
    let used = Renderer::new(&scene);
    let mut camera = camera(200, 120);
    // A hold, a dolly, a long move, a pan below and one above the angle up to which the order is reused.
    let moves = [
        (0.0, DVec3::ZERO),
        (0.0, DVec3::Z * 0.05),
        (0.0, DVec3::new(3.0, 0.5, 1.0)),
        (1e-5, DVec3::X),
        (0.4, -DVec3::X),
    ];
    for (turn_rad, step) in moves.into_iter().chain(moves) {
        camera.pose.position += step;
        camera.pose.rotation = glam::DQuat::from_rotation_y(turn_rad) * camera.pose.rotation;
        let with = used.render(&camera, &RenderSettings::default()).unwrap();
        let alone = RenderSettings { reuses_order: false, ..RenderSettings::default() };
        let without = Renderer::new(&scene).render(&camera, &alone).unwrap();
        assert!(with.rgb == without.rgb && with.transmittance == without.transmittance, "{turn_rad} {step}");
    }
}

#[test]
fn eight_bit_frames_are_the_rounded_values() {
    let scene = crowd(3_000, 12);
    let renderer = Renderer::new(&scene);
    for &quality in Quality::VARIANTS {
        let settings =
            RenderSettings { quality, background: glam::Vec3::new(0.2, 0.5, 1.5), ..RenderSettings::default() };
        let linear = renderer.render(&camera(131, 77), &settings).unwrap();
        let mut levels = cinesplat::render::Rgb8Frame::default();
        renderer.render_rgb8_into(&camera(131, 77), &settings, &mut levels).unwrap();
        assert_eq!((levels.width, levels.height), (131, 77));
        let rounded: Vec<u8> =
            linear.rgb.iter().map(|value| (value.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8).collect();
        assert!(levels.rgb8 == rounded, "{}", quality.as_ref());
    }
}
