//! Paths that the tests of this folder share.

use cinesplat::evaluation::Trajectory;
use cinesplat::export::{PoseTrack, read};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

use crate::support::shared;

/// A path of the trajectory data sets; `None` where they are absent.
pub(super) fn recorded(name: &str) -> Option<Trajectory> {
    let path = shared("data/trajectories")?.join(name);
    Some(Trajectory::from(&read(&path, None).unwrap().track))
}

/// Poses at 30 a second.
pub(super) fn at_30_fps(poses: &[Pose]) -> Trajectory {
    Trajectory::from_poses(Some((0..poses.len()).map(|idx| idx as f64 / 30.0).collect()), poses)
}

/// A path through points, the camera turned by the same rotation all along.
pub(super) fn through(points: impl Iterator<Item = DVec3>, rotation: DQuat) -> Trajectory {
    at_30_fps(&points.map(|point| Pose::new(point, rotation)).collect::<Vec<_>>())
}

/// A path of matrices as another program's file holds them.
pub(super) fn track_of(name: &str) -> Option<PoseTrack> {
    Some(read(&shared(name)?, None).unwrap().track)
}
