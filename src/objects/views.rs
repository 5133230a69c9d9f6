//! Virtual cameras around an object.

use glam::DVec3;

use super::object::Object;
use cinesplat_geometry::{Camera, Intrinsics, LevelFrame, Pose};

/// Vertical field of view of the virtual cameras: narrow, so that the projection is nearly orthographic.
const FOV_Y_RAD: f64 = 0.5;

/// Factor on the least distance at which the whole box is in the frame.
const MARGIN: f64 = 1.1;

/// Cameras with square frames on rings around an object: `num_azimuths` per elevation (rad, seen from its middle),
/// aimed at its middle, with a common distance and lens that show the whole box in every view. Azimuth 0 is the heading of
/// the box, so that the views rotate with the object.
pub(crate) fn ring(
    object: &Object,
    up: DVec3,
    num_azimuths: usize,
    elevations_rad: &[f64],
    size_px: u32,
) -> Vec<Camera> {
    let Ok(frame) = LevelFrame::new(up) else { return Vec::new() };
    let frame = frame.with_heading(object.rotation * DVec3::X);
    let distance = object.radius().max(f64::MIN_POSITIVE) * MARGIN / (FOV_Y_RAD / 2.0).sin();
    let intrinsics = Intrinsics::from_fov_y(size_px, size_px, FOV_Y_RAD);
    let camera = |away: DVec3| {
        let pose = Pose::facing(object.center + away * distance, -away, frame.up, Some(frame.east));
        Camera { pose, intrinsics }
    };
    let mut cameras: Vec<Camera> = frame.rings(num_azimuths, elevations_rad).map(camera).collect();
    let zoom = largest_zoom(&cameras, object);
    for camera in &mut cameras {
        camera.intrinsics.fx_px *= zoom;
        camera.intrinsics.fy_px *= zoom;
    }
    cameras
}

/// The factor on the focal length at which the corners of the box still lie in the frames of all cameras.
fn largest_zoom(cameras: &[Camera], object: &Object) -> f64 {
    let off_axis = |camera: &Camera, corner: DVec3| {
        let size = f64::from(camera.intrinsics.width);
        camera.project(corner).map_or(0.5, |(px, _)| ((px - size / 2.0) / size).abs().max_element())
    };
    let corners = object.corners();
    let most = cameras.iter().flat_map(|camera| corners.map(|corner| off_axis(camera, corner))).fold(0.0, f64::max);
    if most > 0.0 { 0.5 / MARGIN / most } else { 1.0 }
}

/// Scene units per pixel at the middle of an object, for a camera of its ring.
pub(crate) fn unit_per_px(camera: &Camera, object: &Object) -> f64 {
    (object.center - camera.pose.position).length() / camera.intrinsics.fy_px
}
