//! Formats that are only read: files written here from known poses by the definition of each format.

use cinesplat::evaluation::{EvalSettings, Trajectory, evaluate};
use cinesplat::export::{Format, ImportSettings, Imported, PoseFrame, ReadSettings, cameras_json, read, read_with};
use cinesplat::geometry::{Pose, rotation};
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::sample_shot::file;

/// A few poses that no mistake of signs, order or inversion leaves unchanged.
fn poses() -> Vec<Pose> {
    (0..4)
        .map(|k| {
            let k = f64::from(k);
            Pose::new(DVec3::new(1.0 + k, -2.0, 0.5 * k), rotation::exp(DVec3::new(0.3, 0.2 * k - 0.4, 0.5)))
        })
        .collect()
}

fn rows(matrix: DMat4) -> Vec<f64> {
    matrix.transpose().to_cols_array().to_vec()
}

fn joined(values: &[f64], separator: &str) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(separator)
}

/// Checks that a file was read as the poses of this module.
fn check(imported: &Imported, format: Format, tolerance: f64) {
    assert_eq!(imported.format, format);
    assert_eq!(imported.track.frames.len(), poses().len());
    for (found, wanted) in imported.track.frames.iter().zip(poses()) {
        assert!(found.pose.position.distance(wanted.position) < tolerance, "{found:?}, expected {wanted:?}");
        assert!(rotation::angle_between(found.pose.rotation, wanted.rotation) < tolerance, "{found:?}");
        if let Some(matrix) = found.matrix {
            assert!(matrix.abs_diff_eq(DMat3::from_quat(wanted.rotation), tolerance));
        }
    }
}

/// INRIA's list of cameras: 200 x 100 px, focal length 80 px.
fn inria_json() -> String {
    let camera = |(idx, pose): (usize, &Pose)| {
        let r: Vec<String> = rows(DMat4::from_quat(pose.rotation))
            .chunks(4)
            .take(3)
            .map(|row| format!("[{}]", joined(&row[..3], ",")))
            .collect();
        let position = joined(&pose.position.to_array(), ",");
        format!(
            r#"{{"id":{idx},"img_name":"scan/{idx}.jpg","width":200,"height":100,"position":[{position}],"rotation":[{}],"fy":80.0,"fx":80.0}}"#,
            r.join(",")
        )
    };
    format!("[{}]", poses().iter().enumerate().map(camera).collect::<Vec<_>>().join(","))
}

#[test]
fn inrias_cameras_as_a_path_and_as_stills() {
    let (path, _folder) = file("cameras.json", inria_json().as_bytes());
    let imported = read(&path, None).unwrap();
    check(&imported, Format::Inria, 1e-12);
    assert_eq!(imported.track.size_px, Some((200, 100)));
    let fov = imported.track.frames[0].fov_y_rad.unwrap();
    assert!((fov - 2.0 * (50.0_f64 / 80.0).atan()).abs() < 1e-12);
    let stills = cameras_json::read(&inria_json()).unwrap();
    assert_eq!(stills.cameras[1].name, "scan_1.jpg");
    assert!(stills.cameras[1].camera.pose.position.distance(poses()[1].position) < 1e-12);
}

#[test]
fn realestate10k_with_the_address_of_the_film() {
    let line = |(idx, pose): (usize, &Pose)| {
        let inverse = rows(pose.inverse().world_from_camera());
        format!("{} 0.45 0.8 0.52 0.5 0 0 {}\n", 33_000_000 + 40_000 * idx, joined(&inverse[..12], " "))
    };
    let lines: String = poses().iter().enumerate().map(line).collect();
    for head in ["https://www.youtube.com/watch?v=x\n", ""] {
        let (path, _folder) = file("0000cc6d8b108390.txt", format!("{head}{lines}").as_bytes());
        let imported = read(&path, None).unwrap();
        check(&imported, Format::Re10k, 1e-12);
        let frames = &imported.track.frames;
        assert!((frames[1].time_secs - 33.04).abs() < 1e-12);
        assert!((frames[0].fov_y_rad.unwrap() - 2.0 * (0.5_f64 / 0.8).atan()).abs() < 1e-12);
        assert!((imported.track.stated_aspect.unwrap() - 0.8 / 0.45).abs() < 1e-12);
        let losses = "the principal point, up to 2.00 % of the image from its center, is not read";
        assert_eq!(imported.track.unread, [losses]);
    }
}

#[test]
fn motionctrls_list_of_matrices() {
    let matrix = |pose: &Pose| format!("[{}]", joined(&rows(pose.inverse().world_from_camera())[..12], ","));
    let text = format!("[{}]", poses().iter().map(matrix).collect::<Vec<_>>().join(","));
    let (path, _folder) = file("poses.json", text.as_bytes());
    check(&read(&path, None).unwrap(), Format::MotionCtrl, 1e-12);
}

#[test]
fn recammasters_cameras_by_name() {
    // Rows forward, right, up and position, with y mirrored: the left-handed world of Unreal Engine.
    let text_of = |pose: &Pose| {
        let axes = DMat3::from_quat(pose.rotation);
        let row = |v: DVec3, last: u8| format!("[{} {} {} {last}] ", v.x, -v.y, v.z);
        row(axes.z_axis, 0) + &row(axes.x_axis, 0) + &row(-axes.y_axis, 0) + &row(pose.position, 1)
    };
    let still = text_of(&Pose::new(DVec3::ONE, DQuat::IDENTITY));
    let frame =
        |(idx, pose): (usize, &Pose)| format!(r#""frame{idx}": {{"cam01": "{still}", "cam02": "{}"}}"#, text_of(pose));
    let text = format!("{{{}}}", poses().iter().enumerate().map(frame).collect::<Vec<_>>().join(","));
    let (path, _folder) = file("camera_extrinsics.json", text.as_bytes());
    let named = |camera: &str| ReadSettings { camera: Some(camera.to_owned()), ..ReadSettings::default() };
    check(&read_with(&path, &named("cam02")).unwrap(), Format::ReCamMaster, 1e-12);
    let first = read(&path, None).unwrap();
    assert_eq!(first.track.frames[3].pose.position, DVec3::ONE);
    assert_eq!(first.track.unread, ["the file holds 2 cameras: cam01 is read, of cam01, cam02"]);
    let error = read_with(&path, &named("cam09")).unwrap_err().to_string();
    assert_eq!(error, "found cam09, expected one of the cameras cam01, cam02");
}

#[test]
fn arias_device_with_its_gravity() {
    let mut text = "graph_uid,tracking_timestamp_us,utc_timestamp_ns,tx_world_device,ty_world_device,tz_world_device,\
                    qx_world_device,qy_world_device,qz_world_device,qw_world_device,gravity_x_world,gravity_y_world,\
                    gravity_z_world,quality_score\n"
        .to_owned();
    for (idx, pose) in poses().iter().enumerate() {
        let values: Vec<f64> = pose.position.to_array().into_iter().chain(pose.rotation.to_array()).collect();
        let line = format!("a-b,{},7,{},0.0,0.0,-9.81,1.0\n", 5_000_000 + 1000 * idx, joined(&values, ","));
        text.push_str(&line);
    }
    let (path, _folder) = file("closed_loop_trajectory.csv", text.as_bytes());
    let imported = read(&path, None).unwrap();
    check(&imported, Format::Aria, 1e-12);
    assert_eq!((imported.track.up, imported.track.frames[1].time_secs), (Some(DVec3::Z), 5.001));
}

#[test]
fn a_folder_of_7scenes_without_the_poses_that_tracking_lost() {
    let folder = tempfile::tempdir().unwrap();
    let write = |idx: usize, text: String| {
        std::fs::write(folder.path().join(format!("frame-{idx:06}.pose.txt")), text).unwrap();
    };
    for (idx, pose) in poses().iter().enumerate() {
        let lines = rows(pose.world_from_camera()).chunks(4).map(|row| joined(row, "\t ") + "\n").collect();
        write(2 * idx, lines);
    }
    write(3, "inf inf inf inf\n".repeat(4));
    std::fs::write(folder.path().join("frame-000000.color.png"), b"x").unwrap();
    let imported = read(folder.path(), None).unwrap();
    check(&imported, Format::SevenScenes, 1e-12);
    assert_eq!(imported.track.unread, ["1 of 5 poses are not finite and are left out: the others keep their times"]);
    // Frames 0, 2, 4 and 6 stay where they are in time, at any rate.
    let settings = ImportSettings { fps: Some(10.0), ..ImportSettings::default() };
    let (shot, _) = imported.into_shot(&settings).unwrap();
    let times: Vec<f64> = shot.keyframes.iter().map(|key| key.time_secs).collect();
    assert_eq!(times, [0.0, 0.2, 0.4, 0.6]);
}

#[test]
fn a_lost_pose_does_not_shift_the_later_frames_of_7scenes() {
    let folder = tempfile::tempdir().unwrap();
    let write = |sequence: &str, idx: usize, lost: bool| {
        let pose = Pose::new(DVec3::new(idx as f64, (idx * idx) as f64, 0.0), DQuat::IDENTITY);
        let lines = rows(pose.world_from_camera()).chunks(4).map(|row| joined(row, " ") + "\n").collect();
        let text = if lost { "nan nan nan nan\n".repeat(4) } else { lines };
        let folder = folder.path().join(sequence);
        std::fs::create_dir_all(&folder).unwrap();
        // Without leading zeros the order of the names is not that of the numbers.
        std::fs::write(folder.join(format!("frame-{idx}.pose.txt")), text).unwrap();
    };
    for idx in 0..12 {
        write("whole", idx, false);
        write("gap", idx, idx == 4);
    }
    let [whole, gap] = ["whole", "gap"].map(|name| read(&folder.path().join(name), None).unwrap().track);
    let positions: Vec<f64> = whole.frames.iter().map(|frame| frame.pose.position.x).collect();
    assert_eq!(positions, (0..12).map(f64::from).collect::<Vec<_>>());
    let found = evaluate(&Trajectory::from(&whole), &Trajectory::from(&gap), &EvalSettings::default()).unwrap();
    assert_eq!((found.errors.len(), found.statistics.max), (11, 0.0));
    // Numbers are no times: a path with stamps is matched by index.
    let stamps = (0..12).map(|idx| 1000.0 + f64::from(idx)).collect();
    let stamped = Trajectory { times_secs: Some(stamps), frame_numbers: None, ..Trajectory::from(&whole) };
    let found = evaluate(&stamped, &Trajectory::from(&whole), &EvalSettings::default()).unwrap();
    assert_eq!((found.errors.len(), found.statistics.max), (12, 0.0));
    assert!(found.notes.iter().any(|line| line.contains("by index")), "{:?}", found.notes);
}

#[test]
fn sequences_of_7scenes_in_one_folder_follow_each_other() {
    let read_names = |names: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        for (idx, name) in names.iter().enumerate() {
            let matrix = Pose::new(DVec3::new(idx as f64, 0.0, 0.0), DQuat::IDENTITY).world_from_camera();
            let text: String = rows(matrix).chunks(4).map(|row| joined(row, " ") + "\n").collect();
            std::fs::write(folder.path().join(format!("{name}.pose.txt")), text).unwrap();
        }
        let track = read(folder.path(), None).unwrap().track;
        let found = |frame: &PoseFrame| (frame.pose.position.x, (30.0 * frame.time_secs).round());
        track.frames.iter().map(found).collect::<Vec<_>>()
    };
    let counted = vec![(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)];
    let sequences = ["seq-01-frame-000004", "seq-01-frame-000010", "seq-02-frame-000000", "seq-02-frame-000005"];
    assert_eq!(read_names(&sequences), counted);
    // Decimals of a stamp are no numbers of frames.
    assert_eq!(read_names(&["9.25", "9.5", "10.125", "10.75"]), counted);
    assert_eq!(read_names(&["frame.7", "frame.10"]), vec![(0.0, 7.0), (1.0, 10.0)]);
}

#[test]
fn a_fault_in_a_folder_of_7scenes_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("frame-000007.pose.txt"), "1 0 0\n").unwrap();
    let error = read(folder.path(), None).unwrap_err();
    assert_eq!(
        (error.code(), error.to_string().starts_with("frame-000007.pose.txt: line 1: ")),
        ("EXCHANGE-LINE", true)
    );
}

#[test]
fn dpvo_has_nanoseconds_and_w_last() {
    let line = |(idx, pose): (usize, &Pose)| {
        let values: Vec<f64> = pose.position.to_array().into_iter().chain(pose.rotation.to_array()).collect();
        format!("{:.18e} {}\n", 1.403_636_579_75e18 + 5e7 * idx as f64, joined(&values, " "))
    };
    let text: String = poses().iter().enumerate().map(line).collect();
    let (path, _folder) = file("MH_01.txt", text.as_bytes());
    check(&read(&path, Some(Format::Dpvo)).unwrap(), Format::Dpvo, 1e-12);
    // EuRoC's own nanoseconds are whole numbers. The doubt still names the flag.
    let found = read(&path, None).unwrap();
    assert_eq!((found.format, found.doubt.as_ref().map(|doubt| doubt.other)), (Format::Dpvo, Some(Format::Euroc)));
    check(&found, Format::Dpvo, 1e-12);
}

#[test]
fn kitti_with_times_in_the_lines_or_beside() {
    let lines = |is_timed: bool| -> String {
        let line = |(idx, pose): (usize, &Pose)| {
            let time = if is_timed { format!("{} ", 0.1 * idx as f64) } else { String::new() };
            time + &joined(&rows(pose.world_from_camera())[..12], " ") + "\n"
        };
        poses().iter().enumerate().map(line).collect()
    };
    let (path, _first) = file("00.txt", lines(true).as_bytes());
    let timed = read(&path, None).unwrap();
    check(&timed, Format::Kitti, 1e-12);
    assert!(timed.track.timed && (timed.track.frames[3].time_secs - 0.3).abs() < 1e-12);
    let (path, folder) = file("00.txt", lines(false).as_bytes());
    assert!(!read(&path, None).unwrap().track.timed);
    std::fs::write(folder.path().join("times.txt"), "0\n1.0e-01\n0.2\n").unwrap();
    assert!(!read(&path, None).unwrap().track.timed, "as many times as poses are needed");
    std::fs::write(folder.path().join("times.txt"), "0\n1.0e-01\n0.2\n0.3\n").unwrap();
    let beside = read(&path, None).unwrap();
    assert_eq!(
        (beside.track.timed, &beside.track.unread[..]),
        (true, &["the times are those of times.txt".to_owned()][..])
    );
    assert_eq!(beside.track.frames[1].time_secs, 0.1);
}

#[test]
fn what_a_lens_loses_is_said_with_its_amount() {
    // Without distortion the path is that of a pinhole.
    let lens = r#""w":200,"h":100,"fl_x":88,"fl_y":80,"cx":103,"cy":54"#;
    let matrix = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
    let frames = format!(r#""frames":[{{"transform_matrix":{matrix}}}]"#);
    let (path, _folder) = file("transforms.json", format!("{{{lens},{frames}}}").as_bytes());
    insta::assert_snapshot!(read(&path, None).unwrap().track.unread.join("\n"), @r"
    the principal point, up to 5.00 px from the image's center, is not read
    the horizontal focal length, +10.000 % off the vertical one, is not read
    ");
    let (path, _folder) = file("transforms.json", format!(r#"{{{lens},"k1":-0.05,"k4":0.001,{frames}}}"#).as_bytes());
    insta::assert_snapshot!(read(&path, None).unwrap().track.unread.join("\n"), @r"
    the principal point, up to 5.00 px from the image's center, is not read
    the lens distortion is not read (largest coefficient: k1 -0.0500)
    the horizontal focal length, +10.000 % off the vertical one, is not read
    ");
    let (path, folder) = file("images.txt", b"1 1 0 0 0 0 0 0 1 a.png\n\n");
    std::fs::write(folder.path().join("cameras.txt"), "1 FOV 200 100 80 80 103 54 0.02\n").unwrap();
    insta::assert_snapshot!(read(&path, None).unwrap().track.unread.join("\n"), @r"
    the lens model FOV is read as a pinhole of the same focal length
    the principal point, up to 5.00 px from the image's center, is not read
    the lens distortion is not read (largest coefficient: a parameter 0.0200)
    ");
}

#[test]
fn a_usdz_package_holds_its_layer_first() {
    use std::io::Write as _;
    let shot = super::sample_shot::with_cut();
    let (imported, _, folder) =
        super::sample_shot::there_and_back(&shot, Format::Usd, "a.usda", cinesplat::export::Content::Sampled);
    let layer = std::fs::read(folder.path().join("a.usda")).unwrap();
    let path = folder.path().join("a.usdz");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
    let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    archive.start_file("a.usda", stored).unwrap();
    archive.write_all(&layer).unwrap();
    archive.finish().unwrap();
    let packed = read(&path, None).unwrap();
    assert_eq!((packed.format, packed.track), (Format::Usd, imported.track));
}
