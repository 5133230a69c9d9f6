//! Views that face what they show: slides along a wall are square to it, seats are seen from before, and low views look up.

use cinesplat::objects::Object;
use cinesplat::operator::{
    Framing, Motion, Pass, Program, SolveLevel, SolveSettings, Step, SubjectPart, Via, World, realize,
};
use cinesplat::trajectory::{CameraState, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::composition::in_frame;
use super::{film, room, solved, wall, world};

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// Middles of the pictures, and the room with them on the wall at -z: 3 on the left, 4 and 5 on the right of it.
const PICTURES: [f64; 3] = [-0.8, 0.0, 0.8];

fn gallery() -> World {
    let (mut gaussians, mut objects) = room();
    for (id, x) in (3..).zip(PICTURES) {
        let (center, half) = (DVec3::new(x, 1.5, -2.95), DVec3::new(0.3, 0.35, 0.02));
        let first = gaussians.len();
        wall(&mut gaussians, center - DVec3::new(0.3, 0.35, 0.0), DVec3::X * 0.6, DVec3::Y * 0.7);
        let picture = Object::from_box(id, &format!("picture {id}"), center, half);
        objects.objects.push(Object { num_gaussians: gaussians.len() - first, ..picture });
    }
    World::new(&gaussians, DVec3::Y, &objects, &[1, 2, 3, 4, 5]).unwrap()
}

/// Angle between the level part of a view axis and a level direction, degrees.
fn off_deg(state: &CameraState, ahead: DVec3) -> f64 {
    let forward = state.pose.forward();
    DVec3::new(forward.x, 0.0, forward.z).angle_between(ahead).to_degrees()
}

#[test]
fn a_slide_along_pictures_is_square_to_their_wall() {
    let from_to = Step { start: about(3), end: about(5), ..Step::of(Move::TruckRight) };
    let row = |part| Framing { subjects: vec![3, 4, 5], part, ..Framing::default() };
    let along = Step { start: row(SubjectPart::Left), end: row(SubjectPart::Right), ..Step::of(Move::TruckRight) };
    for step in [from_to, along] {
        let states = film(&solved(&gallery(), vec![step]));
        let (first, last) = (&states[0], &states[states.len() - 1]);
        assert!(off_deg(first, -DVec3::Z) < 15.0, "{} degrees off the wall", off_deg(first, -DVec3::Z));
        let places = [(first, PICTURES[0]), (last, PICTURES[2])]
            .map(|(state, x)| in_frame(state, DVec3::new(x, 1.5, -2.95)).x.abs());
        assert!(places.iter().all(|place| *place < 0.3), "pictures at {places:?}");
    }
}

#[test]
fn a_rise_before_a_picture_is_square_to_its_wall() {
    let states = film(&solved(&gallery(), vec![Step { end: about(3), ..Step::of(Move::PedestalUp) }]));
    assert!(off_deg(&states[0], -DVec3::Z) < 20.0, "{} degrees off the wall", off_deg(&states[0], -DVec3::Z));
}

#[test]
fn what_faces_people_is_seen_from_before() {
    for facing in [DVec3::X, -DVec3::Z] {
        let mut world = world();
        world.set_facing(2, facing);
        for movement in [Move::Static, Move::PushIn] {
            let states = film(&solved(&world, vec![Step { end: about(2), ..Step::of(movement) }]));
            let eye = states[states.len() - 1].pose.position;
            let from = DVec3::new(eye.x + 1.2, 0.0, eye.z - 0.8);
            assert!(from.angle_between(facing).to_degrees() < 90.0, "{movement}: {facing} seen from {from}");
        }
    }
}

#[test]
fn a_low_push_looks_up_from_its_start() {
    let low = Framing { angle: Some(ShotAngle::Low), ..about(1) };
    let states = film(&solved(&world(), vec![Step { end: low, ..Step::of(Move::PushIn) }]));
    let pitch_deg = states[0].pose.forward().y.asin().to_degrees();
    assert!((7.5..=42.5).contains(&pitch_deg), "pitch {pitch_deg}");
}

#[test]
fn a_pull_out_to_the_room_leaves_its_subject_small() {
    let wide = Framing { size: Some(ShotSize::Long), ..Framing::default() };
    let (mut gaussians, mut objects) = room();
    let center = DVec3::new(-1.2, 1.1, 0.8);
    let first = gaussians.len();
    wall(&mut gaussians, center - DVec3::new(0.08, 0.08, 0.0), DVec3::X * 0.16, DVec3::Y * 0.16);
    let mug = Object::from_box(3, "mug", center, DVec3::splat(0.09));
    objects.objects.push(Object { num_gaussians: gaussians.len() - first, ..mug });
    let world = World::new(&gaussians, DVec3::Y, &objects, &[3]).unwrap();
    let steps = vec![Step { end: about(3), ..Step::of(Move::PushIn) }, Step { end: wide, ..Step::of(Move::PullOut) }];
    let states = film(&solved(&world, steps));
    let last = &states[states.len() - 1];
    let size = 0.16 / (2.0 * last.pose.position.distance(center) * (last.fov_y_rad / 2.0).tan());
    assert!(size < 0.25, "the mug is {size} of the height");
}

#[test]
fn a_pan_past_a_thing_shows_it_and_one_without_tilts_keeps_its_pitch() {
    let world = gallery();
    let past = Some(Via { how: Pass::Past, objects: vec![1] });
    let pan = Step { start: about(4), end: about(2), via: past, ..Step::of(Move::PanRight) };
    let states = film(&solved(&world, vec![pan]));
    let seen = |state: &CameraState| {
        let ahead = (DVec3::new(1.2, 0.6, 0.9) - state.pose.position).dot(state.pose.forward()) > 0.0;
        ahead && in_frame(state, DVec3::new(1.2, 0.6, 0.9)).abs().max_element() < 0.5
    };
    assert!(states.iter().any(seen), "the box is never seen");

    let steps = vec![Step { start: about(3), end: about(2), either_way: true, ..Step::of(Move::PanRight) }];
    let program = Program { steps, forbidden: vec![Motion::Tilt], ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Fast, seed: 7, ..SolveSettings::default() };
    let states = film(&realize(&world, &program, "", &[], &settings));
    let pitches: Vec<f64> = states.iter().map(|state| state.pose.forward().y.asin().to_degrees()).collect();
    let (least, most) = pitches.iter().fold((f64::MAX, f64::MIN), |(low, high), deg| (low.min(*deg), high.max(*deg)));
    assert!(most - least < 1.0, "pitch {least} to {most}");
}

#[test]
fn a_crane_from_one_thing_to_another_goes_no_way_around() {
    let crane = Step { start: about(1), end: about(2), ..Step::of(Move::CraneUp) };
    let states = film(&solved(&world(), vec![crane]));
    let [first, last] = [&states[0], &states[states.len() - 1]].map(|state| {
        let from = state.pose.position - DVec3::new(-1.2, 0.5, 0.8);
        DVec3::new(from.x, 0.0, from.z)
    });
    let turn_deg = first.angle_between(last).to_degrees();
    assert!(turn_deg < 30.0, "{turn_deg} degrees around the second thing");
}
