//! The frame of the network's inputs and outputs.

use cinesplat::director::SceneFrame;
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

fn close(a: DVec3, b: DVec3) -> bool {
    (a - b).length() < 1e-9
}

#[test]
fn x_points_right_of_the_heading_y_up_and_z_backward() {
    let (up, center) = (DVec3::Z, DVec3::new(5.0, -2.0, 1.0));
    let frame = SceneFrame::new(up, center, 4.0, Some(center + DVec3::new(0.0, 3.0, 2.0))).unwrap();
    // With heading +y and up +z, right is +x.
    assert!(close(frame.point(center + DVec3::X * 4.0), DVec3::X));
    assert!(close(frame.point(center + DVec3::Z * 4.0), DVec3::Y));
    assert!(close(frame.point(center + DVec3::Y * 4.0), DVec3::NEG_Z));
}

#[test]
fn a_pose_survives_its_6d_rotation() {
    let frame = SceneFrame::new(DVec3::new(0.2, 1.0, -0.1), DVec3::new(1.0, 2.0, 3.0), 7.0, None).unwrap();
    let pose = Pose::new(DVec3::new(-4.0, 0.5, 9.0), DQuat::from_euler(glam::EulerRot::YXZ, 0.4, -0.3, 0.1));
    let (position, rotation_6d) = frame.pose(&pose);
    let back = frame.world_pose(position, rotation_6d, DQuat::IDENTITY);
    assert!(close(back.position, pose.position));
    assert!(back.rotation.angle_between(pose.rotation) < 1e-6);
}

#[test]
fn a_rotated_and_shifted_world_gives_the_same_coordinates() {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 2.1);
    let shift = DVec3::new(100.0, -30.0, 7.0);
    let (up, center, target) = (DVec3::Y, DVec3::new(0.5, 0.0, 0.2), DVec3::new(2.0, 0.3, 1.0));
    let here = SceneFrame::new(up, center, 3.0, Some(target)).unwrap();
    let there = SceneFrame::new(turn * up, turn * center + shift, 3.0, Some(turn * target + shift)).unwrap();
    let point = DVec3::new(-1.0, 2.0, 0.7);
    assert!((here.point(point) - there.point(turn * point + shift)).length() < 1e-9);
    let half = DVec3::new(0.3, 0.2, 0.9);
    let apart = here.half_extents(half, DQuat::from_rotation_y(0.3))
        - there.half_extents(half, turn * DQuat::from_rotation_y(0.3));
    assert!(apart.length() < 1e-9);
}

#[test]
fn the_bounding_box_of_a_box_at_45_degrees_is_wider() {
    let frame = SceneFrame::new(DVec3::Y, DVec3::ZERO, 2.0, Some(DVec3::NEG_Z)).unwrap();
    let half = frame.half_extents(DVec3::ONE, DQuat::from_rotation_y(std::f64::consts::FRAC_PI_4));
    let diagonal = 2.0_f64.sqrt() / 2.0;
    assert!((half - DVec3::new(diagonal, 0.5, diagonal)).length() < 1e-9);
}

#[test]
fn scenes_without_extent_or_up_direction_are_rejected() {
    let new = |up, size| SceneFrame::new(up, DVec3::ZERO, size, None).map_err(|error| error.code());
    assert_eq!(new(DVec3::ZERO, 1.0), Err("DIRECTOR-SCENE"));
    assert_eq!(new(DVec3::Y, 0.0), Err("DIRECTOR-SCENE"));
    assert_eq!(new(DVec3::Y, f64::NAN), Err("DIRECTOR-SCENE"));
    // A target straight above gives no heading; the frame takes its own.
    assert!(SceneFrame::new(DVec3::Y, DVec3::ZERO, 1.0, Some(DVec3::Y)).is_ok());
}
