//! Tiles to pixels: front to back, a tile at a time, each 8 x 4 block with its own list of splats.
//!
//! Enters: the places of a tile's splats, nearest first. Leaves: its pixels. Splats are taken a few hundred at a time:
//! first every splat is entered into the lists of the blocks it touches, then every block that is not yet opaque
//! blends its list with all its pixels in registers. A block that has become opaque takes no more splats.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::bin::TILE_PX;
use super::kernel::{Blender, Constants, Cutoffs, Pixels, RECORDS_LEN, Record};
use super::payload::Sink;
use super::spans::{BLOCK_HEIGHT, BLOCK_WIDTH, BLOCKS_ACROSS, NUM_STRIPS, StripMasks, touched_blocks};
use super::splat::EXPONENT_DIVISOR;
use super::splats::Splats;
use super::{View, splat::Splat};

const NUM_BLOCKS: usize = BLOCKS_ACROSS * NUM_STRIPS;
const BLOCK_LEN: usize = BLOCK_WIDTH * BLOCK_HEIGHT;
/// A block's left and right half are blended side by side.
const HALF_WIDTH: usize = BLOCK_WIDTH / 2;
const HALF_LEN: usize = BLOCK_LEN / 2;
pub(super) const TILE_LEN: usize = TILE_PX * TILE_PX;

/// Pixels of a tile in an order of their own, half block after half block: `[half block * 16 + row in block * 4 + column in half block]`.
type Plane = [f32; TILE_LEN];

/// What has been blended of a tile: color, and transmittance, which is negative where blending has stopped.
#[derive(Debug)]
struct Planes {
    red: Plane,
    green: Plane,
    blue: Plane,
    transmittance: Plane,
}

impl Planes {
    /// Nothing blended.
    fn clear(&mut self) {
        for plane in [&mut self.red, &mut self.green, &mut self.blue] {
            plane.fill(0.0);
        }
        self.transmittance.fill(1.0);
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, at: Range<usize>) -> Pixels<S> {
        Pixels {
            first: at.start,
            red: load(simd, &self.red[at.clone()]),
            green: load(simd, &self.green[at.clone()]),
            blue: load(simd, &self.blue[at.clone()]),
            transmittance: load(simd, &self.transmittance[at]),
        }
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, simd: S, at: Range<usize>, pixels: &Pixels<S>) {
        store(simd, &mut self.red[at.clone()], pixels.red);
        store(simd, &mut self.green[at.clone()], pixels.green);
        store(simd, &mut self.blue[at.clone()], pixels.blue);
        store(simd, &mut self.transmittance[at], pixels.transmittance);
    }

    /// Color over a background and transmittance of four pixels side by side, from this place of the planes on.
    #[inline(always)]
    fn quad(&self, at: usize, background: [f32; 3]) -> ([f32; 3 * HALF_WIDTH], [f32; HALF_WIDTH]) {
        let (mut rgb, mut rests) = ([0.0; 3 * HALF_WIDTH], [0.0; HALF_WIDTH]);
        for column in 0..HALF_WIDTH {
            let rest = self.transmittance[at + column].abs();
            rgb[3 * column] = self.red[at + column] + background[0] * rest;
            rgb[3 * column + 1] = self.green[at + column] + background[1] * rest;
            rgb[3 * column + 2] = self.blue[at + column] + background[2] * rest;
            rests[column] = rest;
        }
        (rgb, rests)
    }
}

/// The memory that one tile at a time needs; used for one tile after another.
#[derive(Debug)]
pub(super) struct Workspace {
    splats: Box<[Splat; RECORDS_LEN]>,
    records: Box<[Record; RECORDS_LEN]>,
    touched: Box<[StripMasks; RECORDS_LEN]>,
    /// Records of each block.
    lists: Box<[[u16; RECORDS_LEN]; NUM_BLOCKS]>,
    list_lens: [u16; NUM_BLOCKS],
    /// Blocks that take no more splats.
    done: StripMasks,
    planes: Box<Planes>,
    num_block_blends: u64,
}

impl Default for Workspace {
    #[allow(
        clippy::large_stack_arrays,
        reason = "made once a thread, 64 KiB the largest, and moved to the heap at once"
    )]
    fn default() -> Self {
        let plane = [0.0; TILE_LEN];
        Self {
            splats: Box::new([Splat::default(); RECORDS_LEN]),
            records: Box::new([Record::default(); RECORDS_LEN]),
            touched: Box::new([[0; NUM_STRIPS]; RECORDS_LEN]),
            lists: Box::new([[0; RECORDS_LEN]; NUM_BLOCKS]),
            list_lens: [0; NUM_BLOCKS],
            done: [0; NUM_STRIPS],
            planes: Box::new(Planes { red: plane, green: plane, blue: plane, transmittance: plane }),
            num_block_blends: 0,
        }
    }
}

/// One tile to be blended.
pub(super) struct Tile<'a, I, K> {
    /// Its left and upper corner, pixels.
    pub(super) origin_px: [usize; 2],
    /// Places of its splats, nearest first.
    pub(super) places: I,
    /// Where the splats are.
    pub(super) splats: &'a Splats,
    /// The view.
    pub(super) view: &'a View,
    /// Memory to work in; holds the pixels afterwards.
    pub(super) workspace: &'a mut Workspace,
    /// What else is made of the weights.
    pub(super) sink: &'a mut K,
}

impl<'a, I: Iterator<Item = &'a [u32]>, K: Sink> WithSimd for Tile<'a, I, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { origin_px, places, splats, view, workspace, sink } = self;
        workspace.clear(origin_px, view);
        let cutoffs = Cutoffs {
            level: (view.alpha_cut.log2() / EXPONENT_DIVISOR) as f32,
            // A little less: behind two layers of the largest opacity the spec has exactly 1e-4 left, which is not
            // below its least; in `f32` it would be, and the second layer would be missing.
            transmittance: (view.transmittance_stop * (1.0 - 1e-5)) as f32,
        };
        let constants = Constants::new(simd, cutoffs);
        let corner = origin_px.map(|position| position as f32);
        for slice in places {
            for some in slice.chunks(RECORDS_LEN) {
                // Copied first: the copies wait for memory side by side, the work below would wait one by one.
                for (splat, &place) in workspace.splats.iter_mut().zip(some) {
                    *splat = *splats.get(place);
                }
                workspace.enter(some.len(), corner);
                if K::IS_ACTIVE {
                    sink.begin(&workspace.records[..some.len()]);
                }
                workspace.blend_lists(simd, &constants, sink);
                if workspace.done == [u8::MAX; NUM_STRIPS] {
                    return;
                }
            }
        }
    }
}

impl Workspace {
    /// Starts a tile: nothing blended, blocks beyond the picture done with.
    fn clear(&mut self, origin_px: [usize; 2], view: &View) {
        self.planes.clear();
        self.list_lens.fill(0);
        self.num_block_blends = 0;
        let columns = (view.width as usize - origin_px[0]).div_ceil(BLOCK_WIDTH).min(BLOCKS_ACROSS);
        let rows = (view.height as usize - origin_px[1]).div_ceil(BLOCK_HEIGHT).min(NUM_STRIPS);
        self.done.fill(u8::MAX);
        self.done[..rows].fill((0xff_u32 << columns) as u8);
    }

    /// Enters the copied splats into the lists of the blocks they touch.
    #[inline(always)]
    fn enter(&mut self, num_splats: usize, corner_px: [f32; 2]) {
        // Two loops: the first has no branches and overlaps from splat to splat, the second has little else.
        let splats = &self.splats[..num_splats.min(RECORDS_LEN)];
        for ((splat, record), words) in splats.iter().zip(self.records.iter_mut()).zip(self.touched.iter_mut()) {
            *record = relative(splat, corner_px);
            *words = touched_blocks(splat, corner_px);
        }
        let open = words(&self.done).map(|word| !word);
        for (position, touched) in self.touched[..splats.len()].iter().enumerate() {
            for (word, (touched, open)) in words(touched).into_iter().zip(open).enumerate() {
                let mut left = touched & open;
                while left != 0 {
                    let block = word * 64 + left.trailing_zeros() as usize;
                    let len = &mut self.list_lens[block % NUM_BLOCKS];
                    self.lists[block % NUM_BLOCKS][usize::from(*len) % RECORDS_LEN] = position as u16;
                    *len += 1;
                    left &= left - 1;
                }
            }
        }
    }

    /// Blends every block's list and empties it.
    #[inline(always)]
    fn blend_lists<S: Simd, K: Sink>(&mut self, simd: S, constants: &Constants<S>, sink: &mut K) {
        for block in 0..NUM_BLOCKS {
            let len = usize::from(std::mem::take(&mut self.list_lens[block]));
            if len > 0 {
                self.num_block_blends += len as u64;
                if self.blend_block(simd, (block, len), constants, sink) {
                    self.done[block / BLOCKS_ACROSS] |= 1 << (block % BLOCKS_ACROSS);
                }
            }
        }
    }

    /// Blends the list of one block; true when the block takes no more.
    #[inline(always)]
    fn blend_block<S: Simd, K: Sink>(
        &mut self,
        simd: S,
        (block, len): (usize, usize),
        constants: &Constants<S>,
        sink: &mut K,
    ) -> bool {
        let list = &self.lists[block][..len];
        let (xs, ys) = half_block_centers(block);
        let mut is_done = true;
        for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
            let lanes = first_lane..(first_lane + S::F32_LANES).min(HALF_LEN);
            let start = block * BLOCK_LEN + first_lane;
            let [left, right] = [start..start + lanes.len(), start + HALF_LEN..start + HALF_LEN + lanes.len()];
            let mut pixels = [self.planes.load(simd, left.clone()), self.planes.load(simd, right.clone())];
            let (x, y) = (load(simd, &xs[lanes.clone()]), load(simd, &ys[lanes]));
            let x = [x, simd.add_f32s(x, simd.splat_f32s(HALF_WIDTH as f32))];
            let mut blender = Blender { simd, records: &self.records, x, y, constants, sink: &mut *sink };
            is_done &= blender.blend(list, &mut pixels);
            self.planes.store(simd, left, &pixels[0]);
            self.planes.store(simd, right, &pixels[1]);
        }
        is_done
    }

    /// Overlaps between splats and blocks blended for the last tile.
    pub(super) fn num_block_blends(&self) -> u64 {
        self.num_block_blends
    }

    /// Writes the pixels of one row of the tile, from the left, as many as the output holds.
    #[inline(always)]
    pub(super) fn write_row(&self, row: usize, background: [f32; 3], rgb: &mut [f32], transmittance: &mut [f32]) {
        let strip = row / BLOCK_HEIGHT * BLOCKS_ACROSS * BLOCK_LEN;
        let first = strip + row % BLOCK_HEIGHT * HALF_WIDTH;
        let (rgb, rgb_end) = rgb.as_chunks_mut::<{ 3 * HALF_WIDTH }>();
        let (rests, rests_end) = transmittance.as_chunks_mut::<HALF_WIDTH>();
        let num_whole = rests.len();
        for (half_block, (rgb, rests)) in rgb.iter_mut().zip(rests).enumerate() {
            (*rgb, *rests) = self.planes.quad(first + half_block * HALF_LEN, background);
        }
        if !rests_end.is_empty() {
            let (rgb, rests) = self.planes.quad(first + num_whole * HALF_LEN, background);
            rgb_end.copy_from_slice(&rgb[..rgb_end.len()]);
            rests_end.copy_from_slice(&rests[..rests_end.len()]);
        }
    }
}

/// A whole register of numbers.
#[inline(always)]
fn load<S: Simd>(simd: S, numbers: &[f32]) -> S::f32s {
    match S::as_simd_f32s(numbers).0 {
        [whole] => *whole,
        _ => simd.partial_load_f32s(numbers),
    }
}

/// Writes a whole register of numbers.
#[inline(always)]
fn store<S: Simd>(simd: S, numbers: &mut [f32], values: S::f32s) {
    match S::as_mut_simd_f32s(numbers).0 {
        [whole] => *whole = values,
        _ => simd.partial_store_f32s(numbers, values),
    }
}

/// Column and row in the tile of a pixel of a [`Plane`].
pub(super) fn position_in_tile(pixel: usize) -> [usize; 2] {
    let (half_block, lane) = (pixel / HALF_LEN, pixel % HALF_LEN);
    let (halves_across, strip_len) = (2 * BLOCKS_ACROSS, 2 * BLOCKS_ACROSS);
    let column = half_block % halves_across * HALF_WIDTH + lane % HALF_WIDTH;
    [column, half_block / strip_len * BLOCK_HEIGHT + lane / HALF_WIDTH]
}

/// Block masks as two words: bit i of word w belongs to block 64 w + i.
#[inline(always)]
fn words(masks: &StripMasks) -> [u64; NUM_BLOCKS / 64] {
    let mut words = [0; NUM_BLOCKS / 64];
    for (word, strips) in words.iter_mut().zip(masks.as_chunks::<8>().0) {
        *word = u64::from_le_bytes(*strips);
    }
    words
}

/// Pixel centers of the left half of a block relative to its tile, x and y, in the order of a [`Plane`].
#[inline(always)]
fn half_block_centers(block: usize) -> ([f32; HALF_LEN], [f32; HALF_LEN]) {
    let (left, top) = (block % BLOCKS_ACROSS * BLOCK_WIDTH, block / BLOCKS_ACROSS * BLOCK_HEIGHT);
    let (mut x, mut y) = ([0.0; HALF_LEN], [0.0; HALF_LEN]);
    for lane in 0..HALF_LEN {
        x[lane] = (left + lane % HALF_WIDTH) as f32 + 0.5;
        y[lane] = (top + lane / HALF_WIDTH) as f32 + 0.5;
    }
    (x, y)
}

/// A splat relative to the tile's corner.
#[inline(always)]
fn relative(splat: &Splat, corner_px: [f32; 2]) -> Record {
    let (x, y) = (splat.mean_px[0] - corner_px[0], splat.mean_px[1] - corner_px[1]);
    let [ux, uy, vy] = splat.whiten;
    Record {
        ux,
        uy,
        u0: -(ux * x + uy * y),
        vy,
        v0: -(vy * y),
        level: splat.level,
        color: splat.color,
        depth: splat.depth,
        gaussian_idx: splat.gaussian_idx,
    }
}
