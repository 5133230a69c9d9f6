//! Yaw, pitch, roll and look-at: signs of the file format, and a defined heading at the zenith.

use cinesplat::geometry::{LevelAngles, LevelFrame, Pose, rotation};
use glam::DVec3;

fn frame() -> LevelFrame {
    LevelFrame::new(DVec3::new(0.1, -1.0, 0.05)).unwrap()
}

#[test]
fn angles_round_trip_for_any_up() {
    for up in [DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::new(0.1, -1.0, 0.05)] {
        let frame = LevelFrame::new(up).unwrap();
        for (yaw_rad, pitch_rad, roll_rad) in [(0.0, 0.0, 0.0), (2.0, 0.7, -0.4), (-3.0, -1.3, 1.0)] {
            let angles = LevelAngles { yaw_rad, pitch_rad, roll_rad };
            let back = frame.angles(frame.rotation(angles));
            assert!((back.yaw_rad - yaw_rad).abs() < 1e-9 && (back.pitch_rad - pitch_rad).abs() < 1e-9);
            assert!((back.roll_rad - roll_rad).abs() < 1e-9);
        }
    }
}

#[test]
fn signs_are_the_operators() {
    let frame = frame();
    let level = Pose { position: DVec3::ZERO, rotation: frame.rotation(LevelAngles::default()) };
    let turned = |angles| Pose { position: DVec3::ZERO, rotation: frame.rotation(angles) };
    let right = turned(LevelAngles { yaw_rad: 0.1, ..LevelAngles::default() });
    assert!(right.forward().dot(level.right()) > 0.09, "positive yaw looks to the right");
    let up = turned(LevelAngles { pitch_rad: 0.1, ..LevelAngles::default() });
    assert!(up.forward().dot(frame.up) > 0.09, "positive pitch looks up");
    let rolled = turned(LevelAngles { roll_rad: 0.1, ..LevelAngles::default() });
    assert!(rolled.right().dot(frame.up) < -0.09, "positive roll dips the right side");
}

#[test]
fn look_at_is_level_and_refuses_no_direction() {
    let frame = frame();
    let pose = Pose::look_at(DVec3::new(3.0, 1.0, -2.0), DVec3::new(0.0, 0.4, 0.0), frame.up, None).unwrap();
    assert!(pose.right().dot(frame.up).abs() < 1e-12);
    assert!(pose.up().dot(frame.up) > 0.0);
    assert!(Pose::look_at(DVec3::ONE, DVec3::ONE, frame.up, None).is_err());
    assert!(Pose::look_at(DVec3::ONE, DVec3::NAN, frame.up, None).is_err());
}

#[test]
fn straight_down_keeps_the_heading_it_is_given() {
    let hint = DVec3::new(0.6, 0.0, 0.8);
    let pose = Pose::look_at(DVec3::Y * 3.0, DVec3::ZERO, DVec3::Y, Some(hint)).unwrap();
    assert!(pose.right().dot(hint) > 0.999_999);
    assert!(rotation::angle(pose.rotation).is_finite());
}

#[test]
fn points_move_along_up_and_about_it() {
    let frame = frame();
    let (pivot, point) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.5, -1.0));
    let raised = frame.at_height(point, 7.0);
    assert!((frame.height(raised) - 7.0).abs() < 1e-12);
    assert!(frame.horizontal(raised - point).length() < 1e-12);
    let swung = frame.swung(pivot, point, 0.3);
    let [before, after] = [point, swung].map(|at| at - pivot);
    assert!((frame.azimuth(after) - frame.azimuth(before) - 0.3).abs() < 1e-12);
    assert!((frame.height(after) - frame.height(before)).abs() < 1e-12);
    assert!((after.length() - before.length()).abs() < 1e-12);
}

#[test]
fn rings_are_level_circles_from_north_on() {
    let frame = frame();
    let rings: Vec<DVec3> = frame.rings(4, &[0.0, 0.5]).collect();
    assert_eq!(rings.len(), 8);
    assert!((rings[0] - frame.north).length() < 1e-12 && (rings[1] - frame.east).length() < 1e-12);
    let heights = rings[4..].iter().map(|away| frame.height(*away));
    assert!(heights.into_iter().all(|height| (height - 0.5_f64.sin()).abs() < 1e-12));
    assert!(rings.iter().all(|away| (away.length() - 1.0).abs() < 1e-12));
}
