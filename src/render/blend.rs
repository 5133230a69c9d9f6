//! Tiles to pixels: blends each tile front to back, each block of 8 x 4 pixels with its own list of splats.
//!
//! Enters: the places of a tile's splats, nearest first. Leaves: the tile's pixels, or what a [`Sink`] makes of the
//! weights. Splats are processed in chunks of 256: first the coverage of every block is computed, then every block that
//! is not yet opaque blends the splats that cover it, with its pixels in registers. A block that has become opaque takes
//! no more splats (early termination).

use std::marker::PhantomData;

use pulp::{Simd, WithSimd};

use super::View;
use super::coverage::{Coverage, PositionList};
use super::kernel::{Arithmetic, Blender, CHECK_INTERVAL, Constants, Cutoffs};
use super::payload::Sink;
use super::pixels::{BlockValues, TilePixels};
use super::record::{RECORDS_LEN, Record};
use super::splat::{EXPONENT_DIVISOR, Splat};
use super::splats::Splats;
use super::sweep::Sample;
use super::tiles::{BLOCK_HEIGHT, BLOCK_WIDTH, BLOCKS_ACROSS, NUM_BLOCKS, NUM_STRIPS, StripMasks};

/// Work buffers for one tile, reused for the next.
#[derive(Debug)]
pub(super) struct Workspace {
    splats: Box<[Splat; RECORDS_LEN]>,
    records: Box<[Record; RECORDS_LEN]>,
    coverage: Coverage,
    /// Blocks that take no more splats.
    done: StripMasks,
    pixels: TilePixels,
    num_block_blends: u64,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            splats: Box::new([Splat::default(); RECORDS_LEN]),
            records: Box::new([Record::default(); RECORDS_LEN]),
            coverage: Coverage::default(),
            done: [0; NUM_STRIPS],
            pixels: TilePixels::default(),
            num_block_blends: 0,
        }
    }
}

/// One tile to blend.
pub(super) struct Tile<'a, I, A, K> {
    /// Upper left corner, pixels.
    pub(super) origin_px: [usize; 2],
    /// Places of the tile's splats, nearest first.
    pub(super) places: I,
    /// The splats of the picture.
    pub(super) splats: &'a Splats,
    /// The view.
    pub(super) view: &'a View,
    /// The picture of a sweep; `None` = the view's own.
    pub(super) sample: Option<&'a Sample>,
    /// Work buffers; hold the pixels afterwards.
    pub(super) workspace: &'a mut Workspace,
    /// Receives the weights.
    pub(super) sink: &'a mut K,
    /// How opacities are computed and blended.
    pub(super) arithmetic: PhantomData<A>,
}

impl<'a, I: Iterator<Item = &'a [u32]>, A: Arithmetic, K: Sink> WithSimd for Tile<'a, I, A, K> {
    /// Number of splats that were blended before the tile was opaque.
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        let Self { origin_px, places, splats, view, sample, workspace, sink, .. } = self;
        workspace.clear(origin_px, view);
        let cutoffs = Cutoffs {
            level: A::level((view.alpha_cut.log2() / EXPONENT_DIVISOR) as f32),
            // Slightly lower: behind two layers of opacity 0.99 the spec image has a transmittance of exactly 1e-4,
            // which is not below the stop. In `f32` it would be, and the second layer would be missing.
            transmittance: (view.transmittance_stop * (1.0 - 1e-5)) as f32,
        };
        let constants = Constants::new(simd, cutoffs);
        let corner = origin_px.map(|position| position as f32);
        let mut num_taken = 0;
        let mut left = places.flatten().map(|&place| splats.get(place));
        while workspace.done != [u8::MAX; NUM_STRIPS] {
            // Copied first: the loads of the copies overlap; the work below would wait for each load.
            let mut len = 0;
            for (to, from) in workspace.splats.iter_mut().zip(&mut left) {
                *to = *from;
                len += 1;
            }
            if len == 0 {
                break;
            }
            num_taken += len;
            if let Some(sample) = sample {
                workspace.splats[..len].iter_mut().for_each(|splat| sample.move_splat(splat));
            }
            workspace.blend_copied::<S, A, K>(simd, (len, corner), &constants, sink);
        }
        sink.end_tile(simd);
        num_taken
    }
}

impl Workspace {
    /// Bytes of a workspace.
    pub(super) const BYTES: usize =
        RECORDS_LEN * (size_of::<Splat>() + size_of::<Record>()) + Coverage::BYTES + TilePixels::BYTES;

    /// Starts a tile: clears the pixels and marks blocks outside the picture as done.
    fn clear(&mut self, origin_px: [usize; 2], view: &View) {
        self.pixels.clear();
        self.num_block_blends = 0;
        let columns = (view.width as usize - origin_px[0]).div_ceil(BLOCK_WIDTH).min(BLOCKS_ACROSS);
        let rows = (view.height as usize - origin_px[1]).div_ceil(BLOCK_HEIGHT).min(NUM_STRIPS);
        self.done.fill(u8::MAX);
        self.done[..rows].fill((0xff_u32 << columns) as u8);
    }

    /// Blends the chunk of copied splats.
    #[inline(always)]
    fn blend_copied<S: Simd, A: Arithmetic, K: Sink>(
        &mut self,
        simd: S,
        (len, corner_px): (usize, [f32; 2]),
        constants: &Constants<S>,
        sink: &mut K,
    ) {
        let splats = &self.splats[..len.min(RECORDS_LEN)];
        for (position, (splat, record)) in splats.iter().zip(self.records.iter_mut()).enumerate() {
            *record = relative::<A>(splat, corner_px);
            self.coverage.set_splat(position, splat, corner_px);
        }
        self.coverage.compute(len, &self.done);
        sink.begin_chunk(&self.records[..len]);
        self.blend_blocks::<S, A, K>(simd, constants, sink);
        sink.end_chunk();
    }

    /// Blends the chunk into every block that is not done.
    #[inline(always)]
    fn blend_blocks<S: Simd, A: Arithmetic, K: Sink>(&mut self, simd: S, constants: &Constants<S>, sink: &mut K) {
        let mut list = PositionList::default();
        let mut weights = [BlockValues::ZERO; CHECK_INTERVAL];
        for block in 0..NUM_BLOCKS {
            let (strip, bit) = (block / BLOCKS_ACROSS, 1 << (block % BLOCKS_ACROSS));
            if self.done[strip] & bit != 0 {
                continue;
            }
            let len = self.coverage.list(block, &mut list);
            if len > 0 {
                self.num_block_blends += len as u64;
                let (records, pixels) = (&self.records, &mut self.pixels);
                let (sink, weights) = (&mut *sink, &mut weights);
                let mut blender = Blender { simd, records, constants, pixels, sink, weights };
                if blender.blend::<A>(block, &list.0[..len.min(RECORDS_LEN)]) {
                    self.done[strip] |= bit;
                }
            }
        }
    }

    /// Number of splat-block pairs that were blended for the last tile.
    pub(super) fn num_block_blends(&self) -> u64 {
        self.num_block_blends
    }

    /// The pixels of the last tile.
    pub(super) fn pixels(&self) -> &TilePixels {
        &self.pixels
    }
}

/// The record of a splat relative to the tile's corner.
#[inline(always)]
fn relative<A: Arithmetic>(splat: &Splat, corner_px: [f32; 2]) -> Record {
    let (x, y) = (splat.mean_px[0] - corner_px[0], splat.mean_px[1] - corner_px[1]);
    let [ux, uy, vy] = splat.whiten.map(|factor| factor * A::OFFSET_UNIT);
    Record {
        ux,
        uy,
        u0: -(ux * x + uy * y),
        vy,
        v0: -(vy * y),
        level: A::level(splat.level),
        color: splat.color,
        depth: splat.depth,
        gaussian_idx: splat.gaussian_idx,
    }
}
