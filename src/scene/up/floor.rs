use glam::DVec3;

use super::facets::Facet;
use super::sample::Sample;

/// Slabs across the scene size; a floor is looked for in two neighbors together.
const SLABS: f64 = 80.0;

/// Footprint cells across the scene size, and cells of the grid that holds any footprint.
const CELLS: f64 = 32.0;
const GRID: usize = 64;
const WORDS: usize = GRID * GRID / 64;

/// Patches looked at for a footprint.
const MAX_PATCHES: usize = 10_000;

/// Share of matter below a slab from which it is no floor.
const MOST_BELOW: f64 = 0.2;

/// Cosine of the angle between a piece of floor and the floor: 20 degrees, wide enough for rough captures.
const FLUSH_COS: f64 = 0.94;

/// Share of directions within that angle by chance.
const FLUSH_CHANCE: f64 = 0.06;

/// Values at which coverage, mass and flushness count in full. Of the scenes with a known floor the weakest (a furnished
/// kitchen, cluttered to the walls) has 0.53, 0.20 and 0.31; the strongest wall (of a living room) has 0.48, 0.25, 0.93.
const FULL_COVERAGE: f64 = 0.7;
const FULL_MASS: f64 = 0.15;
const FULL_FLUSH: f64 = 0.3;

/// Patches from which shares of them are believed in full.
const FULL_PATCHES: f64 = 1000.0;

/// What a direction looks like as world up: the best floor across it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Floor {
    /// 0..=1: how much there is a floor. The product of what it covers, holds and how level its pieces are.
    pub(super) evidence: f64,
    /// Height of the floor's middle along the direction, from the middle of the scene.
    pub(super) height: f64,
    /// Mean height of the matter between floor and top, 0..=1; 0.5 where there is none.
    pub(super) mean_height: f64,
}

/// Looks for the floor across the unit direction `up`: the slab that covers most of the scene's footprint with little
/// matter below it.
pub(super) fn look(sample: &Sample, facets: &[Facet], up: DVec3) -> Floor {
    let slabs = Slabs::cut(sample, up);
    let Some((idx, coverage)) = slabs.best() else { return Floor { mean_height: 0.5, ..Floor::default() } };
    let mass = (slabs.counts[idx] + slabs.counts[idx + 1]) / slabs.total();
    let height = slabs.low + (idx as f64 + 1.0) * slabs.thickness;
    let flush = flushness(sample, facets, up, height, slabs.thickness);
    let evidence = (sample.patches.len() as f64 / FULL_PATCHES).min(1.0)
        * (coverage / FULL_COVERAGE).min(1.0)
        * (mass / FULL_MASS).min(1.0)
        * ((flush - FLUSH_CHANCE) / FULL_FLUSH).clamp(0.0, 1.0);
    Floor { evidence, height, mean_height: slabs.mean_height(idx) }
}

/// A scene cut into slabs across a direction.
struct Slabs {
    /// Height of the lowest slab's bottom.
    low: f64,
    /// Thickness of a slab.
    thickness: f64,
    /// Patches in each slab.
    counts: Vec<f64>,
    /// Footprint of each slab, one bit a cell.
    cells: Vec<[u64; WORDS]>,
}

impl Slabs {
    fn cut(sample: &Sample, up: DVec3) -> Self {
        let thickness = sample.size / SLABS;
        let stride = sample.patches.len().div_ceil(MAX_PATCHES).max(1);
        let patches = || sample.patches.iter().step_by(stride);
        let heights = || patches().map(|patch| patch.position.dot(up));
        let low = heights().fold(f64::INFINITY, f64::min);
        let high = heights().fold(f64::NEG_INFINITY, f64::max);
        // The sample's box has a diagonal of at most 1.2 scene sizes: never more than 100 slabs.
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

    /// Lower index of the pair of slabs that is the best floor, and its share of the footprint less what matter below it
    /// takes from it.
    fn best(&self) -> Option<(usize, f64)> {
        let ones = |words: &[u64; WORDS]| f64::from(words.iter().map(|word| word.count_ones()).sum::<u32>());
        let union = |a: &[u64; WORDS], b: &[u64; WORDS]| std::array::from_fn(|idx| a[idx] | b[idx]);
        let footprint = ones(&self.cells.iter().fold([0; WORDS], |all, words| union(&all, words)));
        let mut below = 0.0;
        let mut best: Option<(usize, f64)> = None;
        for (idx, pair) in self.cells.windows(2).enumerate() {
            let coverage = ones(&union(&pair[0], &pair[1])) / footprint.max(1.0);
            let merit = coverage * (1.0 - below / self.total() / MOST_BELOW);
            if merit > best.map_or(0.0, |(_, merit)| merit) {
                best = Some((idx, merit));
            }
            below += self.counts[idx];
        }
        best
    }

    /// Mean height of the matter off the floor and off the topmost slabs, where a ceiling may be.
    fn mean_height(&self, floor_idx: usize) -> f64 {
        let between = floor_idx + 3..self.counts.len().saturating_sub(4);
        let span = (between.len().max(2) - 1) as f64;
        let matter = self.counts.get(between).unwrap_or_default();
        let sum: f64 = matter.iter().sum();
        let weighted: f64 = matter.iter().enumerate().map(|(idx, count)| count * idx as f64 / span).sum();
        if sum > 0.0 { weighted / sum } else { 0.5 }
    }
}

/// Share of the matter about a height that lies level: by facets where there are enough of them, or by the Gaussians' own
/// normals, whichever says more.
fn flushness(sample: &Sample, facets: &[Facet], up: DVec3, height: f64, thickness: f64) -> f64 {
    let share = |pieces: &mut dyn Iterator<Item = (DVec3, DVec3)>| {
        let (mut level, mut all) = (0_usize, 0_usize);
        for (position, normal) in pieces {
            if (position.dot(up) - height).abs() < 1.5 * thickness {
                all += 1;
                level += usize::from(normal.dot(up).abs() > FLUSH_COS);
            }
        }
        if all < 8 { 0.0 } else { level as f64 / all as f64 }
    };
    let by_facets = share(&mut facets.iter().map(|facet| (facet.position, facet.normal)));
    by_facets.max(share(&mut sample.patches.iter().map(|patch| (patch.position, patch.normal))))
}
