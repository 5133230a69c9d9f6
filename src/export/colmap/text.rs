//! The text form. Each image has two lines: `IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME`, and its points (written
//! blank).

use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::super::ExportError;
use super::super::columns::{all_lines, bad_line, data_lines, joined, number};
use super::super::track::PoseTrack;
use super::model::{CameraModel, ModelCamera, ModelFiles, ModelImage, model, track};

pub(crate) fn write(track: &PoseTrack) -> ModelFiles {
    let (cameras, images) = model(track);
    let mut camera_text = String::from("# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n");
    for camera in &cameras {
        let (name, params) = (<&str>::from(CameraModel::Pinhole), joined(camera.pinhole_params(), " "));
        let _ = writeln!(camera_text, "{} {name} {} {} {params}", camera.id, camera.width, camera.height);
    }
    let mut image_text =
        String::from("# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n");
    for (idx, image) in images.iter().enumerate() {
        let [x, y, z, w] = image.rotation.to_array();
        let pose = joined([w, x, y, z].into_iter().chain(image.translation.to_array()), " ");
        let _ = writeln!(image_text, "{} {pose} {} {}\n", idx + 1, image.camera_id, image.name);
    }
    let points = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n";
    vec![
        ("cameras.txt", camera_text.into_bytes()),
        ("images.txt", image_text.into_bytes()),
        ("points3D.txt", points.as_bytes().to_vec()),
    ]
}

/// The track of `images.txt` and `cameras.txt`; without the latter the fields of view are unknown.
pub(crate) fn read(images: &str, cameras: Option<&str>) -> Result<PoseTrack, ExportError> {
    let cameras = cameras.map(read_cameras).transpose()?.unwrap_or_default();
    let mut lines = all_lines(images).enumerate().map(|(idx, line)| (idx + 1, line));
    let mut list = Vec::new();
    while let Some((line, text)) = lines.next() {
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        list.push(read_image(line, text)?);
        // The line of points may be blank.
        lines.next();
    }
    track(list, &cameras)
}

fn read_image(line: usize, text: &str) -> Result<ModelImage, ExportError> {
    let columns: Vec<&str> = text.split_whitespace().collect();
    let expected = || bad_line(line, text, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    let [_, w, x, y, z, tx, ty, tz, camera_id, name, ..] = columns[..] else { return Err(expected()) };
    let mut v = [0.0; 7];
    for (value, column) in v.iter_mut().zip([w, x, y, z, tx, ty, tz]) {
        *value = number(line, column)?;
    }
    let rotation = DQuat::from_xyzw(v[1], v[2], v[3], v[0]);
    if !(rotation.length() > 1e-6) {
        return Err(bad_line(line, text, "a quaternion that is not 0"));
    }
    let camera_id = camera_id.parse().map_err(|_| expected())?;
    let translation = DVec3::new(v[4], v[5], v[6]);
    Ok(ModelImage { name: name.to_owned(), camera_id, rotation: rotation.normalize(), translation })
}

fn read_cameras(text: &str) -> Result<Vec<ModelCamera>, ExportError> {
    data_lines(text).map(|(line, text)| read_camera(line, text)).collect()
}

fn read_camera(line: usize, text: &str) -> Result<ModelCamera, ExportError> {
    let columns: Vec<&str> = text.split_whitespace().collect();
    let expected = || bad_line(line, text, "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[] of a known model");
    let [id, name, width, height, params @ ..] = &columns[..] else { return Err(expected()) };
    let params = params.iter().map(|column| number(line, column)).collect::<Result<Vec<_>, _>>()?;
    let whole = |text: &str| text.parse::<u32>().map_err(|_| expected());
    let model: CameraModel = name.parse().map_err(|_| expected())?;
    ModelCamera::new(whole(id)?, model, (whole(width)?, whole(height)?), &params).ok_or_else(expected)
}
