//! What stands before or beside a subject in the picture, and many things in one picture.

use cinesplat::objects::Object;
use cinesplat::operator::{Framing, Step, World};
use cinesplat::trajectory::{CameraState, Move};
use glam::{DVec2, DVec3};

use super::viewpoints::generated;
use super::{film, room, solved, wall};

/// Position in the frame of a world point, over its width and height from the middle.
fn position(state: &CameraState, point: DVec3) -> DVec2 {
    let at = state.pose.to_camera(point);
    let tan = 2.0 * (state.fov_y_rad / 2.0).tan();
    DVec2::new(at.x / at.z / tan * 9.0 / 16.0, -at.y / at.z / tan)
}

/// Bounds in the frame of a box.
fn bounds(state: &CameraState, center: DVec3, half: DVec3) -> [DVec2; 2] {
    let sign = |i: usize, bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corners = (0..8).map(|i| position(state, center + half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2))));
    corners.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

#[test]
fn a_portrait_is_taken_from_where_no_post_stands_before_it() {
    let (mut gaussians, objects) = room();
    // Thin posts on two sides of box 1, at half a step from it.
    let posts = [DVec3::new(0.55, 0.0, 0.75), DVec3::new(1.1, 0.0, 0.3)];
    for post in posts {
        wall(&mut gaussians, post, DVec3::X * 0.06, DVec3::Y * 1.2);
    }
    let world = World::new(&gaussians, DVec3::Y, &objects, &[1, 2]).unwrap();
    let portrait = Step { start: Framing { subjects: vec![1], ..Framing::default() }, ..Step::of(Move::Static) };
    let state = film(&solved(&world, vec![portrait]))[0];
    let (center, half) = (DVec3::new(1.2, 0.6, 0.9), DVec3::new(0.3, 0.6, 0.3));
    let [low, high] = bounds(&state, center, half);
    assert!((0.55..0.9).contains(&(high.y - low.y)), "{} of the height", high.y - low.y);
    for post in posts {
        let at = position(&state, post + DVec3::new(0.03, 0.6, 0.0));
        let is_before = state.pose.to_camera(post).z < state.pose.to_camera(center).z - 0.3;
        let is_over = at.cmpge(low).all() && at.cmple(high).all();
        assert!(!(is_before && is_over), "the post at {post} stands before the box, at {at}");
    }
}

#[test]
fn many_things_fill_the_picture_about_its_middle_and_are_told_apart() {
    let (mut gaussians, mut objects) = room();
    let half = DVec3::new(0.08, 0.15, 0.08);
    let centers = [(-0.5, -1.0), (-0.1, -1.5), (0.3, -0.9), (0.0, -1.1)].map(|(x, z)| DVec3::new(x, 0.75, z));
    for (i, center) in centers.into_iter().enumerate() {
        let first = gaussians.len();
        for side in [-1.0, 1.0] {
            let corner = center + DVec3::new(-half.x, -half.y, side * half.z);
            wall(&mut gaussians, corner, DVec3::X * 2.0 * half.x, DVec3::Y * 2.0 * half.y);
            let corner = center + DVec3::new(side * half.x, -half.y, -half.z);
            wall(&mut gaussians, corner, DVec3::Z * 2.0 * half.z, DVec3::Y * 2.0 * half.y);
        }
        let id = 11 + u32::try_from(i).unwrap();
        let thing = Object::from_box(id, &format!("thing {i}"), center, half);
        objects.objects.push(Object { num_gaussians: gaussians.len() - first, ..thing });
    }
    // The table.
    wall(&mut gaussians, DVec3::new(-0.8, 0.58, -1.8), DVec3::X * 1.4, DVec3::Z * 1.2);
    let ids = vec![11, 12, 13, 14];
    let world = World::new(&gaussians, DVec3::Y, &objects, &ids).unwrap();
    let group = Step { end: Framing { subjects: ids, ..Framing::default() }, ..Step::of(Move::Static) };
    let state = film(&solved(&world, vec![group]))[0];
    let parts = centers.map(|center| bounds(&state, center, half));
    let low = parts.iter().map(|part| part[0]).reduce(DVec2::min).unwrap();
    let high = parts.iter().map(|part| part[1]).reduce(DVec2::max).unwrap();
    assert!(low.midpoint(high).abs().max_element() < 0.03, "the middle of all at {}", low.midpoint(high));
    assert!((high - low).max_element() > 0.65, "all of them fill {}", high - low);
    let area = |[low, high]: [DVec2; 2]| (high - low).max(DVec2::ZERO).element_product();
    let shared: f64 = (0..4)
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| area([parts[i][0].max(parts[j][0]), parts[i][1].min(parts[j][1])]))
        .sum();
    let total: f64 = parts.into_iter().map(area).sum();
    assert!(shared < 0.25 * total, "{shared} of {total} is shared");
}

#[test]
fn a_walk_into_a_room_ends_with_its_things_about_the_middle() {
    for seed in [3, 7] {
        let (opened, world) = generated(seed, &[]);
        let objects = opened.objects.unwrap();
        let walk = film(&solved(&world, vec![Step::of(Move::FlyThrough)]));
        let last = walk[walk.len() - 1];
        let ahead = objects.objects.iter().filter(|object| last.pose.to_camera(object.center).z > 0.5);
        let seen: Vec<DVec2> = ahead.map(|object| position(&last, object.center)).collect();
        let seen: Vec<DVec2> = seen.into_iter().filter(|at| at.abs().max_element() < 0.5).collect();
        let middle = seen.iter().sum::<DVec2>() / seen.len() as f64;
        assert!(seen.len() >= 4, "{} things in the last picture", seen.len());
        assert!(middle.abs().max_element() < 0.2, "the middle of its things at {middle}");
    }
}
