//! Passing an object under, through, behind, in front of and along it; and a reveal from behind one.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Framing, Pass, Solution, Step, Via, World};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraState, Move, ShotSize};
use glam::DVec3;

use super::composition::assert_met;
use super::{film, room, solved, wall};

/// Center and half extents of a table top (3), a door frame (4) and a post (5).
const TABLE: (DVec3, DVec3) = (DVec3::new(0.8, 1.1, -1.2), DVec3::new(0.6, 0.03, 0.35));
const DOOR: (DVec3, DVec3) = (DVec3::new(-1.2, 0.95, -1.0), DVec3::new(0.55, 0.95, 0.05));
const POST: (DVec3, DVec3) = (DVec3::new(0.45, 0.8, -0.1), DVec3::new(0.35, 0.8, 0.06));

fn object(id: u32, (center, half_extents): (DVec3, DVec3)) -> Object {
    Object::from_box(id, &format!("thing {id}"), center, half_extents)
}

/// The room with further objects; `post` stands between box 1 and the middle of the room.
fn furnished(post: bool) -> World {
    let (mut gaussians, mut objects) = room();
    let slab = |gaussians: &mut Gaussians, (center, half): (DVec3, DVec3)| {
        wall(gaussians, center - half.with_y(0.0), DVec3::X * 2.0 * half.x, DVec3::Z * 2.0 * half.z);
    };
    slab(&mut gaussians, TABLE);
    let (center, half) = DOOR;
    for side in [-1.0, 1.0] {
        let foot = DVec3::new(center.x + side * half.x, 0.0, center.z - half.z);
        wall(&mut gaussians, foot, DVec3::Z * 2.0 * half.z, DVec3::Y * 2.0 * half.y);
    }
    let top = DVec3::new(center.x - half.x, 2.0 * half.y, center.z - half.z);
    wall(&mut gaussians, top, DVec3::X * 2.0 * half.x, DVec3::Z * 2.0 * half.z);
    let mut further = vec![object(3, TABLE), object(4, DOOR)];
    if post {
        let (center, half) = POST;
        wall(&mut gaussians, center - half.with_z(0.0), DVec3::X * 2.0 * half.x, DVec3::Y * 2.0 * half.y);
        further.push(object(5, POST));
    }
    objects = ObjectSet { objects: objects.objects.into_iter().chain(further).collect(), ..objects };
    World::new(&gaussians, DVec3::Y, &objects, &[1, 2, 3, 4, 5]).unwrap()
}

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn passed(how: Pass, id: u32, step: Step) -> Solution {
    solved(&furnished(id == 5), vec![Step { via: Some(Via { how, objects: vec![id] }), ..step }])
}

/// Positions on a fine polyline through the frames.
fn positions(solution: &Solution) -> Vec<DVec3> {
    let frames: Vec<CameraState> = film(solution);
    let between = |pair: &[CameraState]| {
        let (a, b) = (pair[0].pose.position, pair[1].pose.position);
        (0..20).map(move |i| a.lerp(b, f64::from(i) / 20.0)).collect::<Vec<_>>()
    };
    frames.windows(2).flat_map(between).collect()
}

#[test]
fn under_an_object_is_below_its_bottom() {
    for movement in [Move::FlyThrough, Move::PushIn, Move::Follow] {
        let solution = passed(Pass::Under, 3, Step { end: about(1), ..Step::of(movement) });
        let (center, half) = TABLE;
        let below: Vec<DVec3> = positions(&solution)
            .into_iter()
            .filter(|p| (p.x - center.x).abs() < half.x && (p.z - center.z).abs() < half.z)
            .collect();
        assert!(!below.is_empty() && below.iter().all(|p| p.y < center.y - half.y), "{movement}");
        assert_met(&solution, "passes under thing 3");
    }
}

#[test]
fn through_an_object_crosses_its_box() {
    for (movement, end) in [(Move::FlyThrough, Framing::default()), (Move::Follow, about(2)), (Move::PushIn, about(2))]
    {
        let solution = passed(Pass::Through, 4, Step { end, ..Step::of(movement) });
        let (center, half) = DOOR;
        let inside = |p: &DVec3| ((*p - center) / half).abs().max_element() <= 1.0;
        let path = positions(&solution);
        assert!(path.iter().any(inside), "{movement}");
        let sides = [path[0].z - center.z, path[path.len() - 1].z - center.z];
        assert!(sides[0] * sides[1] < 0.0, "{movement} ends on the other side: {sides:?}");
        assert_met(&solution, "passes through thing 4");
    }
}

#[test]
fn behind_and_in_front_are_the_back_and_the_front() {
    for (how, sign) in [(Pass::Behind, -1.0), (Pass::Front, 1.0)] {
        for movement in [Move::FlyThrough, Move::Follow] {
            let solution = passed(how, 2, Step::of(movement));
            let center = DVec3::new(-1.2, 0.5, 0.8);
            // The front faces the middle of the room.
            let front = DVec3::new(1.2, 0.0, -0.8) * sign;
            let off = |p: &DVec3| (*p - center).with_y(0.0).angle_between(front).to_degrees();
            let least = positions(&solution).iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(least < 62.0, "{how} {movement}: {least} degrees from that side");
            assert_met(&solution, if how == Pass::Behind { "passes behind" } else { "passes in front of" });
        }
    }
}

#[test]
fn along_an_object_is_from_one_end_to_the_other() {
    for movement in [Move::TruckRight, Move::TruckLeft, Move::FlyThrough, Move::PushIn] {
        let solution = passed(Pass::Along, 3, Step::of(movement));
        let path = positions(&solution);
        let (center, half) = TABLE;
        let along = path.iter().map(|p| ((p.x - center.x) / half.x).clamp(-1.0, 1.0));
        let (low, high) = along.fold((1.0_f64, -1.0_f64), |(low, high), at| (low.min(at), high.max(at)));
        assert!(high - low > 1.6, "{movement} covers {low} to {high}");
        assert_met(&solution, "passes along thing 3");
    }
}

#[test]
fn a_reveal_from_behind_an_object_starts_with_the_subject_hidden() {
    let solution = passed(Pass::Behind, 5, Step { end: about(1), ..Step::of(Move::Reveal) });
    let frames = film(&solution);
    let (center, half) = POST;
    // The line from the first camera to the subject's center crosses the post.
    let (eye, subject) = (frames[0].pose.position, DVec3::new(1.2, 0.6, 0.9));
    let crossing = eye.lerp(subject, (center.z - eye.z) / (subject.z - eye.z));
    assert!((crossing.x - center.x).abs() < half.x && crossing.y < center.y + half.y, "{crossing}");
    let eye = frames[frames.len() - 1].pose.position;
    let crossing = eye.lerp(subject, (center.z - eye.z) / (subject.z - eye.z));
    assert!((crossing.x - center.x).abs() > half.x || crossing.y > center.y + half.y, "{crossing}");
    assert_met(&solution, "visible share of box 1 at most 0.10 at the start");
    assert_met(&solution, "visible share of box 1 at least 0.60 at the end");
}

#[test]
fn a_hidden_subject_is_not_visible_at_that_end() {
    let start = Framing { hidden: true, ..about(1) };
    let solution = solved(&furnished(true), vec![Step { start, end: about(1), ..Step::of(Move::Follow) }]);
    assert_met(&solution, "visible share of box 1 at most 0.10 at the start");
}

#[test]
fn trucks_see_the_named_side_and_slide_through_the_gate() {
    let solution = passed(Pass::Front, 2, Step::of(Move::TruckRight));
    assert_met(&solution, "passes in front of box 2");
    let solution = passed(Pass::Under, 3, Step { end: about(1), ..Step::of(Move::TruckLeft) });
    let (center, half) = TABLE;
    let below =
        |p: &DVec3| (p.x - center.x).abs() < half.x && (p.z - center.z).abs() < half.z && p.y < center.y - half.y;
    assert!(positions(&solution).iter().any(below));
}

#[test]
fn a_pull_out_through_an_object_leaves_its_subject_behind_it() {
    let solution = passed(Pass::Through, 4, Step { start: about(2), ..Step::of(Move::PullOut) });
    let (center, half) = DOOR;
    let path = positions(&solution);
    assert!(path.iter().any(|p| ((*p - center) / half).abs().max_element() <= 1.0));
    let subject = DVec3::new(-1.2, 0.5, 0.8);
    assert!(path[path.len() - 1].distance(subject) > 1.3 * path[0].distance(subject));
    assert_met(&solution, "passes through thing 4");
}

#[test]
fn a_pass_after_another_step_starts_where_that_step_ends() {
    for (how, id) in [(Pass::Through, 4), (Pass::Under, 3), (Pass::Behind, 2), (Pass::Along, 3)] {
        let hold = Step { start: about(2), ..Step::of(Move::Static) };
        for movement in [Move::PullOut, Move::Follow] {
            let pass = Step { via: Some(Via { how, objects: vec![id] }), ..Step::of(movement) };
            let frames = film(&solved(&furnished(false), vec![hold.clone(), pass]));
            for pair in frames.windows(2) {
                let turn = pair[0].pose.forward().angle_between(pair[1].pose.forward()).to_degrees();
                let travel = pair[0].pose.position.distance(pair[1].pose.position);
                assert!(turn < 25.0 && travel < 0.4, "{how} {movement}: jumps by {turn} degrees and {travel}");
            }
        }
    }
}

/// Level distance of a point from a box with axes along the world's.
fn level_distance((center, half): (DVec3, DVec3), point: DVec3) -> f64 {
    ((point - center).abs() - half).max(DVec3::ZERO).with_y(0.0).length()
}

/// Angle between the view axis of a camera and the direction to box 1, degrees.
fn off_box_deg(state: &CameraState) -> f64 {
    state.pose.forward().angle_between(DVec3::new(1.2, 0.6, 0.9) - state.pose.position).to_degrees()
}

#[test]
fn from_an_object_the_camera_starts_next_to_it_and_ends_on_the_subject() {
    let boxed = (DVec3::new(-1.2, 0.5, 0.8), DVec3::new(0.4, 0.5, 0.3));
    for movement in [Move::Static, Move::PushIn, Move::ZoomIn, Move::Follow, Move::FlyThrough, Move::Reveal] {
        let solution = passed(Pass::From, 2, Step { end: about(1), ..Step::of(movement) });
        let frames = film(&solution);
        let (position, off) = (frames[0].pose.position, off_box_deg(&frames[frames.len() - 1]));
        assert!(level_distance(boxed, position) < 1.3 && (0.3..2.2).contains(&position.y), "{movement}: {position}");
        assert!(off < 20.0, "{movement} ends {off} degrees beside the subject");
        assert!(solution.clearance.is_clear(), "{movement}");
        assert_met(&solution, "the camera starts at box 2");
        assert_met(&solution, "visible share of box 1");
    }
}

#[test]
fn a_flight_from_one_thing_to_another_begins_at_the_first_and_looks_ahead() {
    let walk = Step { start: about(2), end: about(1), ..Step::of(Move::FlyThrough) };
    let solution = solved(&furnished(false), vec![walk.clone()]);
    assert_met(&solution, "the camera starts at box 2");
    let frames = film(&solution);
    assert!(off_box_deg(&frames[0]) < 60.0 && off_box_deg(&frames[frames.len() - 1]) < 20.0);
    // A stated picture of the first thing is one to open on.
    let start = Framing { size: Some(ShotSize::MediumCloseUp), ..about(2) };
    let solution = solved(&furnished(false), vec![Step { start, ..walk }]);
    assert!(!solution.report.iter().any(|line| line.wanted.contains("the camera starts at")));
}

#[test]
fn turns_slides_and_cranes_start_from_an_object() {
    for movement in [Move::PanRight, Move::PanLeft, Move::TiltUp, Move::TruckLeft, Move::TruckRight, Move::CraneUp] {
        let frames = film(&passed(Pass::From, 4, Step { start: about(1), ..Step::of(movement) }));
        let (position, off) = (frames[0].pose.position, off_box_deg(&frames[0]));
        assert!(level_distance(DOOR, position) < 1.3, "{movement}: {position}");
        assert!(off < 25.0, "{movement} starts {off} degrees beside the subject");
    }
}

#[test]
fn a_later_step_from_an_object_travels_there_first() {
    let via = Some(Via { how: Pass::From, objects: vec![4] });
    let push = Step { via, end: about(1), ..Step::of(Move::PushIn) };
    let solution = solved(&furnished(false), vec![Step { start: about(2), ..Step::of(Move::Static) }, push]);
    assert_met(&solution, "the camera starts at thing 4");
    let frames = film(&solution);
    let jump = |pair: &[CameraState]| pair[0].pose.position.distance(pair[1].pose.position);
    assert!(frames.windows(2).map(jump).fold(0.0, f64::max) < 0.4);
    assert!(frames.iter().any(|s| level_distance(DOOR, s.pose.position) < 1.3));
}

#[test]
fn over_the_shoulder_shows_the_object_in_the_foreground() {
    for movement in [Move::Static, Move::PushIn] {
        let solution = passed(Pass::Past, 2, Step { end: about(1), ..Step::of(movement) });
        let first = film(&solution)[0];
        let (shoulder, subject) = (DVec3::new(-1.2, 0.5, 0.8), DVec3::new(1.2, 0.6, 0.9));
        assert!(first.pose.position.distance(shoulder) < first.pose.position.distance(subject), "{movement}");
        assert!(first.pose.to_camera(shoulder).z > 0.0, "{movement}");
        assert_met(&solution, "box 2 in the foreground of box 1");
        assert_met(&solution, "visible share of box 1 at least 0.60");
    }
}
