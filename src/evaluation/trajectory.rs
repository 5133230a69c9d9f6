use glam::{DMat3, DVec3};

use super::svd::svd;
use cinesplat_export::PoseTrack;
use cinesplat_geometry::Pose;

/// Length of the mean up direction of cameras that are upright: their up is within about 45 degrees of it.
const UPRIGHT: f64 = 0.7;

/// Frames per second in a [`PoseTrack`] without times.
const COUNTED_FPS: f64 = 30.0;

/// A camera path for error measures: poses with the rotation matrices of their file.
///
/// Rotations are matrices, not quaternions, because the rounded matrices of a file (KITTI) are not exactly orthonormal,
/// and results that agree with other programs need the same numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    /// Time stamps; `None` if the file has none.
    pub times_secs: Option<Vec<f64>>,
    /// Numbers of the frames of a file without times; `None` if the file has none.
    pub frame_numbers: Option<Vec<f64>>,
    /// Camera centers, world.
    pub positions: Vec<DVec3>,
    /// Rotations of `world_from_camera`, OpenCV camera axes.
    pub rotations: Vec<DMat3>,
    /// Vertical field of view per pose; `None` if the file has none.
    pub fov_y_rad: Vec<Option<f64>>,
    /// World up; `None` if the file does not state it.
    pub up: Option<DVec3>,
}

impl From<&PoseTrack> for Trajectory {
    fn from(track: &PoseTrack) -> Self {
        let rotation =
            |frame: &cinesplat_export::PoseFrame| frame.matrix.unwrap_or(DMat3::from_quat(frame.pose.rotation));
        let times = || track.frames.iter().map(|frame| frame.time_secs);
        Self {
            times_secs: track.timed.then(|| times().collect()),
            frame_numbers: (track.is_numbered && !track.timed)
                .then(|| times().map(|secs| (secs * COUNTED_FPS).round()).collect()),
            positions: track.frames.iter().map(|frame| frame.pose.position).collect(),
            rotations: track.frames.iter().map(rotation).collect(),
            fov_y_rad: track.frames.iter().map(|frame| frame.fov_y_rad).collect(),
            up: track.up,
        }
    }
}

impl Trajectory {
    /// A path of poses, with times or without.
    pub fn from_poses(times_secs: Option<Vec<f64>>, poses: &[Pose]) -> Self {
        Self {
            times_secs,
            frame_numbers: None,
            positions: poses.iter().map(|pose| pose.position).collect(),
            rotations: poses.iter().map(|pose| DMat3::from_quat(pose.rotation)).collect(),
            fov_y_rad: vec![None; poses.len()],
            up: None,
        }
    }

    /// Number of poses.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are no poses.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Sum of the distances from pose to pose, scene units.
    pub(crate) fn path_length(&self) -> f64 {
        self.positions.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    /// The poses at these indices, in this order. Indices out of range are skipped.
    #[must_use]
    pub fn select(&self, indices: &[usize]) -> Self {
        let pick = |list: &[f64]| indices.iter().filter_map(|idx| list.get(*idx).copied()).collect();
        Self {
            times_secs: self.times_secs.as_deref().map(pick),
            frame_numbers: self.frame_numbers.as_deref().map(pick),
            positions: indices.iter().filter_map(|idx| self.positions.get(*idx).copied()).collect(),
            rotations: indices.iter().filter_map(|idx| self.rotations.get(*idx).copied()).collect(),
            fov_y_rad: indices.iter().filter_map(|idx| self.fov_y_rad.get(*idx).copied()).collect(),
            up: self.up,
        }
    }

    /// Times, or the indices of the poses if there are none.
    pub(crate) fn times_or_indices(&self) -> Vec<f64> {
        self.times_secs.clone().unwrap_or_else(|| (0..self.len()).map(|idx| idx as f64).collect())
    }

    /// Diagonal of the bounding box of the positions, scene units.
    pub fn diameter(&self) -> f64 {
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = self.positions.iter().fold(bounds, |(low, high), p| (low.min(*p), high.max(*p)));
        if self.is_empty() { 0.0 } else { (high - low).length() }
    }

    /// World up: the file's, else the mean of the cameras' up directions, else `-y`.
    ///
    /// Where the cameras' up directions do not agree, the poses are those of a body with other axes: up is the world
    /// direction that stays most constant in the body.
    pub(crate) fn up_or_mean(&self) -> DVec3 {
        if let Some(up) = self.up {
            return up;
        }
        let sum = self.rotations.iter().fold(DMat3::ZERO, |sum, rotation| sum + *rotation);
        let mean = -sum.y_axis / self.len().max(1) as f64;
        if mean.length() >= UPRIGHT {
            return mean.normalize();
        }
        let found = svd(sum).u.x_axis;
        let agrees = found.dot(mean) >= 0.0;
        (if agrees { found } else { -found }).try_normalize().unwrap_or(DVec3::NEG_Y)
    }
}
