use cinesplat::objects;
use cinesplat::scene::Gaussians;
use glam::{DVec3, Vec3};

use super::{push_box, scene_of};

#[test]
fn labels_describe_size_color_and_shape_and_are_unique() {
    let mut gaussians = Gaussians::default();
    let mut labels = Vec::new();
    let things = [
        (DVec3::new(0.0, 0.0, 0.0), DVec3::new(2.0, 1.5, 2.0), Vec3::new(0.9, 0.9, 0.9)),
        (DVec3::new(8.0, 0.0, 0.0), DVec3::splat(0.2), Vec3::new(0.75, 0.1, 0.12)),
        (DVec3::new(0.0, 0.0, 8.0), DVec3::splat(0.2), Vec3::new(0.75, 0.1, 0.12)),
        (DVec3::new(8.0, 0.0, 8.0), DVec3::new(0.1, 0.6, 0.1), Vec3::new(0.1, 0.45, 0.12)),
        (DVec3::new(-5.0, 0.0, 5.0), DVec3::new(1.0, 1.0, 0.05), Vec3::new(0.03, 0.03, 0.03)),
    ];
    for (id, (center, half, color)) in (1..).zip(things) {
        push_box(&mut gaussians, center, half, 0.1, color);
        labels.resize(gaussians.len(), id);
    }
    let set = objects::from_labels(&scene_of(gaussians), labels);
    let said: Vec<&str> = set.objects.iter().map(|object| object.label.as_str()).collect();
    assert_eq!(said, ["large white box", "small red box", "small red box 2", "small tall green box", "black panel"]);
}

/// A ball of Gaussians on its surface.
fn push_ball(gaussians: &mut Gaussians, center: DVec3, radius: f64, color: Vec3) {
    for i in 0..600 {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 600.0;
        let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        super::push(gaussians, center + radius * DVec3::new(r * cos, z, r * sin), 0.05, color);
    }
}

#[test]
fn floor_ceiling_and_walls_have_their_names_and_only_boxes_are_called_box() {
    let mut gaussians = Gaussians::default();
    let mut labels = Vec::new();
    let gray = Vec3::splat(0.6);
    let things = [
        (DVec3::new(0.0, 0.0, 0.0), DVec3::new(3.0, 0.02, 2.0)),
        (DVec3::new(0.0, 2.5, 0.0), DVec3::new(3.0, 0.02, 2.0)),
        (DVec3::new(0.0, 1.25, -2.0), DVec3::new(3.0, 1.25, 0.02)),
        (DVec3::new(3.0, 1.25, 0.0), DVec3::new(0.02, 1.25, 2.0)),
        // A table top is no floor, and a screen in the middle no wall.
        (DVec3::new(-1.0, 0.8, 0.0), DVec3::new(0.8, 0.03, 0.5)),
        (DVec3::new(0.5, 1.2, 0.5), DVec3::new(1.9, 1.0, 0.02)),
        (DVec3::new(2.0, 0.9, 1.0), DVec3::new(0.2, 0.9, 0.2)),
    ];
    for (id, (center, half)) in (1..).zip(things) {
        let color = if id == 7 { Vec3::new(0.0, 0.5, 0.5) } else { gray };
        push_box(&mut gaussians, center, half, 0.1, color);
        labels.resize(gaussians.len(), id);
    }
    push_ball(&mut gaussians, DVec3::new(-2.0, 0.4, 1.2), 0.4, gray);
    labels.resize(gaussians.len(), 8);
    let set = objects::from_labels(&scene_of(gaussians), labels);
    let said: Vec<&str> = set.objects.iter().map(|object| object.label.as_str()).collect();
    assert_eq!(said[..4], ["floor", "ceiling", "wall", "wall 2"]);
    for structural in &said[4..] {
        let is_structure = ["floor", "ceiling", "wall"].iter().any(|name| structural.starts_with(name));
        assert!(!is_structure, "{structural}");
    }
    assert!(said[6].starts_with("tall") && said[6].ends_with("box"), "{}", said[6]);
    assert!(said[7].ends_with("object"), "{}", said[7]);
}
