//! The depth order of a picture's splats, computed from the order of the previous picture where possible.
//!
//! Enters: the splats of a picture. Leaves: their keys, nearest first.
//!
//! While the camera keeps its direction (dolly, truck, pedestal) every depth changes by the same amount. The order then
//! changes only where rounding swaps neighbors, and for splats that come into view. The splats are therefore put into
//! the previous order, insertion sort repairs it, and splats that come into view are sorted and merged in. If the
//! repair would take more moves than there are splats, all are sorted instead. No two keys are equal, so both ways give
//! the same order.

use glam::DVec3;
use rayon::prelude::*;

use super::memory::bytes_of;
use super::sort::{self, DepthKey};
use super::splats::Splats;
use super::{SortMode, View};
use cinesplat_scene::Gaussians;

/// Smallest cosine between the view directions of two pictures at which the order is reused: one hundredth of a degree.
/// Above that angle the repair takes longer than the sort.
const MIN_COSINE: f64 = 1.0 - 1.5e-8;

/// The rank of a Gaussian that was not in the previous order.
const NO_RANK: u32 = u32::MAX;

/// Splats in depth order, and buffers for sorting. Kept from picture to picture.
#[derive(Debug, Default)]
pub(super) struct DepthOrder {
    keys: Vec<DepthKey>,
    spare: Vec<DepthKey>,
    /// Rank of each Gaussian in the previous order, [`NO_RANK`] if absent. Empty unless the last two views had the same
    /// direction: a camera that turns never uses it.
    rank: Vec<u32>,
    /// Direction of the previous view; zero if its order cannot be reused.
    forward: DVec3,
    /// Length of the previous order.
    last_len: usize,
}

impl DepthOrder {
    /// The splats of a view, nearest first. The caller may overwrite the keys.
    pub(super) fn of(&mut self, splats: &Splats, view: &View, gaussians: &Gaussians) -> &mut [DepthKey] {
        splats.write_keys(&mut self.keys);
        if view.sort == SortMode::Ray {
            self.keys.par_iter_mut().for_each(|key| {
                let mean = gaussians.means[key.gaussian_idx as usize].as_dvec3();
                key.depth_bits = view.sort_distance(mean, 0.0).to_bits();
            });
        }
        // In ray mode every distance changes by a different amount when the camera moves.
        let is_reusable = view.reuses_order && view.sort == SortMode::Z;
        let forward = view.camera_from_world.row(2);
        let keeps_direction = is_reusable && forward.dot(self.forward) >= MIN_COSINE;
        if !(keeps_direction && self.rank.len() == gaussians.len() && self.repair()) {
            sort::sort(&mut self.keys, &mut self.spare);
        }
        self.rank.clear();
        if keeps_direction {
            self.store_ranks(gaussians.len());
        }
        self.forward = if is_reusable { forward } else { DVec3::ZERO };
        &mut self.keys
    }

    /// Bytes that the lists have allocated.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.keys) + bytes_of(&self.spare) + bytes_of(&self.rank)
    }

    /// Stores the rank of every Gaussian.
    fn store_ranks(&mut self, num_gaussians: usize) {
        self.rank.resize(num_gaussians, NO_RANK);
        for (rank, key) in (0..).zip(&self.keys) {
            if let Some(place) = self.rank.get_mut(key.gaussian_idx as usize) {
                *place = rank;
            }
        }
        self.last_len = self.keys.len();
    }

    /// Sorts the keys from the previous order. Returns false, with the keys in any order, if that takes too many
    /// moves.
    fn repair(&mut self) -> bool {
        let absent = DepthKey { place: NO_RANK, ..DepthKey::default() };
        self.spare.clear();
        self.spare.resize(self.last_len, absent);
        let mut new = Vec::new();
        for key in &self.keys {
            match self.rank.get(key.gaussian_idx as usize).and_then(|&rank| self.spare.get_mut(rank as usize)) {
                Some(slot) => *slot = *key,
                None => new.push(*key),
            }
        }
        self.spare.retain(|key| key.place != NO_RANK);
        let is_sorted = insertion_sort(&mut self.spare);
        if new.is_empty() {
            std::mem::swap(&mut self.keys, &mut self.spare);
        } else {
            sort::sort(&mut new, &mut Vec::new());
            sort::merge_run(&self.spare, &new, &mut self.keys);
        }
        is_sorted
    }
}

/// Sorts nearly sorted keys. Returns false if that takes more moves than there are keys.
fn insertion_sort(keys: &mut [DepthKey]) -> bool {
    let mut num_moves = 0;
    for idx in 1..keys.len() {
        let mut place = idx;
        while place > 0 && keys[place].order() < keys[place - 1].order() {
            keys.swap(place, place - 1);
            place -= 1;
        }
        num_moves += idx - place;
        if num_moves > keys.len() {
            return false;
        }
    }
    true
}
