use cinesplat::objects::{self, Object, ObjectSet};
use cinesplat::scene::Gaussians;
use glam::{DQuat, DVec3, Vec3};

use super::{Dice, push, scene_of};

/// Gaussians evenly distributed in a rotated box.
fn filled(center: DVec3, half: DVec3, rotation: DQuat, count: usize) -> Gaussians {
    let mut dice = Dice::new(7);
    let mut gaussians = Gaussians::default();
    for _ in 0..count {
        let inside = DVec3::from_array(std::array::from_fn(|_| 2.0 * dice.unit() - 1.0)) * half;
        push(&mut gaussians, center + rotation * inside, 0.01, Vec3::splat(0.5));
    }
    gaussians
}

fn only(set: &ObjectSet) -> &Object {
    assert_eq!(set.objects.len(), 1);
    &set.objects[0]
}

#[test]
fn a_rotated_box_is_fitted_to_its_gaussians() {
    let (center, half) = (DVec3::new(1.0, 2.0, -3.0), DVec3::new(2.0, 0.5, 0.7));
    for yaw_deg in [0.0_f64, 20.0, 45.0, 70.0, 110.0] {
        let rotation = DQuat::from_rotation_y(yaw_deg.to_radians());
        let scene = scene_of(filled(center, half, rotation, 4000));
        let set = objects::from_labels(&scene, vec![1; 4000]);
        let object = only(&set);
        assert!(object.center.distance(center) < 0.05, "{yaw_deg}: {:?}", object.center);
        assert!((object.half_extents.element_product() / half.element_product() - 1.0).abs() < 0.06, "{yaw_deg}");
        let long = if object.half_extents.x > object.half_extents.z { DVec3::X } else { DVec3::Z };
        let along = (object.rotation * long).dot(rotation * DVec3::X).abs();
        assert!(along > 1.5_f64.to_radians().cos(), "{yaw_deg}: {along}");
        assert!((object.rotation * DVec3::Y).dot(DVec3::Y) > 1.0 - 1e-9, "the box stands upright");
    }
}

#[test]
fn floaters_do_not_enlarge_a_box() {
    let mut gaussians = filled(DVec3::ZERO, DVec3::ONE, DQuat::IDENTITY, 2000);
    push(&mut gaussians, DVec3::new(80.0, 0.0, 0.0), 0.01, Vec3::ONE);
    push(&mut gaussians, DVec3::new(0.0, -90.0, 0.0), 0.01, Vec3::ONE);
    let scene = scene_of(gaussians);
    let half = only(&objects::from_labels(&scene, vec![4; 2002])).half_extents;
    assert!((half - 1.0).abs().max_element() < 0.05, "{half}");
}

#[test]
fn boxes_are_upright_for_every_up() {
    let up = DVec3::new(0.004, -0.9995, -0.031).normalize();
    let mut scene =
        scene_of(filled(DVec3::ZERO, DVec3::new(1.0, 2.0, 0.5), DQuat::from_rotation_arc(DVec3::Y, up), 4000));
    scene.up = up;
    let set = objects::from_labels(&scene, vec![1; 4000]);
    let object = only(&set);
    assert!((object.rotation * DVec3::Y).dot(up).abs() > 1.0 - 1e-9);
    assert!((object.half_extents.y - 2.0).abs() < 0.1, "{}", object.half_extents);
}

#[test]
fn one_gaussian_has_a_box_without_extent() {
    let scene = scene_of(filled(DVec3::ONE, DVec3::ZERO, DQuat::IDENTITY, 1));
    let set = objects::from_labels(&scene, vec![9]);
    assert_eq!((only(&set).id, only(&set).half_extents), (9, DVec3::ZERO));
    assert!(only(&set).center.distance(DVec3::ONE) < 1e-6);
    assert!(objects::from_labels(&scene, vec![0]).objects.is_empty());
}

#[test]
fn a_box_spans_what_its_corners_span() {
    let rotation = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0);
    let object =
        Object { rotation, ..Object::from_box(1, "box", DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.2, 1.0, 0.6)) };
    let axis = DVec3::new(0.3, 0.8, -0.5).normalize();
    let along = object.corners().map(|corner| corner.dot(axis));
    let [low, high] = object.span_along(axis);
    assert!((low - along.into_iter().fold(f64::INFINITY, f64::min)).abs() < 1e-12);
    assert!((high - along.into_iter().fold(f64::NEG_INFINITY, f64::max)).abs() < 1e-12);
}
