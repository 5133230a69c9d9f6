//! Depth, object ids, weights, features and lifted values agree with the blending weights of the picture.

use std::collections::{BTreeMap, BTreeSet};

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::objects;
use cinesplat::render::{Frame, InstructionSet, LiftedValues, Limits, PixelWeight, Quality, RenderSettings, Renderer};
use cinesplat::scene::{self, Gaussians, LoadOptions};
use glam::{DVec3, Quat, Vec3};

use super::scenes::{camera, crowd, push};
use crate::support;

const SETTINGS: fn() -> RenderSettings = || RenderSettings { quality: Quality::Final, ..RenderSettings::default() };

/// Two walls, across the left and the right half of the picture; the right one is nearer.
fn walls() -> Gaussians {
    let mut scene = Gaussians::default();
    let flat = Vec3::new(0.8, 4.0, 0.01);
    push(&mut scene, Vec3::new(-2.4, 0.0, 4.0), flat, Quat::IDENTITY, (1.0, Vec3::X));
    push(&mut scene, Vec3::new(2.4, 0.0, 3.0), flat, Quat::IDENTITY, (1.0, Vec3::Y));
    scene
}

#[test]
fn weights_of_a_pixel_sum_to_one_less_the_transmittance() {
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
    let mut lifted = LiftedValues::new(2, 1);
    renderer.lift(&view, &SETTINGS(), &mask, &mut lifted).unwrap();
    assert!(lifted.mean(0, 0).unwrap() < 0.02, "{lifted:?}");
    assert!(lifted.mean(1, 0).unwrap() > 0.98, "{lifted:?}");
}

#[test]
fn lifted_weights_are_the_sums_of_the_listed_ones() {
    let scene = crowd(2_000, 13);
    let renderer = Renderer::new(&scene);
    let view = camera(140, 80);
    let mut lifted = LiftedValues::new(scene.len(), 2);
    let values: Vec<f32> = (0..140 * 80 * 2).map(|position| (position % 17) as f32).collect();
    renderer.lift(&view, &SETTINGS(), &values, &mut lifted).unwrap();
    let mut expected = LiftedValues::new(scene.len(), 2);
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
fn labels_and_values_of_the_wrong_length_are_rejected() {
    let scene = walls();
    let renderer = Renderer::new(&scene);
    let wrong = renderer.object_ids(&camera(20, 10), &SETTINGS(), &[1]).unwrap_err();
    assert_eq!(wrong.code(), "RENDER-LENGTH");
    assert!(renderer.lift(&camera(20, 10), &SETTINGS(), &[0.0; 3], &mut LiftedValues::new(2, 1)).is_err());
}

#[test]
fn a_list_of_weights_above_the_memory_limit_is_an_error() {
    let scene = crowd(4_000, 17);
    let renderer = Renderer::new(&scene);
    let view = camera(150, 90);
    let all = renderer.weights(&view, &SETTINGS()).unwrap();
    let held = renderer.memory_bytes() + 150 * 90 * 16;
    let with_cap = |max_memory_bytes: u64| {
        let limits = Limits { max_memory_bytes, ..Limits::default() };
        renderer.weights(&view, &RenderSettings { limits, ..SETTINGS() })
    };
    let error = with_cap(held + (all.len() * 12) as u64 / 2).unwrap_err();
    assert_eq!(error.code(), "RENDER-MEMORY");
    assert_eq!(with_cap(held * 8 + (all.len() * 12 * 4) as u64).unwrap(), all);
}

#[test]
fn features_blend_as_colors_for_any_number_of_channels() {
    let mut scene = crowd(2_000, 18);
    // Color of degree 0, so that it can be passed as features.
    scene.sh_degree = 0;
    scene.sh_rest.clear();
    let renderer = Renderer::new(&scene);
    let view = camera(150, 90);
    let frame = renderer.render(&view, &SETTINGS()).unwrap();
    // Nineteen channels take two passes; three of them hold red, green and blue.
    let num_channels = 19;
    let mut features = vec![0.25_f32; scene.len() * num_channels];
    for (row, dc) in features.chunks_exact_mut(num_channels).zip(&scene.sh_dc) {
        let color = (*dc * 0.282_094_8 + 0.5).max(Vec3::ZERO);
        (row[0], row[7], row[18]) = (color.x, color.y, color.z);
    }
    let map = renderer.features(&view, &SETTINGS(), &features, num_channels).unwrap();
    assert_eq!((map.width, map.height, map.values.len()), (150, 90, 150 * 90 * num_channels));
    let pixels = map.values.chunks_exact(num_channels).zip(frame.rgb.chunks_exact(3)).zip(&frame.transmittance);
    for ((row, rgb), rest) in pixels {
        let apart = [(row[0], rgb[0]), (row[7], rgb[1]), (row[18], rgb[2]), (row[3], 0.25 * (1.0 - rest))];
        assert!(apart.iter().all(|(found, expected)| (found - expected).abs() < 1e-4), "{apart:?}");
    }
    let short = renderer.features(&view, &SETTINGS(), &features[1..], num_channels).unwrap_err();
    assert_eq!(short.code(), "RENDER-LENGTH");
    let limits = Limits { max_memory_bytes: 150 * 90 * 16 + 1_000, ..Limits::default() };
    let large = renderer.features(&view, &RenderSettings { limits, ..SETTINGS() }, &features, num_channels);
    assert_eq!(large.unwrap_err().code(), "RENDER-MEMORY");
}

#[test]
fn ids_of_many_labels_are_the_argmax_of_summed_weights() {
    let scene = crowd(3_000, 20);
    // 600 labels, the largest one and none among them.
    let label = |idx: usize| if idx.is_multiple_of(3) { u16::MAX } else { (idx % 600) as u16 };
    let labels: Vec<u16> = (0..scene.len()).map(label).collect();
    let renderer = Renderer::new(&scene);
    let view = camera(130, 70);
    let ids = renderer.object_ids(&view, &SETTINGS(), &labels).unwrap();
    let mut sums = vec![BTreeMap::<u16, f32>::new(); 130 * 70];
    for weight in renderer.weights(&view, &SETTINGS()).unwrap() {
        *sums[weight.pixel_idx as usize].entry(labels[weight.gaussian_idx as usize]).or_default() += weight.weight;
    }
    assert!(ids.ids.contains(&u16::MAX));
    for (id, sums) in ids.ids.iter().zip(&sums) {
        let largest = sums.values().copied().fold(0.0, f32::max);
        assert!(sums.get(id).copied().unwrap_or_default() >= largest - 1e-6, "{id} of {sums:?}");
    }
}

/// All outputs but color, as bits.
fn all_outputs(scene: &Gaussians, settings: &RenderSettings) -> Vec<Vec<u64>> {
    let (renderer, view) = (Renderer::new(scene), camera(150, 90));
    let numbers = |num: usize| (0..num).map(|idx| (idx % 23) as f32 / 7.0).collect::<Vec<f32>>();
    let bits = |values: &[f32]| values.iter().map(|value| u64::from(value.to_bits())).collect::<Vec<u64>>();
    let wide_bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
    let labels: Vec<u16> = (0..scene.len()).map(|idx| (idx % 40) as u16).collect();
    let depth = renderer.depth(&view, settings).unwrap();
    let ids = renderer.object_ids(&view, settings, &labels).unwrap();
    let features = renderer.features(&view, settings, &numbers(scene.len() * 11), 11).unwrap();
    let weights = renderer.weights(&view, settings).unwrap();
    let weight_bits = |weight: &PixelWeight| {
        [u64::from(weight.pixel_idx), u64::from(weight.gaussian_idx), u64::from(weight.weight.to_bits())]
    };
    let mut lifted = LiftedValues::new(scene.len(), 3);
    renderer.lift(&view, settings, &numbers(150 * 90 * 3), &mut lifted).unwrap();
    vec![
        bits(&depth.expected),
        bits(&depth.median),
        ids.ids.into_iter().map(u64::from).collect(),
        bits(&features.values),
        weights.iter().flat_map(weight_bits).collect(),
        wide_bits(&lifted.sums),
        wide_bits(&lifted.weights),
    ]
}

#[test]
fn every_output_has_the_same_bits_on_any_threads_and_instruction_set() {
    let scene = crowd(2_000, 21);
    for quality in [Quality::Standard, Quality::Final] {
        let on = |num_threads: usize, instructions: InstructionSet| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
            let settings = RenderSettings { quality, instructions, ..RenderSettings::default() };
            pool.install(|| all_outputs(&scene, &settings))
        };
        let scalar = on(1, InstructionSet::Scalar);
        for (num_threads, instructions) in [
            (1, InstructionSet::Widest),
            (2, InstructionSet::Widest),
            (7, InstructionSet::Widest),
            (3, InstructionSet::Avx2),
        ] {
            let found = on(num_threads, instructions);
            assert!(found == scalar, "{quality:?} {num_threads} {instructions:?}");
        }
    }
}

#[test]
fn nan_inputs_stay_where_their_splat_or_pixel_is() {
    let mut scene = Gaussians::default();
    let round = Vec3::splat(0.3);
    push(&mut scene, Vec3::new(-0.3, 0.0, 4.0), round, Quat::IDENTITY, (0.5, Vec3::X));
    push(&mut scene, Vec3::new(0.3, 0.2, 3.0), round, Quat::IDENTITY, (0.5, Vec3::Y));
    let renderer = Renderer::new(&scene);
    let view = camera(200, 100);
    let weights = renderer.weights(&view, &SETTINGS()).unwrap();
    let held: BTreeSet<(u32, u32)> = weights.iter().map(|weight| (weight.pixel_idx, weight.gaussian_idx)).collect();
    let map = renderer.features(&view, &SETTINGS(), &[f32::NAN, 1.0], 1).unwrap();
    for (pixel, value) in (0..).zip(&map.values) {
        assert_eq!(value.is_nan(), held.contains(&(pixel, 0)), "{pixel}");
    }
    let is_empty = |pixel: u32| !held.contains(&(pixel, 0)) && !held.contains(&(pixel, 1));
    let values: Vec<f32> = (0..200 * 100).map(|pixel| if is_empty(pixel) { f32::NAN } else { 1.0 }).collect();
    assert!(values.iter().any(|value| value.is_nan()));
    let mut lifted = LiftedValues::new(2, 1);
    renderer.lift(&view, &SETTINGS(), &values, &mut lifted).unwrap();
    assert_eq!(lifted.sums, lifted.weights);
}

#[test]
fn other_outputs_do_not_change_the_next_picture() {
    let scene = crowd(3_000, 19);
    let renderer = Renderer::new(&scene);
    let view = camera(150, 90);
    let before = renderer.render(&view, &SETTINGS()).unwrap();
    renderer.depth(&view, &SETTINGS()).unwrap();
    renderer.weights(&view, &SETTINGS()).unwrap();
    let after = renderer.render(&view, &SETTINGS()).unwrap();
    assert!(before.rgb == after.rgb && before.transmittance == after.transmittance);
}

/// Cameras without roll on two rings around a point, looking at it.
fn ring(center: DVec3, radius: f64, num: usize) -> Vec<Camera> {
    let around = |idx: usize| {
        let angle = idx as f64 / num as f64 * std::f64::consts::TAU;
        let rise = if idx.is_multiple_of(2) { 0.15 } else { 0.6 };
        let eye = center + DVec3::new(angle.cos(), rise, angle.sin()) * radius;
        let pose = Pose::facing(eye, center - eye, DVec3::Y, None);
        Camera { pose, intrinsics: Intrinsics::from_fov_y(240, 240, 1.0) }
    };
    (0..num).map(around).collect()
}

#[test]
fn a_mask_of_the_guitar_lifted_from_24_views_is_its_label() {
    let Some(folder) = support::shared("data/composites") else { return };
    let scene = scene::load(&folder.join("kitchen_plus_dev.spz"), &LoadOptions::default()).unwrap();
    let labels = objects::read_labels(&folder.join("kitchen_plus_dev_labels.npy"), &scene).unwrap();
    let gaussians = &scene.gaussians;
    let renderer = Renderer::new(gaussians);
    let settings = RenderSettings { near: 0.02, ..RenderSettings::default() };
    // Center of the guitar's box, from the file beside the scene.
    let views = ring(DVec3::new(0.7708, 0.75, -0.376), 1.35, 24);
    let mut lifted = LiftedValues::new(gaussians.len(), 1);
    for view in &views {
        let ids = renderer.object_ids(view, &settings, &labels).unwrap();
        let mask: Vec<f32> = ids.ids.iter().map(|&id| f32::from(u8::from(id == 1))).collect();
        renderer.lift(view, &settings, &mask, &mut lifted).unwrap();
    }
    // Only Gaussians that the views show: hidden ones are in no mask.
    let visible = |idx: &usize| lifted.weights[*idx] > 0.05;
    let (mut both, mut either) = (0, 0);
    for idx in (0..gaussians.len()).filter(visible) {
        let (found, is_guitar) = (lifted.mean(idx, 0).unwrap() > 0.5, labels[idx] == 1);
        both += usize::from(found && is_guitar);
        either += usize::from(found || is_guitar);
    }
    let (of_guitar, num_visible) =
        (labels.iter().filter(|&&label| label == 1).count(), (0..labels.len()).filter(visible).count());
    let iou = both as f64 / either as f64;
    assert!(
        iou >= 0.9,
        "IoU {iou:.3}: {both} of {either}; {num_visible} Gaussians visible, {of_guitar} are the guitar"
    );
    assert!(both * 2 > of_guitar, "{both} of {of_guitar} found");
}
