//! Files of real captures.

use cinesplat::export::{Format, read};
use glam::DVec3;

use crate::support::shared;

#[test]
fn instant_ngps_fox() {
    let Some(path) = shared("data/fox/transforms.json") else { return };
    let imported = read(&path, None).unwrap();
    let track = imported.track;
    assert_eq!((imported.format, track.frames.len(), track.size_px), (Format::Transforms, 67, Some((1080, 1920))));
    // The file states camera_angle_y as 1.2193576.
    assert!((track.frames[0].fov_y_rad.unwrap() - 1.219_357_612_194_485_6).abs() < 1e-4);
    // All cameras look inward: their view axes pass near one point, the fox's head.
    let middle = track.frames.iter().map(|f| f.pose.position).sum::<DVec3>() / 67.0;
    let mean_axis = track.frames.iter().map(|f| f.pose.forward()).sum::<DVec3>().normalize();
    assert!(track.frames.iter().all(|f| f.pose.forward().dot(mean_axis) > 0.3), "{middle}");
}

#[test]
fn the_lund_door_as_colmap_text() {
    let Some(folder) = shared("data/lund_door") else { return };
    let imported = read(&folder, None).unwrap();
    let track = imported.track;
    assert_eq!((imported.format, track.frames.len(), track.size_px), (Format::Colmap, 12, Some((1296, 1936))));
    // The points triangulated from these images are in front of every camera.
    let points = std::fs::read_to_string(folder.join("sparse/points3D.txt")).unwrap();
    let points: Vec<DVec3> = points
        .lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| {
            let numbers: Vec<f64> = line.split_whitespace().skip(1).take(3).filter_map(|n| n.parse().ok()).collect();
            Some(DVec3::from_array(numbers.try_into().ok()?))
        })
        .collect();
    assert!(points.len() > 10_000);
    for frame in &track.frames {
        let ahead = points.iter().filter(|point| frame.pose.to_camera(**point).z > 0.0).count();
        assert!(ahead as f64 > 0.99 * points.len() as f64, "{ahead} of {}", points.len());
    }
}

#[test]
fn the_living_rooms_log_and_the_gendop_path() {
    let Some(data) = shared("data") else { return };
    let room = read(&data.join("livingroom/trajectory.log"), None).unwrap();
    let path = read(&data.join("gendop/case1_transforms_cleaning.json"), None).unwrap();
    assert_eq!((room.format, room.track.frames.len()), (Format::Log, 211));
    assert_eq!((path.format, path.track.frames.len()), (Format::Transforms, 120));
    assert_eq!(path.track.size_px, Some((512, 208)));
}
