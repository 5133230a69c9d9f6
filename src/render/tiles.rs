//! Partition of a picture: tiles of 64 x 64 pixels; a tile has strips, one above the other, of blocks of 8 x 4 pixels.

use std::ops::Range;

use super::View;

/// Edge of a tile in pixels.
pub(super) const TILE_PX: usize = 64;
/// Pixels of a tile.
pub(super) const TILE_LEN: usize = TILE_PX * TILE_PX;

/// Width of a block in pixels.
pub(super) const BLOCK_WIDTH: usize = 8;
/// Height of a block in pixels.
pub(super) const BLOCK_HEIGHT: usize = 4;
/// Blocks side by side in a tile; equals the number of bits in a byte, see [`StripMasks`].
pub(super) const BLOCKS_ACROSS: usize = TILE_PX / BLOCK_WIDTH;
/// Strips (rows of blocks) in a tile.
pub(super) const NUM_STRIPS: usize = TILE_PX / BLOCK_HEIGHT;
/// Blocks of a tile, numbered row by row.
pub(super) const NUM_BLOCKS: usize = BLOCKS_ACROSS * NUM_STRIPS;

/// One bit per block: `[strip]` counts block rows from the top, bit 0 is the leftmost block.
pub(super) type StripMasks = [u8; NUM_STRIPS];

/// Some rows of the tiles of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct TileGrid {
    /// Number of columns.
    pub(super) across: usize,
    /// Index of the first row.
    pub(super) first_row: usize,
    /// Number of rows.
    pub(super) down: usize,
}

impl TileGrid {
    /// The grid that covers a view.
    pub(super) fn of(view: &View) -> Self {
        let [across, down] = [view.width, view.height].map(|size| (size as usize).div_ceil(TILE_PX));
        Self { across, first_row: 0, down }
    }

    /// The grid restricted to some rows.
    pub(super) fn rows(self, rows: &Range<usize>) -> Self {
        Self { first_row: rows.start, down: rows.len(), ..self }
    }

    /// Number of tiles.
    pub(super) fn len(self) -> usize {
        self.across * self.down
    }
}
