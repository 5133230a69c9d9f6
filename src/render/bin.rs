//! Splats to tiles: for each tile of the picture the splats that may touch it, nearest first.
//!
//! The sorted splats are cut into runs of fixed length, each binned on its own; a tile's list is its part of every
//! run, one after the other. So the order never depends on the number of threads.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::RenderError;
use super::memory::{Budget, bytes_of};
use super::sort::DepthKey;
use super::splats::Splats;
use super::tiles::TileGrid;

/// Splats in a run.
const RUN_LEN: usize = 8192;

/// A splat in the order of depth and the tiles that it touches: first and last column, first and last row. It takes the
/// place of its key, which has done its work.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Placed {
    rect: [u16; 4],
    place: u32,
}

/// The bins of one run of splats.
#[derive(Debug, Default)]
struct Run {
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
    /// Bins splats given in depth order into the tiles of a grid; returns the number of splat-tile pairs. The keys are
    /// written over.
    ///
    /// # Errors
    /// [`RenderError::Cost`] or [`RenderError::Memory`] before anything is allocated for the pairs.
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

    /// Bytes that the lists hold on to.
    pub(super) fn bytes(&self) -> u64 {
        let lists = |run: &Run| bytes_of(&run.counts) + bytes_of(&run.ends) + bytes_of(&run.places);
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
                // Where it does not belong it is written over, or stays in the slot to spare.
                places[ends[tile_idx] as usize] = place;
                ends[tile_idx] += is_covered;
            });
        }
    }
}

/// Calls `visit` with every tile of a rectangle and 1. Up to 2 x 2 tiles, which is most, it is called four times, with 0
/// for those that are not in it: whether they are cannot be foretold, and a wrong guess costs more than a visit.
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
