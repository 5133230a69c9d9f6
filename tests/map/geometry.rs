use cinesplat::map::drawing::Ink;
use cinesplat::map::{Drawing, draw};
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::trajectory::{Keyframe, Shot};
use glam::{DQuat, DVec2, DVec3, Quat};

use super::{FOV_Y_DEG, areas, first_key_px, key, mapped, middle, room, texts, travel, views};

/// Fill of a view cone in the plan.
const CONE: Ink = Ink::new([20, 70, 160]).with_opacity(0.13);

/// Pixels per scene unit by the scale bar: the length of its two halves over the number beside it.
fn px_per_unit(drawing: &Drawing) -> f64 {
    let (at, words) = texts(drawing).into_iter().find(|(_, words)| words.contains("scene unit")).unwrap();
    let left = views(drawing)[0].0.x;
    let units: f64 = words.split(' ').next().unwrap().parse().unwrap();
    (at.x - 9.0 - left) / units
}

#[test]
fn a_known_camera_lands_at_the_computed_pixel() {
    let drawing = mapped(&travel());
    let (scale, found) = (px_per_unit(&drawing), first_key_px(&drawing));
    // The room is symmetric, so the world's origin is in the middle of the plan. The path runs along +x, which is to the
    // right; with y up, -z is ahead.
    let (corner, size) = views(&drawing)[0];
    let expected = corner + size / 2.0 + DVec2::new(-0.5, 0.5) * scale;
    assert!(found.distance(expected) < 0.02 * scale, "{found} is not {expected}");
    // From the side: height 1.2 over a floor at 0 under a ceiling at 2.5.
    let discs = areas(&drawing, Ink::new([24, 24, 28]));
    let sideways = middle(discs.iter().filter(|disc| disc.len() == 40).nth(1).unwrap());
    let (corner, size) = views(&drawing)[1];
    let expected = corner + size / 2.0 + DVec2::new(-0.5, 1.25 - 1.2) * scale;
    assert!(sideways.distance(expected) < 0.02 * scale, "{sideways} is not {expected}");
}

#[test]
fn a_cone_opens_by_the_horizontal_field_of_view() {
    for (width, height) in [(1280, 720), (720, 1280), (1000, 1000)] {
        let shot = Shot { width, height, ..travel() };
        let drawing = mapped(&shot);
        let apex = first_key_px(&drawing);
        let cone = &areas(&drawing, CONE)[0];
        let rays: Vec<DVec2> = cone.iter().filter(|point| point.distance(apex) > 5.0).map(|p| *p - apex).collect();
        let widest = rays.iter().flat_map(|a| rays.iter().map(|b| a.angle_to(*b).abs())).fold(0.0, f64::max);
        let expected = 2.0 * ((FOV_Y_DEG.to_radians() / 2.0).tan() * f64::from(width) / f64::from(height)).atan();
        assert!((widest - expected).abs() < 1e-6, "{} is not {}", widest.to_degrees(), expected.to_degrees());
        assert!(rays.iter().all(|ray| ray.y < 0.0), "the camera looks ahead, up the page: {rays:?}");
    }
}

#[test]
fn the_scale_bar_has_a_round_length_that_matches_two_keys_one_unit_apart() {
    let drawing = mapped(&travel());
    let words = texts(&drawing).into_iter().find(|(_, words)| words.contains("scene unit")).unwrap().1.to_owned();
    assert!(["0.2 ", "0.5 ", "1 "].iter().any(|start| words.starts_with(start)), "{words}");
    let square = areas(&drawing, Ink::new([24, 24, 28])).into_iter().find(|area| area.len() == 4).unwrap();
    let apart = middle(&square).distance(first_key_px(&drawing));
    assert!((apart - px_per_unit(&drawing)).abs() < 0.01, "{apart} px apart, {} px a unit", px_per_unit(&drawing));
}

/// The room and the travel in a world that is turned, scaled and moved.
fn elsewhere(turn: DQuat, scale: f64, shift: DVec3) -> Drawing {
    let (mut scene, objects) = room();
    let place = |point: DVec3| turn * point * scale + shift;
    let gaussians = &mut scene.gaussians;
    gaussians.means.iter_mut().for_each(|mean| *mean = (turn * mean.as_dvec3() * scale).as_vec3());
    gaussians.origin = shift;
    gaussians.scales.iter_mut().for_each(|s| *s *= scale as f32);
    gaussians.rotations.iter_mut().for_each(|r| *r = (turn * r.as_dquat()).as_quat());
    assert_eq!(gaussians.rotations[0], turn.as_quat() * Quat::IDENTITY);
    scene.up = turn * DVec3::Y;
    let moved = |object: &Object| Object {
        rotation: turn,
        ..Object::from_box(object.id, &object.label, place(object.center), object.half_extents * scale)
    };
    let objects = ObjectSet { objects: objects.objects.iter().map(moved).collect(), labels: Vec::new() };
    let mut shot = travel();
    shot.scene.up = Some(scene.up);
    let moved = |old: &Keyframe| key(old.time_secs, place(old.pose.position), turn * DVec3::NEG_Z, scene.up);
    shot.keyframes = shot.keyframes.iter().map(moved).collect();
    draw(&scene, &objects, &shot).unwrap()
}

#[test]
fn the_map_is_the_same_in_a_world_that_is_turned_scaled_and_moved() {
    let expected = mapped(&travel());
    let turns = [DQuat::IDENTITY, DQuat::from_rotation_x(1.1), DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_Z)];
    for turn in turns {
        for (scale, shift) in [(1e-5, DVec3::ZERO), (1.0, DVec3::ZERO), (3e4, DVec3::splat(2e6))] {
            let found = elsewhere(turn, scale, shift);
            let apart = first_key_px(&found).distance(first_key_px(&expected));
            assert!(apart < 3.0, "{turn} x {scale} + {shift}: {apart} px off");
            let ratio = px_per_unit(&found) * scale / px_per_unit(&expected);
            assert!((ratio - 1.0).abs() < 0.01, "{turn} x {scale} + {shift}: {ratio}");
            let (found, expected) = (&areas(&found, CONE)[0], &areas(&expected, CONE)[0]);
            // A hull may hold a corner twice, a rounding apart.
            let covers = |a: &[DVec2], b: &[DVec2]| a.iter().all(|p| b.iter().any(|q| p.distance(*q) < 4.0));
            assert!(covers(found, expected) && covers(expected, found), "{found:?} {expected:?}");
        }
    }
}
