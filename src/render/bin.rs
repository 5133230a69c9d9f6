//! Splats to tiles.
//!
//! Enters: splats in depth order. Leaves: for each tile the splats that may overlap it, nearest first. The sorted
//! splats are cut into runs of fixed length and each run is binned by itself; a tile's list is the concatenation of its
//! parts in all runs. The invariant: the order does not depend on the number of threads.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::RenderError;
use super::memory::{Budget, bytes_of};
use super::sort::DepthKey;
use super::splats::Splats;
use super::tiles::TileGrid;

/// Splats per run.
const RUN_LEN: usize = 8192;

/// A splat in depth order and the tiles that it overlaps: first and last column, first and last row. Overwrites its
/// sort key, which is no longer needed and has the same size.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Placed {
    rect: [u16; 4],
    place: u32,
}

/// The bins of one run of splats.
#[derive(Debug, Default)]
struct Run {
    /// Number of splats per tile, followed by slots that [`for_each_tile`] adds 0 to.
    counts: Vec<u32>,
    /// Index in `places` at which the next splat of each tile is written; after binning, the end of the tile's list.
    ends: Vec<u32>,
    /// Places of splats, tile after tile, with one spare slot after each tile.
    places: Vec<u32>,
}

/// The splats of every tile. Keeps its memory from picture to picture.
#[derive(Debug, Default)]
pub(super) struct Bins {
    runs: Vec<Run>,
    num_runs: usize,
}

impl Bins {
    /// Bins splats in depth order into the tiles of a grid; returns the number of splat-tile pairs. Overwrites the
    /// keys.
    ///
    /// # Errors
    /// [`RenderError::Cost`] for too many pairs, [`RenderError::Memory`] if their list would exceed the limit; both
    /// before the list is allocated.
    pub(super) fn fill(
        &mut self,
        keys: &mut [DepthKey],
        splats: &Splats,
        grid: TileGrid,
        budget: &mut Budget,
    ) -> Result<u64, RenderError> {
        self.num_runs = keys.len().div_ceil(RUN_LEN);
        if self.runs.len() < self.num_runs {
            self.runs.resize_with(self.num_runs, Run::default);
        }
        let runs = &mut self.runs[..self.num_runs];
        let placed: &mut [Placed] = bytemuck::cast_slice_mut(keys);
        let counted = runs.par_iter_mut().zip(placed.par_chunks_mut(RUN_LEN));
        let num_pairs = counted.map(|(run, placed)| run.count(placed, splats, grid)).sum();
        budget.take_pairs(num_pairs)?;
        runs.par_iter_mut().zip(placed.par_chunks(RUN_LEN)).for_each(|(run, placed)| run.place(placed, grid));
        Ok(num_pairs)
    }

    /// Bytes that the lists have allocated.
    pub(super) fn bytes(&self) -> u64 {
        let lists = |run: &Run| bytes_of(&run.counts) + bytes_of(&run.ends) + bytes_of(&run.places);
        self.runs.iter().map(lists).sum()
    }

    /// Places of the splats of one tile, nearest first, one slice per run.
    pub(super) fn of_tile(&self, tile_idx: usize) -> impl Iterator<Item = &[u32]> {
        self.runs[..self.num_runs].iter().map(move |run| {
            let end = run.ends[tile_idx] as usize;
            &run.places[end - run.counts[tile_idx] as usize..end]
        })
    }
}

impl Run {
    /// Looks up the tiles of each splat and counts the splats of each tile; returns the number of pairs.
    fn count(&mut self, placed: &mut [Placed], splats: &Splats, grid: TileGrid) -> u64 {
        self.counts.clear();
        self.counts.resize(grid.len() + grid.across + 2, 0);
        for splat in placed {
            splat.rect = splats.rect(splat.place);
            for_each_tile(splat.rect, grid, |tile_idx, is_covered| self.counts[tile_idx] += is_covered);
        }
        self.counts.iter().map(|&count| u64::from(count)).sum()
    }

    /// Writes every splat's place into the lists of its tiles.
    fn place(&mut self, placed: &[Placed], grid: TileGrid) {
        let mut next = 0;
        self.ends.clear();
        self.ends.extend(self.counts.iter().map(|count| {
            next += count + 1;
            next - count - 1
        }));
        self.places.clear();
        self.places.resize(next as usize, 0);
        let (ends, places) = (&mut self.ends, &mut self.places);
        for &Placed { rect, place } in placed {
            for_each_tile(rect, grid, |tile_idx, is_covered| {
                // Written even if the tile is not covered: then the next splat overwrites it, or it stays in the spare
                // slot.
                places[ends[tile_idx] as usize] = place;
                ends[tile_idx] += is_covered;
            });
        }
    }
}

/// Calls `visit(tile_idx, 1)` for every tile of a rectangle.
///
/// Most rectangles have up to 2 x 2 tiles. For those it makes four calls, with 0 for tiles outside the rectangle: a
/// branch would be unpredictable, and a misprediction costs more than a wasted visit.
#[inline(always)]
fn for_each_tile([left, right, top, bottom]: [u16; 4], grid: TileGrid, mut visit: impl FnMut(usize, u32)) {
    let first = (usize::from(top) - grid.first_row) * grid.across + usize::from(left);
    let (columns, rows) = (u32::from(right + 1 - left), u32::from(bottom + 1 - top));
    if columns.max(rows) <= 2 {
        let (is_wide, is_high) = (columns - 1, rows - 1);
        visit(first, 1);
        visit(first + 1, is_wide);
        visit(first + grid.across, is_high);
        visit(first + grid.across + 1, is_wide * is_high);
        return;
    }
    for row in 0..rows as usize {
        for column in 0..columns as usize {
            visit(first + row * grid.across + column, 1);
        }
    }
}
