//! Camera files of RealEstate10K, which CameraCtrl also reads: an optional line with the address of the film, then lines of
//! microseconds, `fx fy cx cy` over the image's size, two numbers that are 0 (`k1 k2` in other programs' files), and `camera_from_world` (3 x 4, row-major)
//! with OpenCV camera axes.

use glam::DMat3;

use super::ExportError;
use super::columns::{bad_line, data_lines, numbers};
use super::json_read::matrix_from_rows;
use super::lens_losses::LensLosses;
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::LensModel;

/// Columns of a line.
pub(super) const COLUMNS: usize = 19;
const MICROS: f64 = 1e6;

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    let mut stated_aspect = None;
    let mut losses = LensLosses::default();
    for (line, text) in data_lines(text) {
        if frames.is_empty() && text.starts_with("http") {
            continue;
        }
        let v = numbers::<COLUMNS>(line, text)?;
        let [fx, fy, cx, cy] = [v[1], v[2], v[3], v[4]];
        if !(fx > 0.0 && fy > 0.0) {
            return Err(bad_line(line, text, "focal lengths above 0 in columns 2 and 3"));
        }
        let camera_from_world = matrix_from_rows(&v[7..]).ok_or_else(|| bad_line(line, text, "a 3 x 4 matrix"))?;
        let inverse = Pose::from_matrix(camera_from_world);
        let inverse = inverse.map_err(|error| bad_line(line, text, format!("a rigid pose ({error})")))?;
        // Pixels are square, so the focal lengths over the sizes give the aspect.
        stated_aspect = stated_aspect.or(Some(fy / fx));
        losses.principal_point_frac([cx - 0.5, cy - 0.5]);
        losses.distortion("k1", v[5]);
        losses.distortion("k2", v[6]);
        // Pixels are square: the offsets are over the height.
        let value = |name: &str| match name {
            "k1" => Some(v[5]),
            "k2" => Some(v[6]),
            "center_x" => Some((cx - 0.5) * fy / fx),
            "center_y" => Some(cy - 0.5),
            _ => None,
        };
        losses.lens(Some(LensModel::of_values(value)));
        frames.push(PoseFrame {
            fov_y_rad: Some(2.0 * (0.5 / fy).atan()),
            matrix: Some(DMat3::from_mat4(camera_from_world).transpose()),
            ..PoseFrame::new(v[0] / MICROS, inverse.inverse())
        });
    }
    let lens_model = losses.lens_model();
    let unread = losses.into_lines();
    Ok(PoseTrack { stated_aspect, timed: true, lens_model, unread, ..PoseTrack::untimed(frames) })
}
