//! The front of a lone thing.

use cinesplat::critic::Subjects;
use cinesplat::geometry::LevelFrame;
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::scene::Gaussians;
use cinesplat::synth::{SynthKind, SynthObject, SynthScene, SynthSettings, generate};
use glam::{DVec3, Quat, Vec3};

/// A closed box whose sides are gray except one, which is striped.
pub fn striped(toward: Option<DVec3>) -> (Gaussians, ObjectSet) {
    let mut scene = Gaussians::default();
    let steps = || (-12..=12).map(|i| f64::from(i) / 25.0);
    for normal in [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z] {
        let across = DVec3::Y.cross(normal);
        for (x, y) in steps().flat_map(|x| steps().map(move |y| (x, y))) {
            let is_dark = Some(normal) == toward && (x * 25.0).rem_euclid(6.0) < 3.0;
            scene.means.push((0.5 * normal + across * x + DVec3::Y * y).as_vec3());
            scene.scales.push(Vec3::new(0.025, 0.025, 0.001));
            scene.rotations.push(Quat::from_rotation_arc(Vec3::Z, normal.as_vec3()));
            scene.opacities.push(0.99);
            scene.sh_dc.push((Vec3::splat(if is_dark { 0.1 } else { 0.6 }) - 0.5) / 0.282_094_8);
        }
    }
    let objects = vec![Object::from_box(7, "box", DVec3::ZERO, DVec3::splat(0.6))];
    (scene, ObjectSet { objects, labels: Vec::new() })
}

#[test]
fn the_striped_side_of_a_box_is_its_front() {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    for toward in [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z] {
        let (scene, objects) = striped(Some(toward));
        let fronts = Subjects::new(&scene, &objects, &[7]).fronts(&frame).unwrap();
        let [(7, front)] = fronts[..] else { panic!("{fronts:?}") };
        assert!(front.angle_between(toward).to_degrees() < 25.0, "striped toward {toward}, front {front}");
    }
}

#[test]
fn a_box_with_equal_sides_has_no_front() {
    let (scene, objects) = striped(None);
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    assert_eq!(Subjects::new(&scene, &objects, &[7]).fronts(&frame).unwrap(), []);
}

#[test]
fn the_edge_of_a_board_is_not_its_front() {
    let mut scene = Gaussians::default();
    let steps = || (-12..=12).map(|i| f64::from(i) / 25.0);
    for (normal, half_depth, half_width) in
        [(DVec3::X, 0.5, 0.05), (-DVec3::X, 0.5, 0.05), (DVec3::Z, 0.05, 0.5), (-DVec3::Z, 0.05, 0.5)]
    {
        let across = DVec3::Y.cross(normal);
        for (x, y) in steps().flat_map(|x| steps().map(move |y| (x, y))) {
            // Only the edges have something to see.
            let is_dark = normal.x != 0.0 && (y * 25.0).rem_euclid(4.0) < 2.0;
            scene.means.push((half_depth * normal + across * x * 2.0 * half_width + DVec3::Y * y).as_vec3());
            scene.scales.push(Vec3::new(0.05 * half_width as f32, 0.025, 0.001));
            scene.rotations.push(Quat::from_rotation_arc(Vec3::Z, normal.as_vec3()));
            scene.opacities.push(0.99);
            scene.sh_dc.push((Vec3::splat(if is_dark { 0.1 } else { 0.6 }) - 0.5) / 0.282_094_8);
        }
    }
    let objects = vec![Object::from_box(7, "board", DVec3::ZERO, DVec3::new(0.6, 0.6, 0.1))];
    let objects = ObjectSet { objects, labels: Vec::new() };
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let fronts = Subjects::new(&scene, &objects, &[7]).fronts(&frame).unwrap();
    assert!(fronts.iter().all(|(_, front)| front.x.abs() < 0.8), "{fronts:?}");
}

/// Angle between the front that is found of an object of a generated room, cut out of it, and its own; `None` where none is
/// found.
fn off_front_deg(made: &SynthScene, object: &SynthObject) -> Option<f64> {
    let own: Vec<usize> = (0..made.labels.len()).filter(|&i| u32::from(made.labels[i]) == object.id).collect();
    let cloud = made.gaussians.plain_subset(&own);
    let whole = Object::from_box(1, &object.label, object.center, object.half_extents);
    let whole = Object { rotation: object.rotation, ..whole };
    let objects = ObjectSet { objects: vec![whole], labels: Vec::new() };
    let front = Subjects::new(&cloud, &objects, &[1]).front(1, &LevelFrame::new(made.up).unwrap()).unwrap()?;
    Some(front.angle_between(object.rotation * DVec3::Z).to_degrees())
}

#[test]
fn seats_face_away_from_their_backs() {
    let (mut right, mut wrong) = (0, Vec::new());
    for seed in [3, 5, 8, 11, 14, 21] {
        let made = generate(&SynthSettings { seed, kind: SynthKind::Room, detail: 0.1 });
        let is_seat = |object: &&SynthObject| object.label.ends_with("chair") || object.label.ends_with("sofa");
        for object in made.objects.iter().filter(is_seat) {
            match off_front_deg(&made, object) {
                Some(deg) if deg < 30.0 => right += 1,
                off => wrong.push(format!("{} of room {seed}: {off:?}", object.label)),
            }
        }
    }
    assert!(right > 0 && wrong.is_empty(), "{right} right, wrong: {wrong:#?}");
}
