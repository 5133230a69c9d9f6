use cinesplat::objects::{self, CloudSettings, Object, ObjectSet, PointSampler, fill_clouds};
use cinesplat::scene::{Gaussians, Scene};
use glam::{DQuat, DVec3, Quat, Vec3};

use super::{Dice, push, push_box, scene_of};

/// Evenly distributed points on a sphere (golden spiral).
fn sphere(center: DVec3, radius: f64, count: usize) -> Gaussians {
    let mut gaussians = Gaussians::default();
    for i in 0..count {
        let height = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let angle = i as f64 * 2.399_963_23;
        let level = (1.0 - height * height).sqrt();
        let out = DVec3::new(level * angle.cos(), height, level * angle.sin());
        push(&mut gaussians, center + out * radius, 0.04 * radius as f32, Vec3::splat(0.6));
    }
    gaussians
}

fn quick() -> CloudSettings {
    CloudSettings {
        num_azimuths: 6,
        elevations_rad: vec![0.0, 0.6],
        mask_size_px: 64,
        points: 64,
        ..CloudSettings::default()
    }
}

fn with_clouds(scene: &Scene, settings: &CloudSettings) -> ObjectSet {
    let mut set = objects::from_labels(scene, vec![1; scene.gaussians.len()]);
    fill_clouds(scene, &mut set, settings).unwrap();
    set
}

fn sorted(points: &[DVec3]) -> Vec<[i64; 3]> {
    let mut keys: Vec<[i64; 3]> = points.iter().map(|p| (*p * 1e5).round().to_array().map(|v| v as i64)).collect();
    keys.sort_unstable();
    keys
}

#[test]
fn the_cloud_of_a_sphere_is_its_silhouettes() {
    let scene = scene_of(sphere(DVec3::new(3.0, 1.0, -2.0), 0.5, 3000));
    let set = with_clouds(&scene, &CloudSettings::default());
    let object = &set.objects[0];
    assert!(object.points.len() <= 128, "2 % of its Gaussians, or 128");
    assert!(object.mask_iou > 0.95, "{}", object.mask_iou);
    assert!(object.shape_radius > 0.0);
    for point in &object.points {
        assert!((point.distance(object.center) - 0.5).abs() < 0.06, "{point} is not on the surface");
    }
}

#[test]
fn only_a_small_radius_resolves_a_hole() {
    // A ring of beads in the upright plane: its hull would fill the hole.
    let mut gaussians = Gaussians::default();
    for i in 0..2400 {
        let (around, across) = (f64::from(i) * 0.261_799, f64::from(i) * 2.399_963);
        let tube = DVec3::new(across.cos() * around.cos(), across.cos() * around.sin(), across.sin()) * 0.2;
        let beat = f64::from(i / 24) * 0.002_6;
        let middle = DVec3::new((around + beat).cos(), (around + beat).sin(), 0.0);
        push(&mut gaussians, middle + tube, 0.04, Vec3::splat(0.6));
    }
    let scene = scene_of(gaussians);
    let set = with_clouds(&scene, &CloudSettings::default());
    let object = &set.objects[0];
    assert!(object.shape_radius < 0.8, "radius {} fills a hole of radius 0.8", object.shape_radius);
    assert!(object.mask_iou > 0.6, "{}", object.mask_iou);
}

#[test]
fn the_cloud_does_not_depend_on_order_or_duplicates() {
    let mut gaussians = Gaussians::default();
    push_box(&mut gaussians, DVec3::ZERO, DVec3::new(0.5, 0.3, 0.2), 0.05, Vec3::splat(0.4));
    let mut order: Vec<usize> = (0..gaussians.len()).chain(0..40).collect();
    Dice::new(4).shuffle(&mut order);
    let mut shuffled = Gaussians::default();
    for &i in &order {
        push(&mut shuffled, gaussians.mean_world(i), gaussians.scales[i].x, Vec3::splat(0.4));
    }
    let (one, two) = (scene_of(gaussians), scene_of(shuffled));
    let mut set = objects::from_labels(&one, vec![1; one.gaussians.len()]);
    let mut again = ObjectSet { objects: set.objects.clone(), labels: vec![1; two.gaussians.len()] };
    fill_clouds(&one, &mut set, &quick()).unwrap();
    fill_clouds(&two, &mut again, &quick()).unwrap();
    assert_eq!(sorted(&set.objects[0].points), sorted(&again.objects[0].points));
}

#[test]
fn the_cloud_rotates_with_the_world() {
    let base = sphere(DVec3::ZERO, 0.4, 900);
    let turn = DQuat::from_euler(glam::EulerRot::YXZ, 0.7, -0.4, 1.1);
    let shift = DVec3::new(5.0, -2.0, 1.0);
    let mut moved = Gaussians::default();
    for i in 0..base.len() {
        push(&mut moved, turn * base.mean_world(i) + shift, base.scales[i].x, Vec3::splat(0.6));
        moved.rotations[i] = Quat::from_xyzw(turn.x as f32, turn.y as f32, turn.z as f32, turn.w as f32);
    }
    let (one, mut two) = (scene_of(base), scene_of(moved));
    two.up = turn * DVec3::Y;
    let mut set = objects::from_labels(&one, vec![1; 900]);
    let object = &set.objects[0];
    let twin = Object { center: turn * object.center + shift, rotation: turn * object.rotation, ..object.clone() };
    let mut turned = ObjectSet { objects: vec![twin], labels: vec![1; 900] };
    fill_clouds(&one, &mut set, &quick()).unwrap();
    fill_clouds(&two, &mut turned, &quick()).unwrap();
    let (a, b) = (&set.objects[0], &turned.objects[0]);
    assert!((a.mask_iou - b.mask_iou).abs() < 0.01, "{} {}", a.mask_iou, b.mask_iou);
    // Which of many equal points are kept hangs on the rounding of means: the clouds agree as shapes.
    let gap = |p: &DVec3| b.points.iter().map(|q| q.distance(turn * *p + shift)).fold(f64::INFINITY, f64::min);
    let worst = a.points.iter().map(gap).fold(0.0, f64::max);
    assert!(worst < 0.15, "{worst}");
}

#[test]
fn few_gaussians_still_give_a_cloud() {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    for means in [vec![at(1.0, 1.0)], vec![at(0.0, 0.0), at(1.0, 0.0)], vec![at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]]
    {
        let mut gaussians = Gaussians::default();
        for &mean in &means {
            push(&mut gaussians, mean, 0.1, Vec3::ONE);
        }
        let scene = scene_of(gaussians);
        let set = with_clouds(&scene, &quick());
        assert_eq!(sorted(&set.objects[0].points), sorted(&means));
        assert!(set.objects[0].shape_radius.is_finite() && set.objects[0].mask_iou.is_finite());
    }
}

/// Overlap of stored points with masks, computed here alone: alpha shapes of the points by their definition.
fn overlap_of_stored_points(scene: &Scene, object: &Object) -> f64 {
    use cinesplat::geometry::{Camera, Intrinsics, Pose};
    use cinesplat::objects::alpha_shape::AlphaShapes;
    use cinesplat::render::{Quality, RenderSettings, Renderer};
    let renderer = Renderer::new(&scene.gaussians);
    let mut sum = 0.0;
    for step in 0..6 {
        // Other views than those of the cloud.
        let angle = 0.35 + f64::from(step);
        let away = DVec3::new(angle.cos(), 0.25, angle.sin()).normalize();
        let eye = object.center + away * object.radius() * 8.0;
        let pose = Pose::look_at(eye, object.center, DVec3::Y, None).unwrap();
        let camera = Camera { pose, intrinsics: Intrinsics::from_fov_y(256, 256, 0.3) };
        let settings = RenderSettings { quality: Quality::Final, near: 0.0, ..RenderSettings::default() };
        let mask: Vec<bool> =
            renderer.render(&camera, &settings).unwrap().transmittance.iter().map(|t| *t < 0.5).collect();
        let px: Vec<glam::DVec2> = object.points.iter().map(|p| camera.project(*p).unwrap().0).collect();
        let radius_px = object.shape_radius * camera.intrinsics.fy_px / (eye - object.center).length();
        let radii = AlphaShapes::new(&px).covering_radii_px(256, 256);
        let covered = |i: usize| f64::from(radii[i]) <= radius_px;
        let both = (0..mask.len()).filter(|&i| mask[i] && covered(i)).count();
        let any = (0..mask.len()).filter(|&i| mask[i] || covered(i)).count();
        sum += both as f64 / any as f64;
    }
    sum / 6.0
}

#[test]
fn the_stated_overlap_is_that_of_the_stored_points() {
    let scene = scene_of(sphere(DVec3::new(3.0, 1.0, -2.0), 0.5, 9000));
    let set = with_clouds(&scene, &CloudSettings::default());
    let object = &set.objects[0];
    let measured = overlap_of_stored_points(&scene, object);
    assert!((measured - object.mask_iou).abs() < 0.03, "{measured} measured, {} stated", object.mask_iou);
    assert!(measured > 0.94, "{measured}");
}

#[test]
fn the_sampler_of_silhouettes_beats_the_others_at_the_same_number_of_points() {
    let mut gaussians = Gaussians::default();
    push_box(&mut gaussians, DVec3::new(0.0, 0.4, 0.0), DVec3::new(0.5, 0.05, 0.4), 0.02, Vec3::splat(0.4));
    push_box(&mut gaussians, DVec3::new(0.0, 0.0, 0.0), DVec3::new(0.1, 0.4, 0.1), 0.02, Vec3::splat(0.4));
    let scene = scene_of(gaussians);
    let with = |sampler| {
        let settings = CloudSettings { sampler, points: 100, tolerance: 0.0, ..CloudSettings::default() };
        with_clouds(&scene, &settings).objects[0].mask_iou
    };
    let ours = with(PointSampler::Silhouette);
    for (sampler, name) in PointSampler::ALL.into_iter().filter(|(other, _)| *other != PointSampler::Silhouette) {
        let other = with(sampler);
        assert!(ours > other, "{name}: {other}, silhouette: {ours}");
    }
    assert!(ours > 0.9, "{ours}");
}

#[test]
fn more_points_are_kept_for_a_smaller_tolerance() {
    let mut gaussians = Gaussians::default();
    for k in 0..5 {
        let center = DVec3::new(f64::from(k) * 0.3, 0.0, f64::from(k % 2) * 0.4);
        push_box(&mut gaussians, center, DVec3::new(0.05, 0.5, 0.05), 0.012, Vec3::splat(0.4));
    }
    let scene = scene_of(gaussians);
    let with =
        |tolerance| with_clouds(&scene, &CloudSettings { tolerance, ..CloudSettings::default() }).objects[0].clone();
    let (coarse, fine) = (with(0.4), with(0.0));
    assert!(coarse.points.len() < fine.points.len(), "{} {}", coarse.points.len(), fine.points.len());
    assert!(coarse.mask_iou <= fine.mask_iou);
}

#[test]
fn masks_without_pixels_and_far_coordinates_give_finite_clouds() {
    let mut faint = sphere(DVec3::ZERO, 0.5, 300);
    faint.opacities.iter_mut().for_each(|opacity| *opacity = 0.01);
    let mut far = sphere(DVec3::ZERO, 0.5, 3000);
    far.origin = DVec3::new(5e5, 5e6, 100.0);
    let mut flat = Gaussians::default();
    push_box(&mut flat, DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0), 0.05, Vec3::ONE);
    let mut line = Gaussians::default();
    (0..50).for_each(|i| push(&mut line, DVec3::new(f64::from(i) * 0.1, 0.0, 0.0), 0.02, Vec3::ONE));
    let mut twins = Gaussians::default();
    (0..50).for_each(|_| push(&mut twins, DVec3::ONE, 0.1, Vec3::ONE));
    for (name, gaussians) in [("faint", faint), ("far", far), ("flat", flat), ("line", line), ("twins", twins)] {
        let set = with_clouds(&scene_of(gaussians), &quick());
        let object = &set.objects[0];
        assert!(!object.points.is_empty() && object.points.iter().all(|p| p.is_finite()), "{name}");
        assert!(object.shape_radius.is_finite() && (0.0..=1.0).contains(&object.mask_iou), "{name}");
        if name == "far" {
            assert!(object.mask_iou > 0.9, "{}", object.mask_iou);
        }
    }
}

#[test]
fn an_object_of_no_gaussians_gets_the_corners_of_its_box() {
    let scene = scene_of(sphere(DVec3::ZERO, 1.0, 10));
    let mut set = objects::from_labels(&scene, vec![1; 10]);
    set.labels = vec![0; 10];
    fill_clouds(&scene, &mut set, &quick()).unwrap();
    assert_eq!(set.objects[0].points, set.objects[0].corners());
    let kept = set.objects[0].clone();
    set.labels = vec![1; 10];
    fill_clouds(&scene, &mut set, &quick()).unwrap();
    assert_eq!(set.objects[0], kept, "a cloud that is there stays");
}
