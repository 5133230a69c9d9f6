//! Poses, rotations, cameras and the frames they live in.
//!
//! Enters: numbers from files and solvers. Leaves: rigid poses that are always right-handed and orthonormal.
//! Everything is `f64`. World = the scene file's own world, never changed. Camera axes are OpenCV:
//! x right, y down, z forward. A pose is `world_from_camera`. This folder never does IO and, with
//! `export`, is the only place where axes are flipped (see [`frames`]).

mod camera;
mod error;
pub mod frames;
mod level;
mod pose;
pub mod rotation;

pub use camera::{Camera, Intrinsics};
pub use error::GeometryError;
pub use level::{LevelAngles, LevelFrame};
pub use pose::Pose;
