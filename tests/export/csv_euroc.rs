use cinesplat::export::{Content, Format, read};

use super::sample_shot::{file, there_and_back, with_cut};

#[test]
fn csv_has_a_named_column_for_everything() {
    let (_, _, folder) = there_and_back(&with_cut(), Format::Csv, "a.csv", Content::Keyframes);
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let mut lines = text.lines();
    insta::assert_snapshot!(lines.next().unwrap(), @"time_secs,x,y,z,qx,qy,qz,qw,yaw_deg,pitch_deg,roll_deg,fov_y_deg,focus_distance,easing,cut");
    assert!(lines.clone().all(|line| line.split(',').count() == 15));
    assert!(lines.nth(2).unwrap().ends_with(",4,linear,1"));
}

#[test]
fn csv_columns_may_stand_in_any_order_and_number() {
    let (path, _folder) = file("a.csv", b"z,y,x,time_secs,qw,qx,qy,qz,note\n3,2,1,0.5,1,0,0,0,hello\n");
    let frame = read(&path, None).unwrap().track.frames[0].clone();
    assert_eq!((frame.time_secs, frame.pose.position.to_array(), frame.fov_y_rad), (0.5, [1.0, 2.0, 3.0], None));
}

#[test]
fn euroc_counts_nanoseconds_and_puts_w_first() {
    // A line of the data set's ground truth.
    let line = "1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,-0.027876,0.033207,0.800006,-0.003172,0.021267,0.078502,-0.025266,0.136696,0.075593\n";
    let (path, _folder) = file("data.csv", line.as_bytes());
    let frame = read(&path, None).unwrap().track.frames[0].clone();
    assert!((frame.time_secs - 1_403_636_580.838_555_6).abs() < 1e-6);
    assert!((frame.pose.rotation.w - 0.534_108).abs() < 1e-6 && (frame.pose.rotation.z + 0.082_152).abs() < 1e-6);
}

#[test]
fn the_ground_truth_of_euroc_has_z_up_and_a_path_alone_has_none() {
    let pose = |idx: i64| format!("{},1.0,2.0,{}.0,0.5,-0.5,0.5,0.5", 1_403_715_524_907_143_168 + 5_000_000 * idx, idx);
    let state = ",0.1,0.2,0.3,0.01,0.02,0.03,0.04,0.05,0.06";
    let lines = |rest: &str| (0..4).map(|idx| pose(idx) + rest + "\n").collect::<String>();
    for (rest, up) in [(state, Some(glam::DVec3::Z)), ("", None)] {
        let (path, _folder) = file("data.csv", lines(rest).as_bytes());
        let imported = read(&path, None).unwrap();
        assert_eq!((imported.format, imported.track.up), (Format::Euroc, up), "{rest}");
    }
}
