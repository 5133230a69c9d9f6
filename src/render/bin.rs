//! Splats to tiles: for each tile of the picture the splats that may touch it, nearest first.
//!
//! The sorted splats are cut into runs of fixed length, each binned on its own; a tile's list is its part of every
//! run, one after the other. So the order never depends on the number of threads.

use rayon::prelude::*;

use super::memory::{Budget, bytes_of};
use super::sort::DepthKey;
use super::splats::Splats;
use super::{RenderError, View};

/// Edge of a tile in pixels.
pub(super) const TILE_PX: usize = 64;
/// Splats in a run.
const RUN_LEN: usize = 8192;

/// A picture cut into tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct TileGrid {
    /// Tiles side by side.
    pub(super) across: usize,
    /// Tiles on top of each other.
    pub(super) down: usize,
}

impl TileGrid {
    /// The grid that covers a view.
    pub(super) fn of(view: &View) -> Self {
        Self { across: (view.width as usize).div_ceil(TILE_PX), down: (view.height as usize).div_ceil(TILE_PX) }
    }

    /// Number of tiles.
    pub(super) fn len(self) -> usize {
        self.across * self.down
    }
}

/// The bins of one run of splats.
#[derive(Debug, Default)]
struct Run {
    /// Tiles each splat touches: first and last column, first and last row.
    rects: Vec<[u16; 4]>,
    /// Number of splats of each tile, and room for counts of 0 behind.
    counts: Vec<u32>,
    /// Where the next place of each tile goes; in the end one after its last.
    ends: Vec<u32>,
    /// Places of splats, tile after tile, each with one slot to spare behind it.
    places: Vec<u32>,
}

/// The splats of every tile. Memory is kept from picture to picture.
#[derive(Debug, Default)]
pub(super) struct Bins {
    runs: Vec<Run>,
    num_runs: usize,
}

impl Bins {
    /// Bins splats given in depth order; returns the number of splat-tile pairs.
    ///
    /// # Errors
    /// [`RenderError::Cost`] or [`RenderError::Memory`] before anything is allocated for the pairs.
    pub(super) fn fill(
        &mut self,
        keys: &[DepthKey],
        splats: &Splats,
        view: &View,
        budget: &mut Budget,
    ) -> Result<u64, RenderError> {
        let grid = TileGrid::of(view);
        self.num_runs = keys.len().div_ceil(RUN_LEN);
        if self.runs.len() < self.num_runs {
            self.runs.resize_with(self.num_runs, Run::default);
        }
        let runs = &mut self.runs[..self.num_runs];
        let num_pairs =
            runs.par_iter_mut().zip(keys.par_chunks(RUN_LEN)).map(|(run, keys)| run.count(keys, splats, grid)).sum();
        budget.take_pairs(num_pairs)?;
        runs.par_iter_mut().zip(keys.par_chunks(RUN_LEN)).for_each(|(run, keys)| run.place(keys, grid));
        Ok(num_pairs)
    }

    /// Bytes that the lists hold on to.
    pub(super) fn bytes(&self) -> u64 {
        let lists =
            |run: &Run| bytes_of(&run.rects) + bytes_of(&run.counts) + bytes_of(&run.ends) + bytes_of(&run.places);
        self.runs.iter().map(lists).sum()
    }

    /// Places of the splats of one tile, nearest first, in slices.
    pub(super) fn of_tile(&self, tile_idx: usize) -> impl Iterator<Item = &[u32]> {
        self.runs[..self.num_runs].iter().map(move |run| {
            let end = run.ends[tile_idx] as usize;
            &run.places[end - run.counts[tile_idx] as usize..end]
        })
    }
}

impl Run {
    /// Finds the tiles that each splat touches and how many splats each tile gets; returns the number of pairs.
    fn count(&mut self, keys: &[DepthKey], splats: &Splats, grid: TileGrid) -> u64 {
        self.rects.clear();
        self.rects.extend(keys.iter().map(|key| splats.rect(key.place)));
        self.counts.clear();
        self.counts.resize(grid.len() + grid.across + 2, 0);
        for &rect in &self.rects {
            for_each_tile(rect, grid, |tile_idx, is_touched| self.counts[tile_idx] += is_touched);
        }
        self.counts.iter().map(|&count| u64::from(count)).sum()
    }

    /// Writes every splat's place into the lists of its tiles.
    fn place(&mut self, keys: &[DepthKey], grid: TileGrid) {
        let mut next = 0;
        self.ends.clear();
        self.ends.extend(self.counts.iter().map(|count| {
            next += count + 1;
            next - count - 1
        }));
        self.places.clear();
        self.places.resize(next as usize, 0);
        let (ends, places) = (&mut self.ends, &mut self.places);
        for (key, &rect) in keys.iter().zip(&self.rects) {
            for_each_tile(rect, grid, |tile_idx, is_touched| {
                // Where it does not belong it is written over, or stays in the slot to spare.
                places[ends[tile_idx] as usize] = key.place;
                ends[tile_idx] += is_touched;
            });
        }
    }
}

/// Calls `visit` with every tile of a rectangle and 1. Up to 2 x 2 tiles, which is most, it is called four times, with 0
/// for those that are not in it: whether they are cannot be foretold, and a wrong guess costs more than a visit.
#[inline(always)]
fn for_each_tile([left, right, top, bottom]: [u16; 4], grid: TileGrid, mut visit: impl FnMut(usize, u32)) {
    let first = usize::from(top) * grid.across + usize::from(left);
    let (columns, rows) = (u32::from(right + 1 - left), u32::from(bottom + 1 - top));
    if columns.max(rows) <= 2 {
        let (is_first, is_wide, is_high) = (columns.min(1), columns / 2, rows - 1);
        visit(first, is_first);
        visit(first + 1, is_wide);
        visit(first + grid.across, is_first * is_high);
        visit(first + grid.across + 1, is_wide * is_high);
        return;
    }
    for row in 0..rows as usize {
        for column in 0..columns as usize {
            visit(first + row * grid.across + column, 1);
        }
    }
}
