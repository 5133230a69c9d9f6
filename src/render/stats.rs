use std::time::Duration;

/// Wall time of the stages of one picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct StageTimes {
    /// Gaussians to splats.
    pub project: Duration,
    /// Splats to depth order, and their colors.
    pub sort: Duration,
    /// Splats to tiles.
    pub bin: Duration,
    /// Tiles to pixels.
    pub blend: Duration,
}

impl StageTimes {
    /// All stages together.
    pub fn total(&self) -> Duration {
        self.project + self.sort + self.bin + self.blend
    }
}

/// Work done for one picture, counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WorkCounts {
    /// Gaussians whose projection was computed; the others were ruled out in groups.
    pub num_projected: u64,
    /// Splats that reach the picture.
    pub num_splats: u64,
    /// Overlaps between splats and tiles.
    pub num_pairs: u64,
    /// Overlaps between splats and 8 x 4 pixel blocks (`reference`: pixels) that were blended.
    pub num_block_blends: u64,
}

/// What a picture cost.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Where the time went.
    pub times: StageTimes,
    /// How much work there was.
    pub counts: WorkCounts,
}
