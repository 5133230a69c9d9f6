//! Random shots through formats that are only read, written here by the definition of each format.

use cinesplat::export::{Format, PoseFrame, PoseTrack, read};
use cinesplat::geometry::{Pose, rotation};
use cinesplat::trajectory::Shot;
use glam::{DMat3, DMat4, DQuat};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::round_trips::shots;

/// A format, a file name, the text of frames, whether it keeps times and lenses, and the unit of its stamps, s.
struct Row {
    format: Format,
    name: &'static str,
    text: fn(&[PoseFrame]) -> String,
    stamp_secs: Option<f64>,
    keeps_fov: bool,
}

fn joined(values: impl IntoIterator<Item = f64>, separator: &str) -> String {
    values.into_iter().map(|value| value.to_string()).collect::<Vec<_>>().join(separator)
}

/// The rows of a 4 x 4 matrix.
fn rows(matrix: DMat4) -> [f64; 16] {
    matrix.transpose().to_cols_array()
}

fn camera_from_world(pose: &Pose) -> Vec<f64> {
    rows(pose.inverse().world_from_camera())[..12].to_vec()
}

fn lines(frames: &[PoseFrame], line: impl Fn(&PoseFrame) -> String) -> String {
    frames.iter().map(|frame| line(frame) + "\n").collect()
}

fn position_and(pose: &Pose, rotation: [f64; 4]) -> impl Iterator<Item = f64> {
    pose.position.to_array().into_iter().chain(rotation)
}

fn wxyz(rotation: DQuat) -> [f64; 4] {
    [rotation.w, rotation.x, rotation.y, rotation.z]
}

fn nanos(frame: &PoseFrame) -> i64 {
    (frame.time_secs * 1e9).round() as i64 + 1_403_636_579_000_000_000
}

fn re10k(frames: &[PoseFrame]) -> String {
    lines(frames, |frame| {
        let focal = 0.5 / (frame.fov_y_rad.unwrap() / 2.0).tan();
        let stamp = (frame.time_secs * 1e6).round();
        format!("{stamp} {focal} {focal} 0.5 0.5 0 0 {}", joined(camera_from_world(&frame.pose), " "))
    })
}

fn aria(frames: &[PoseFrame]) -> String {
    let head = "graph_uid,tracking_timestamp_us,utc_timestamp_ns,tx_world_device,ty_world_device,tz_world_device,qx_world_device,\
                qy_world_device,qz_world_device,qw_world_device,gravity_x_world,gravity_y_world,gravity_z_world,quality_score\n";
    let text = lines(frames, |frame| {
        let stamp = (frame.time_secs * 1e6).round();
        let pose = joined(position_and(&frame.pose, frame.pose.rotation.to_array()), ",");
        format!("a-b,{stamp},7,{pose},0.0,0.0,-9.81,1.0")
    });
    head.to_owned() + &text
}

fn dpvo(frames: &[PoseFrame]) -> String {
    lines(frames, |frame| {
        format!("{} {}", nanos(frame), joined(position_and(&frame.pose, frame.pose.rotation.to_array()), " "))
    })
}

fn euroc_with_spaces(frames: &[PoseFrame]) -> String {
    lines(frames, |frame| {
        format!("{} {}", nanos(frame), joined(position_and(&frame.pose, wxyz(frame.pose.rotation)), " "))
    })
}

fn tum_with_commas(frames: &[PoseFrame]) -> String {
    lines(frames, |frame| {
        let pose = joined(position_and(&frame.pose, frame.pose.rotation.to_array()), ",");
        format!("{:.9},{pose}", frame.time_secs + 1.4e9)
    })
}

fn kitti_with_times(frames: &[PoseFrame]) -> String {
    lines(frames, |frame| {
        format!("{} {}", frame.time_secs, joined(rows(frame.pose.world_from_camera())[..12].iter().copied(), " "))
    })
}

fn motionctrl(frames: &[PoseFrame]) -> String {
    let matrix = |frame: &PoseFrame| format!("[{}]", joined(camera_from_world(&frame.pose), ","));
    format!("[{}]", frames.iter().map(matrix).collect::<Vec<_>>().join(","))
}

fn recammaster(frames: &[PoseFrame]) -> String {
    let of = |(idx, frame): (usize, &PoseFrame)| {
        let axes = DMat3::from_quat(frame.pose.rotation);
        let row = |v: glam::DVec3, last: u8| format!("[{} {} {} {last}] ", v.x, -v.y, v.z);
        let rows = row(axes.z_axis, 0) + &row(axes.x_axis, 0) + &row(-axes.y_axis, 0) + &row(frame.pose.position, 1);
        format!(r#""frame{idx}": {{"cam01": "{rows}"}}"#)
    };
    format!("{{{}}}", frames.iter().enumerate().map(of).collect::<Vec<_>>().join(","))
}

fn inria(frames: &[PoseFrame]) -> String {
    let of = |(idx, frame): (usize, &PoseFrame)| {
        let matrix = rows(DMat4::from_quat(frame.pose.rotation));
        let axes: Vec<String> =
            matrix.chunks(4).take(3).map(|row| format!("[{}]", joined(row[..3].iter().copied(), ","))).collect();
        let focal = 360.0 / (frame.fov_y_rad.unwrap() / 2.0).tan();
        format!(
            r#"{{"id":{idx},"img_name":"{idx:05}","width":1280,"height":720,"position":[{}],"rotation":[{}],"fy":{focal},"fx":{focal}}}"#,
            joined(frame.pose.position.to_array(), ","),
            axes.join(",")
        )
    };
    format!("[{}]", frames.iter().enumerate().map(of).collect::<Vec<_>>().join(","))
}

const ROWS: [Row; 9] = [
    Row { format: Format::Re10k, name: "a.txt", text: re10k, stamp_secs: Some(1e-6), keeps_fov: true },
    Row {
        format: Format::Aria,
        name: "closed_loop_trajectory.csv",
        text: aria,
        stamp_secs: Some(1e-6),
        keeps_fov: false,
    },
    Row { format: Format::Dpvo, name: "b.txt", text: dpvo, stamp_secs: Some(1e-6), keeps_fov: false },
    Row { format: Format::Euroc, name: "c.txt", text: euroc_with_spaces, stamp_secs: Some(1e-6), keeps_fov: false },
    Row { format: Format::Tum, name: "d.csv", text: tum_with_commas, stamp_secs: Some(1e-6), keeps_fov: false },
    Row { format: Format::Kitti, name: "e.txt", text: kitti_with_times, stamp_secs: Some(1e-12), keeps_fov: false },
    Row { format: Format::MotionCtrl, name: "f.json", text: motionctrl, stamp_secs: None, keeps_fov: false },
    Row { format: Format::ReCamMaster, name: "g.json", text: recammaster, stamp_secs: None, keeps_fov: false },
    Row { format: Format::Inria, name: "h.json", text: inria, stamp_secs: None, keeps_fov: true },
];

fn check(wanted: &[PoseFrame], row: &Row) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(row.name);
    std::fs::write(&path, (row.text)(wanted)).unwrap();
    // The order of a quaternion in a few lines may be anyone's guess: the reader is told the format.
    let got = read(&path, Some(row.format)).unwrap().track;
    compare(wanted, &got, row.name, row.stamp_secs);
    for (a, b) in wanted.iter().zip(&got.frames).filter(|_| row.keeps_fov) {
        assert!((a.fov_y_rad.unwrap() - b.fov_y_rad.unwrap()).abs() < 1e-12, "{}", row.name);
    }
}

/// Compares poses, and times from the first one.
fn compare(wanted: &[PoseFrame], got: &PoseTrack, name: &str, stamp_secs: Option<f64>) {
    assert_eq!((got.frames.len(), got.timed), (wanted.len(), stamp_secs.is_some()), "{name}");
    for (a, b) in wanted.iter().zip(&got.frames) {
        let moved = a.pose.position.distance(b.pose.position);
        let turned = rotation::angle_between(a.pose.rotation, b.pose.rotation);
        assert!(moved < 1e-12 && turned < 1e-12, "{name}: moved {moved}, turned {turned}");
        let late = (b.time_secs - got.frames[0].time_secs) - (a.time_secs - wanted[0].time_secs);
        assert!(stamp_secs.is_none_or(|stamp| late.abs() <= stamp), "{name}: {late} s late");
    }
}

fn frames_of(shot: &Shot) -> Vec<PoseFrame> {
    PoseTrack::sampled(shot, None).unwrap().frames
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, rng_seed: RngSeed::Fixed(11), ..ProptestConfig::default() })]

    #[test]
    fn frames_of_random_shots(shot in shots()) {
        let frames = frames_of(&shot);
        ROWS.iter().for_each(|row| check(&frames, row));
    }

    #[test]
    fn folders_of_7scenes(shot in shots(), lost in 0..20_usize) {
        let (frames, folder) = (frames_of(&shot), tempfile::tempdir().unwrap());
        for (idx, frame) in frames.iter().enumerate() {
            let text: String = if idx == lost + 1 {
                "nan nan nan nan\n".repeat(4)
            } else {
                rows(frame.pose.world_from_camera()).chunks(4).map(|row| joined(row.iter().copied(), " ") + "\n").collect()
            };
            std::fs::write(folder.path().join(format!("frame-{idx:06}.pose.txt")), text).unwrap();
        }
        let kept: Vec<usize> = (0..frames.len()).filter(|idx| *idx != lost + 1).collect();
        let wanted: Vec<PoseFrame> = kept.iter().map(|idx| frames[*idx].clone()).collect();
        let got = read(folder.path(), None).unwrap().track;
        compare(&wanted, &got, "7scenes", None);
        let numbers: Vec<usize> = got.frames.iter().map(|frame| (frame.time_secs * 30.0).round() as usize).collect();
        prop_assert_eq!(numbers, kept);
    }
}
