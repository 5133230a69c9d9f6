use rayon::prelude::*;

use super::batch::Batch;
use super::groups::{GROUP_LEN, Groups};
use super::memory::bytes_of;
use super::project::Projection;
use super::sort::DepthKey;
use super::splat::Splat;
use cinesplat_scene::Gaussians;

/// Groups per batch of splats.
const GROUPS_PER_BATCH: usize = 16;
/// Places per batch; a batch has at most as many splats.
const BATCH_LEN: usize = GROUPS_PER_BATCH * GROUP_LEN;
/// Groups that one job tests for visibility.
const GROUPS_PER_JOB: usize = 1024;

/// The splats of a picture, in no defined order. A splat's place is its index: `batch * BATCH_LEN + position in the
/// batch`.
#[derive(Debug, Default)]
pub(super) struct Splats {
    /// Indices of the groups that may be visible.
    visible_groups: Vec<u32>,
    batches: Vec<Batch>,
    num_batches: usize,
}

/// Projects groups into a batch; replaces its splats.
fn fill_batch(batch: &mut Batch, visible: &[u32], projection: &Projection, (gaussians, groups): (&Gaussians, &Groups)) {
    batch.splats.clear();
    batch.hot_fields.clear();
    for &group in visible {
        // Exactly one group more: a vector that doubles is half empty on average.
        batch.splats.reserve_exact(GROUP_LEN);
        batch.hot_fields.reserve_exact(GROUP_LEN);
        projection.project_group(gaussians, groups.packs_of(group as usize), batch);
    }
}

impl Splats {
    /// Finds the groups that may be visible; returns the number of their Gaussians.
    pub(super) fn find_visible_groups(&mut self, groups: &Groups, projection: &Projection) -> u64 {
        let all = (0..groups.bounds.len() as u32).into_par_iter().with_min_len(GROUPS_PER_JOB);
        self.visible_groups.clear();
        self.visible_groups.par_extend(all.filter(|&group| projection.may_be_visible(&groups.bounds[group as usize])));
        self.visible_groups.iter().map(|&group| groups.len_of(group as usize) as u64).sum()
    }

    /// Projects the groups that may be visible.
    pub(super) fn fill(&mut self, gaussians: &Gaussians, groups: &Groups, projection: &Projection) {
        self.num_batches = self.visible_groups.len().div_ceil(GROUPS_PER_BATCH);
        if self.batches.len() < self.num_batches {
            self.batches.resize_with(self.num_batches, Batch::default);
        }
        let work = self.batches.par_iter_mut().zip(self.visible_groups.par_chunks(GROUPS_PER_BATCH));
        work.for_each(|(batch, visible)| fill_batch(batch, visible, projection, (gaussians, groups)));
    }

    fn batches(&self) -> &[Batch] {
        &self.batches[..self.num_batches]
    }

    /// Number of splats.
    pub(super) fn len(&self) -> usize {
        self.batches().iter().map(|batch| batch.splats.len()).sum()
    }

    /// Bytes that the lists have allocated.
    pub(super) fn bytes(&self) -> u64 {
        self.batches.iter().map(|batch| bytes_of(&batch.splats) + bytes_of(&batch.hot_fields)).sum::<u64>()
            + bytes_of(&self.visible_groups)
    }

    /// The splat at a place.
    #[inline(always)]
    pub(super) fn get(&self, place: u32) -> &Splat {
        let place = place as usize;
        &self.batches[place / BATCH_LEN].splats[place % BATCH_LEN]
    }

    /// The tiles that the splat at a place overlaps: first and last column, first and last row.
    #[inline(always)]
    pub(super) fn rect(&self, place: u32) -> [u16; 4] {
        let place = place as usize;
        self.batches[place / BATCH_LEN].hot_fields[place % BATCH_LEN].rect
    }

    /// Overwrites `keys` with the depth and place of every splat.
    pub(super) fn write_keys(&self, keys: &mut Vec<DepthKey>) {
        keys.resize(self.len(), DepthKey::default());
        let mut left = keys.as_mut_slice();
        let mut work = Vec::with_capacity(self.num_batches);
        for (first, batch) in (0..).step_by(BATCH_LEN).zip(self.batches()) {
            work.push((first, batch, left.split_off_mut(..batch.splats.len()).unwrap_or_default()));
        }
        work.into_par_iter().with_min_len(4).for_each(|(first, batch, keys): (u32, &Batch, &mut [DepthKey])| {
            for ((place, key), hot) in (first..).zip(keys).zip(&batch.hot_fields) {
                *key = DepthKey { depth_bits: hot.depth.to_bits(), gaussian_idx: hot.gaussian_idx, place };
            }
        });
    }
}
