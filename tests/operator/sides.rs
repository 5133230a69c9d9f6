//! Which side of a subject a film shows where the words leave it open: the captured one, and the front of a lone thing.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Step, SubjectSide, World};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::Move;
use glam::{DVec3, Quat, Vec3};

use super::{add, film, solved, wall};

/// The half of a ball of radius 0.5 about the origin whose azimuth is within a quarter turn of a direction, as flat Gaussians.
fn half_shell(toward: DVec3) -> (Gaussians, ObjectSet) {
    let mut gaussians = Gaussians::default();
    for i in 0..2000 {
        let height = 1.0 - 2.0 * (f64::from(i) + 0.5) / 2000.0;
        let turn = f64::from(i) * 2.399_963;
        let normal = DVec3::new(
            (1.0 - height * height).sqrt() * turn.cos(),
            height,
            (1.0 - height * height).sqrt() * turn.sin(),
        );
        if normal.dot(toward) > 0.0 {
            let rotation = Quat::from_rotation_arc(Vec3::Z, normal.as_vec3());
            add(&mut gaussians, 0.5 * normal, Vec3::new(0.03, 0.03, 0.002), rotation, 0.95);
        }
    }
    let ball = Object::from_box(1, "ball", DVec3::ZERO, DVec3::splat(0.5));
    let objects = vec![Object { num_gaussians: gaussians.len(), ..ball }];
    (gaussians, ObjectSet { objects, labels: Vec::new() })
}

fn still_of(id: u32) -> Vec<Step> {
    vec![Step { end: Framing { subjects: vec![id], ..Framing::default() }, ..Step::of(Move::Static) }]
}

#[test]
fn a_thing_captured_from_one_side_is_filmed_from_there() {
    for toward in [DVec3::X, DVec3::Z, -DVec3::X, -DVec3::Z] {
        let (gaussians, objects) = half_shell(toward);
        let world = World::new(&gaussians, DVec3::Y, &objects, &[1]).unwrap();
        let eye = film(&solved(&world, still_of(1)))[0].pose.position;
        assert!(eye.dot(toward) > 0.0, "captured from {toward}, filmed from {eye}");
    }
}

/// A cube that is all there is.
fn cube() -> (Gaussians, ObjectSet) {
    let mut gaussians = Gaussians::default();
    for axis in 0..3 {
        let [u, v] = [DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]];
        for side in [-0.5, 0.5] {
            wall(&mut gaussians, DVec3::AXES[axis] * side - 0.5 * (u + v), u, v);
        }
    }
    let cube = Object::from_box(1, "cube", DVec3::ZERO, DVec3::splat(0.5));
    let objects = vec![Object { num_gaussians: gaussians.len(), ..cube }];
    (gaussians, ObjectSet { objects, labels: Vec::new() })
}

fn off_deg(eye: DVec3, front: DVec3) -> f64 {
    eye.with_y(0.0).angle_between(front).to_degrees()
}

#[test]
fn a_lone_thing_is_filmed_from_its_front() {
    let (gaussians, objects) = cube();
    for front in [DVec3::X, -DVec3::X, DVec3::Z] {
        let mut world = World::new(&gaussians, DVec3::Y, &objects, &[1]).unwrap();
        world.set_front(1, front);
        let off_deg = off_deg(film(&solved(&world, still_of(1)))[0].pose.position, front);
        assert!(off_deg < 75.0, "front {front}, filmed {off_deg} degrees off");
    }
}

#[test]
fn a_film_that_names_nothing_shows_the_front_of_the_only_thing() {
    let (gaussians, objects) = cube();
    for front in [DVec3::X, -DVec3::X, DVec3::Z] {
        let mut world = World::new(&gaussians, DVec3::Y, &objects, &[]).unwrap();
        world.set_front_of_whole(&[], front);
        let off_deg = off_deg(film(&solved(&world, vec![Step::of(Move::PushIn)]))[0].pose.position, front);
        assert!(off_deg < 60.0, "front {front}, filmed {off_deg} degrees off");
    }
}

#[test]
fn a_full_circle_begins_and_ends_at_the_front_and_an_arc_passes_it() {
    let (gaussians, objects) = cube();
    for front in [DVec3::X, -DVec3::Z] {
        let mut world = World::new(&gaussians, DVec3::Y, &objects, &[1]).unwrap();
        world.set_front_of_whole(&[1], front);
        let around = |amount| {
            let end = Framing { subjects: vec![1], ..Framing::default() };
            let orbit = Step { end, amount, either_way: true, ..Step::of(Move::OrbitLeft) };
            film(&solved(&world, vec![orbit]))
        };
        let circle = around(Some(Amount::Degrees(360.0)));
        for end in [circle[0], circle[circle.len() - 1]] {
            let off_deg = off_deg(end.pose.position, front);
            assert!(off_deg < 1.0, "begins and ends {off_deg} degrees off");
        }
        let nearest = around(None).iter().map(|state| off_deg(state.pose.position, front)).fold(180.0, f64::min);
        assert!(nearest < 20.0, "passes {nearest} degrees off");
    }
}

#[test]
fn a_three_quarter_view_is_between_the_front_and_a_side() {
    let (gaussians, objects) = cube();
    for (side, middle_deg) in [(SubjectSide::FromFrontQuarter, 45.0), (SubjectSide::FromBackQuarter, 135.0)] {
        let mut world = World::new(&gaussians, DVec3::Y, &objects, &[1]).unwrap();
        world.set_front(1, DVec3::X);
        let end = Framing { subjects: vec![1], side: Some(side), ..Framing::default() };
        let eye = film(&solved(&world, vec![Step { end, ..Step::of(Move::Static) }]))[0].pose.position;
        let off_deg = off_deg(eye, DVec3::X);
        assert!((off_deg - middle_deg).abs() < 36.0, "{side}: {off_deg} degrees off the front");
    }
}
