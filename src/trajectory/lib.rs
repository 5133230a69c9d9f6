//! A shot as data, and the smooth path through its keyframes.
//!
//! Enters: keyframes from the director, the operator or a file. Leaves: the camera at any time. The one invariant: at a
//! key's time the camera is at that key. This crate does no IO; `export` writes files.

mod blend;
mod bounds;
mod camera_state;
mod clearance;
mod curve;
mod easing;
mod error;
mod leg;
mod lens_model;
mod pace;
mod path;
mod profile;
mod segments;
mod shot;
mod timing;
mod track;
mod vocabulary;

pub use bounds::{BoundingBall, PathInterval};
pub use camera_state::CameraState;
pub use clearance::{ClearanceFailure, ClearanceProof};
pub use easing::Easing;
pub use error::TrajectoryError;
pub use lens_model::{LENS_EFFECT, LensModel, LensProjection};
pub use path::CameraPath;
pub use profile::ramp_secs;
pub use shot::{
    EffectRequest, EffectRuns, Intent, KeyOptics, Keyframe, LookAt, MAX_FRAMES, MAX_KEYFRAMES, ModelRef, ReportLine,
    SceneRef, Shot,
};
pub use timing::{retime, retimed};
pub use vocabulary::{Move, ShotAngle, ShotSize};
