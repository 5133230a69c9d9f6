//! Rotations near 0 and 180 degrees, where textbook formulas lose all digits.

use cinesplat::geometry::{Pose, frames, rotation};
use glam::{DMat3, DMat4, DQuat, DVec3};

const ANGLES: [f64; 9] = [0.0, 1e-12, 1e-8, 3e-4, 0.5, 3.0, 3.1, std::f64::consts::PI - 1e-12, std::f64::consts::PI];

fn axes() -> [DVec3; 3] {
    [DVec3::X, DVec3::new(1.0, -2.0, 3.0).normalize(), DVec3::new(-0.3, 0.0, 0.95).normalize()]
}

#[test]
fn exponential_undoes_logarithm_at_every_angle() {
    for axis in axes() {
        for angle in ANGLES {
            let turn = DQuat::from_axis_angle(axis, angle);
            let back = rotation::exp(rotation::log(turn));
            let off = (DMat3::from_quat(turn) - DMat3::from_quat(back)).to_cols_array().map(f64::abs);
            assert!(off.iter().all(|&v| v < 1e-12), "angle {angle}: off by {off:?}");
        }
    }
}

#[test]
fn tiny_angles_do_not_read_zero() {
    for angle in [1e-12, 1e-9, 1e-6, 3e-4] {
        let turn = DQuat::from_axis_angle(axes()[1], angle);
        assert!((rotation::angle(turn) / angle - 1.0).abs() < 1e-9, "{angle} read {}", rotation::angle(turn));
    }
}

#[test]
fn slerp_goes_the_short_way_whatever_the_signs() {
    let (a, b) = (DQuat::from_rotation_y(0.2), DQuat::from_rotation_x(1.0));
    for t in [0.0, 0.3, 1.0] {
        let (one, other) = (rotation::slerp(a, b, t), rotation::slerp(a, -b, t));
        assert!(rotation::angle_between(one, other) < 1e-14);
    }
    assert!(rotation::angle_between(rotation::slerp(a, b, 1.0), b) < 1e-14);
    assert!(
        (rotation::angle_between(a, rotation::slerp(a, b, 0.25)) / rotation::angle_between(a, b) - 0.25).abs() < 1e-12
    );
}

#[test]
fn six_d_is_total_and_round_trips() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -2.0, 1.1);
    assert!(rotation::angle_between(turn, rotation::from_6d(rotation::to_6d(turn), DQuat::IDENTITY)) < 1e-12);
    for degenerate in [[0.0; 6], [1.0, 0.0, 0.0, 2.0, 0.0, 0.0], [f64::NAN; 6], [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]] {
        let m = DMat3::from_quat(rotation::from_6d(degenerate, turn));
        assert!((m.determinant() - 1.0).abs() < 1e-9, "{degenerate:?}");
    }
}

#[test]
fn a_mirror_or_a_scale_is_no_rotation() {
    assert!(rotation::from_matrix(DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0))).is_err());
    assert!(rotation::from_matrix(DMat3::from_diagonal(DVec3::splat(1.01))).is_err());
    assert!(rotation::from_matrix(DMat3::from_cols(DVec3::NAN, DVec3::Y, DVec3::Z)).is_err());
}

#[test]
fn opengl_axes_round_trip_and_point_the_right_way() {
    let pose = Pose::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO, DVec3::Y, None).unwrap();
    let gl = frames::to_opengl(&pose);
    assert!((gl.z_axis.truncate() + pose.forward()).length() < 1e-12, "OpenGL cameras look along -z");
    assert!((gl.y_axis.truncate() - pose.up()).length() < 1e-12, "OpenGL y is up");
    let back = frames::from_opengl(gl).unwrap();
    assert!(rotation::angle_between(back.rotation, pose.rotation) < 1e-12 && back.position == pose.position);
    let round = pose.world_from_camera() * pose.camera_from_world();
    assert!((round - DMat4::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-12));
}
