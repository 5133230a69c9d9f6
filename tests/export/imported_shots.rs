//! Shots of files that state no frame rate, size, field of view or up.

use cinesplat::export::{Content, Format, ImportSettings, read};
use cinesplat::trajectory::Shot;
use glam::{DQuat, DVec3};

use super::sample_shot::{file, key, shot, there_and_back, with_cut};

/// 15.25 s at 24 frames per second: 366 frames.
fn long_shot() -> Shot {
    let end = key(15.25, DVec3::new(1.0, -2.0, 9.5), DQuat::IDENTITY, 50.0);
    shot(vec![key(0.0, DVec3::new(1.0, -2.0, 0.5), DQuat::IDENTITY, 50.0), end], DVec3::NEG_Y)
}

const LOSSY: [(Format, &str); 5] = [
    (Format::Csv, "a.csv"),
    (Format::Tum, "a.tum"),
    (Format::Euroc, "a.euroc.csv"),
    (Format::Lichtfeld, "a.json"),
    (Format::Gltf, "a.glb"),
];

#[test]
fn the_rate_and_the_last_frame_of_a_film_are_not_lost() {
    for (format, name) in LOSSY {
        let (imported, _, _folder) = there_and_back(&long_shot(), format, name, Content::Sampled);
        let (back, lines) = imported.into_shot(&ImportSettings::default()).unwrap();
        assert_eq!((back.fps, back.num_frames(), back.keyframes.len()), (24.0, 366, 366), "{name}");
        assert!(lines.iter().any(|line| line.ends_with("its times are even at 24 frames per second")), "{lines:?}");
    }
    for (format, name) in [(Format::Kitti, "a.kitti"), (Format::Log, "a.log"), (Format::Colmap, "sparse")] {
        let (imported, _, _folder) = there_and_back(&long_shot(), format, name, Content::Sampled);
        let (back, lines) = imported.into_shot(&ImportSettings::default()).unwrap();
        assert_eq!((back.fps, back.num_frames()), (30.0, 366), "{name}");
        assert!(lines.contains(&"the file has no times: 30 frames per second are assumed".to_owned()), "{lines:?}");
    }
}

#[test]
fn rounded_times_and_ntsc_rates_are_found() {
    let rate_of = |fps: f64, digits: usize| {
        let line = |idx: u32| format!("{:.digits$} {idx} 2 3 0 0 0 1\n", f64::from(idx) / fps);
        let (path, _folder) = file("a.tum", (0..90).map(line).collect::<String>().as_bytes());
        read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap().0.fps
    };
    for fps in [10.0, 24.0, 24000.0 / 1001.0, 25.0, 30.0, 30000.0 / 1001.0, 60.0] {
        assert_eq!(rate_of(fps, 6), fps);
    }
    assert_eq!((rate_of(24.0, 3), rate_of(60.0, 4)), (24.0, 60.0));
    assert!((rate_of(12.5, 9) - 12.5).abs() < 1e-9);
}

#[test]
fn uneven_times_and_keyframes_assume_a_rate_and_say_so() {
    let (path, _folder) = file("a.tum", b"0 1 2 3 0 0 0 1\n0.04 1 2 4 0 0 0 1\n0.10 1 2 5 0 0 0 1\n");
    let (back, lines) = read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((back.fps, back.duration_secs), (30.0, 0.1));
    insta::assert_snapshot!(lines.join("\n"), @r"
    the file has no frame rate and its times are not those of a film (steps of 0.0400 to 0.0600 s): 30 frames per second are assumed
    the file has no image size: 1280 x 720 is assumed
    the file has no field of view: 50 degrees is assumed
    the file has no world up: the shot states none
    ");
    let (imported, _, _folder) = there_and_back(&with_cut(), Format::Csv, "a.csv", Content::Keyframes);
    let (back, _) = imported.into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((back.fps, back.duration_secs), (30.0, 3.0));
}

#[test]
fn the_image_size_of_a_gltf_is_assumed_aloud() {
    let portrait = Shot { width: 1080, height: 1920, ..long_shot() };
    let (imported, _, _folder) = there_and_back(&portrait, Format::Gltf, "a.gltf", Content::Sampled);
    let (back, lines) = imported.into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((back.width, back.height), (405, 720));
    let line = "the file has no image size: 405 x 720 is assumed, of its aspect ratio 0.5625";
    assert!(lines.iter().any(|found| found == line), "{lines:?}");
}

#[test]
fn settings_win_over_the_file_and_over_what_is_assumed() {
    let settings = ImportSettings {
        fps: Some(12.0),
        size_px: Some((640, 480)),
        fov_y_rad: Some(0.5),
        up: Some(DVec3::new(0.0, 0.0, 2.0)),
    };
    let (imported, _, _folder) = there_and_back(&long_shot(), Format::Kitti, "a.kitti", Content::Sampled);
    let (back, lines) = imported.into_shot(&settings).unwrap();
    assert_eq!((back.fps, back.num_frames(), back.duration_secs), (12.0, 366, 30.5));
    assert_eq!((back.width, back.height, back.scene.up), (640, 480, Some(DVec3::Z)));
    assert!(lines.is_empty() && back.keyframes.iter().all(|key| key.fov_y_rad == 0.5), "{lines:?}");
    let (imported, _, _folder) = there_and_back(&long_shot(), Format::Usd, "a.usda", Content::Sampled);
    let (back, lines) = imported.into_shot(&settings).unwrap();
    assert_eq!((back.fps, back.num_frames(), back.duration_secs), (12.0, 183, 15.25));
    insta::assert_snapshot!(lines.join("\n"), @r"
    the rate of 24 frames per second in the file is replaced by 12
    the image size of 1280 x 720 in the file is replaced by 640 x 480
    the field of view of 366 poses in the file is replaced by 28.648 degrees
    ");
}

#[test]
fn columns_that_are_not_read_are_counted() {
    let line = "1403636580838555648,4.6,-1.7,0.7,1,0,0,0,-0.02,0.03,0.8,-0.003,0.02,0.07,-0.02,0.13,0.07\n";
    let (path, _folder) = file("data.csv", line.as_bytes());
    let (_, lines) = read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap();
    assert_eq!(lines[0], "9 columns behind the quaternion are not read");
    assert!(lines[1].starts_with("a shot starts at 0 s: 1403636580.8"), "{lines:?}");
}

#[test]
fn poses_out_of_order_are_sorted_and_repeated_ones_dropped_aloud() {
    let line = |idx: usize| format!("{} {idx} 2 3 0 0 0 1\n", idx as f64 / 24.0);
    let order = [5, 6, 7, 0, 1, 2, 2, 3, 4, 7];
    let (path, _folder) = file("a.tum", order.map(line).concat().as_bytes());
    let (back, lines) = read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap();
    let places: Vec<f64> = back.keyframes.iter().map(|key| key.pose.position.x).collect();
    assert_eq!((places, back.fps), ((0..8).map(f64::from).collect(), 24.0));
    insta::assert_snapshot!(lines[..2].join("\n"), @r"
    the poses are put in order of time (places where the time steps back: 1)
    poses that are repeated with their times are taken once (repetitions: 2)
    ");
    // Two places at one time are a fault of the file.
    let (path, _folder) = file("a.tum", b"0 1 2 3 0 0 0 1\n0.1 1 2 3 0 0 0 1\n0.1 9 2 3 0 0 0 1\n");
    assert!(read(&path, None).unwrap().into_shot(&ImportSettings::default()).is_err());
}

/// The original files of NeRF state the horizontal field of view and no image size: 50 degrees were assumed.
#[test]
fn the_horizontal_field_of_view_of_nerf_is_taken_with_the_given_or_the_assumed_size() {
    let matrix = "[[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]";
    let text =
        format!(r#"{{"camera_angle_x":0.69,"frames":[{{"file_path":"./train/r_0","transform_matrix":{matrix}}}]}}"#);
    let (path, _folder) = file("transforms_train.json", text.as_bytes());
    let settings = ImportSettings { size_px: Some((800, 800)), ..ImportSettings::default() };
    let (square, lines) = read(&path, None).unwrap().into_shot(&settings).unwrap();
    assert!((square.keyframes[0].fov_y_rad - 0.69).abs() < 1e-12);
    insta::assert_snapshot!(lines.join("\n"), @r"
    the file has no times: 30 frames per second are assumed
    the file states the field of view across the image: that of an image of 800 x 800
    the file has no world up: the shot states none
    ");
    let (wide, lines) = read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap();
    let wanted = 2.0 * ((0.69_f64 / 2.0).tan() * 720.0 / 1280.0).atan();
    assert!((wide.keyframes[0].fov_y_rad - wanted).abs() < 1e-12);
    assert!(lines[1].ends_with("1280 x 720 is assumed") && lines[2].ends_with("an image of 1280 x 720"), "{lines:?}");
}

/// At exactly 1 kHz the rate was 1000.0000000000002, above the largest one of a film; 7.5 was 7.499999948630137.
#[test]
fn rates_of_rounded_stamps_have_few_decimals() {
    let made = |line: &dyn Fn(u32) -> String, num_frames: u32| {
        let (path, _folder) = file("a.tum", (0..num_frames).map(line).collect::<String>().as_bytes());
        read(&path, None).unwrap().into_shot(&ImportSettings::default()).unwrap()
    };
    let at = |fps: f64, start: f64| move |idx: u32| format!("{:.6} {idx} 2 3 0 0 0 1\n", start + f64::from(idx) / fps);
    for (fps, start) in [(7.5, 0.0), (7.5, 1_305_031_098.665_9), (1000.0, 1.0), (12.5, 0.0), (400.0, 0.0)] {
        assert_eq!(made(&at(fps, start), 366).0.fps, fps, "{fps} from {start}");
    }
    let (shot, lines) = made(&at(2000.0, 0.0), 366);
    assert_eq!((shot.fps, shot.keyframes.len()), (30.0, 366));
    assert!(lines[0].contains("30 frames per second are assumed"), "{lines:?}");
}
