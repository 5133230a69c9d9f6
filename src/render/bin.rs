//! Splats to tiles: for each tile of the picture the splats that may touch it, nearest first.
//!
//! The sorted splats are cut into runs of fixed length, each binned on its own; a tile's list is its part of every
//! run, one after the other. So the order never depends on the number of threads.

use rayon::prelude::*;

use super::sort::DepthKey;
use super::splats::Splats;
use super::{Limits, RenderError, View};

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
    /// Where each tile's part of `places` begins; one more than there are tiles.
    starts: Vec<u32>,
    /// Places of splats, tile after tile.
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
        limits: &Limits,
    ) -> Result<u64, RenderError> {
        let grid = TileGrid::of(view);
        self.num_runs = keys.len().div_ceil(RUN_LEN);
        if self.runs.len() < self.num_runs {
            self.runs.resize_with(self.num_runs, Run::default);
        }
        let runs = &mut self.runs[..self.num_runs];
        let num_pairs =
            runs.par_iter_mut().zip(keys.par_chunks(RUN_LEN)).map(|(run, keys)| run.count(keys, splats, grid)).sum();
        check_pairs(num_pairs, limits)?;
        runs.par_iter_mut().zip(keys.par_chunks(RUN_LEN)).for_each(|(run, keys)| run.place(keys, grid));
        Ok(num_pairs)
    }

    /// Places of the splats of one tile, nearest first, in slices.
    pub(super) fn of_tile(&self, tile_idx: usize) -> impl Iterator<Item = &[u32]> {
        self.runs[..self.num_runs].iter().map(move |run| {
            let (start, end) = (run.starts[tile_idx] as usize, run.starts[tile_idx + 1] as usize);
            &run.places[start..end]
        })
    }
}

impl Run {
    /// Finds the tiles that each splat touches and how many splats each tile gets; returns the number of pairs.
    fn count(&mut self, keys: &[DepthKey], splats: &Splats, grid: TileGrid) -> u64 {
        self.rects.clear();
        self.starts.clear();
        self.starts.resize(grid.len() + 1, 0);
        let mut num_pairs = 0;
        for key in keys {
            let rect = splats.rect(key.place);
            self.rects.push(rect);
            for_each_tile(rect, grid, |tile_idx| {
                self.starts[tile_idx + 1] += 1;
                num_pairs += 1;
            });
        }
        num_pairs
    }

    /// Writes every splat's place into the lists of its tiles.
    fn place(&mut self, keys: &[DepthKey], grid: TileGrid) {
        for tile_idx in 0..grid.len() {
            self.starts[tile_idx + 1] += self.starts[tile_idx];
        }
        self.places.clear();
        self.places.resize(self.starts[grid.len()] as usize, 0);
        let (starts, places) = (&mut self.starts, &mut self.places);
        for (key, &rect) in keys.iter().zip(&self.rects) {
            for_each_tile(rect, grid, |tile_idx| {
                places[starts[tile_idx] as usize] = key.place;
                starts[tile_idx] += 1;
            });
        }
        // Each start has moved to its tile's end, which is the next tile's start.
        starts.copy_within(0..grid.len(), 1);
        starts[0] = 0;
    }
}

fn for_each_tile([left, right, top, bottom]: [u16; 4], grid: TileGrid, mut visit: impl FnMut(usize)) {
    for row in usize::from(top)..=usize::from(bottom) {
        for column in usize::from(left)..=usize::from(right) {
            visit(row * grid.across + column);
        }
    }
}

/// Holds the number of splat-tile pairs against the caps.
///
/// # Errors
/// [`RenderError::Cost`] or [`RenderError::Memory`].
pub(super) fn check_pairs(num_pairs: u64, limits: &Limits) -> Result<(), RenderError> {
    if num_pairs > limits.max_pairs {
        return Err(RenderError::Cost { found: num_pairs, limit: limits.max_pairs });
    }
    let found_bytes = num_pairs * size_of::<u32>() as u64;
    if found_bytes > limits.max_memory_bytes {
        return Err(RenderError::Memory { num_pairs, found_bytes, limit_bytes: limits.max_memory_bytes });
    }
    Ok(())
}
