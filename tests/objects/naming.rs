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
    assert_eq!(
        said,
        ["large white object", "small red object", "small red object 2", "small tall green object", "black panel"]
    );
}
