//! The depth order of a picture's splats, and what it owes to that of the picture before.
//!
//! While the camera keeps its direction (dollies, trucks, pedestals) every depth changes by the same amount and the
//! order stays what it was, but for what rounding makes equal and for what comes into view. So the splats are put into
//! the old order first; what comes into view is sorted and merged; and insertion repairs the rest. Where that would take
//! more moves than there are splats, they are sorted anew. No two keys are equal: the order is the same either way.

use glam::DVec3;
use rayon::prelude::*;

use super::memory::bytes_of;
use super::sort::{self, DepthKey};
use super::splats::Splats;
use super::{SortMode, View};
use cinesplat_scene::Gaussians;

/// Least cosine between the directions of two pictures of which the second is worth trying in the order of the first;
/// a hundredth of a degree. Farther apart, the repair costs more than the sort.
const MIN_COSINE: f64 = 1.0 - 1.5e-8;

/// No place in the order before.
const NO_RANK: u32 = u32::MAX;

/// Splats in depth order, and memory to find it in. Kept from picture to picture.
#[derive(Debug, Default)]
pub(super) struct DepthOrder {
    keys: Vec<DepthKey>,
    spare: Vec<DepthKey>,
    /// Where each Gaussian stood in the last order; [`NO_RANK`] for those that did not. Empty unless the last two views had
    /// one direction: a camera that turns never asks.
    rank: Vec<u32>,
    /// Direction of the last view; zero where its order says nothing about others.
    forward: DVec3,
    /// Length of the last order.
    last_len: usize,
}

impl DepthOrder {
    /// The splats of a view, nearest first. What is written over them is not asked for again.
    pub(super) fn of(&mut self, splats: &Splats, view: &View, gaussians: &Gaussians) -> &mut [DepthKey] {
        splats.write_keys(&mut self.keys);
        if view.sort == SortMode::Ray {
            self.keys.par_iter_mut().for_each(|key| {
                let mean = gaussians.means[key.gaussian_idx as usize].as_dvec3();
                key.depth_bits = view.sort_distance(mean, 0.0).to_bits();
            });
        }
        // Distances change by amounts of their own when the camera moves.
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

    /// Bytes that the lists hold on to.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.keys) + bytes_of(&self.spare) + bytes_of(&self.rank)
    }

    /// Notes where every Gaussian stands.
    fn store_ranks(&mut self, num_gaussians: usize) {
        self.rank.resize(num_gaussians, NO_RANK);
        for (rank, key) in (0..).zip(&self.keys) {
            if let Some(place) = self.rank.get_mut(key.gaussian_idx as usize) {
                *place = rank;
            }
        }
        self.last_len = self.keys.len();
    }

    /// Puts the keys in order by way of the last one; false, with the keys in some order, where that takes too long.
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

/// Sorts keys that are nearly sorted; false where it takes more moves than there are keys.
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
