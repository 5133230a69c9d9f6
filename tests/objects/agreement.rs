use cinesplat::objects::{Agreement, Object, ObjectSet, agreements};
use cinesplat::scene::Gaussians;
use glam::{DVec3, Vec3};

use super::push;

#[test]
fn overlap_counts_opacity_and_the_parts_of_a_whole() {
    let mut gaussians = Gaussians::default();
    (0..5).for_each(|i| push(&mut gaussians, DVec3::X * f64::from(i), 0.1, Vec3::ONE));
    gaussians.opacities = vec![0.5, 0.5, 1.0, 1.0, 0.25];
    let object = |id, parent| Object { parent, ..Object::from_box(id, "", DVec3::ZERO, DVec3::ONE) };
    let objects = vec![object(1, None), object(2, Some(1)), object(3, None)];
    let found = ObjectSet { objects, labels: vec![1, 2, 3, 0, 3] };
    // The whole 1 has Gaussians 0 and 1; the object 3 has 2 and 4.
    let said = agreements(&gaussians, &found, &[7, 7, 8, 8, 0]);
    let expected = [
        Agreement { true_id: 7, found_id: Some(1), iou: 1.0 },
        Agreement { true_id: 8, found_id: Some(3), iou: 1.0 / 2.25 },
    ];
    assert_eq!(said, expected);
    let none = ObjectSet { objects: Vec::new(), labels: vec![0; 5] };
    assert_eq!(agreements(&gaussians, &none, &[0, 0, 0, 0, 9])[0], Agreement { true_id: 9, found_id: None, iou: 0.0 });
}
