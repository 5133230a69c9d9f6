//! Things that stand on others, and things at walls: from where they are seen, and how the camera goes along them.

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Pass, Step, Via, World};
use cinesplat::trajectory::{CameraState, Move, ShotAngle};
use glam::DVec3;

use super::composition::in_frame;
use super::{film, room, solved, wall};

/// Height of the tabletop, and half the extents of the table.
const TOP: f64 = 0.76;
const HALF: DVec3 = DVec3::new(0.8, 0.38, 0.45);
const CENTER: DVec3 = DVec3::new(0.0, 0.38, -0.9);

/// The room of the operator's tests with a table (3), two things on it (4, 5), a cupboard at a wall (6) and a chair before the
/// table (7).
fn furnished(ids: &[u32]) -> World {
    let (mut gaussians, set) = room();
    let mut objects = set.objects;
    let mut add = |id: u32, label: &str, center: DVec3, half: DVec3, sides: &[(DVec3, DVec3, DVec3)]| {
        let first = gaussians.len();
        for (corner, u, v) in sides {
            wall(&mut gaussians, *corner, *u, *v);
        }
        objects.push(Object { num_gaussians: gaussians.len() - first, ..Object::from_box(id, label, center, half) });
    };
    let legs = [(-0.75, -1.3), (0.75, -1.3), (-0.75, -0.5), (0.75, -0.5)];
    let mut sides = vec![(DVec3::new(-0.8, TOP, -1.35), DVec3::X * 1.6, DVec3::Z * 0.9)];
    sides.extend(legs.map(|(x, z)| (DVec3::new(x, 0.0, z), DVec3::Y * TOP, DVec3::ZERO)));
    add(3, "table", CENTER, HALF, &sides);
    for (id, x) in [(4, -0.5), (5, 0.5)] {
        let (center, half) = (DVec3::new(x, TOP + 0.13, -0.9), DVec3::new(0.08, 0.12, 0.08));
        add(id, "vase", center, half, &faces(center, half));
    }
    let (center, half) = (DVec3::new(-1.0, 0.9, 2.74), DVec3::new(0.5, 0.88, 0.22));
    add(6, "cupboard", center, half, &faces(center, half));
    let (center, half) = (DVec3::new(0.3, 0.5, 0.1), DVec3::new(0.22, 0.5, 0.05));
    add(7, "chair", center, half, &faces(center, half));
    World::new(&gaussians, DVec3::Y, &ObjectSet { objects, labels: Vec::new() }, ids).unwrap()
}

/// The six faces of a box as parallelograms: corner and sides.
fn faces(center: DVec3, half: DVec3) -> Vec<(DVec3, DVec3, DVec3)> {
    let face = |axis: usize, side: f64| {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (mut corner, mut du, mut dv) = (center - half, DVec3::ZERO, DVec3::ZERO);
        corner[axis] = center[axis] + side * half[axis];
        (du[u], dv[v]) = (2.0 * half[u], 2.0 * half[v]);
        (corner, du, dv)
    };
    (0..3).flat_map(|axis| [-1.0, 1.0].map(|side| face(axis, side))).collect()
}

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.with_y(0.0).angle_between(b.with_y(0.0)).to_degrees()
}

#[test]
fn a_table_with_things_on_it_is_never_seen_from_below_its_top() {
    let world = furnished(&[3]);
    for movement in [Move::PushIn, Move::Static, Move::PullOut] {
        for state in film(&solved(&world, vec![Step { end: about(3), ..Step::of(movement) }])) {
            let height = state.pose.position.y;
            assert!(height > TOP + 0.05, "{movement}: camera at {height}, top at {TOP}");
        }
    }
}

#[test]
fn a_slide_along_a_table_shows_what_stands_on_it() {
    let world = furnished(&[3]);
    let via = Via { how: Pass::Along, objects: vec![3] };
    let step = Step { end: about(3), via: Some(via), ..Step::of(Move::TruckRight) };
    let frames = film(&solved(&world, vec![step]));
    let middle = &frames[frames.len() / 2];
    let rows = [TOP, TOP + 0.25].map(|height| in_frame(middle, DVec3::new(0.0, height, -0.9)).y);
    assert!(rows[0] > -0.5 && rows[1] < 0.5, "the things are out of the frame: {rows:?}");
    assert!(rows[1] - rows[0] > 0.2, "the things are {} of the frame high", rows[1] - rows[0]);
    assert!(middle.pose.position.y > TOP, "camera at {}", middle.pose.position.y);
}

#[test]
fn a_way_from_thing_to_thing_on_a_table_slides_along_it() {
    let world = furnished(&[4, 5]);
    let steps =
        vec![Step { end: about(4), ..Step::of(Move::Static) }, Step { end: about(5), ..Step::of(Move::Follow) }];
    let frames = film(&solved(&world, steps));
    let turned = angle_deg(frames[0].pose.forward(), frames[frames.len() - 1].pose.forward());
    assert!(turned < 40.0, "turns by {turned} degrees");
}

#[test]
fn a_table_from_straight_above_lies_along_the_frame() {
    let world = furnished(&[3]);
    let framing = Framing { angle: Some(ShotAngle::Overhead), ..about(3) };
    let state = film(&solved(&world, vec![Step { end: framing, ..Step::of(Move::Static) }]))[0];
    let askew = angle_deg(state.pose.right(), DVec3::X);
    let askew = askew.min(180.0 - askew).min((askew - 90.0).abs());
    assert!(askew < 15.0, "askew by {askew} degrees");
}

#[test]
fn a_descent_from_straight_above_stays_above() {
    let world = furnished(&[3]);
    let framing = Framing { angle: Some(ShotAngle::Overhead), ..about(3) };
    let step = Step { start: framing.clone(), end: framing, ..Step::of(Move::CraneDown) };
    let frames = film(&solved(&world, vec![step]));
    let height = |state: &CameraState| state.pose.position.y - TOP;
    let share = height(&frames[frames.len() - 1]) / height(&frames[0]);
    assert!((0.4..0.8).contains(&share), "sinks to {share} of its height above the table");
}

#[test]
fn what_stands_at_a_wall_is_not_seen_along_the_wall() {
    let world = furnished(&[6]);
    for movement in [Move::Static, Move::PushIn] {
        let frames = film(&solved(&world, vec![Step { end: about(6), ..Step::of(movement) }]));
        let off = angle_deg(frames[0].pose.position - DVec3::new(-1.0, 0.9, 2.74), -DVec3::Z);
        assert!(off < 60.0, "{movement}: {off} degrees beside its front");
    }
}

#[test]
fn a_pull_out_that_takes_in_a_whole_ends_aimed_at_it() {
    let world = furnished(&[4, 3]);
    let first = Step { end: about(4), amount: Some(Amount::Slight), ..Step::of(Move::PushIn) };
    let end = Framing { whole: true, ..about(3) };
    let frames = film(&solved(&world, vec![first, Step { end, ..Step::of(Move::PullOut) }]));
    let last = &frames[frames.len() - 1];
    let at = in_frame(last, CENTER);
    assert!(at.abs().max_element() < 0.22, "the table is at {at}");
    assert!(last.pose.position.distance(CENTER) > frames[0].pose.position.distance(CENTER));
}

#[test]
fn a_way_along_a_table_between_things_on_it_stays_just_above_it() {
    let world = furnished(&[3, 4, 5]);
    let via = Via { how: Pass::Along, objects: vec![3] };
    let step = Step { start: about(4), end: about(5), via: Some(via), ..Step::of(Move::Follow) };
    let frames = film(&solved(&world, vec![step]));
    for state in &frames {
        let height = state.pose.position.y;
        assert!((TOP..TOP + 0.6).contains(&height), "camera at {height}, top at {TOP}");
    }
    let last = in_frame(&frames[frames.len() - 1], DVec3::new(0.5, TOP + 0.13, -0.9));
    assert!(last.abs().max_element() < 0.2, "the second vase is at {last}");
}

#[test]
fn a_rise_to_above_a_table_swings_over_it() {
    let world = furnished(&[3]);
    let above = Framing { angle: Some(ShotAngle::Overhead), ..about(3) };
    let steps =
        vec![Step { end: about(3), ..Step::of(Move::Static) }, Step { end: above, ..Step::of(Move::PedestalUp) }];
    let frames = film(&solved(&world, steps));
    let last = &frames[frames.len() - 1];
    let down = (-last.pose.forward().y).asin().to_degrees();
    assert!(down > 50.0, "looks down by {down} degrees");
    let aside = |state: &CameraState| (state.pose.position - CENTER).with_y(0.0).length();
    assert!(aside(last) < 0.8 * aside(&frames[0]), "from {} to {} beside it", aside(&frames[0]), aside(last));
}

#[test]
fn a_pan_that_ends_close_goes_on_to_its_end() {
    let world = furnished(&[3, 6]);
    let close = Framing { height_frac: Some(0.9), ..about(6) };
    let pan = Step { end: close, either_way: true, ..Step::of(Move::PanRight) };
    let frames = film(&solved(&world, vec![Step { end: about(3), ..Step::of(Move::Static) }, pan]));
    let cupboard = DVec3::new(-1.0, 0.9, 2.74);
    let distance = |state: &CameraState| state.pose.position.distance(cupboard);
    let (first, last) = (distance(&frames[0]), distance(&frames[frames.len() - 1]));
    assert!(last < 0.85 * first, "from {first} to {last} from the cupboard");
}

#[test]
fn a_table_is_revealed_over_what_hides_its_top() {
    let world = furnished(&[3, 7]);
    let via = Via { how: Pass::Behind, objects: vec![7] };
    let frames = film(&solved(&world, vec![Step { end: about(3), via: Some(via), ..Step::of(Move::Reveal) }]));
    let last = frames[frames.len() - 1].pose.position.y;
    assert!(last > frames[0].pose.position.y + 0.2 && last > TOP, "rises from {} to {last}", frames[0].pose.position.y);
}
