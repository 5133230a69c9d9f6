use cinesplat::objects::{
    self, Describe, FeatureSettings, ObjectSet, ObjectsError, PointFeatures, fill_clouds, fill_features,
};
use cinesplat::scene::{Gaussians, Scene};
use glam::{DVec3, Vec3};

use super::{push_box, scene_of};

const RED: Vec3 = Vec3::new(0.9, 0.1, 0.1);
const BLUE: Vec3 = Vec3::new(0.1, 0.1, 0.9);

/// A cube whose faces are red on one half of it and blue on the other, with its cloud.
fn two_colors() -> (Scene, ObjectSet) {
    let mut gaussians = Gaussians::default();
    for (x, color) in [(-0.5, RED), (0.5, BLUE)] {
        push_box(&mut gaussians, DVec3::new(x, 0.0, 0.0), DVec3::new(0.5, 1.0, 1.0), 0.05, color);
    }
    let scene = scene_of(gaussians);
    let mut set = objects::from_labels(&scene, vec![1; scene.gaussians.len()]);
    fill_clouds(&scene, &mut set, &objects::CloudSettings::default()).unwrap();
    (scene, set)
}

/// The mean color of each patch of a picture, 0..=255.
fn mean_colors(rgb8: &[u8], settings: &FeatureSettings) -> Vec<f32> {
    let (px, side) = (settings.picture_px as usize, settings.side_patches);
    let patch = px / side;
    let mut sums = vec![0.0; side * side * 3];
    for (pixel, rgb) in rgb8.chunks_exact(3).enumerate() {
        let place = (pixel / px / patch) * side + pixel % px / patch;
        sums[3 * place..][..3].iter_mut().zip(rgb).for_each(|(sum, channel)| *sum += f32::from(*channel));
    }
    sums.iter().map(|sum| sum / (patch * patch) as f32).collect()
}

#[test]
fn points_take_the_features_of_the_pictures_in_which_they_are_seen() {
    let (scene, mut set) = two_colors();
    let settings = FeatureSettings { side_patches: 32, ..FeatureSettings::of_patches(14) };
    let mut done = Vec::new();
    let mut num_pictures = 0;
    let mut describe = |rgb8: &[u8]| {
        assert_eq!(rgb8.len(), 3 * 224 * 224);
        num_pictures += 1;
        Ok::<_, ObjectsError>(mean_colors(rgb8, &settings))
    };
    fill_features(&scene, &mut set, &settings, &mut describe, &mut |at, of| done.push((at, of))).unwrap();
    assert_eq!((done, num_pictures), (vec![(1, 1)], 12));
    let object = &set.objects[0];
    assert_eq!(object.features.num_channels, 3);
    assert_eq!(object.features.values.len(), 3 * object.points.len());
    let mut num_clear = [0, 0];
    for (point, color) in object.points.iter().zip(object.features.values.chunks_exact(3)) {
        // The bottom is in no picture, and near the border of the colors a patch has both.
        if point.y < -0.9 || point.x.abs() < 0.3 {
            continue;
        }
        let (own, other) = if point.x < 0.0 { (color[0], color[2]) } else { (color[2], color[0]) };
        assert!(own > 1.5 * other, "{point}: {color:?}");
        num_clear[usize::from(point.x > 0.0)] += 1;
    }
    assert!(num_clear.iter().all(|num| *num > 20), "{num_clear:?}");
}

#[test]
fn points_hidden_on_the_far_side_do_not_take_the_colors_before_them() {
    let (scene, mut set) = two_colors();
    // A single camera before the blue side: of the middles of both sides it sees one.
    let settings = FeatureSettings { num_azimuths: 1, elevations_rad: vec![0.0], ..FeatureSettings::of_patches(14) };
    set.objects[0].rotation = glam::DQuat::IDENTITY;
    set.objects[0].points = vec![DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    let mut describe = |rgb8: &[u8]| Ok::<_, ObjectsError>(mean_colors(rgb8, &settings));
    fill_features(&scene, &mut set, &settings, &mut describe, &mut |_, _| ()).unwrap();
    let seen = set.objects[0].features.values.chunks_exact(3).filter(|color| color.iter().any(|value| *value > 0.0));
    assert_eq!(seen.count(), 1);
}

#[test]
fn what_cannot_be_described_is_an_error() {
    let (scene, mut set) = two_colors();
    let settings = FeatureSettings { num_azimuths: 1, ..FeatureSettings::of_patches(14) };
    let mut told = |describe: &mut Describe<ObjectsError>| {
        fill_features(&scene, &mut set, &settings, describe, &mut |_, _| ()).unwrap_err().to_string()
    };
    insta::assert_snapshot!(told(&mut |_| Ok(vec![0.0; 100])), @"picture of the objects failed: 100 features of a picture, expected a multiple of 256");
    let mut lengths = [256, 512].into_iter();
    insta::assert_snapshot!(told(&mut |_| Ok(vec![0.5; lengths.next().unwrap()])), @"picture of the objects failed: 512 features of a picture, expected 256");
    insta::assert_snapshot!(told(&mut |_| Err(ObjectsError::Picture { reason: "dark".to_owned() })), @"picture of the objects failed: dark");
}

#[test]
fn things_without_gaussians_or_with_a_new_cloud_have_no_features() {
    let (scene, mut set) = two_colors();
    set.objects[0].features = PointFeatures { num_channels: 1, values: vec![1.0; set.objects[0].points.len()] };
    let mut other = set.clone();
    other.objects[0].points.clear();
    fill_clouds(&scene, &mut other, &objects::CloudSettings::default()).unwrap();
    assert_eq!(other.objects[0].features, PointFeatures::default());
    set.labels = vec![0; scene.gaussians.len()];
    let settings = FeatureSettings::of_patches(14);
    let mut describe = |_: &[u8]| -> Result<Vec<f32>, ObjectsError> { panic!("nothing to see") };
    fill_features(&scene, &mut set, &settings, &mut describe, &mut |_, _| ()).unwrap();
    assert_eq!(set.objects[0].features, PointFeatures::default());
}
