//! The lines of a shard, as JSON.

use serde::{Deserialize, Serialize};

use super::settings::DatasetSettings;

/// `format` of the header.
pub(super) const FORMAT: &str = "cinesplat.shots";
/// `version` of the header.
pub(super) const VERSION: u32 = 1;

/// First line of a shard: the settings that decide its content. Older shards store only the seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Header {
    pub(super) format: String,
    pub(super) version: u32,
    /// Seed of the whole dataset.
    pub(super) seed: u64,
    /// Number of scenes in this shard.
    #[serde(default)]
    pub(super) num_scenes: Option<u64>,
    #[serde(default)]
    pub(super) shots_per_scene: Option<u64>,
    #[serde(default)]
    pub(super) detail: Option<f64>,
    #[serde(default)]
    pub(super) solve: Option<String>,
}

impl Header {
    /// The header of a shard of `num_scenes` scenes.
    pub(super) fn new(settings: &DatasetSettings, num_scenes: u64) -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            seed: settings.seed,
            num_scenes: Some(num_scenes),
            shots_per_scene: Some(settings.shots_per_scene),
            detail: Some(settings.detail),
            solve: Some(settings.solve.to_string()),
        }
    }

    /// The first setting that differs from `expected`: its name with both values. Settings that are not stored agree.
    pub(super) fn difference(&self, expected: &Self) -> Option<[String; 2]> {
        self.settings().into_iter().zip(expected.settings()).find_map(|((name, found), (_, expected))| {
            let (found, expected) = (found?, expected?);
            (found != expected).then(|| [found, expected].map(|value| format!("{name} {value}")))
        })
    }

    fn settings(&self) -> [(&'static str, Option<String>); 5] {
        [
            ("seed", Some(self.seed.to_string())),
            ("number of scenes", self.num_scenes.map(|value| value.to_string())),
            ("shots per scene", self.shots_per_scene.map(|value| value.to_string())),
            ("detail", self.detail.map(|value| value.to_string())),
            ("search effort", self.solve.clone()),
        ]
    }
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
