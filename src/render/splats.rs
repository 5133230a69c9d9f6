use rayon::prelude::*;

use super::View;
use super::groups::{GROUP_LEN, Groups, PACKS_IN_GROUP};
use super::memory::bytes_of;
use super::project::Projection;
use super::sort::DepthKey;
use super::splat::Splat;
use crate::scene::Gaussians;

/// Groups whose splats are kept together.
const GROUPS_IN_BATCH: usize = 16;
/// Room for a batch in the numbering of places.
const BATCH_LEN: usize = GROUPS_IN_BATCH * GROUP_LEN;

/// Bytes that a splat takes here.
pub(super) const BYTES_A_SPLAT: usize = size_of::<Splat>() + size_of::<Touch>();

/// Where a splat goes.
#[derive(Debug, Clone, Copy)]
struct Touch {
    /// Tiles that it touches: first and last column, first and last row.
    rect: [u16; 4],
    /// The Gaussian that it shows.
    gaussian_idx: u32,
    depth: f32,
}

/// The splats of one batch of groups.
#[derive(Debug, Default)]
pub(super) struct Batch {
    splats: Vec<Splat>,
    /// What sorting and binning need of each splat, apart from the rest because they go through it in no order.
    touches: Vec<Touch>,
    num_projected: u64,
}

/// The splats of a picture, in no order that matters; a splat's place is a number that finds it.
#[derive(Debug, Default)]
pub(super) struct Splats {
    batches: Vec<Batch>,
}

impl Batch {
    /// Adds a splat and the tiles that it touches; see [`Splat::tile_rect`].
    #[inline(always)]
    pub(super) fn push(&mut self, splat: Splat, rect: [u16; 4]) {
        self.splats.push(splat);
        self.touches.push(Touch { rect, gaussian_idx: splat.gaussian_idx, depth: splat.depth });
    }
}

impl Splats {
    /// Projects all groups that may be seen; returns the number of Gaussians projected.
    pub(super) fn fill(&mut self, gaussians: &Gaussians, groups: &Groups, view: &View) -> u64 {
        let projection = Projection::new(view);
        self.batches.resize_with(groups.groups.len().div_ceil(GROUPS_IN_BATCH), Batch::default);
        let packs = groups.packs.par_chunks(GROUPS_IN_BATCH * PACKS_IN_GROUP);
        let parts = groups.groups.par_chunks(GROUPS_IN_BATCH).zip(packs);
        self.batches.par_iter_mut().zip(parts).for_each(|(batch, (groups, packs))| {
            batch.splats.clear();
            batch.touches.clear();
            batch.num_projected = 0;
            for (group, packs) in groups.iter().zip(packs.chunks(PACKS_IN_GROUP)) {
                if projection.may_see(group) {
                    projection.project_group(gaussians, packs, batch);
                    batch.num_projected += packs.iter().map(|pack| pack.len as u64).sum::<u64>();
                }
            }
        });
        self.batches.iter().map(|batch| batch.num_projected).sum()
    }

    /// Number of splats.
    pub(super) fn len(&self) -> usize {
        self.batches.iter().map(|batch| batch.splats.len()).sum()
    }

    /// Bytes that they hold on to.
    pub(super) fn bytes(&self) -> u64 {
        self.batches.iter().map(|batch| bytes_of(&batch.splats) + bytes_of(&batch.touches)).sum()
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
        let slots = self.batches.iter().map(|batch| left.split_off_mut(..batch.touches.len()).unwrap_or_default());
        let work: Vec<(u32, &Batch, &mut [DepthKey])> = (0..)
            .step_by(BATCH_LEN)
            .zip(&self.batches)
            .zip(slots)
            .map(|((first, batch), keys)| (first, batch, keys))
            .collect();
        work.into_par_iter().with_min_len(4).for_each(|(first, batch, keys)| {
            for ((place, key), touch) in (first..).zip(keys).zip(&batch.touches) {
                *key = DepthKey { depth_bits: touch.depth.to_bits(), gaussian_idx: touch.gaussian_idx, place };
            }
        });
    }
}
