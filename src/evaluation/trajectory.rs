use glam::{DMat3, DVec3};

use cinesplat_export::PoseTrack;
use cinesplat_geometry::Pose;

/// A camera path as error measures see it: poses with rotation matrices as they stood in their file.
///
/// Matrices rather than quaternions, because a file of rounded matrices (KITTI) is off orthonormal by its digits, and
/// measures that are to agree with other programs must see the same numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    /// Time stamps; `None` where the file has none.
    pub times_secs: Option<Vec<f64>>,
    /// Camera centers, world.
    pub positions: Vec<DVec3>,
    /// Rotations of `world_from_camera`, OpenCV camera axes.
    pub rotations: Vec<DMat3>,
    /// Vertical fields of view; `None` where the file has none.
    pub fov_y_rad: Vec<Option<f64>>,
    /// World up; `None` where the file does not say.
    pub up: Option<DVec3>,
}

impl From<&PoseTrack> for Trajectory {
    fn from(track: &PoseTrack) -> Self {
        let rotation =
            |frame: &cinesplat_export::PoseFrame| frame.matrix.unwrap_or(DMat3::from_quat(frame.pose.rotation));
        Self {
            times_secs: track.timed.then(|| track.frames.iter().map(|frame| frame.time_secs).collect()),
            positions: track.frames.iter().map(|frame| frame.pose.position).collect(),
            rotations: track.frames.iter().map(rotation).collect(),
            fov_y_rad: track.frames.iter().map(|frame| frame.fov_y_rad).collect(),
            up: track.up,
        }
    }
}

impl Trajectory {
    /// A path of poses at times, nothing else known.
    pub fn from_poses(times_secs: Option<Vec<f64>>, poses: &[Pose]) -> Self {
        Self {
            times_secs,
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

    /// Sum of the distances from pose to pose.
    pub fn path_length(&self) -> f64 {
        self.positions.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    /// The poses at these indices, in this order; indices out of range are left out.
    #[must_use]
    pub fn select(&self, indices: &[usize]) -> Self {
        let pick = |list: &[f64]| indices.iter().filter_map(|idx| list.get(*idx).copied()).collect();
        Self {
            times_secs: self.times_secs.as_deref().map(pick),
            positions: indices.iter().filter_map(|idx| self.positions.get(*idx).copied()).collect(),
            rotations: indices.iter().filter_map(|idx| self.rotations.get(*idx).copied()).collect(),
            fov_y_rad: indices.iter().filter_map(|idx| self.fov_y_rad.get(*idx).copied()).collect(),
            up: self.up,
        }
    }

    /// Times, or the index of each pose where there are none.
    pub fn times_or_indices(&self) -> Vec<f64> {
        self.times_secs.clone().unwrap_or_else(|| (0..self.len()).map(|idx| idx as f64).collect())
    }

    /// Diagonal of the box around the positions.
    pub fn diameter(&self) -> f64 {
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = self.positions.iter().fold(bounds, |(low, high), p| (low.min(*p), high.max(*p)));
        if self.is_empty() { 0.0 } else { (high - low).length() }
    }

    /// World up: the file's, or the mean of the cameras' own up directions, or `-y`.
    pub fn up_or_mean(&self) -> DVec3 {
        let mean: DVec3 = self.rotations.iter().map(|rotation| -rotation.y_axis).sum();
        self.up.or(mean.try_normalize()).unwrap_or(DVec3::NEG_Y)
    }
}
