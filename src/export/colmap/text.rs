//! The text form: `IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME` and a line of points (here blank) an image.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::super::ExportError;
use super::super::columns::{bad_line, data_lines, joined, number};
use super::super::track::PoseTrack;
use super::{Image, Lens, MODELS, ModelFiles, PINHOLE, model, model_number, non_empty, track};

pub(crate) fn write(track: &PoseTrack) -> ModelFiles {
    let (lenses, images) = model(track);
    let mut cameras = String::from("# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n");
    for lens in &lenses {
        let params = joined(lens.params(), " ");
        let _ = writeln!(cameras, "{} {} {} {} {params}", lens.id, MODELS[PINHOLE].0, lens.width, lens.height);
    }
    let mut list = String::from("# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n");
    for (idx, image) in images.iter().enumerate() {
        let [x, y, z, w] = image.rotation.to_array();
        let pose = joined([w, x, y, z].into_iter().chain(image.translation.to_array()), " ");
        let _ = writeln!(list, "{} {pose} {} {}\n", idx + 1, image.lens_id, image.name);
    }
    let points = "# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n";
    vec![
        ("cameras.txt", cameras.into_bytes()),
        ("images.txt", list.into_bytes()),
        ("points3D.txt", points.as_bytes().to_vec()),
    ]
}

/// The track of `images.txt` and `cameras.txt`; without the latter, fields of view stay unknown.
pub(crate) fn read(images: &str, cameras: Option<&str>) -> Result<PoseTrack, ExportError> {
    let lenses = cameras.map(read_lenses).transpose()?.unwrap_or_default();
    let mut lines = images.lines().enumerate().map(|(idx, line)| (idx + 1, line.trim()));
    let mut list = Vec::new();
    while let Some((line, text)) = lines.next() {
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        list.push(read_image(line, text)?);
        // The line of points, which may be blank.
        lines.next();
    }
    Ok(track(non_empty(list)?, &lenses))
}

fn read_image(line: usize, text: &str) -> Result<Image, ExportError> {
    let columns: Vec<&str> = text.split_whitespace().collect();
    let expected = || bad_line(line, text, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    let [_, w, x, y, z, tx, ty, tz, lens_id, name, ..] = columns[..] else { return Err(expected()) };
    let mut v = [0.0; 7];
    for (value, column) in v.iter_mut().zip([w, x, y, z, tx, ty, tz]) {
        *value = number(line, column)?;
    }
    let rotation = DQuat::from_xyzw(v[1], v[2], v[3], v[0]);
    if !(rotation.length() > 1e-6) {
        return Err(bad_line(line, text, "a quaternion that is not 0"));
    }
    let lens_id = lens_id.parse().map_err(|_| expected())?;
    let translation = DVec3::new(v[4], v[5], v[6]);
    Ok(Image { name: name.to_owned(), lens_id, rotation: rotation.normalize(), translation })
}

fn read_lenses(text: &str) -> Result<Vec<Lens>, ExportError> {
    data_lines(text).map(|(line, text)| read_lens(line, text)).collect()
}

fn read_lens(line: usize, text: &str) -> Result<Lens, ExportError> {
    let columns: Vec<&str> = text.split_whitespace().collect();
    let expected = || bad_line(line, text, "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[] of a known model");
    let [id, name, width, height, params @ ..] = &columns[..] else { return Err(expected()) };
    let params = params.iter().map(|column| number(line, column)).collect::<Result<Vec<_>, _>>()?;
    let whole = |text: &str| text.parse::<u32>().map_err(|_| expected());
    let model = model_number(name).ok_or_else(expected)?;
    Lens::new(whole(id)?, model, (whole(width)?, whole(height)?), &params).ok_or_else(expected)
}
