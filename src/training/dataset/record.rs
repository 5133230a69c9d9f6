//! The lines of a shard, as JSON.

use serde::{Deserialize, Serialize};

/// `format` of the header.
pub(super) const FORMAT: &str = "cinesplat.shots";
/// `version` of the header.
pub(super) const VERSION: u32 = 1;

/// First line of a shard.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Header {
    pub(super) format: String,
    pub(super) version: u32,
    /// Seed of the whole dataset.
    pub(super) seed: u64,
}

/// A scene with its shots.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct SceneRecord {
    /// Seed of the scene.
    pub(super) seed: u64,
    pub(super) up: [f64; 3],
    pub(super) center: [f64; 3],
    pub(super) size: f64,
    pub(super) objects: Vec<ObjectRecord>,
    pub(super) shots: Vec<ShotRecord>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ObjectRecord {
    pub(super) id: u32,
    pub(super) label: String,
    pub(super) center: [f32; 3],
    pub(super) half_extents: [f32; 3],
    pub(super) rotation_xyzw: [f32; 4],
    pub(super) points: Vec<[f32; 3]>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ShotRecord {
    pub(super) prompt: String,
    /// In the notation of `language`.
    pub(super) program: String,
    /// Byte range of the prompt per step.
    pub(super) words: Vec<Option<[usize; 2]>>,
    /// One per key of the program.
    pub(super) cameras: Vec<CameraRecord>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct CameraRecord {
    pub(super) position: [f32; 3],
    pub(super) rotation_xyzw: [f32; 4],
    pub(super) fov_y_rad: f32,
    pub(super) time_secs: f32,
}
