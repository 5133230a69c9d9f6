//! What a picture gives besides color: anything made of the weights (opacity times transmittance) with which splats
//! enter pixels. The blending loop is generic over it, so that color alone pays nothing.

use super::pixels::position_in_tile;
use super::record::Record;
use super::tiles::{TILE_LEN, TILE_PX};

/// Takes the weights of one tile.
pub(super) trait Sink {
    /// Whether it wants any; without, the calls are compiled away.
    const IS_ACTIVE: bool;

    /// The splats that the positions of the next weights refer to.
    fn begin_chunk(&mut self, records: &[Record]);

    /// The weights of the splat at a position in the pixels from `first_pixel` of the tile on; see
    /// [`position_in_tile`]. Nearest splats come first in every pixel.
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]);
}

/// A tile's place in the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct TileArea {
    /// Left and upper corner, pixels.
    pub(super) origin_px: [usize; 2],
    /// Width of the picture.
    pub(super) width: usize,
    /// Height of the picture.
    pub(super) height: usize,
}

impl TileArea {
    /// Index in the picture of a pixel of the tile, row-major; `None` beyond the border.
    pub(super) fn picture_idx(&self, pixel: usize) -> Option<usize> {
        let [column, row] = position_in_tile(pixel);
        let (x, y) = (self.origin_px[0] + column, self.origin_px[1] + row);
        (x < self.width && y < self.height).then_some(y * self.width + x)
    }

    /// Values of the tile's pixels row after row, those beyond the border left out: `num_channels` numbers a pixel, given
    /// in the tile's own order.
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

/// What a tile leaves of an output with values in every pixel.
pub(super) struct TileRows<T> {
    area: TileArea,
    num_columns: usize,
    num_channels: usize,
    values: Vec<T>,
}

impl<T: Copy> TileRows<T> {
    /// Writes the tile into a picture of `stride` values a pixel, from the channel `first` on.
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

/// An output beside color: a sink a tile, and what becomes of it.
pub(super) trait Payload: Sync {
    /// Takes a tile's weights.
    type Sink: Sink;
    /// What a tile leaves.
    type TileOutput: Send;

    /// Hears how many bytes all sinks and parts together may take.
    fn set_limit(&self, _max_bytes: u64) {}

    /// An empty sink.
    fn sink(&self, area: TileArea) -> Self::Sink;

    /// What the sink of a finished tile has come to.
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
