//! Outputs besides color, computed from the blending weights (opacity times transmittance) of splats in pixels.
//!
//! Enters: weights from the blending loop. Leaves: one output per tile. The blending loop is generic over the payload,
//! so that rendering color alone has no overhead.

use super::pixels::position_in_tile;
use super::record::Record;
use super::tiles::{TILE_LEN, TILE_PX};

/// Receives the weights of one tile.
pub(super) trait Sink {
    /// Whether it needs weights; if not, the calls are compiled away.
    const IS_ACTIVE: bool;

    /// Starts a chunk: the positions of the following weights are indices into `records`.
    fn begin_chunk(&mut self, records: &[Record]);

    /// Adds the weights of the splat at a position, in the tile's pixels from `first_pixel` on; [`position_in_tile`]
    /// explains their order. In every pixel the nearest splats come first.
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]);
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
    /// Index of a pixel of the tile in the picture, row-major; `None` outside the picture.
    pub(super) fn picture_idx(&self, pixel: usize) -> Option<usize> {
        let [column, row] = position_in_tile(pixel);
        let (x, y) = (self.origin_px[0] + column, self.origin_px[1] + row);
        (x < self.width && y < self.height).then_some(y * self.width + x)
    }

    /// Reorders values of the tile's pixels (`num_channels` per pixel, in the tile's own order) to rows; drops pixels
    /// outside the picture.
    pub(super) fn in_rows<T: Copy + Default>(self, values: &[T], num_channels: usize) -> TileRows<T> {
        let num_columns = (self.width - self.origin_px[0]).min(TILE_PX);
        let num_rows = (self.height - self.origin_px[1]).min(TILE_PX);
        let mut ordered = vec![T::default(); num_columns * num_rows * num_channels];
        for (pixel, value) in values.chunks_exact(num_channels).enumerate().take(TILE_LEN) {
            let [column, row] = position_in_tile(pixel);
            if column < num_columns && row < num_rows {
                ordered[(row * num_columns + column) * num_channels..][..num_channels].copy_from_slice(value);
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
    const IS_ACTIVE: bool = false;

    fn begin_chunk(&mut self, _: &[Record]) {}

    fn add(&mut self, _: usize, _: usize, _: &[f32]) {}
}

impl Payload for ColorOnly {
    type Sink = Self;
    type TileOutput = ();

    fn sink(&self, _: TileArea) -> Self {
        Self
    }

    fn finish(&self, _: Self, _: TileArea) {}
}
