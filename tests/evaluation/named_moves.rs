//! Published camera paths with the name of a move are recognized as that move.

use cinesplat::evaluation::{Trajectory, name_move};
use cinesplat::geometry::Pose;
use cinesplat::trajectory::Move;
use glam::{DMat3, DMat4, DQuat, DVec3};
use serde_json::Value;

use super::paths::{at_30_fps, through};
use crate::support::shared;

fn json(path: &std::path::Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A camera of ReCamMaster's file: the rows are forward, right, up and position, in a world with z up.
fn recammaster(file: &Value, camera: usize) -> Trajectory {
    let pose = |frame: usize| {
        let text = file[format!("frame{frame}")][format!("cam{camera:02}")].as_str().unwrap();
        let numbers: Vec<f64> = text.replace(['[', ']'], " ").split_whitespace().map(|n| n.parse().unwrap()).collect();
        let row = |idx: usize| DVec3::new(numbers[4 * idx], numbers[4 * idx + 1], numbers[4 * idx + 2]);
        // The frame is left-handed (x forward, y right, z up), so y is mirrored.
        let mirrored = |v: DVec3| DVec3::new(v.x, -v.y, v.z);
        let axes = DMat3::from_cols(mirrored(row(1)), -mirrored(row(2)), mirrored(row(0)));
        Pose::new(mirrored(row(3)), DQuat::from_mat3(&axes))
    };
    Trajectory { up: Some(DVec3::Z), ..at_30_fps(&(0..81).map(pose).collect::<Vec<_>>()) }
}

#[test]
fn the_ten_moves_of_recammaster() {
    let Some(path) = shared("data/camera_moves/recammaster/camera_extrinsics.json") else { return };
    let file = json(&path);
    // Paths seven and eight rise and fall with a fixed aim.
    let wanted = [
        Move::PanRight,
        Move::PanLeft,
        Move::TiltUp,
        Move::TiltDown,
        Move::PushIn,
        Move::PullOut,
        Move::CraneUp,
        Move::CraneDown,
        Move::ArcLeft,
        Move::ArcRight,
    ];
    for (camera, wanted) in (1..=10).zip(wanted) {
        let found = name_move(&recammaster(&file, camera), 0.0);
        assert_eq!(found.map(|found| found.name), Some(wanted), "camera {camera}: {found:?}");
    }
    let arc = name_move(&recammaster(&file, 10), 0.0).unwrap();
    assert!((arc.amount.to_degrees() - 29.8).abs() < 0.1, "{arc:?}");
}

#[test]
fn the_named_poses_of_motionctrl() {
    let Some(folder) = shared("data/camera_moves/motionctrl") else { return };
    let wanted = [
        ("I", Move::PushIn),
        ("I_0.2x", Move::PushIn),
        ("I_2.0x", Move::PushIn),
        ("O", Move::PullOut),
        ("O_0.4x", Move::PullOut),
        ("L", Move::TruckLeft),
        ("R", Move::TruckRight),
        ("U", Move::PedestalUp),
        ("D", Move::PedestalDown),
        ("SPIN-CW-60", Move::RollCw),
        ("SPIN-ACW-60", Move::RollCcw),
        ("Round-RI_90", Move::ArcRight),
        ("Round-RI-120", Move::ArcRight),
    ];
    for (name, wanted) in wanted {
        let file = json(&folder.join(format!("test_camera_{name}.json")));
        let pose = |rows: &Value| {
            let mut m = [0.0; 16];
            m[15] = 1.0;
            rows.as_array().unwrap().iter().zip(&mut m).for_each(|(v, slot)| *slot = v.as_f64().unwrap());
            // 3 x 4 camera_from_world in row-major order.
            Pose::from_matrix(DMat4::from_cols_array(&m).transpose().inverse()).unwrap()
        };
        let path = at_30_fps(&file.as_array().unwrap().iter().map(pose).collect::<Vec<_>>());
        let found = name_move(&Trajectory { up: Some(DVec3::NEG_Y), ..path }, 0.0);
        assert_eq!(found.map(|found| found.name), Some(wanted), "{name}: {found:?}");
    }
}

/// A path at 30 frames per second with fields of view.
fn with_lens(points: impl Iterator<Item = DVec3>, fov_deg: impl Fn(f64) -> f64) -> Trajectory {
    let path = through(points, DQuat::IDENTITY);
    let share = |idx: usize| idx as f64 / (path.len() as f64 - 1.0);
    let fov_y_rad = (0..path.len()).map(|idx| Some(fov_deg(share(idx)).to_radians())).collect();
    Trajectory { fov_y_rad, up: Some(DVec3::NEG_Y), ..path }
}

#[test]
fn lenses_make_zooms_and_dolly_zooms() {
    let still = || std::iter::repeat_n(DVec3::ONE, 30);
    let ahead = |direction: f64| (0..30).map(move |k| DVec3::Z * (direction * 0.1 * f64::from(k)));
    let name = |path: Trajectory| name_move(&path, 0.0).unwrap().name;
    assert_eq!(name(with_lens(still(), |t| 50.0 - 20.0 * t)), Move::ZoomIn);
    assert_eq!(name(with_lens(still(), |t| 50.0 + 20.0 * t)), Move::ZoomOut);
    assert_eq!(name(with_lens(still(), |_| 50.0)), Move::Static);
    assert_eq!(name(with_lens(ahead(1.0), |t| 50.0 + 20.0 * t)), Move::DollyZoomIn);
    assert_eq!(name(with_lens(ahead(-1.0), |t| 50.0 - 20.0 * t)), Move::DollyZoomOut);
    assert_eq!(name(with_lens(ahead(1.0), |_| 50.0)), Move::PushIn);
}

#[test]
fn a_full_circle_is_an_orbit_and_a_wander_is_nothing() {
    let around = |radius: &dyn Fn(f64) -> f64| {
        let pose = |k: i32| {
            let angle = f64::from(k) / 120.0 * std::f64::consts::TAU;
            let eye = DVec3::new(angle.sin(), -0.2, -angle.cos()) * radius(angle);
            Pose::look_at(eye, DVec3::ZERO, DVec3::NEG_Y, None).unwrap()
        };
        Trajectory { up: Some(DVec3::NEG_Y), ..at_30_fps(&(0..=120).map(pose).collect::<Vec<_>>()) }
    };
    let orbit = name_move(&around(&|_| 2.0), 0.0).unwrap();
    // From -z, looking along +z, toward +x, which is the operator's right.
    assert_eq!(orbit.name, Move::OrbitRight);
    assert!((orbit.amount - std::f64::consts::TAU).abs() < 1e-9);
    assert_eq!(name_move(&around(&|angle| 2.0 + angle.sin()), 0.0), None);
}

#[test]
fn hand_tremor_below_the_given_distance_is_still() {
    let shaken = through((0..30).map(|k| DVec3::X * (1e-4 * f64::from(k).sin())), DQuat::IDENTITY);
    assert_eq!(name_move(&shaken, 1e-3).unwrap().name, Move::Static);
}
