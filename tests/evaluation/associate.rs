use cinesplat::evaluation::{EvaluationError, MatchSettings, Matching, Trajectory, associate};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

fn stamped(times: &[f64]) -> Trajectory {
    // The x coordinate identifies the pose.
    let poses: Vec<Pose> = (0..times.len()).map(|idx| Pose::new(DVec3::X * idx as f64, DQuat::IDENTITY)).collect();
    Trajectory::from_poses(Some(times.to_vec()), &poses)
}

fn within(max_diff_secs: f64, matching: Matching) -> MatchSettings {
    MatchSettings { max_diff_secs, matching, ..MatchSettings::default() }
}

/// Indices of matched poses: reference, estimate.
fn matched(reference: &[f64], estimate: &[f64], max_diff: f64) -> (Vec<usize>, Vec<usize>) {
    let matches = associate(&stamped(reference), &stamped(estimate), &within(max_diff, Matching::Nearest)).unwrap();
    let indices = |path: &Trajectory| path.positions.iter().map(|p| p.x as usize).collect();
    (indices(&matches.reference), indices(&matches.estimate))
}

#[test]
fn nearest_stamps_within_the_bound() {
    assert_eq!(matched(&[0.0, 1.0, 2.0, 3.0], &[0.004, 1.99, 2.5], 0.02), (vec![0, 2], vec![0, 1]));
}

#[test]
fn a_pose_is_used_once() {
    // Time stamp 1 is the nearest to both estimates: it is matched with the closer one, time stamp 0 with the other.
    assert_eq!(matched(&[0.0, 1.0], &[0.6, 0.9], 1.0), (vec![0, 1], vec![0, 1]));
    assert_eq!(matched(&[1.0], &[0.95, 1.01, 1.2], 1.0), (vec![0], vec![1]));
}

#[test]
fn matches_never_cross() {
    // 9.5 is matched with 10. A match of 11 with 0, the only ones left, would cross it.
    assert_eq!(matched(&[0.0, 10.0], &[9.5, 11.0], 20.0), (vec![1], vec![0]));
}

#[test]
fn stamps_out_of_order_are_sorted() {
    assert_eq!(matched(&[2.0, 0.0, 1.0], &[1.0, 2.0, 0.0], 0.1), (vec![1, 2, 0], vec![2, 0, 1]));
}

#[test]
fn counts_what_it_drops_and_by_how_much_it_is_off() {
    let matches =
        associate(&stamped(&[0.0, 1.0, 2.0]), &stamped(&[0.003, 5.0]), &within(0.01, Matching::Nearest)).unwrap();
    assert_eq!((matches.dropped_reference, matches.dropped_estimate), (2, 1));
    assert!((matches.largest_diff_secs - 0.003).abs() < 1e-15);
}

#[test]
fn clocks_apart_say_so() {
    let error =
        associate(&stamped(&[0.0, 1.0]), &stamped(&[100.0, 101.0]), &within(0.01, Matching::Nearest)).unwrap_err();
    assert!(matches!(error, EvaluationError::NoMatches { nearest_secs: 99.0, .. }), "{error}");
}

#[test]
fn paths_without_times_match_by_order() {
    let untimed = Trajectory { times_secs: None, ..stamped(&[0.0; 5]) };
    let matches = associate(&untimed, &stamped(&[7.0, 8.0, 9.0]), &within(0.01, Matching::Nearest)).unwrap();
    assert_eq!((matches.reference.len(), matches.dropped_reference, matches.notes.len()), (3, 2, 1));
}

#[test]
fn the_path_with_more_poses_is_interpolated_at_the_times_of_the_other() {
    let turned = |degrees: f64| DQuat::from_rotation_z(degrees.to_radians());
    let poses = [0.0, 1.0, 2.0, 3.0].map(|x| Pose::new(DVec3::X * x, turned(40.0 * x)));
    let dense = Trajectory::from_poses(Some(vec![0.0, 1.0, 2.0, 3.0]), &poses);
    let sparse = stamped(&[0.25, 0.75, 3.5]);
    for is_dense_estimate in [true, false] {
        let (reference, estimate) = if is_dense_estimate { (&sparse, &dense) } else { (&dense, &sparse) };
        let matches = associate(reference, estimate, &within(0.01, Matching::Interpolated)).unwrap();
        let (dropped, resampled) = if is_dense_estimate {
            (matches.dropped_reference, matches.estimate)
        } else {
            (matches.dropped_estimate, matches.reference)
        };
        assert_eq!((resampled.positions, dropped), (vec![DVec3::X * 0.25, DVec3::X * 0.75], 1));
        let quarter = glam::DMat3::from_rotation_z(10_f64.to_radians());
        assert!(resampled.rotations[0].abs_diff_eq(quarter, 1e-12));
    }
}

#[test]
fn poses_with_one_stamp_share_its_match() {
    assert_eq!(matched(&[0.0, 1.0, 2.0], &[1.0, 1.0, 1.9], 0.2), (vec![1, 1, 2], vec![0, 1, 2]));
    // The k-th of one path goes with the k-th of the other.
    assert_eq!(matched(&[0.0, 1.0, 1.0], &[1.0, 1.0, 9.0], 0.2), (vec![1, 2], vec![0, 1]));
}

#[test]
fn an_empty_path_is_named() {
    let error = associate(&stamped(&[0.0]), &Trajectory::default(), &within(1.0, Matching::Nearest)).unwrap_err();
    assert_eq!(error, EvaluationError::Empty { which: "estimate" });
}
