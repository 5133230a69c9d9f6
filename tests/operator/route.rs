//! Routes: through a door, not through a wall, and none out of a closed box.

use cinesplat::geometry::Pose;
use cinesplat::objects::ObjectSet;
use cinesplat::operator::{NoRoute, Route, World, route};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraPath, CameraState};
use glam::DVec3;

use super::clearance::Dice;
use super::{brute_force, room, wall};
use crate::support::shot_over;

/// The door in the plane x = 0: least and largest z, and height.
const DOOR: (f64, f64, f64) = (1.2, 2.0, 2.0);

/// The room with a wall across its middle and a door in it.
fn divided() -> Gaussians {
    let (mut gaussians, _) = room();
    let floor = DVec3::new(0.0, 0.0, -3.0);
    wall(&mut gaussians, floor, DVec3::Z * (DOOR.0 + 3.0), DVec3::Y * 2.6);
    wall(&mut gaussians, DVec3::new(0.0, 0.0, DOOR.1), DVec3::Z * (3.0 - DOOR.1), DVec3::Y * 2.6);
    wall(&mut gaussians, DVec3::new(0.0, DOOR.2, DOOR.0), DVec3::Z * (DOOR.1 - DOOR.0), DVec3::Y * 0.6);
    // The ceiling blocks routes over the wall.
    wall(&mut gaussians, DVec3::new(-3.0, 2.6, -3.0), DVec3::X * 6.0, DVec3::Z * 6.0);
    gaussians
}

fn prepared(gaussians: &Gaussians) -> World {
    World::new(gaussians, DVec3::Y, &ObjectSet::default(), &[]).unwrap()
}

fn camera(x: f64, y: f64, z: f64) -> CameraState {
    let pose = Pose::facing(DVec3::new(x, y, z), DVec3::X, DVec3::Y, None);
    CameraState { pose, fov_y_rad: 0.9, focus_distance: None }
}

/// Densely sampled positions of a route.
fn positions(world: &World, route: &Route) -> Vec<DVec3> {
    let path = CameraPath::new(&shot_over(route.keyframes(world, 6.0))).unwrap();
    (0..=1500).map(|i| path.sample(f64::from(i) * 0.004).pose.position).collect()
}

#[test]
fn a_route_crosses_a_wall_through_its_door() {
    let gaussians = divided();
    let world = prepared(&gaussians);
    let (start, goal) = (camera(-2.0, 1.2, -1.5), camera(2.2, 1.4, -1.2));
    let found = route(&world, &start, &goal).unwrap();
    assert!(!found.is_straight() && found.proof.is_clear());
    assert_eq!((found.states[0], found.states[found.states.len() - 1]), (start, goal));
    let way = positions(&world, &found);
    for pair in way.windows(2) {
        let distance = brute_force(&gaussians, pair[0]).0;
        assert!(
            distance >= world.camera_radius && distance >= found.proof.min_distance - 1e-9,
            "{distance} at {}",
            pair[0]
        );
        if pair[0].x * pair[1].x <= 0.0 {
            assert!((DOOR.0..DOOR.1).contains(&pair[0].z) && pair[0].y < DOOR.2, "crosses at {}", pair[0]);
        }
    }
    // The route is at most 15 % longer than the shortest one, along the door's near edge.
    let edge = DVec3::new(0.0, 1.3, DOOR.0 + world.camera_radius);
    let shortest = start.pose.position.distance(edge) + edge.distance(goal.pose.position);
    let length: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    assert!(length < 1.15 * shortest, "{length} where {shortest} would do");
    assert_eq!(route(&world, &start, &goal).unwrap(), found, "a second search gives another route");
}

#[test]
fn an_open_route_is_straight() {
    let world = prepared(&divided());
    let found = route(&world, &camera(-2.0, 1.2, -1.5), &camera(-2.0, 1.2, 1.5)).unwrap();
    assert!(found.is_straight());
}

#[test]
fn no_route_leaves_a_closed_box() {
    let (mut gaussians, _) = room();
    let low = DVec3::new(-2.0, 0.6, -2.0);
    for (corner, u, v) in [
        (low, DVec3::X, DVec3::Y),
        (low + DVec3::Z, DVec3::X, DVec3::Y),
        (low, DVec3::Z, DVec3::Y),
        (low + DVec3::X, DVec3::Z, DVec3::Y),
        (low, DVec3::X, DVec3::Z),
        (low + DVec3::Y, DVec3::X, DVec3::Z),
    ] {
        wall(&mut gaussians, corner, u, v);
    }
    let world = prepared(&gaussians);
    let (outside, inside) = (camera(0.5, 1.2, -1.0), camera(-1.5, 1.1, -1.5));
    assert_eq!(route(&world, &outside, &inside), Err(NoRoute::Enclosed));
    assert_eq!(route(&world, &inside, &outside), Err(NoRoute::Enclosed));
    assert_eq!(route(&world, &camera(-3.0, 1.2, 0.0), &outside), Err(NoRoute::BlockedStart));
    assert_eq!(route(&world, &outside, &camera(-2.0, 1.1, -1.5)), Err(NoRoute::BlockedGoal));
}

#[test]
fn routes_between_random_places_are_clear_by_a_plain_scan() {
    let gaussians = divided();
    let world = prepared(&gaussians);
    let mut dice = Dice(4);
    // Free places on either side of the wall at x = 0.
    let mut place = |side: f64| loop {
        let point = dice.vector() * DVec3::new(2.8, 1.2, 2.8) + DVec3::Y * 1.3;
        if point.x * side > 0.0 && world.clearance(point) >= 1.25 * world.camera_radius {
            return point;
        }
    };
    let mut num_detours = 0;
    for _ in 0..6 {
        let (a, b) = (place(-1.0), place(1.0));
        let Ok(found) = route(&world, &camera(a.x, a.y, a.z), &camera(b.x, b.y, b.z)) else { continue };
        num_detours += usize::from(!found.is_straight());
        let path = CameraPath::new(&shot_over(found.keyframes(&world, 6.0))).unwrap();
        for i in 0..=300 {
            let distance = brute_force(&gaussians, path.sample(f64::from(i) * 0.02).pose.position).0;
            assert!(distance >= world.camera_radius && distance >= found.proof.min_distance - 1e-9, "{distance}");
        }
    }
    assert!(num_detours > 0, "no route through the door was found");
}
