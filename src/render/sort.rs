//! Sorts splats by depth: a parallel radix sort of runs, then a parallel merge. No two keys are equal, so the order
//! does not depend on the number of runs.

use bytemuck::{Pod, Zeroable};

/// Bits of a key per pass. With more bits, a pass writes to more places than the cache has lines.
const DIGIT_BITS: u32 = 9;
const NUM_DIGITS: usize = 1 << DIGIT_BITS;

/// Runs shorter than this are sorted and merged by one thread.
const MIN_PARALLEL_LEN: usize = 4096;

/// Sort key of a splat: its depth, its Gaussian and its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct DepthKey {
    /// Bits of the depth. It is positive, so the bits have the order of the numbers.
    pub(super) depth_bits: u32,
    /// The Gaussian; breaks ties between equal depths.
    pub(super) gaussian_idx: u32,
    /// The splat's place in [`super::splats::Splats`].
    pub(super) place: u32,
}

impl DepthKey {
    /// The key as one number; no two keys are equal.
    pub(super) fn order(self) -> u64 {
        u64::from(self.depth_bits) << 32 | u64::from(self.gaussian_idx)
    }
}

/// Sorts by depth, nearest first, ties by Gaussian. `spare` is a work buffer.
pub(super) fn sort(keys: &mut [DepthKey], spare: &mut Vec<DepthKey>) {
    spare.resize(keys.len(), DepthKey::default());
    let num_levels = rayon::current_num_threads().next_power_of_two().ilog2();
    sort_runs(keys, spare, num_levels, false);
}

/// Sorts `keys`. The result is in `spare` if `into_spare`, else in `keys`.
fn sort_runs(keys: &mut [DepthKey], spare: &mut [DepthKey], num_levels: u32, into_spare: bool) {
    if num_levels == 0 || keys.len() < MIN_PARALLEL_LEN {
        radix_sort(keys, spare);
        if into_spare {
            spare.copy_from_slice(keys);
        }
        return;
    }
    let middle = keys.len() / 2;
    let ((left, right), (spare_left, spare_right)) = (keys.split_at_mut(middle), spare.split_at_mut(middle));
    rayon::join(
        || sort_runs(left, spare_left, num_levels - 1, !into_spare),
        || sort_runs(right, spare_right, num_levels - 1, !into_spare),
    );
    if into_spare {
        merge(&keys[..middle], &keys[middle..], spare, num_levels);
    } else {
        merge(&spare[..middle], &spare[middle..], keys, num_levels);
    }
}

/// Merges two sorted runs on 2^`num_levels` threads.
fn merge(left: &[DepthKey], right: &[DepthKey], to: &mut [DepthKey], num_levels: u32) {
    if num_levels == 0 || to.len() < MIN_PARALLEL_LEN {
        return merge_run(left, right, to);
    }
    let middle = to.len() / 2;
    let from_left = num_from_left(left, right, middle);
    let ((a, c), (b, d)) = (left.split_at(from_left), right.split_at(middle - from_left));
    let (front, back) = to.split_at_mut(middle);
    rayon::join(|| merge(a, b, front, num_levels - 1), || merge(c, d, back, num_levels - 1));
}

/// Number of keys of the left run among the first `len` merged keys.
fn num_from_left(left: &[DepthKey], right: &[DepthKey], len: usize) -> usize {
    let (mut low, mut high) = (len.saturating_sub(right.len()), len.min(left.len()));
    while low < high {
        let middle = usize::midpoint(low, high);
        if left[middle].order() < right[len - middle - 1].order() { low = middle + 1 } else { high = middle }
    }
    low
}

/// Merges two sorted runs.
pub(super) fn merge_run<'a>(mut left: &'a [DepthKey], mut right: &'a [DepthKey], to: &mut [DepthKey]) {
    for to in to {
        let from = match (left.first(), right.first()) {
            (Some(a), Some(b)) if a.order() < b.order() => &mut left,
            (Some(_), None) => &mut left,
            _ => &mut right,
        };
        if let Some((first, rest)) = from.split_first() {
            (*to, *from) = (*first, rest);
        }
    }
}

/// Least-significant-digit radix sort: the digits of the Gaussian, then those of the depth. High bits that are equal in
/// all keys take no pass.
fn radix_sort(keys: &mut [DepthKey], spare: &mut [DepthKey]) {
    let Some(&first) = keys.first() else { return };
    let (depths, gaussians) = keys.iter().fold((0, 0), |(depths, gaussians), key| {
        (depths | (key.depth_bits ^ first.depth_bits), gaussians | (key.gaussian_idx ^ first.gaussian_idx))
    });
    let num_passes = |differing: u32| (u32::BITS - differing.leading_zeros()).div_ceil(DIGIT_BITS);
    let (mut from, mut to) = (&mut *keys, &mut *spare);
    for pass in 0..num_passes(gaussians) {
        scatter(from, to, |key| key.gaussian_idx >> (DIGIT_BITS * pass));
        std::mem::swap(&mut from, &mut to);
    }
    for pass in 0..num_passes(depths) {
        scatter(from, to, |key| key.depth_bits >> (DIGIT_BITS * pass));
        std::mem::swap(&mut from, &mut to);
    }
    if (num_passes(gaussians) + num_passes(depths)) % 2 == 1 {
        keys.copy_from_slice(spare);
    }
}

/// One pass of the radix sort: writes `from` to `to`, stably sorted by one digit.
fn scatter(from: &[DepthKey], to: &mut [DepthKey], digit: impl Fn(&DepthKey) -> u32) {
    let digit = |key: &DepthKey| digit(key) as usize % NUM_DIGITS;
    let mut starts = [0_u32; NUM_DIGITS];
    for key in from {
        starts[digit(key)] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    for key in from {
        let start = &mut starts[digit(key)];
        to[*start as usize] = *key;
        *start += 1;
    }
}
