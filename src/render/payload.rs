//! Outputs besides color, computed from the blending weights (opacity times transmittance) of splats in pixels.
//!
//! Enters: weights from the blending loop, one block of pixels at a time. Leaves: one output per tile. The blending loop
//! is generic over the payload: it computes either colors or weights, and never both. A sink keeps the sums of a block in
//! registers while it adds the splats of one call.

use pulp::Simd;

use super::pixels::{BlockValues, HALF_WIDTH, position_in_tile};
use super::record::Record;
use super::tiles::{BLOCK_HEIGHT, BLOCK_WIDTH, TILE_PX};

/// Pixels of a block.
pub(super) const BLOCK_LEN: usize = BLOCK_WIDTH * BLOCK_HEIGHT;

/// Receives the weights of one tile.
pub(super) trait Sink {
    /// Whether it takes weights, instead of the picture; if not, the calls are compiled away.
    const TAKES_WEIGHTS: bool;

    /// Starts a chunk: the positions of the following weights are indices into `records`.
    fn begin_chunk(&mut self, records: &[Record]);

    /// Adds the weights in one block of the splats at the listed positions, nearest first. The numbers of the block's
    /// pixels start at `block * BLOCK_LEN`; [`position_in_tile`] explains their order. In every block the
    /// nearest splats come first.
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]);

    /// Ends a chunk.
    #[inline(always)]
    fn end_chunk(&mut self) {}

    /// Ends the tile.
    #[inline(always)]
    fn end_tile<S: Simd>(&mut self, _: S) {}
}

/// A tile's place in the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct TileArea {
    /// Upper left corner, pixels.
    pub(super) origin_px: [usize; 2],
    /// Width of the picture.
    pub(super) width: usize,
    /// Height of the picture.
    pub(super) height: usize,
}

impl TileArea {
    /// Index in the picture, row-major, of every pixel of a block; `None` outside the picture.
    #[inline(always)]
    pub(super) fn picture_idxs(&self, block: usize) -> [Option<usize>; BLOCK_LEN] {
        let mut idxs = [None; BLOCK_LEN];
        for (quad, idxs) in idxs.as_chunks_mut::<HALF_WIDTH>().0.iter_mut().enumerate() {
            let [column, row] = position_in_tile(block * BLOCK_LEN + quad * HALF_WIDTH);
            let (left, y) = (self.origin_px[0] + column, self.origin_px[1] + row);
            for (x, idx) in (left..).zip(idxs) {
                *idx = (x < self.width && y < self.height).then_some(y * self.width + x);
            }
        }
        idxs
    }

    /// Index of the tile in the picture, row-major.
    pub(super) fn tile_idx(&self) -> usize {
        let [column, row] = self.origin_px.map(|origin_px| origin_px / TILE_PX);
        row * self.width.div_ceil(TILE_PX) + column
    }

    /// Reorders values of the tile's pixels (`num_channels` per pixel, in the tile's own order) to rows; drops pixels
    /// outside the picture.
    pub(super) fn in_rows<T: Copy + Default>(self, values: &[T], num_channels: usize) -> TileRows<T> {
        let num_columns = (self.width - self.origin_px[0]).min(TILE_PX);
        let num_rows = (self.height - self.origin_px[1]).min(TILE_PX);
        let mut ordered = vec![T::default(); num_columns * num_rows * num_channels];
        // Four neighbors at a time: they are neighbors in the tile's own order, too.
        for (quad, values) in values.chunks_exact(HALF_WIDTH * num_channels).enumerate() {
            let [column, row] = position_in_tile(quad * HALF_WIDTH);
            if column < num_columns && row < num_rows {
                let num_values = HALF_WIDTH.min(num_columns - column) * num_channels;
                ordered[(row * num_columns + column) * num_channels..][..num_values]
                    .copy_from_slice(&values[..num_values]);
            }
        }
        TileRows { area: self, num_columns, num_channels, values: ordered }
    }
}

/// Values of the pixels of one tile, row-major.
pub(super) struct TileRows<T> {
    area: TileArea,
    num_columns: usize,
    num_channels: usize,
    values: Vec<T>,
}

impl<T: Copy> TileRows<T> {
    /// Writes the tile into a picture of `stride` values per pixel, starting at channel `first`.
    pub(super) fn write(&self, picture: &mut [T], stride: usize, first: usize) {
        let [left, top] = self.area.origin_px;
        for (row, values) in (top..).zip(self.values.chunks_exact(self.num_columns * self.num_channels)) {
            let start = (row * self.area.width + left) * stride;
            if stride == self.num_channels {
                picture[start..][..values.len()].copy_from_slice(values);
                continue;
            }
            let pixels = picture[start..].chunks_mut(stride).zip(values.chunks_exact(self.num_channels));
            pixels.for_each(|(pixel, values)| pixel[first..][..self.num_channels].copy_from_slice(values));
        }
    }
}

/// An output besides color: makes one sink per tile and turns it into the tile's output.
pub(super) trait Payload: Sync {
    /// Receives the weights of a tile.
    type Sink: Sink;
    /// The output of a tile.
    type TileOutput: Send;

    /// Sets how many bytes all sinks and outputs together may take.
    fn set_limit(&self, _max_bytes: u64) {}

    /// An empty sink.
    fn sink(&self, area: TileArea) -> Self::Sink;

    /// The output of a finished tile.
    fn finish(&self, sink: Self::Sink, area: TileArea) -> Self::TileOutput;
}

/// Color alone.
pub(super) struct ColorOnly;

impl Sink for ColorOnly {
    const TAKES_WEIGHTS: bool = false;

    #[inline(always)]
    fn begin_chunk(&mut self, _: &[Record]) {}

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, _: S, _: usize, _: &[u8], _: &[BlockValues]) {}
}

impl Payload for ColorOnly {
    type Sink = Self;
    type TileOutput = ();

    fn sink(&self, _: TileArea) -> Self {
        Self
    }

    fn finish(&self, _: Self, _: TileArea) {}
}
