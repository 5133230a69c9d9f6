use std::ops::AddAssign;
use std::time::Duration;

/// Wall time of each stage of one picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct StageTimes {
    /// Gaussians to splats, colors included.
    pub project: Duration,
    /// Splats to depth order.
    pub sort: Duration,
    /// Splats to tiles.
    pub bin: Duration,
    /// Tiles to pixels.
    pub blend: Duration,
}

impl StageTimes {
    /// Sum over the stages.
    pub fn total(&self) -> Duration {
        self.project + self.sort + self.bin + self.blend
    }
}

/// Counters of the work for one picture, summed over its bands: a splat that overlaps two bands counts twice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct WorkCounts {
    /// Pictures that were rendered: 1, or the number of sub-frames of an exposure.
    pub num_subframes: u64,
    /// Gaussians that were projected; the others were rejected group by group.
    pub num_projected: u64,
    /// Splats that overlap the picture.
    pub num_splats: u64,
    /// Splat-tile pairs.
    pub num_pairs: u64,
    /// Blended pairs of a splat and a block of 8 x 4 pixels; for [`super::Quality::Reference`], of a splat and a pixel.
    pub num_block_blends: u64,
}

impl AddAssign for WorkCounts {
    fn add_assign(&mut self, other: Self) {
        self.num_subframes += other.num_subframes;
        self.num_projected += other.num_projected;
        self.num_splats += other.num_splats;
        self.num_pairs += other.num_pairs;
        self.num_block_blends += other.num_block_blends;
    }
}

/// Time and work of one picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Wall time of each stage. [`super::Quality::Reference`] reports all time as `blend`.
    pub times: StageTimes,
    /// Counters of the work.
    pub counts: WorkCounts,
}

impl AddAssign for RenderStats {
    fn add_assign(&mut self, other: Self) {
        let StageTimes { project, sort, bin, blend } = other.times;
        self.times.project += project;
        self.times.sort += sort;
        self.times.bin += bin;
        self.times.blend += blend;
        self.counts += other.counts;
    }
}
