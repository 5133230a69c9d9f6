use cinesplat::export::{Content, Format, ImportSettings, read};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

use super::sample_shot::{file, key, shot, there_and_back};
use crate::support::shared;

#[test]
fn tum_lines_are_as_documented() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = key(0.0, DVec3::new(1.0, -2.5, 0.125), DQuat::from_xyzw(0.0, half, 0.0, half), 50.0);
    let (_, _, folder) = there_and_back(&shot(vec![turned], DVec3::Y), Format::Tum, "a.tum", Content::Keyframes);
    let text = std::fs::read_to_string(folder.path().join("a.tum")).unwrap();
    insta::assert_snapshot!(text, @r"
    # timestamp tx ty tz qx qy qz qw
    0 1 -2.5 0.125 0 0.7071067811865476 0 0.7071067811865476
    ");
}

#[test]
fn kitti_lines_are_rows_of_world_from_camera() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = key(0.0, DVec3::new(1.0, -2.5, 0.125), DQuat::from_xyzw(0.0, half, 0.0, half), 50.0);
    let (_, _, folder) = there_and_back(&shot(vec![turned], DVec3::Y), Format::Kitti, "a.kitti", Content::Keyframes);
    let text = std::fs::read_to_string(folder.path().join("a.kitti")).unwrap();
    let rows: Vec<f64> = text.split_whitespace().map(|number| number.parse().unwrap()).collect();
    // A quarter turn about y maps z to x.
    let wanted = [0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, -2.5, -1.0, 0.0, 0.0, 0.125];
    assert!(rows.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15), "{rows:?}");
}

#[test]
fn reads_the_benchmarks_own_files() {
    let Some(folder) = shared("data/trajectories") else { return };
    let tum = read(&folder.join("freiburg1_xyz-groundtruth.txt"), None).unwrap();
    let kitti = read(&folder.join("KITTI_00_gt.txt"), None).unwrap();
    assert_eq!((tum.format, tum.track.frames.len(), tum.track.timed), (Format::Tum, 3000, true));
    assert_eq!((kitti.format, kitti.track.frames.len(), kitti.track.timed), (Format::Kitti, 4541, true));
    // The times come from the file beside it, KITTI_00_gt_times.txt.
    // First data line of the file.
    let first = &tum.track.frames[0];
    assert_eq!(first.time_secs, 1_305_031_098.665_9);
    assert_eq!(first.pose.position, DVec3::new(1.3563, 0.6305, 1.6380));
    // The description of the data set states a length of 3724 m for sequence 00.
    let steps = kitti.track.frames.windows(2).map(|pair| (pair[1].pose.position - pair[0].pose.position).length());
    assert!((steps.sum::<f64>() - 3724.2).abs() < 0.5);
}

#[test]
fn errors_name_the_line() {
    let refused = |text: &str, format: Format| {
        let (path, _folder) = file("a.txt", text.as_bytes());
        read(&path, Some(format)).unwrap_err().to_string()
    };
    insta::assert_snapshot!(refused("# c\n1 2 3 4 0 0 0 1\n2 2 3 4 0 0 0\n", Format::Tum), @r#"line 3: found "2 2 3 4 0 0 0", expected 8 columns, not 7"#);
    insta::assert_snapshot!(refused("1 2 3 nan 0 0 0 1\n", Format::Tum), @r#"line 1: found "nan", expected a finite number"#);
    insta::assert_snapshot!(refused("1 2 3 4 0 0 0 0\n", Format::Tum), @r#"line 1: found "1 2 3 4 0 0 0 0", expected a unit quaternion"#);
    insta::assert_snapshot!(refused("2 0 0 0 0 1 0 0 0 0 1 0\n", Format::Kitti), @r#"line 1: found "2 0 0 0 0 1 0 0 0 0 1 0", expected a rigid pose (not a rotation: R^T R is off the identity by 3.000e0, determinant 2.000e0)"#);
    insta::assert_snapshot!(refused("# nothing\n", Format::Kitti), @"no camera poses in the file, expected at least one");
}

#[test]
fn times_from_1970_become_a_shot_that_starts_at_0() {
    let (path, _folder) = file("a.txt", b"1305031098.5 1 2 3 0 0 0 1\n1305031099.0 1 2 4 0 0 0 1\n");
    let (shot, assumed) = read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap();
    assert_eq!(shot.keyframes.iter().map(|key| key.time_secs).collect::<Vec<_>>(), [0.0, 0.5]);
    assert_eq!(shot.keyframes[1].pose, Pose::new(DVec3::new(1.0, 2.0, 4.0), DQuat::IDENTITY));
    assert_eq!(assumed.len(), 5, "start, rate, size, field of view and up: {assumed:?}");
}
