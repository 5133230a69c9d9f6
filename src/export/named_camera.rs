//! Still cameras with names, and the path that they are in order.

use super::ExportError;
use super::lens_losses::LensLosses;
use super::name_order::out_of_order;
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use cinesplat_geometry::Camera;

/// A camera and the name of its image.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCamera {
    /// File name without extension and without path separators.
    pub name: String,
    /// Pose and image.
    pub camera: Camera,
}

/// The cameras in order, as a path without times.
pub(super) fn track(cameras: &[NamedCamera]) -> Result<PoseTrack, ExportError> {
    let mut losses = LensLosses::default();
    let frame = |(idx, named): (usize, &NamedCamera)| {
        let Camera { pose, intrinsics } = named.camera;
        let middle = [f64::from(intrinsics.width) / 2.0, f64::from(intrinsics.height) / 2.0];
        losses.principal_point_px([intrinsics.cx_px - middle[0], intrinsics.cy_px - middle[1]]);
        losses.focal_px(intrinsics.fx_px, intrinsics.fy_px);
        PoseFrame { fov_y_rad: Some(intrinsics.fov_y_rad()), ..PoseFrame::new(idx as f64 / DEFAULT_FPS, pose) }
    };
    let frames: Vec<PoseFrame> = cameras.iter().enumerate().map(frame).collect();
    let sizes: Vec<(u32, u32)> =
        cameras.iter().map(|named| (named.camera.intrinsics.width, named.camera.intrinsics.height)).collect();
    let first = *sizes.first().ok_or(ExportError::NoPoses)?;
    let num_other = sizes.iter().filter(|size| **size != first).count();
    let mut unread = losses.into_lines();
    if num_other > 0 {
        unread.push(format!("{num_other} cameras have other image sizes than the first, {} x {}", first.0, first.1));
    }
    unread.extend(out_of_order(cameras.iter().map(|named| named.name.as_str())));
    Ok(PoseTrack { size_px: Some(first), unread, ..PoseTrack::untimed(frames) })
}
