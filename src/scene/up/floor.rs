use glam::DVec3;

use super::facets::Facet;
use super::sample::PatchSample;

/// Slabs per scene size. A floor takes two adjacent slabs.
const SLABS: f64 = 80.0;

/// Footprint cells per scene size, and cells per side of the grid that contains every footprint.
const CELLS: f64 = 32.0;
const GRID: usize = 64;
const WORDS: usize = GRID * GRID / 64;

/// Maximum number of patches for a footprint.
const MAX_PATCHES: usize = 10_000;

/// A slab with at least this share of all patches below it is not a floor.
const MAX_SHARE_BELOW: f64 = 0.2;

/// Cosine of the angle to `up` within which a normal counts as level: 20 degrees, wide enough for noisy captures.
const LEVEL_COS: f64 = 0.94;

/// Share of random directions within that angle.
const LEVEL_CHANCE: f64 = 0.06;

/// Values of coverage, mass and levelness at which each counts fully.
const FULL_COVERAGE: f64 = 0.7;
const FULL_MASS: f64 = 0.15;
const FULL_LEVELNESS: f64 = 0.3;

/// Minimum number of patches for reliable shares.
const FULL_PATCHES: f64 = 1000.0;

/// The best floor perpendicular to a direction.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Floor {
    /// Share of the footprint that the floor covers, reduced for patches below it, 0..=1.
    pub(super) coverage: f64,
    /// Share of level normals at the floor beyond chance, 0..=1.
    pub(super) levelness: f64,
    /// Evidence for the floor, 0..=1: the product of coverage, mass and levelness.
    pub(super) evidence: f64,
    /// Height of the floor along the direction, from the center of the scene's core.
    pub(super) height: f64,
    /// Mean height of the patches between the floor (0) and the top (1); 0.5 without patches there.
    pub(super) mean_height: f64,
}

/// Finds the floor perpendicular to the unit direction `up`: the slab that covers most of the scene's footprint and has few
/// patches below it.
pub(super) fn find_floor(sample: &PatchSample, facets: &[Facet], up: DVec3) -> Floor {
    let slabs = Slabs::cut(sample, up);
    let Some((idx, coverage)) = slabs.best() else { return Floor { mean_height: 0.5, ..Floor::default() } };
    let mass = (slabs.counts[idx] + slabs.counts[idx + 1]) / slabs.total();
    let height = slabs.low + (idx as f64 + 1.0) * slabs.thickness;
    let levelness = levelness(sample, facets, up, height, slabs.thickness);
    let evidence = (sample.patches.len() as f64 / FULL_PATCHES).min(1.0)
        * (coverage / FULL_COVERAGE).min(1.0)
        * (mass / FULL_MASS).min(1.0)
        * ((levelness - LEVEL_CHANCE) / FULL_LEVELNESS).clamp(0.0, 1.0);
    let levelness = ((levelness - LEVEL_CHANCE) / (1.0 - LEVEL_CHANCE)).max(0.0);
    Floor { evidence, height, mean_height: slabs.mean_height(idx), coverage, levelness }
}

/// Slabs of a scene perpendicular to a direction.
struct Slabs {
    /// Height of the bottom of the lowest slab.
    low: f64,
    /// Thickness of a slab.
    thickness: f64,
    /// Number of patches per slab.
    counts: Vec<f64>,
    /// Footprint per slab, one bit per cell.
    cells: Vec<[u64; WORDS]>,
}

impl Slabs {
    fn cut(sample: &PatchSample, up: DVec3) -> Self {
        let thickness = sample.size / SLABS;
        let stride = sample.patches.len().div_ceil(MAX_PATCHES).max(1);
        let patches = || sample.patches.iter().step_by(stride);
        let heights = || patches().map(|patch| patch.position.dot(up));
        let low = heights().fold(f64::INFINITY, f64::min);
        let high = heights().fold(f64::NEG_INFINITY, f64::max);
        // The diagonal of the sample is at most 1.2 scene sizes, so there are at most 100 slabs.
        let num = if high >= low { ((high - low) / thickness) as usize + 2 } else { 2 };
        let (mut counts, mut cells) = (vec![0.0; num], vec![[0_u64; WORDS]; num]);
        let east = up.any_orthonormal_vector();
        let north = up.cross(east);
        let cell =
            |along: f64| (along / sample.size * CELLS + GRID as f64 / 2.0).clamp(0.0, GRID as f64 - 1.0) as usize;
        for (patch, height) in patches().zip(heights()) {
            let slab = (((height - low) / thickness) as usize).min(num - 1);
            let bit = cell(patch.position.dot(east)) * GRID + cell(patch.position.dot(north));
            counts[slab] += 1.0;
            cells[slab][bit / 64] |= 1 << (bit % 64);
        }
        Self { low, thickness, counts, cells }
    }

    fn total(&self) -> f64 {
        self.counts.iter().sum::<f64>().max(1.0)
    }

    /// Index of the lower slab of the best floor, and its coverage of the footprint, reduced for patches below it.
    fn best(&self) -> Option<(usize, f64)> {
        let ones = |words: &[u64; WORDS]| f64::from(words.iter().map(|word| word.count_ones()).sum::<u32>());
        let union = |a: &[u64; WORDS], b: &[u64; WORDS]| std::array::from_fn(|idx| a[idx] | b[idx]);
        let footprint = ones(&self.cells.iter().fold([0; WORDS], |all, words| union(&all, words)));
        let mut below = 0.0;
        let mut best: Option<(usize, f64)> = None;
        for (idx, pair) in self.cells.windows(2).enumerate() {
            let coverage = ones(&union(&pair[0], &pair[1])) / footprint.max(1.0);
            let score = coverage * (1.0 - below / self.total() / MAX_SHARE_BELOW);
            if score > best.map_or(0.0, |(_, score)| score) {
                best = Some((idx, score));
            }
            below += self.counts[idx];
        }
        best
    }

    /// Mean height of the patches above the floor and below the topmost slabs, which may hold a ceiling.
    fn mean_height(&self, floor_idx: usize) -> f64 {
        let between = floor_idx + 3..self.counts.len().saturating_sub(4);
        let span = (between.len().max(2) - 1) as f64;
        let num_patches = self.counts.get(between).unwrap_or_default();
        let sum: f64 = num_patches.iter().sum();
        let weighted: f64 = num_patches.iter().enumerate().map(|(idx, count)| count * idx as f64 / span).sum();
        if sum > 0.0 { weighted / sum } else { 0.5 }
    }
}

/// Share of level normals around a height: that of the facets or that of the patches, whichever is larger.
fn levelness(sample: &PatchSample, facets: &[Facet], up: DVec3, height: f64, thickness: f64) -> f64 {
    let share = |pieces: &mut dyn Iterator<Item = (DVec3, DVec3)>| {
        let (mut level, mut all) = (0_usize, 0_usize);
        for (position, normal) in pieces {
            if (position.dot(up) - height).abs() < 1.5 * thickness {
                all += 1;
                level += usize::from(normal.dot(up).abs() > LEVEL_COS);
            }
        }
        if all < 8 { 0.0 } else { level as f64 / all as f64 }
    };
    let by_facets = share(&mut facets.iter().map(|facet| (facet.position, facet.normal)));
    by_facets.max(share(&mut sample.patches.iter().map(|patch| (patch.position, patch.normal))))
}
