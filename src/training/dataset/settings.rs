//! Settings of a dataset.

use cinesplat_operator::SolveLevel;

/// Settings that decide the shots of a dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct DatasetSettings {
    /// Seed of scenes and prompts.
    pub seed: u64,
    /// Number of scenes.
    pub num_scenes: u64,
    /// Number of prompts that the operator tries in each scene.
    pub shots_per_scene: u64,
    /// Number of Gaussians per scene, relative to a generated scene for films; in
    /// [`SynthSettings::DETAIL_RANGE`](cinesplat_synth::SynthSettings::DETAIL_RANGE).
    pub detail: f64,
    /// Effort of the search for cameras.
    pub solve: SolveLevel,
    /// Number of threads; each makes whole shards.
    pub threads: usize,
}

impl Default for DatasetSettings {
    fn default() -> Self {
        Self { seed: 8, num_scenes: 256, shots_per_scene: 24, detail: 0.05, solve: SolveLevel::Fast, threads: 2 }
    }
}
