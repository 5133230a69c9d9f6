//! A shot as data, and the smooth path through its keyframes.
//!
//! Enters: keyframes from the director, the operator or a file. Leaves: the camera at any time. The one invariant: at a
//! key's time the camera is at that key. Never does IO; files are written by `export`.

mod curve;
mod easing;
mod error;
mod leg;
mod path;
mod profile;
mod proof;
mod shot;
mod stray;
mod timing;
mod track;
mod vocabulary;

pub use easing::Easing;
pub use error::TrajectoryError;
pub use path::{CameraPath, CameraState};
pub use proof::{ClearanceFailure, ClearanceProof};
pub use shot::{EffectRequest, Intent, Keyframe, ModelRef, ReportLine, SceneRef, Shot};
pub use stray::{Ball, PathPart};
pub use timing::{retime, retimed};
pub use vocabulary::{Move, ShotAngle, ShotSize};
