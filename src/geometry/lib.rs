//! Poses, rotations, cameras and frames of reference.
//!
//! Enters: numbers from files and solvers. Leaves: rigid poses. The one invariant: a pose is right-handed and
//! orthonormal. All numbers are `f64`. The world is that of the scene file and is never changed. Camera axes are
//! OpenCV: x right, y down, z forward. A pose is `world_from_camera`. This crate does no IO. Only [`frames`] and the
//! crate `export` flip the signs of axes.

mod camera;
mod error;
pub mod frames;
mod level;
mod pose;
pub mod rotation;
mod sphere;

pub use camera::{Camera, Intrinsics};
pub use error::GeometryError;
pub use level::{LevelAngles, LevelFrame};
pub use pose::Pose;
pub use sphere::sphere_directions;
