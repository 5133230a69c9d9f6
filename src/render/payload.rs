//! What a picture gives besides color: anything made of the weights (opacity times transmittance) with which splats
//! enter pixels. The blending loop is generic over it, so that color alone pays nothing.

use super::kernel::Record;

/// Takes the weights of one tile.
pub(super) trait Sink {
    /// Whether it wants any; without, the calls are compiled away.
    const IS_ACTIVE: bool;

    /// The splats that the positions of the next weights refer to.
    fn begin(&mut self, records: &[Record]);

    /// The weights of the splat at a position in the pixels from `first_pixel` of the tile on; see
    /// [`super::pixels::position_in_tile`]. Nearest splats come first in every pixel.
    fn take(&mut self, position: usize, first_pixel: usize, weights: &[f32]);
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
        let [column, row] = super::pixels::position_in_tile(pixel);
        let (x, y) = (self.origin_px[0] + column, self.origin_px[1] + row);
        (x < self.width && y < self.height).then_some(y * self.width + x)
    }
}

/// An output beside color: a sink a tile, and what becomes of it.
pub(super) trait Payload: Sync {
    /// Takes a tile's weights.
    type Sink: Sink;
    /// What a tile leaves.
    type Part: Send;

    /// Hears how many bytes all sinks and parts together may take.
    fn allow(&self, _max_bytes: u64) {}

    /// An empty sink.
    fn sink(&self, area: TileArea) -> Self::Sink;

    /// What the sink of a finished tile has come to.
    fn part(&self, sink: Self::Sink, area: TileArea) -> Self::Part;
}

/// Color alone.
pub(super) struct ColorOnly;

impl Sink for ColorOnly {
    const IS_ACTIVE: bool = false;

    fn begin(&mut self, _: &[Record]) {}

    fn take(&mut self, _: usize, _: usize, _: &[f32]) {}
}

impl Payload for ColorOnly {
    type Sink = Self;
    type Part = ();

    fn sink(&self, _: TileArea) -> Self {
        Self
    }

    fn part(&self, _: Self, _: TileArea) {}
}
