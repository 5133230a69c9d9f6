use cinesplat::objects::{EditError, ObjectSet, from_labels, merge, remove};
use cinesplat::scene::{Gaussians, Scene};
use glam::{DVec3, Vec3};

use super::{push, scene_of};

/// Three cubes of 27 Gaussians in a row along x, objects 1, 2 and 3; 4 is a part of 3.
fn row() -> (Scene, ObjectSet) {
    let mut gaussians = Gaussians::default();
    let mut labels = Vec::new();
    for id in 1..=4_u16 {
        for i in 0..27 {
            let at = |div: i32| f64::from(i / div % 3) * 0.1;
            push(&mut gaussians, DVec3::new(f64::from(id) + at(1), at(3), at(9)), 0.02, Vec3::splat(0.5));
            labels.push(id);
        }
    }
    let scene = scene_of(gaussians);
    let mut set = from_labels(&scene, labels);
    set.objects[3].parent = Some(3);
    "left".clone_into(&mut set.objects[0].label);
    (scene, set)
}

fn ids(set: &ObjectSet) -> Vec<u32> {
    set.objects.iter().map(|object| object.id).collect()
}

#[test]
fn joined_objects_keep_the_first_id_and_have_one_box() {
    let (scene, mut set) = row();
    merge(&scene, &mut set, &[1, 3, 3]).unwrap();
    assert_eq!(ids(&set), [1, 2, 4]);
    let joined = set.get(1).unwrap();
    // Those of object 3, and of its part 4, which is a part of 1 now.
    assert_eq!((joined.num_gaussians, joined.label.as_str()), (81, "left"));
    assert_eq!(set.get(4).unwrap().parent, Some(1));
    assert!((2.0 * joined.half_extents.x - 3.2).abs() < 0.01, "{}", joined.half_extents);
    assert!((joined.center - DVec3::new(2.6, 0.1, 0.1)).length() < 0.01, "{}", joined.center);
    assert_eq!(set.labels.iter().filter(|label| **label == 3).count(), 0);
}

#[test]
fn a_part_goes_back_to_its_whole_and_a_whole_leaves_with_its_parts() {
    let (_, mut set) = row();
    remove(&mut set, &[4]).unwrap();
    assert_eq!((ids(&set), set.labels[100]), (vec![1, 2, 3], 3));
    let (_, mut set) = row();
    remove(&mut set, &[3, 4]).unwrap();
    assert_eq!((ids(&set), set.labels[100]), (vec![1, 2], 0));
}

#[test]
fn what_is_not_there_and_wholes_inside_their_parts_are_refused() {
    let (scene, mut set) = row();
    assert_eq!(merge(&scene, &mut set, &[1, 9]), Err(EditError::Unknown(9)));
    assert_eq!(merge(&scene, &mut set, &[4, 3]), Err(EditError::PartOf { part: 4, whole: 3 }));
    assert_eq!(remove(&mut set, &[9, 1]), Err(EditError::Unknown(9)));
    assert_eq!(set, row().1);
    merge(&scene, &mut set, &[3, 4]).unwrap();
    assert_eq!((ids(&set), set.get(3).unwrap().num_gaussians), (vec![1, 2, 3], 54));
}

#[test]
fn boxes_without_gaussians_are_joined_to_the_box_around_them() {
    let (scene, set) = row();
    let mut boxes = ObjectSet { labels: Vec::new(), ..set };
    merge(&scene, &mut boxes, &[1, 2]).unwrap();
    let joined = boxes.get(1).unwrap();
    assert!((2.0 * joined.half_extents.x - 1.2).abs() < 0.01, "{}", joined.half_extents);
}
