//! Views from above.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Framing, Program, SolveLevel, SolveSettings, Step, World, realize};
use cinesplat::trajectory::{Move, ShotAngle};
use glam::DVec3;

use super::{ROOM, film, room, solved, wall, world};

fn overhead(id: u32) -> Framing {
    Framing { subjects: vec![id], angle: Some(ShotAngle::Overhead), ..Framing::default() }
}

#[test]
fn a_top_view_looks_straight_down() {
    let world = world();
    for movement in [Move::Static, Move::RollCw] {
        let step = Step { end: overhead(1), ..Step::of(movement) };
        for state in film(&solved(&world, vec![step])) {
            let down = (-state.pose.forward().y).asin().to_degrees();
            assert!(down > 75.0, "{movement}: looks down by {down} degrees");
        }
    }
}

#[test]
fn a_turn_above_a_thing_is_plumb_and_shows_another_side_of_it() {
    let frames = film(&solved(&world(), vec![Step { end: overhead(1), ..Step::of(Move::RollCw) }]));
    let (first, last) = (&frames[0], &frames[frames.len() - 1]);
    let down = (-first.pose.forward().y).asin().to_degrees();
    assert!(down > 83.0, "looks down by {down} degrees");
    let turned = first.pose.right().angle_between(last.pose.right()).to_degrees();
    assert!((45.0..95.0).contains(&turned), "turns by {turned} degrees");
}

#[test]
fn a_high_angle_on_a_low_thing_looks_down_on_it() {
    let framing = Framing { angle: Some(ShotAngle::High), subjects: vec![2], ..Framing::default() };
    let center = DVec3::new(-1.2, 0.5, 0.8);
    let away =
        film(&solved(&world(), vec![Step { end: framing, ..Step::of(Move::ArcRight) }]))[0].pose.position - center;
    let elevation = away.y.atan2(away.with_y(0.0).length()).to_degrees();
    assert!(elevation > 32.0, "from {elevation} degrees above");
}

#[test]
fn a_top_view_below_a_ceiling_stays_in_the_room_with_a_wider_lens() {
    let (mut gaussians, objects) = room();
    wall(&mut gaussians, DVec3::new(-3.0, ROOM.y, -3.0), DVec3::X * 6.0, DVec3::Z * 6.0);
    // A table of 2.4 by 1.6 m: at a normal lens it needs more room above it than there is.
    let (center, half) = (DVec3::new(0.0, 0.7, -1.0), DVec3::new(1.2, 0.04, 0.8));
    let first = gaussians.len();
    wall(&mut gaussians, center - half, DVec3::X * 2.4, DVec3::Z * 1.6);
    let table = Object { num_gaussians: gaussians.len() - first, ..Object::from_box(3, "table", center, half) };
    let set = ObjectSet { objects: objects.objects.into_iter().chain([table]).collect(), labels: Vec::new() };
    let world = World::new(&gaussians, DVec3::Y, &set, &[3]).unwrap();
    let state = film(&solved(&world, vec![Step { end: overhead(3), ..Step::of(Move::Static) }]))[0];
    let down = (-state.pose.forward().y).asin().to_degrees();
    assert!(down > 75.0 && state.pose.position.y < ROOM.y, "{down} degrees down from {}", state.pose.position);
    assert!(state.pose.right().x.abs() > 0.99, "the long side lies across: {}", state.pose.right());
}

#[test]
fn without_a_search_a_room_is_seen_from_its_best_lookout() {
    // Without a director there is no proposed camera: of a long room the view along it is the best.
    let mut gaussians = cinesplat::scene::Gaussians::default();
    let size = DVec3::new(9.0, 2.5, 3.0);
    for y in [0.0, size.y] {
        wall(&mut gaussians, DVec3::new(0.0, y, 0.0), DVec3::X * size.x, DVec3::Z * size.z);
    }
    for z in [0.0, size.z] {
        wall(&mut gaussians, DVec3::new(0.0, 0.0, z), DVec3::X * size.x, DVec3::Y * size.y);
    }
    for x in [0.0, size.x] {
        wall(&mut gaussians, DVec3::new(x, 0.0, 0.0), DVec3::Z * size.z, DVec3::Y * size.y);
    }
    let world = World::new(&gaussians, DVec3::Y, &ObjectSet::default(), &[]).unwrap();
    let program = Program { steps: vec![Step::of(Move::Static)], ..Program::default() };
    let settings = |level| SolveSettings { level, ..SolveSettings::default() };
    let sight = |level| {
        let state = film(&realize(&world, &program, "", &[], &settings(level)))[0];
        let (eye, forward) = (state.pose.position, state.pose.forward().with_y(0.0).normalize());
        if forward.x > 0.0 { (size.x - eye.x) * forward.x } else { -eye.x * forward.x }
    };
    let (off, full) = (sight(SolveLevel::Off), sight(SolveLevel::Full));
    assert!(off > 0.55 * size.x && off > 0.8 * full, "{off} m of sight without a search, {full} m with one");
}
