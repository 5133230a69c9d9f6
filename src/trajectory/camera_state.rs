use super::Keyframe;
use cinesplat_geometry::Pose;

/// Pose and lens at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraState {
    /// `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view.
    pub fov_y_rad: f64,
    /// Distance of sharpest focus along the view axis, scene units; `None` without depth of field.
    pub focus_distance: Option<f64>,
}

impl From<&Keyframe> for CameraState {
    fn from(key: &Keyframe) -> Self {
        Self { pose: key.pose, fov_y_rad: key.fov_y_rad, focus_distance: key.focus_distance }
    }
}
