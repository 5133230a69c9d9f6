//! Paths for the tests of this folder.

use cinesplat::evaluation::Trajectory;
use cinesplat::export::{PoseTrack, read};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

use crate::support::shared;

/// A path of the trajectory data sets; `None` if they are absent.
pub(super) fn recorded(name: &str) -> Option<Trajectory> {
    let path = shared("data/trajectories")?.join(name);
    Some(Trajectory::from(&read(&path, None).unwrap().track))
}

/// A path of poses at 30 frames per second.
pub(super) fn at_30_fps(poses: &[Pose]) -> Trajectory {
    Trajectory::from_poses(Some((0..poses.len()).map(|idx| idx as f64 / 30.0).collect()), poses)
}

/// A path through points with a constant rotation.
pub(super) fn through(points: impl Iterator<Item = DVec3>, rotation: DQuat) -> Trajectory {
    at_30_fps(&points.map(|point| Pose::new(point, rotation)).collect::<Vec<_>>())
}

/// The poses of a shared file; `None` if it is absent.
pub(super) fn track_of(name: &str) -> Option<PoseTrack> {
    Some(read(&shared(name)?, None).unwrap().track)
}
