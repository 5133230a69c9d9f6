//! Paths made of known moves are described as those moves.

use cinesplat::evaluation::{Description, SubjectSphere, Trajectory, describe};
use cinesplat::geometry::{LevelFrame, Pose};
use cinesplat::trajectory::Move;
use glam::{DQuat, DVec3};

const FPS: f64 = 30.0;

/// A path under construction, one pose per frame; every piece eases in and out.
struct Walk {
    poses: Vec<Pose>,
    fov_y_rad: Vec<f64>,
    level: LevelFrame,
}

impl Walk {
    /// Starts at head height with the view along +z; y points down.
    fn new() -> Self {
        let level = LevelFrame::new(DVec3::NEG_Y).unwrap();
        Self { poses: vec![Pose::new(DVec3::new(0.3, -1.6, -4.0), DQuat::IDENTITY)], fov_y_rad: vec![0.8], level }
    }

    fn piece(mut self, secs: f64, pose_at: impl Fn(&LevelFrame, &Pose, f64) -> Pose) -> Self {
        let (start, frames) = (self.poses[self.poses.len() - 1], (secs * FPS) as usize);
        let fov = self.fov_y_rad[self.fov_y_rad.len() - 1];
        for k in 1..=frames {
            let t = k as f64 / frames as f64;
            self.poses.push(pose_at(&self.level, &start, t * t * (3.0 - 2.0 * t)));
            self.fov_y_rad.push(fov);
        }
        self
    }

    fn travel(self, secs: f64, by_camera: DVec3) -> Self {
        self.piece(secs, |_, start, t| Pose { position: start.position + start.rotation * by_camera * t, ..*start })
    }

    fn pan(self, secs: f64, degrees: f64) -> Self {
        self.piece(secs, |level, start, t| {
            let mut angles = level.angles(start.rotation);
            angles.yaw_rad += degrees.to_radians() * t;
            Pose { rotation: level.rotation(angles), ..*start }
        })
    }

    fn orbit(self, secs: f64, radius: f64, degrees: f64) -> Self {
        self.piece(secs, |level, start, t| {
            let center = start.position + start.rotation * DVec3::Z * radius;
            let turn = DQuat::from_axis_angle(level.up, (degrees * t).to_radians());
            Pose { position: center + turn * (start.position - center), rotation: turn * start.rotation }
        })
    }

    /// About a point ahead, to the operator's right by an angle and up by a height, with the view on that point.
    fn circle(self, secs: f64, radius: f64, (degrees, rise): (f64, f64)) -> Self {
        let center = DVec3::new(0.3, -1.6, -4.0 + radius);
        self.piece(secs, |level, start, t| {
            let turn = DQuat::from_axis_angle(level.up, (degrees * t).to_radians());
            let position = center + turn * (start.position - center) + level.up * rise * t;
            Pose::look_at(position, center, level.up, None).unwrap()
        })
    }

    fn path(self) -> Trajectory {
        let times = (0..self.poses.len()).map(|k| k as f64 / FPS).collect();
        Trajectory {
            up: Some(self.level.up),
            fov_y_rad: self.fov_y_rad.into_iter().map(Some).collect(),
            ..Trajectory::from_poses(Some(times), &self.poses)
        }
    }
}

fn names(path: &Trajectory) -> Vec<Option<Move>> {
    describe(path, &[]).iter().map(|found| found.movement.map(|movement| movement.name)).collect()
}

#[test]
fn moves_in_a_row_come_back_with_their_amounts_and_times() {
    let path = Walk::new()
        .travel(2.0, DVec3::Z * 1.5)
        .orbit(4.0, 2.5, 80.0)
        .pan(2.0, -35.0)
        .travel(3.0, DVec3::X * 0.8)
        .path();
    assert_eq!(names(&path), [Move::PushIn, Move::ArcRight, Move::PanLeft, Move::TruckRight].map(Some));
    let found = describe(&path, &[]);
    let wanted = [(1.5, 2.0), (80_f64.to_radians(), 6.0), (35_f64.to_radians(), 8.0), (0.8, 11.0)];
    for (found, (amount, to_secs)) in found.iter().zip(wanted) {
        let got = found.movement.unwrap().amount;
        assert!((got / amount - 1.0).abs() < 0.03, "{:?}: got {got}, made {amount}", found.movement);
        assert!((found.to_secs - to_secs).abs() < 0.35, "{:?}: ends at {}", found.movement, found.to_secs);
    }
}

#[test]
fn a_pause_and_a_cut_are_told() {
    let still = |walk: Walk, secs: f64| walk.travel(secs, DVec3::ZERO);
    let path = still(Walk::new().travel(2.0, DVec3::Z), 1.5).pan(2.0, 50.0).path();
    assert_eq!(names(&path), [Move::PushIn, Move::Static, Move::PanRight].map(Some));
    let sentence = Description::new(&path, &[], None).sentence();
    assert_eq!(
        sentence,
        "push in for 2 seconds, then hold still for 1.5 seconds, then pan right 50 degrees for 2 seconds"
    );
    let mut jumped = path.clone();
    jumped.positions.iter_mut().skip(105).for_each(|position| *position += DVec3::X * 9.0);
    let found = describe(&jumped, &[105]);
    assert_eq!(found.iter().filter(|found| found.is_cut).count(), 1);
    assert!(Description::new(&jumped, &[105], None).sentence().contains(", cut, then pan right 50 degrees"));
}

/// The sentence of an arc used to read back as an orbit.
#[test]
fn an_arc_is_told_as_an_arc() {
    let path = Walk::new().orbit(4.0, 2.5, 80.0).path();
    assert_eq!(names(&path), [Some(Move::ArcRight)]);
    let sentence = Description::new(&path, &[], None).sentence();
    assert!(sentence.starts_with("arc to the right by "), "{sentence}");
}

/// `orbit the sofa to the left 90 degrees, then crane up` was told as an arc alone.
#[test]
fn a_rise_after_an_arc_is_a_move_of_its_own() {
    for (degrees, arc) in [(-90.0, Move::ArcLeft), (60.0, Move::ArcRight)] {
        let path = Walk::new().circle(5.0, 2.3, (degrees, 0.0)).circle(3.0, 2.3, (0.0, 1.4)).path();
        assert_eq!(names(&path), [arc, Move::CraneUp].map(Some));
        let first = Walk::new().circle(3.0, 2.3, (0.0, 1.4)).circle(5.0, 2.3, (degrees, 0.0)).path();
        assert_eq!(names(&first), [Move::CraneUp, arc].map(Some));
    }
    let path = Walk::new().circle(5.0, 2.3, (-90.0, 0.0)).circle(3.0, 2.3, (0.0, 1.4)).path();
    let sentence = Description::new(&path, &[], None).sentence();
    assert!(sentence.starts_with("arc to the left by 90 degrees for ") && sentence.contains(", then crane up for "));
}

#[test]
fn a_rise_along_an_arc_is_told_beside_it() {
    let told = |degrees: f64, rise: f64| {
        let path = Walk::new().circle(4.0, 2.5, (degrees, rise)).path();
        Description::new(&path, &[], None).sentence()
    };
    assert_eq!(told(80.0, 1.2), "arc to the right by 80 degrees while craning up for 4 seconds");
    assert_eq!(told(-80.0, -1.2), "arc to the left by 80 degrees while craning down for 4 seconds");
    assert_eq!(told(80.0, 0.1), "arc to the right by 80 degrees for 4 seconds");
    assert_eq!(told(-20.0, 2.0), "crane up while arcing to the left by 20 degrees for 4 seconds");
}

#[test]
fn a_move_and_its_way_back_are_two_moves() {
    let push = Walk::new().travel(2.0, DVec3::Z * 1.2).travel(2.0, DVec3::NEG_Z * 1.5).path();
    assert_eq!(names(&push), [Move::PushIn, Move::PullOut].map(Some));
    let whole_way = Walk::new().travel(2.0, DVec3::Z).travel(2.0, DVec3::NEG_Z).path();
    assert_eq!(names(&whole_way), [Move::PushIn, Move::PullOut].map(Some));
    let aside = Walk::new().travel(2.0, DVec3::Z).travel(2.0, DVec3::X).travel(2.0, DVec3::NEG_X).path();
    assert_eq!(names(&aside), [Move::PushIn, Move::TruckRight, Move::TruckLeft].map(Some));
    let pan = Walk::new().pan(2.0, 40.0).pan(2.0, -40.0).path();
    assert_eq!(names(&pan), [Move::PanRight, Move::PanLeft].map(Some));
    let arc = Walk::new().orbit(2.0, 2.5, 50.0).orbit(2.0, 2.5, -80.0).path();
    assert_eq!(names(&arc), [Move::ArcRight, Move::ArcLeft].map(Some));
}

#[test]
fn a_straight_move_before_a_pan_is_no_short_arc() {
    let path = Walk::new().travel(2.0, DVec3::X * 1.5).pan(2.5, -30.0).path();
    assert_eq!(names(&path), [Move::TruckRight, Move::PanLeft].map(Some));
}

#[test]
fn several_moves_at_once_are_told_by_their_directions() {
    // Forward and to the right while the view turns right, which aims at nothing.
    let path = Walk::new()
        .piece(3.0, |level, start, t| {
            let mut angles = level.angles(start.rotation);
            angles.yaw_rad += 0.8 * t;
            let moved = DVec3::new(2.0 * t, 0.0, 1.5 * t);
            Pose { position: start.position + moved, rotation: level.rotation(angles) }
        })
        .path();
    let sentence = Description::new(&path, &[], None).sentence();
    assert_eq!(sentence, "move forward and right while turning right for 3 seconds");
}

/// An orbit with a zoom was told as an orbit, and a truck with one as `move right`.
#[test]
fn a_zoom_beside_another_move_is_told() {
    let zoomed = |walk: Walk, factor: f64| {
        let mut path = walk.path();
        let last = path.fov_y_rad.len() - 1;
        for (k, fov) in path.fov_y_rad.iter_mut().enumerate() {
            let grown = factor.powf(k as f64 / last as f64);
            *fov = fov.map(|fov| 2.0 * ((fov / 2.0).tan() / grown).atan());
        }
        Description::new(&path, &[], None).sentence()
    };
    let orbit = || Walk::new().orbit(4.0, 2.5, 60.0);
    assert_eq!(zoomed(orbit(), 1.3), "arc to the right by 60 degrees while zooming in for 4 seconds");
    assert_eq!(zoomed(orbit(), 1.0), "arc to the right by 60 degrees for 4 seconds");
    let truck = Walk::new().travel(3.0, DVec3::X * 1.5);
    assert_eq!(zoomed(truck, 0.75), "truck right while zooming out for 3 seconds");
}

#[test]
fn the_size_of_a_subject_and_the_height_of_view_are_told() {
    let path = Walk::new().travel(2.0, DVec3::Z * 2.0).path();
    let subject = SubjectSphere { center: DVec3::new(0.3, -1.6, 0.0), radius: 0.5 };
    let table = Description::new(&path, &[], Some(subject)).table();
    // Height 2 asin(0.5 / 4) against 0.8 rad, then at half the distance.
    insta::assert_snapshot!(table, @r"
    from s     to s  move            amount             angle                   fov deg         size
      0.00     2.00  push-in         2 scene units      eye-level               45.8            long to medium
    ");
}

#[test]
fn degenerate_paths_are_described_without_nonsense() {
    for path in [Trajectory::default(), Walk::new().path(), Walk::new().travel(1.0, DVec3::ZERO).path()] {
        let description = Description::new(&path, &[], None);
        for text in [description.sentence(), description.table(), description.to_json()] {
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
    }
}
