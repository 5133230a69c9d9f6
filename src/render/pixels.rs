//! The pixels of a tile during blending, stored by half blocks.
//!
//! The colors and transmittances of a half block are adjacent. Separate planes would be a multiple of 4 KiB apart, and
//! a store to one would delay loads from the others (4K aliasing).

use pulp::Simd;

use super::tiles::{BLOCK_HEIGHT, BLOCK_WIDTH, BLOCKS_ACROSS, NUM_STRIPS};

/// Width of half a block; the left and right half are blended together.
pub(super) const HALF_WIDTH: usize = BLOCK_WIDTH / 2;
/// Pixels of half a block, row-major.
pub(super) const HALF_LEN: usize = HALF_WIDTH * BLOCK_HEIGHT;
/// Half blocks side by side in a tile.
const HALVES_ACROSS: usize = 2 * BLOCKS_ACROSS;
const NUM_HALVES: usize = HALVES_ACROSS * NUM_STRIPS;

/// Blended color and transmittance of half a block. A negative transmittance marks a pixel that has stopped on its own.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
struct HalfBlock {
    red: [f32; HALF_LEN],
    green: [f32; HALF_LEN],
    blue: [f32; HALF_LEN],
    transmittance: [f32; HALF_LEN],
}

impl HalfBlock {
    const CLEAR: Self =
        Self { red: [0.0; HALF_LEN], green: [0.0; HALF_LEN], blue: [0.0; HALF_LEN], transmittance: [1.0; HALF_LEN] };

    /// Color over a background, and transmittance, of one row.
    #[inline(always)]
    fn row(&self, row: usize, background: [f32; 3]) -> ([f32; 3 * HALF_WIDTH], [f32; HALF_WIDTH]) {
        let of = |channel: &[f32; HALF_LEN]| channel.as_chunks::<HALF_WIDTH>().0[row % BLOCK_HEIGHT];
        let rest = of(&self.transmittance).map(f32::abs);
        let channels = [of(&self.red), of(&self.green), of(&self.blue)];
        let mut rgb = [0.0; 3 * HALF_WIDTH];
        for (channel, values) in channels.iter().enumerate() {
            for column in 0..HALF_WIDTH {
                rgb[3 * column + channel] = values[column] + background[channel] * rest[column];
            }
        }
        (rgb, rest)
    }
}

/// Pixels that are blended together, one register per attribute.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixels<S: Simd> {
    pub(super) red: S::f32s,
    pub(super) green: S::f32s,
    pub(super) blue: S::f32s,
    /// Transmittance behind all splats so far; below the stop if the pixel has stopped.
    pub(super) transmittance: S::f32s,
    /// Transmittance behind the splats that the pixel blended; only maintained if each pixel stops on its own.
    pub(super) rest: S::f32s,
    /// Number of the first pixel in the tile.
    pub(super) first: usize,
}

/// The pixels of one tile. A pixel's number is `half block * 16 + row in block * 4 + column in half block`.
#[derive(Debug)]
pub(super) struct TilePixels(Box<[HalfBlock; NUM_HALVES]>);

impl Default for TilePixels {
    #[allow(clippy::large_stack_arrays, reason = "64 KiB, made once per thread and moved to the heap at once")]
    fn default() -> Self {
        Self(Box::new([HalfBlock::CLEAR; NUM_HALVES]))
    }
}

impl TilePixels {
    /// Bytes of the pixels of a tile.
    pub(super) const BYTES: usize = NUM_HALVES * size_of::<HalfBlock>();

    /// Clears all pixels.
    pub(super) fn clear(&mut self) {
        self.0.fill(HalfBlock::CLEAR);
    }

    /// Loads pixels of a half block from `first_lane` on.
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S, half: usize, first_lane: usize) -> Pixels<S> {
        let pixels = &self.0[half % NUM_HALVES];
        Pixels {
            first: half * HALF_LEN + first_lane,
            red: load(simd, &pixels.red, first_lane),
            green: load(simd, &pixels.green, first_lane),
            blue: load(simd, &pixels.blue, first_lane),
            transmittance: load(simd, &pixels.transmittance, first_lane),
            rest: simd.splat_f32s(0.0),
        }
    }

    /// Stores pixels at the place where [`TilePixels::load`] read them.
    #[inline(always)]
    pub(super) fn store<S: Simd>(&mut self, simd: S, pixels: &Pixels<S>) {
        let (half, first_lane) = (pixels.first / HALF_LEN, pixels.first % HALF_LEN);
        let to = &mut self.0[half % NUM_HALVES];
        store(simd, &mut to.red, first_lane, pixels.red);
        store(simd, &mut to.green, first_lane, pixels.green);
        store(simd, &mut to.blue, first_lane, pixels.blue);
        self.store_transmittance(simd, pixels);
    }

    /// As [`TilePixels::store`], the transmittance alone.
    #[inline(always)]
    pub(super) fn store_transmittance<S: Simd>(&mut self, simd: S, pixels: &Pixels<S>) {
        let (half, first_lane) = (pixels.first / HALF_LEN, pixels.first % HALF_LEN);
        store(simd, &mut self.0[half % NUM_HALVES].transmittance, first_lane, pixels.transmittance);
    }

    /// One row of the tile over a background.
    #[inline(always)]
    pub(super) fn row(&self, row: usize, background: [f32; 3]) -> TileRow<'_> {
        let first = row / BLOCK_HEIGHT * HALVES_ACROSS;
        TileRow { halves: &self.0[first..first + HALVES_ACROSS], row, background }
    }
}

/// One row of a tile; written four pixels at a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct TileRow<'a> {
    halves: &'a [HalfBlock],
    row: usize,
    background: [f32; 3],
}

impl TileRow<'_> {
    /// Color and transmittance of four pixels.
    #[inline(always)]
    fn quad(&self, quad: usize) -> ([f32; 3 * HALF_WIDTH], [f32; HALF_WIDTH]) {
        self.halves[quad % HALVES_ACROSS].row(self.row, self.background)
    }

    /// Writes color and transmittance, as many pixels as the slices hold.
    #[inline(always)]
    pub(super) fn write_linear(&self, rgb: &mut [f32], transmittance: &mut [f32]) {
        let (rgb, rgb_end) = rgb.as_chunks_mut();
        let (rest, rest_end) = transmittance.as_chunks_mut();
        for (quad, to) in rgb.iter_mut().zip(rest).enumerate() {
            (*to.0, *to.1) = self.quad(quad);
        }
        if !rest_end.is_empty() {
            let (colors, rests) = self.quad(rgb.len());
            rgb_end.copy_from_slice(&colors[..rgb_end.len()]);
            rest_end.copy_from_slice(&rests[..rest_end.len()]);
        }
    }

    /// Writes color in 8 bits, as many pixels as the slice holds.
    #[inline(always)]
    pub(super) fn write_rgb8(&self, rgb8: &mut [u8]) {
        let (whole, end) = rgb8.as_chunks_mut();
        for (quad, to) in whole.iter_mut().enumerate() {
            *to = self.quad(quad).0.map(super::frame::level);
        }
        if !end.is_empty() {
            let levels = self.quad(whole.len()).0.map(super::frame::level);
            end.copy_from_slice(&levels[..end.len()]);
        }
    }
}

/// One number per pixel of a block: its left half, then its right half, both in the order of [`TilePixels`].
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct BlockValues(pub(super) [[f32; HALF_LEN]; 2]);

impl BlockValues {
    /// All numbers 0.
    pub(super) const ZERO: Self = Self::splat(0.0);

    /// All numbers equal.
    pub(super) const fn splat(value: f32) -> Self {
        Self([[value; HALF_LEN]; 2])
    }

    /// Loads a register per half, from `first_lane` of each half on.
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S, first_lane: usize) -> [S::f32s; 2] {
        [load(simd, &self.0[0], first_lane), load(simd, &self.0[1], first_lane)]
    }

    /// Stores a register per half, from `first_lane` of each half on.
    #[inline(always)]
    pub(super) fn store<S: Simd>(&mut self, simd: S, first_lane: usize, [left, right]: [S::f32s; 2]) {
        store(simd, &mut self.0[0], first_lane, left);
        store(simd, &mut self.0[1], first_lane, right);
    }
}

/// Column and row in the tile of a pixel, from the pixel's number.
pub(super) fn position_in_tile(pixel: usize) -> [usize; 2] {
    let (half, lane) = (pixel / HALF_LEN, pixel % HALF_LEN);
    let column = half % HALVES_ACROSS * HALF_WIDTH + lane % HALF_WIDTH;
    [column, half / HALVES_ACROSS * BLOCK_HEIGHT + lane / HALF_WIDTH]
}

/// Pixel centers of a half block relative to its upper left corner: x, y.
const CENTERS: [[f32; HALF_LEN]; 2] = {
    let mut centers = [[0.0; HALF_LEN]; 2];
    let mut lane = 0;
    while lane < HALF_LEN {
        centers[0][lane] = (lane % HALF_WIDTH) as f32 + 0.5;
        centers[1][lane] = (lane / HALF_WIDTH) as f32 + 0.5;
        lane += 1;
    }
    centers
};

/// Pixel centers of a block relative to its tile: x of the left and of the right half, and y.
#[inline(always)]
pub(super) fn centers<S: Simd>(simd: S, block: usize, first_lane: usize) -> ([S::f32s; 2], S::f32s) {
    let (left, top) = (block % BLOCKS_ACROSS * BLOCK_WIDTH, block / BLOCKS_ACROSS * BLOCK_HEIGHT);
    let (x, y) = (load(simd, &CENTERS[0], first_lane), load(simd, &CENTERS[1], first_lane));
    let x = simd.add_f32s(x, simd.splat_f32s(left as f32));
    ([x, simd.add_f32s(x, simd.splat_f32s(HALF_WIDTH as f32))], simd.add_f32s(y, simd.splat_f32s(top as f32)))
}

/// Loads a register of numbers, starting at `first`.
#[inline(always)]
pub(super) fn load<S: Simd>(_: S, numbers: &[f32; HALF_LEN], first: usize) -> S::f32s {
    S::as_simd_f32s(&numbers[first..first + S::F32_LANES]).0[0]
}

/// Stores a register of numbers, starting at `first`.
#[inline(always)]
pub(super) fn store<S: Simd>(_: S, numbers: &mut [f32; HALF_LEN], first: usize, values: S::f32s) {
    S::as_mut_simd_f32s(&mut numbers[first..first + S::F32_LANES]).0[0] = values;
}
