use cinesplat::synth::{SynthObject, SynthScene};
use glam::{DMat3, DVec3};

use super::SCENES;

/// Penetration depth of two boxes along their separating axes, m; negative if they are apart.
fn overlap(a: &SynthObject, b: &SynthObject) -> f64 {
    let (ra, rb) = (DMat3::from_quat(a.rotation), DMat3::from_quat(b.rotation));
    let reach = |r: &DMat3, half: DVec3, axis: DVec3| {
        half.x * r.x_axis.dot(axis).abs() + half.y * r.y_axis.dot(axis).abs() + half.z * r.z_axis.dot(axis).abs()
    };
    let axes = [ra.x_axis, ra.y_axis, ra.z_axis, rb.x_axis, rb.y_axis, rb.z_axis];
    let along = |axis: &DVec3| {
        let apart = (b.center - a.center).dot(*axis).abs();
        reach(&ra, a.half_extents, *axis) + reach(&rb, b.half_extents, *axis) - apart
    };
    axes.iter().map(along).fold(f64::INFINITY, f64::min)
}

/// Whether `upper` stands on `lower`: its base lies within the footprint of `lower`, in its upper half.
fn stands_on(upper: &SynthObject, lower: &SynthObject) -> bool {
    let foot = upper.center - DVec3::Y * upper.half_extents.y;
    let local = lower.rotation.conjugate() * (foot - lower.center);
    let inside = local.x.abs() < lower.half_extents.x + 0.02 && local.z.abs() < lower.half_extents.z + 0.02;
    inside && local.y > -0.05
}

fn is_rug(object: &SynthObject) -> bool {
    object.label.contains("rug")
}

#[test]
fn no_two_objects_overlap() {
    for (name, scene) in SCENES.iter() {
        for (i, a) in scene.objects.iter().enumerate() {
            for b in &scene.objects[i + 1..] {
                let is_contact = stands_on(a, b) || stands_on(b, a) || is_rug(a) || is_rug(b);
                let depth = overlap(a, b);
                assert!(is_contact || depth < 0.01, "{name}: {} is {depth} m inside {}", a.label, b.label);
            }
        }
    }
}

/// Whether an object stands on the floor or on another object, or hangs.
fn is_supported(scene: &SynthScene, object: &SynthObject) -> bool {
    let foot = object.center.y - object.half_extents.y;
    let hung = ["picture", "clock", "mirror", "window", "shelf", "cabinet", "pendant", "tool wall", "curtains"];
    foot < 0.06
        || hung.iter().any(|word| object.label.contains(word))
        || scene.objects.iter().any(|other| {
            let near = (other.rotation.conjugate() * (object.center - other.center)).abs();
            other.id != object.id
                && near.x < other.half_extents.x + 0.02
                && near.z < other.half_extents.z + 0.02
                && foot > other.center.y - 0.05
                && foot < other.center.y + other.half_extents.y + 0.06
        })
}

#[test]
fn every_object_is_supported() {
    for (name, scene) in SCENES.iter() {
        for object in &scene.objects {
            assert!(is_supported(scene, object), "{name}: {} is not supported at {}", object.label, object.center);
        }
    }
}

#[test]
fn the_free_space_is_wide_and_empty() {
    for (name, scene) in SCENES.iter() {
        let [center, half] = scene.free_space;
        assert!(2.0 * half.z >= 1.2 && 2.0 * half.x >= 3.0, "{name}: only {half}");
        for i in 0..scene.gaussians.len() {
            let p = scene.gaussians.mean_world(i);
            let inside = (p - center).abs().cmplt(half - 0.02).all();
            assert!(!inside, "{name}: a Gaussian of object {} stands at {p}", scene.labels[i]);
        }
    }
}

#[test]
fn rooms_hold_twenty_objects_on_average() {
    let rooms: Vec<usize> = SCENES[..16].iter().map(|(_, scene)| scene.objects.len()).collect();
    assert!(rooms.iter().sum::<usize>() > 16 * 20, "objects per room: {rooms:?}");
}
