//! Finds the blocks of 8 x 4 pixels of a tile that each splat covers.
//!
//! Enters: up to 256 splats. Leaves: for each block the list of splats that cover it, in order. Computed for 16 splats
//! at a time. The invariant: no covered block is missed; extra blocks are allowed.

use super::record::RECORDS_LEN;
use super::splat::Splat;
use super::tiles::{BLOCK_HEIGHT, BLOCK_WIDTH, BLOCKS_ACROSS, NUM_BLOCKS, NUM_STRIPS, StripMasks};

const BLOCKS_PER_PX: f32 = 1.0 / BLOCK_WIDTH as f32;

/// Slack in pixels for rounding errors. An extra block costs a little time, a missed block gives wrong pixels.
const SLACK_PX: f32 = 0.02;

/// Splats per SIMD loop: the width of the widest registers.
const LANES: usize = 16;

/// Groups of eight splats in a chunk.
const NUM_OCTETS: usize = RECORDS_LEN / 8;

/// One value for each of [`LANES`] splats.
type Lane = [f32; LANES];

/// The regions of 16 splats above the alpha cut, relative to the corner of a tile, one array per attribute. Horizontal
/// values are in blocks, vertical ones in pixels.
#[derive(Debug, Clone, Copy, Default)]
struct Regions {
    /// Vertical position of the center.
    y: Lane,
    /// Horizontal position of the center, shifted so that `left` minus half the width rounds to the first block.
    left: Lane,
    /// Horizontal position of the center, shifted so that `right` plus half the width rounds to one past the last
    /// block.
    right: Lane,
    /// The middle of a row moves right by `shift` per pixel down; half its width is `width` times the root in
    /// [`covered_blocks`].
    shift: Lane,
    width: Lane,
    /// See [`Splat`].
    vy: Lane,
    reach: Lane,
    half_y: Lane,
    skew: Lane,
}

/// For every block of a tile, the splats that cover it.
#[derive(Debug)]
pub(super) struct Coverage {
    regions: Box<[Regions; RECORDS_LEN / LANES]>,
    /// `[block][position / 8]`, bit `position % 8`.
    masks: Box<[[u8; NUM_OCTETS]; NUM_BLOCKS]>,
}

impl Default for Coverage {
    fn default() -> Self {
        Self {
            regions: Box::new([Regions::default(); RECORDS_LEN / LANES]),
            masks: Box::new([[0; NUM_OCTETS]; NUM_BLOCKS]),
        }
    }
}

impl Coverage {
    /// Bytes that it takes.
    pub(super) const BYTES: usize = (RECORDS_LEN / LANES) * size_of::<Regions>() + NUM_BLOCKS * NUM_OCTETS;

    /// Sets the region of the splat at a position.
    #[inline(always)]
    pub(super) fn set_splat(&mut self, position: usize, splat: &Splat, corner_px: [f32; 2]) {
        let to = &mut self.regions[position / LANES % (RECORDS_LEN / LANES)];
        let lane = position % LANES;
        let [ux, uy, vy] = splat.whiten;
        (to.left[lane], to.y[lane]) = (splat.mean_px[0] - corner_px[0], splat.mean_px[1] - corner_px[1]);
        (to.shift[lane], to.width[lane]) = (uy, ux);
        (to.vy[lane], to.reach[lane]) = (vy, splat.reach);
        (to.half_y[lane], to.skew[lane]) = (splat.half_px[1] + SLACK_PX, splat.skew_px);
    }

    /// Computes which blocks the first `num_splats` splats cover, in strips that are not entirely done.
    #[inline(always)]
    pub(super) fn compute(&mut self, num_splats: usize, done: &StripMasks) {
        let num_groups = num_splats.div_ceil(LANES).min(RECORDS_LEN / LANES);
        if let Some(last) = self.regions[..num_groups].last_mut() {
            // The lanes after the last splat cover no block.
            let behind = (num_splats + LANES - 1) % LANES + 1;
            last.half_y[behind..].fill(f32::NEG_INFINITY);
        }
        for group in &mut self.regions[..num_groups] {
            for lane in 0..LANES {
                let (width, x) = (1.0 / group.width[lane], group.left[lane] * BLOCKS_PER_PX);
                (group.shift[lane], group.width[lane]) =
                    (-group.shift[lane] * width * BLOCKS_PER_PX, width * BLOCKS_PER_PX);
                // Pixel i has its center at i + 0.5. The first block with a center at or after `left` is ceil((left -
                // 7.5) / 8); the first block with no center up to `right` is ceil((right - 0.5) / 8). Adding 0.5 turns
                // ceil into rounding to nearest.
                group.left[lane] = x - (BLOCK_WIDTH as f32 - 0.5 + SLACK_PX) * BLOCKS_PER_PX + 0.5;
                group.right[lane] = x - (0.5 - SLACK_PX) * BLOCKS_PER_PX + 0.5;
            }
        }
        for (strip, blocks) in self.masks.as_chunks_mut::<BLOCKS_ACROSS>().0.iter_mut().enumerate() {
            if done[strip % NUM_STRIPS] == u8::MAX {
                continue;
            }
            let mut masks = [[0_u8; LANES]; RECORDS_LEN / LANES];
            for (masks, group) in masks.iter_mut().zip(&self.regions[..num_groups]) {
                *masks = covered_blocks(group, strip);
            }
            by_block(&masks, blocks);
        }
    }

    /// Writes the positions of the splats that cover a block to the start of `list`, in order; returns their number.
    #[inline(always)]
    pub(super) fn list(&self, block: usize, list: &mut PositionList) -> usize {
        let masks = &self.masks[block % NUM_BLOCKS];
        if masks.as_chunks::<8>().0.iter().all(|word| *word == [0; 8]) {
            return 0;
        }
        // Branch-free: writes eight positions per byte; the next write overwrites the excess.
        let (mut len, mut first) = (0, 0_u64);
        for word in masks.as_chunks::<8>().0 {
            for mask in word {
                let positions = (SET_BITS[usize::from(*mask)] | first).to_le_bytes();
                // `len` is always below LIST_LEN; the remainder removes the bounds check.
                let place = len % LIST_LEN;
                list.0[place..place + 8].copy_from_slice(&positions);
                // The positions of the last byte are not used after it, and may wrap around.
                (len, first) = (len + mask.count_ones() as usize, first.wrapping_add(0x0808_0808_0808_0808));
            }
        }
        len
    }
}

/// Capacity for all positions, a power of two.
const LIST_LEN: usize = (RECORDS_LEN + 1).next_power_of_two();

/// Positions of splats, with room at the end for the excess that [`Coverage::list`] writes.
#[derive(Debug)]
pub(super) struct PositionList(pub(super) [u8; LIST_LEN + 8]);

impl Default for PositionList {
    fn default() -> Self {
        Self([0; LIST_LEN + 8])
    }
}

/// For every byte the positions of its set bits, lowest first, one byte per position.
const SET_BITS: [u64; 256] = set_bits();

const fn set_bits() -> [u64; 256] {
    let mut positions = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut left, mut shift) = (byte, 0);
        while left != 0 {
            positions[byte] |= (left.trailing_zeros() as u64) << shift;
            left &= left - 1;
            shift += 8;
        }
        byte += 1;
    }
    positions
}

/// For each splat, the blocks of one strip with a pixel center in the region above the alpha cut, possibly a few more.
///
/// At dy below the center the region extends from `shift dy - w` to `shift dy + w`, w = sqrt(reach - (vy dy)^2) / ux.
/// The rightmost point is `skew` below the center, the leftmost point `skew` above it, and both ends are monotone on
/// either side of these points. Within a strip the extreme is therefore at the dy nearest to that point.
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch, which prevents vectorization")]
#[inline(always)]
fn covered_blocks(of: &Regions, strip: usize) -> [u8; LANES] {
    let mut masks = [0; LANES];
    for (lane, mask) in masks.iter_mut().enumerate() {
        let top = (strip * BLOCK_HEIGHT) as f32 + 0.5 - of.y[lane];
        let bottom = top + (BLOCK_HEIGHT - 1) as f32;
        let (dy_right, dy_left) = (of.skew[lane].max(top).min(bottom), (-of.skew[lane]).max(top).min(bottom));
        let (v_right, v_left) = (of.vy[lane] * dy_right, of.vy[lane] * dy_left);
        let half_width = |v: f32| root(of.reach[lane] - v * v) * of.width[lane];
        let first = of.left[lane] + of.shift[lane] * dy_left - half_width(v_left);
        let end = of.right[lane] + of.shift[lane] * dy_right + half_width(v_right);
        let is_covered = (top <= of.half_y[lane]) & (bottom >= -of.half_y[lane]);
        let bits = (0xff_u32 << nearest(first)) & !(0xff_u32 << nearest(end));
        *mask = if is_covered { bits as u8 } else { 0 };
    }
    masks
}

/// The square root or up to 0.4 % more; 0 for numbers that are not above 0. A bit-level estimate of the inverse root
/// and one Newton step take a third of the time of the exact root.
#[inline(always)]
fn root(number: f32) -> f32 {
    let number = number.max(0.0);
    let guess = f32::from_bits(0x5f37_59df - (number.to_bits() >> 1));
    // A Newton step (1.5, 0.5) ends at most 0.18 % below the inverse root and never above it; the factor 1.002 lifts it
    // above the root.
    guess * (1.503 - 0.501 * number * guess * guess) * number
}

/// The integer nearest to a number, clamped to 0..=8. The addition moves it into the lowest bits of the mantissa; a
/// cast does not vectorize.
#[inline(always)]
fn nearest(number: f32) -> u32 {
    const SHIFT: f32 = 8_388_608.0;
    (number.max(0.0).min(BLOCKS_ACROSS as f32) + SHIFT).to_bits() & 31
}

/// Transposes the bit matrix of a strip: from the blocks of each splat to the splats of each block.
#[inline(always)]
fn by_block(masks: &[[u8; LANES]; RECORDS_LEN / LANES], blocks: &mut [[u8; NUM_OCTETS]; BLOCKS_ACROSS]) {
    let mut words = [0_u64; NUM_OCTETS];
    for (word, splats) in words.iter_mut().zip(masks.as_flattened().as_chunks::<8>().0) {
        *word = transposed(u64::from_le_bytes(*splats));
    }
    for (column, block) in blocks.iter_mut().enumerate() {
        for (mask, word) in block.iter_mut().zip(&words) {
            *mask = (word >> (8 * column)) as u8;
        }
    }
}

/// Transpose of 8 x 8 bits, one byte per row: swaps single bits, then pairs, then fours (Warren, Hacker's Delight,
/// 7-3).
#[inline(always)]
fn transposed(mut bits: u64) -> u64 {
    for (shift, mask) in [(7, 0x00aa_00aa_00aa_00aa), (14, 0x0000_cccc_0000_cccc), (28, 0x0000_0000_f0f0_f0f0)] {
        let swap = (bits ^ (bits >> shift)) & mask;
        bits ^= swap ^ (swap << shift);
    }
    bits
}
