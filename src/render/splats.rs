use rayon::prelude::*;

use super::groups::{GROUP_LEN, Groups};
use super::memory::bytes_of;
use super::project::Projection;
use super::sort::DepthKey;
use super::splat::Splat;
use cinesplat_scene::Gaussians;

/// Groups whose splats are kept together.
const GROUPS_IN_BATCH: usize = 16;
/// Room for a batch in the numbering of places.
const BATCH_LEN: usize = GROUPS_IN_BATCH * GROUP_LEN;
/// Groups that one thread looks at together.
const GROUPS_LOOKED_AT: usize = 1024;

/// Bytes that a splat takes here.
pub(super) const BYTES_A_SPLAT: usize = size_of::<Splat>() + size_of::<Touch>();

/// Where a splat goes.
#[derive(Debug, Clone, Copy)]
struct Touch {
    /// Tiles that it touches: first and last column, first and last row.
    rect: [u16; 4],
    gaussian_idx: u32,
    depth: f32,
}

/// The splats of one batch of groups.
#[derive(Debug, Default)]
pub(super) struct Batch {
    splats: Vec<Splat>,
    /// What sorting and binning need of each splat, apart from the rest because they go through it in no order.
    touches: Vec<Touch>,
}

/// The splats of a picture, in no order that matters; a splat's place is a number that finds it.
#[derive(Debug, Default)]
pub(super) struct Splats {
    /// Groups that may be seen.
    seen: Vec<u32>,
    batches: Vec<Batch>,
    num_batches: usize,
}

impl Batch {
    /// Adds a splat and the tiles that it touches; see [`Splat::tile_rect`].
    #[inline(always)]
    pub(super) fn push(&mut self, splat: Splat, rect: [u16; 4]) {
        self.splats.push(splat);
        self.touches.push(Touch { rect, gaussian_idx: splat.gaussian_idx, depth: splat.depth });
    }

    /// The splats of some groups in place of those before.
    fn fill(&mut self, seen: &[u32], projection: &Projection, (gaussians, groups): (&Gaussians, &Groups)) {
        self.splats.clear();
        self.touches.clear();
        for &group in seen {
            // No more than that: what doubles in good time is half empty on average.
            self.splats.reserve_exact(GROUP_LEN);
            self.touches.reserve_exact(GROUP_LEN);
            projection.project_group(gaussians, groups.packs_of(group as usize), self);
        }
    }
}

impl Splats {
    /// Finds the groups that may be seen; returns how many Gaussians they hold.
    pub(super) fn look(&mut self, groups: &Groups, projection: &Projection) -> u64 {
        let all = (0..groups.bounds.len() as u32).into_par_iter().with_min_len(GROUPS_LOOKED_AT);
        self.seen.clear();
        self.seen.par_extend(all.filter(|&group| projection.may_see(&groups.bounds[group as usize])));
        self.seen.iter().map(|&group| groups.len_of(group as usize) as u64).sum()
    }

    /// Projects all groups found.
    pub(super) fn fill(&mut self, gaussians: &Gaussians, groups: &Groups, projection: &Projection) {
        self.num_batches = self.seen.len().div_ceil(GROUPS_IN_BATCH);
        if self.batches.len() < self.num_batches {
            self.batches.resize_with(self.num_batches, Batch::default);
        }
        let work = self.batches.par_iter_mut().zip(self.seen.par_chunks(GROUPS_IN_BATCH));
        work.for_each(|(batch, seen)| batch.fill(seen, projection, (gaussians, groups)));
    }

    fn batches(&self) -> &[Batch] {
        &self.batches[..self.num_batches]
    }

    /// Number of splats.
    pub(super) fn len(&self) -> usize {
        self.batches().iter().map(|batch| batch.splats.len()).sum()
    }

    /// Bytes that they hold on to.
    pub(super) fn bytes(&self) -> u64 {
        self.batches.iter().map(|batch| bytes_of(&batch.splats) + bytes_of(&batch.touches)).sum::<u64>()
            + bytes_of(&self.seen)
    }

    /// The splat at a place.
    #[inline(always)]
    pub(super) fn get(&self, place: u32) -> &Splat {
        let place = place as usize;
        &self.batches[place / BATCH_LEN].splats[place % BATCH_LEN]
    }

    /// The tiles that the splat at a place touches.
    #[inline(always)]
    pub(super) fn rect(&self, place: u32) -> [u16; 4] {
        let place = place as usize;
        self.batches[place / BATCH_LEN].touches[place % BATCH_LEN].rect
    }

    /// Writes the depth and place of every splat over `keys`.
    pub(super) fn write_keys(&self, keys: &mut Vec<DepthKey>) {
        keys.resize(self.len(), DepthKey::default());
        let mut left = keys.as_mut_slice();
        let mut work = Vec::with_capacity(self.num_batches);
        for (first, batch) in (0..).step_by(BATCH_LEN).zip(self.batches()) {
            work.push((first, batch, left.split_off_mut(..batch.splats.len()).unwrap_or_default()));
        }
        work.into_par_iter().with_min_len(4).for_each(|(first, batch, keys): (u32, &Batch, &mut [DepthKey])| {
            for ((place, key), touch) in (first..).zip(keys).zip(&batch.touches) {
                *key = DepthKey { depth_bits: touch.depth.to_bits(), gaussian_idx: touch.gaussian_idx, place };
            }
        });
    }
}
