use cinesplat::evaluation::{EvalSettings, SubjectSphere, Trajectory, evaluate, framing_error};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

/// Ten cameras at z <= -4 that look along +z with a field of view of 90 degrees.
fn path(shift: f64, distance: f64, fov_y_deg: f64) -> Trajectory {
    let pose = |k: usize| Pose::new(DVec3::new(shift, 0.0, -distance - 0.1 * k as f64), DQuat::IDENTITY);
    let poses: Vec<Pose> = (0..10).map(pose).collect();
    let mut path = Trajectory::from_poses(Some((0..10).map(f64::from).collect()), &poses);
    path.fov_y_rad = vec![Some(fov_y_deg.to_radians()); 10];
    path
}

const BALL: SubjectSphere = SubjectSphere { center: DVec3::ZERO, radius: 0.5 };

#[test]
fn equal_paths_frame_alike() {
    let found = framing_error(&path(0.0, 4.0, 90.0), &path(0.0, 4.0, 90.0), &BALL).unwrap();
    assert_eq!((found.offset_max, found.log_size_rmse, found.lost_frac), (0.0, 0.0, 0.0));
}

#[test]
fn a_step_aside_moves_the_subject_and_a_longer_lens_makes_it_larger() {
    // At distance d the frame is 2 d high: an offset of 1 is 1 / (2 d) frame heights, largest at the first camera.
    let aside = framing_error(&path(0.0, 4.0, 90.0), &path(1.0, 4.0, 90.0), &BALL).unwrap();
    assert!((aside.offset_max - 1.0 / 8.0).abs() < 1e-12 && aside.log_size_rmse < 1e-12);
    // Half the field of view: the ratio is tan 45 over tan 22.5.
    let longer = framing_error(&path(0.0, 4.0, 90.0), &path(0.0, 4.0, 45.0), &BALL).unwrap();
    assert!((longer.log_size_rmse - (2.0_f64.sqrt() + 1.0).ln()).abs() < 1e-12 && longer.offset_max < 1e-12);
    // All ten estimates have the subject outside the frame.
    let lost = framing_error(&path(0.0, 4.0, 90.0), &path(20.0, 4.0, 90.0), &BALL).unwrap();
    assert_eq!(lost.lost_frac, 1.0);
}

#[test]
fn without_lenses_or_a_subject_there_is_none() {
    let bare = Trajectory { fov_y_rad: vec![None; 10], ..path(0.0, 4.0, 90.0) };
    assert_eq!(framing_error(&bare, &path(0.0, 4.0, 90.0), &BALL), None);
    let behind = SubjectSphere { center: DVec3::new(0.0, 0.0, -100.0), ..BALL };
    assert_eq!(framing_error(&path(0.0, 4.0, 90.0), &path(0.0, 4.0, 90.0), &behind), None);
    let unasked = evaluate(&path(0.0, 4.0, 90.0), &path(0.0, 4.0, 90.0), &EvalSettings::default()).unwrap();
    assert_eq!(unasked.framing, None);
}
