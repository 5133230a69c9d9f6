//! Depth, object ids, weights and lifting come from the weights of the picture.

use cinesplat::render::{Frame, Lifted, Limits, Quality, RenderSettings, Renderer};
use cinesplat::scene::Gaussians;
use glam::{Quat, Vec3};

use super::scenes::{camera, crowd, push};

const SETTINGS: fn() -> RenderSettings = || RenderSettings { quality: Quality::Final, ..RenderSettings::default() };

/// Two walls across the left and the right half of the picture, the right one nearer.
fn walls() -> Gaussians {
    let mut scene = Gaussians::default();
    let flat = Vec3::new(0.8, 4.0, 0.01);
    push(&mut scene, Vec3::new(-2.4, 0.0, 4.0), flat, Quat::IDENTITY, (1.0, Vec3::X));
    push(&mut scene, Vec3::new(2.4, 0.0, 3.0), flat, Quat::IDENTITY, (1.0, Vec3::Y));
    scene
}

#[test]
fn weights_of_a_pixel_sum_to_what_the_background_loses() {
    let scene = crowd(4_000, 11);
    let renderer = Renderer::new(&scene);
    let view = camera(150, 90);
    let frame: Frame = renderer.render(&view, &SETTINGS()).unwrap();
    let mut sums = vec![0.0_f64; 150 * 90];
    for weight in renderer.weights(&view, &SETTINGS()).unwrap() {
        sums[weight.pixel_idx as usize] += f64::from(weight.weight);
    }
    for (sum, rest) in sums.iter().zip(&frame.transmittance) {
        assert!((sum - (1.0 - f64::from(*rest))).abs() < 1e-5, "{sum} and {rest}");
    }
}

#[test]
fn depth_is_that_of_the_wall_and_absent_beside_it() {
    let scene = walls();
    let depth = Renderer::new(&scene).depth(&camera(200, 100), &SETTINGS()).unwrap();
    let row = 50 * 200;
    assert!((depth.expected[row + 50] - 4.0).abs() < 1e-4 && (depth.median[row + 50] - 4.0).abs() < 1e-6);
    assert!((depth.expected[row + 170] - 3.0).abs() < 1e-4 && (depth.median[row + 170] - 3.0).abs() < 1e-6);
    let nothing = Gaussians::default();
    let depth = Renderer::new(&nothing).depth(&camera(20, 10), &SETTINGS()).unwrap();
    assert!(depth.expected.iter().chain(&depth.median).all(|depth| depth.is_nan()));
}

#[test]
fn object_ids_are_the_argmax_of_summed_weights() {
    let scene = crowd(3_000, 12);
    let labels: Vec<u16> = (0..scene.len()).map(|idx| (idx * 7 % 5) as u16 * 100).collect();
    let renderer = Renderer::new(&scene);
    let view = camera(130, 70);
    let ids = renderer.object_ids(&view, &SETTINGS(), &labels).unwrap();
    let mut sums = vec![[0.0_f32; 5]; 130 * 70];
    for weight in renderer.weights(&view, &SETTINGS()).unwrap() {
        sums[weight.pixel_idx as usize][usize::from(labels[weight.gaussian_idx as usize] / 100)] += weight.weight;
    }
    for (id, sums) in ids.ids.iter().zip(&sums) {
        let largest = sums.iter().copied().fold(0.0, f32::max);
        assert!(sums[usize::from(*id / 100)] >= largest - 1e-6, "{id} of {sums:?}");
    }
}

#[test]
fn lifting_a_picture_of_ids_gives_each_gaussian_its_own() {
    let scene = walls();
    let renderer = Renderer::new(&scene);
    let view = camera(200, 100);
    let ids = renderer.object_ids(&view, &SETTINGS(), &[3, 8]).unwrap();
    let mask: Vec<f32> = ids.ids.iter().map(|&id| f32::from(u8::from(id == 8))).collect();
    let mut lifted = Lifted::new(2, 1);
    renderer.lift(&view, &SETTINGS(), &mask, &mut lifted).unwrap();
    assert!(lifted.mean(0, 0).unwrap() < 0.02, "{lifted:?}");
    assert!(lifted.mean(1, 0).unwrap() > 0.98, "{lifted:?}");
}

#[test]
fn lifted_weights_are_the_sums_of_the_listed_ones() {
    let scene = crowd(2_000, 13);
    let renderer = Renderer::new(&scene);
    let view = camera(140, 80);
    let mut lifted = Lifted::new(scene.len(), 2);
    let values: Vec<f32> = (0..140 * 80 * 2).map(|position| (position % 17) as f32).collect();
    renderer.lift(&view, &SETTINGS(), &values, &mut lifted).unwrap();
    let mut expected = Lifted::new(scene.len(), 2);
    for weight in renderer.weights(&view, &SETTINGS()).unwrap() {
        let (gaussian, pixel) = (weight.gaussian_idx as usize, weight.pixel_idx as usize);
        expected.weights[gaussian] += f64::from(weight.weight);
        for channel in 0..2 {
            expected.sums[gaussian * 2 + channel] += f64::from(weight.weight * values[pixel * 2 + channel]);
        }
    }
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-4 * (1.0 + b.abs()));
    assert!(close(&lifted.weights, &expected.weights) && close(&lifted.sums, &expected.sums));
}

#[test]
fn labels_and_values_of_the_wrong_length_are_refused() {
    let scene = walls();
    let renderer = Renderer::new(&scene);
    let wrong = renderer.object_ids(&camera(20, 10), &SETTINGS(), &[1]).unwrap_err();
    assert_eq!((wrong.code(), wrong.exit_code()), ("RENDER-LENGTH", 65));
    assert!(renderer.lift(&camera(20, 10), &SETTINGS(), &[0.0; 3], &mut Lifted::new(2, 1)).is_err());
}

#[test]
fn a_list_of_weights_ends_at_the_cap_with_one_error() {
    let scene = crowd(4_000, 17);
    let renderer = Renderer::new(&scene);
    let view = camera(150, 90);
    let all = renderer.weights(&view, &SETTINGS()).unwrap();
    let held = renderer.memory_bytes() + 150 * 90 * 16;
    let with_cap = |max_memory_bytes: u64| {
        let limits = Limits { max_memory_bytes, ..Limits::default() };
        renderer.weights(&view, &RenderSettings { limits, ..SETTINGS() })
    };
    let refused = with_cap(held + (all.len() * 12) as u64 / 2).unwrap_err();
    assert_eq!((refused.code(), refused.exit_code()), ("RENDER-MEMORY", 71));
    assert_eq!(with_cap(held * 8 + (all.len() * 12 * 4) as u64).unwrap(), all);
}
