use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::objects::{self, PosedMask};
use cinesplat::pipeline::open_scene;
use cinesplat::render::{RenderSettings, Renderer};
use cinesplat::scene::{LoadOptions, Scene};
use glam::DVec3;
use std::path::Path;

use super::Dice;

/// Cameras around the middle of a room, at two heights, that look outward and across.
fn cameras(scene: &Scene) -> Vec<Camera> {
    let bounds = scene.bounds();
    let (middle, half) = (bounds.center(), (bounds.core_max - bounds.core_min) / 2.0);
    let intrinsics = Intrinsics::from_fov_y(200, 150, 1.2);
    let view = |step: usize| {
        let (sin, cos) = (std::f64::consts::TAU * step as f64 / 16.0).sin_cos();
        let height = if step.is_multiple_of(2) { 0.1 } else { 0.5 } * half.y;
        let eye = middle + DVec3::new(0.6 * half.x * cos, height, 0.6 * half.z * sin);
        let target = middle - DVec3::new(0.3 * half.x * cos, 0.4 * half.y, 0.3 * half.z * sin);
        Camera { pose: Pose::facing(eye, target - eye, DVec3::Y, None), intrinsics }
    };
    (0..16).map(view).collect()
}

/// Masks of the true labels, as a perfect segmenter would draw them.
fn perfect(scene: &Scene, labels: &[u16]) -> Vec<PosedMask> {
    let renderer = Renderer::new(&scene.gaussians);
    let settings = RenderSettings::for_scene(scene);
    let mask = |camera| PosedMask { camera, ids: renderer.object_ids(&camera, &settings, labels).unwrap().ids };
    cameras(scene).into_iter().map(mask).collect()
}

/// A tenth of the pixels have a wrong id, and pixels on the border of two ids have none.
fn spoiled(mask: &PosedMask, dice: &mut Dice, num_ids: usize) -> PosedMask {
    let (width, height) = (mask.camera.intrinsics.width as usize, mask.camera.intrinsics.height as usize);
    let at = |x: usize, y: usize| mask.ids[y * width + x];
    let spoil = |i: usize| {
        let (x, y) = (i % width, i / width);
        let around = [(x.max(1) - 1, y), ((x + 1).min(width - 1), y), (x, y.max(1) - 1), (x, (y + 1).min(height - 1))];
        let is_border = around.into_iter().any(|(x, y)| at(x, y) != mask.ids[i]);
        if dice.unit() < 0.1 {
            dice.below(num_ids) as u16
        } else if is_border {
            0
        } else {
            mask.ids[i]
        }
    };
    PosedMask { camera: mask.camera, ids: (0..mask.ids.len()).map(spoil).collect() }
}

/// The labels that masks give.
fn lift(scene: &Scene, masks: &[PosedMask]) -> Vec<u16> {
    objects::lift_masks(scene, masks, &mut |_, _| ()).unwrap().labels
}

/// Mean overlap of the objects that the masks show in at least 1,500 pixels, and their number.
fn mean_iou(scene: &Scene, masks: &[PosedMask], perfect: &[PosedMask], truth: &[u16]) -> (f64, usize) {
    let found = objects::from_labels(scene, lift(scene, masks));
    let is_shown =
        |id: u32| perfect.iter().flat_map(|mask| &mask.ids).filter(|pixel| u32::from(**pixel) == id).count() >= 1500;
    let agreements = objects::agreements(&scene.gaussians, &found, truth);
    let ious: Vec<f64> = agreements.iter().filter(|a| is_shown(a.true_id)).map(|a| a.iou).collect();
    (ious.iter().sum::<f64>() / ious.len() as f64, ious.len())
}

#[test]
fn masks_of_any_segmenter_become_labels() {
    let opened = open_scene(Path::new("synth:room:3:0.1"), &LoadOptions::default()).unwrap();
    let truth = opened.objects.as_ref().unwrap().labels.clone();
    let scene = opened.scene;
    let perfect = perfect(&scene, &truth);
    let (exact, num) = mean_iou(&scene, &perfect, &perfect, &truth);
    let mut dice = Dice::new(7);
    let spoiled: Vec<PosedMask> = perfect.iter().map(|mask| spoiled(mask, &mut dice, 40)).collect();
    let (noisy, _) = mean_iou(&scene, &spoiled, &perfect, &truth);
    assert!(num >= 5, "{num} things are shown");
    assert!(exact > 0.7, "{exact}");
    assert!(noisy > 0.5, "{noisy}");
}

#[test]
fn a_mask_without_ids_labels_nothing_and_one_of_another_size_is_refused() {
    let mut gaussians = cinesplat::scene::Gaussians::default();
    super::push_box(&mut gaussians, DVec3::ZERO, DVec3::splat(0.5), 0.1, glam::Vec3::splat(0.5));
    let scene = super::scene_of(gaussians);
    let camera = cameras(&scene)[0];
    let empty = PosedMask { camera, ids: vec![0; 200 * 150] };
    assert!(lift(&scene, &[empty]).iter().all(|label| *label == 0));
    assert!(lift(&scene, &[]).iter().all(|label| *label == 0));
    let small = PosedMask { camera, ids: vec![1; 10] };
    assert_eq!(objects::lift_masks(&scene, &[small], &mut |_, _| ()).unwrap_err().code(), "OBJ-LIFT");
}

#[test]
fn cameras_that_look_away_see_nothing_of_the_scene() {
    let mut gaussians = cinesplat::scene::Gaussians::default();
    super::push_box(&mut gaussians, DVec3::ZERO, DVec3::splat(0.5), 0.1, glam::Vec3::splat(0.5));
    let scene = super::scene_of(gaussians);
    let intrinsics = Intrinsics::from_fov_y(40, 30, 1.0);
    let seen = |direction: DVec3| {
        let pose = Pose::facing(DVec3::new(0.0, 0.0, 4.0), direction, DVec3::Y, None);
        let mask = PosedMask { camera: Camera { pose, intrinsics }, ids: vec![1; 40 * 30] };
        objects::lift_masks(&scene, &[mask], &mut |_, _| ()).unwrap().seen_share
    };
    assert_eq!(seen(DVec3::Z), 0.0);
    assert!(seen(-DVec3::Z) > 0.1);
}
