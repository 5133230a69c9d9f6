//! The `f32` renderer: runs the four stages for the whole picture or, if that would take too much memory, band by band.
//!
//! Enters: groups of Gaussians, a view and settings. Leaves: pixels on a canvas, one output per tile, and statistics.
//! The invariant: a picture has the same bits with and without bands.

use std::marker::PhantomData;
use std::ops::Range;
use std::time::Instant;

use rayon::prelude::*;

use super::batch;
use super::bin::Bins;
use super::blend::{Tile, Workspace};
use super::canvas::{Band, Canvas, FinishedTile};
use super::groups::Groups;
use super::kernel::{Arithmetic, Exact, Quick};
use super::memory::Budget;
use super::order::DepthOrder;
use super::payload::{Payload, Sink, TileArea};
use super::pool::Pool;
use super::project::Projection;
use super::sort::DepthKey;
use super::splats::Splats;
use super::sweep::{Sample, ViewSweep};
use super::tiles::{TILE_PX, TileGrid};
use super::{Precision, RenderError, RenderSettings, RenderStats, StageTimes, View};
use cinesplat_scene::Gaussians;

/// Bytes per splat before its pairs are listed: the splat and two sort keys.
const BYTES_PER_SPLAT: u64 = (batch::BYTES_PER_SPLAT + 2 * size_of::<DepthKey>()) as u64;
/// Bytes of the pairs of a splat in a typical scene.
const PAIR_BYTES_PER_SPLAT: u64 = 8;

/// Buffers of one picture, kept for the next.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    splats: Splats,
    order: DepthOrder,
    bins: Bins,
    workspaces: Pool<Workspace>,
    /// Number of splats of the previous picture per Gaussian in its visible groups; `None` before the
    /// first picture.
    visible_frac: Option<f64>,
}

impl Buffers {
    /// Bytes that the buffers have allocated.
    pub(super) fn bytes(&self) -> u64 {
        self.order.bytes() + self.splats.bytes() + self.bins.bytes() + self.workspaces.sum(|_| Workspace::BYTES as u64)
    }
}

/// Renders onto a canvas of the view's size, which must be there unless the payload takes the weights.
///
/// # Errors
/// [`RenderError::Cost`] and [`RenderError::Memory`] where the picture exceeds the limits.
pub(super) fn render<P: Payload>(
    scene: (&Gaussians, &Groups),
    view: &View,
    settings: &RenderSettings,
    buffers: &mut Buffers,
    (canvas, sweep, payload): (Option<Canvas<'_>>, Option<&ViewSweep>, &P),
) -> Result<(RenderStats, Vec<P::TileOutput>), RenderError> {
    let (gaussians, groups) = scene;
    let mut budget = Budget::of_picture(view, &settings.limits)?;
    budget.take("the renderer's copy of the Gaussians", groups.bytes())?;
    if view.reuses_order {
        budget.take("the depth order", gaussians.len() as u64 * size_of::<u32>() as u64)?;
    }
    let bytes_before_bands = budget.bytes_before_bands(gaussians.len(), u64::from(view.width) * u64::from(view.height));
    budget.take("buffers of the threads", (rayon::current_num_threads() * Workspace::BYTES) as u64)?;
    let bands = &canvas.map_or_else(Vec::new, |canvas| canvas.into_bands(view.width as usize));
    let grid = TileGrid::of(view);
    let mut picture = Picture {
        scene,
        view,
        sweep,
        settings,
        buffers: &mut *buffers,
        payload,
        bands,
        grid,
        budget,
        bytes_before_bands,
        stats: RenderStats::default(),
        num_in_view: 0,
    };
    let mut outputs = Vec::with_capacity(grid.len());
    picture.render_rows(0..grid.down, &mut outputs)?;
    picture.stats.counts.num_subframes = 1;
    let Picture { stats, num_in_view, .. } = picture;
    buffers.visible_frac = Some((stats.counts.num_splats as f64 / num_in_view.max(1) as f64).min(1.0));
    Ok((stats, outputs))
}

/// A picture that is being rendered, from the first row of tiles to the last.
struct Picture<'a, P: Payload> {
    scene: (&'a Gaussians, &'a Groups),
    view: &'a View,
    /// The pictures whose mean light is taken; `None` = that of the view alone.
    sweep: Option<&'a ViewSweep>,
    settings: &'a RenderSettings,
    buffers: &'a mut Buffers,
    payload: &'a P,
    /// The canvas, one band per row of tiles; none if the payload takes the weights.
    bands: &'a [Band<'a>],
    grid: TileGrid,
    /// Budget for the splats of a band.
    budget: Budget,
    /// Bytes above which the picture is rendered in bands.
    bytes_before_bands: u64,
    stats: RenderStats,
    /// Number of Gaussians in visible groups; the largest number over the bands.
    num_in_view: u64,
}

impl<P: Payload> Picture<'_, P> {
    /// Renders rows of tiles together, or each half by itself if that would take too much memory. Appends the payload's
    /// output of each tile.
    ///
    /// # Errors
    /// [`RenderError::Cost`], and [`RenderError::Memory`] if a single row exceeds the limit.
    fn render_rows(&mut self, rows: Range<usize>, outputs: &mut Vec<P::TileOutput>) -> Result<(), RenderError> {
        match self.render_at_once(&rows, outputs) {
            Err(RenderError::Memory { .. }) if rows.len() > 1 => {
                let middle = usize::midpoint(rows.start, rows.end);
                self.render_rows(rows.start..middle, outputs)?;
                self.render_rows(middle..rows.end, outputs)
            }
            result => result,
        }
    }

    /// Renders rows of tiles together.
    ///
    /// # Errors
    /// [`RenderError::Cost`]; [`RenderError::Memory`], with nothing rendered, also if several rows would take more than
    /// `bytes_before_bands`.
    fn render_at_once(&mut self, rows: &Range<usize>, outputs: &mut Vec<P::TileOutput>) -> Result<(), RenderError> {
        let (gaussians, groups) = self.scene;
        let Buffers { splats, order, bins, visible_frac, .. } = &mut *self.buffers;
        let grid = self.grid.rows(rows);
        let start = Instant::now();
        let projection = Projection::new(self.view, self.sweep, grid);
        let num_projected = splats.find_visible_groups(groups, &projection);
        self.num_in_view = self.num_in_view.max(num_projected);
        let mut budget = self.budget;
        budget.take("the splats", num_projected * BYTES_PER_SPLAT)?;
        let bytes_per_projected = visible_frac.unwrap_or(1.0) * (BYTES_PER_SPLAT + PAIR_BYTES_PER_SPLAT) as f64;
        let (found_bytes, limit_bytes) = ((num_projected as f64 * bytes_per_projected) as u64, self.bytes_before_bands);
        if rows.len() > 1 && found_bytes > limit_bytes {
            return Err(RenderError::Memory { what: "the splats", found_bytes, limit_bytes });
        }
        splats.fill(gaussians, groups, &projection);
        let projected = Instant::now();
        // The depth order of one band is of no use for the next band.
        let reuses_order = self.view.reuses_order && rows.len() == self.grid.down;
        let keys = order.of(splats, &View { reuses_order, ..*self.view }, gaussians);
        let (sorted, num_splats) = (Instant::now(), keys.len() as u64);
        let num_pairs = bins.fill(keys, splats, grid, &mut budget)?;
        self.budget.count_pairs(num_pairs);
        self.payload.set_limit(budget.left_bytes());
        let binned = Instant::now();
        let num_block_blends = self.blend(grid, outputs);
        let StageTimes { project, sort, bin, blend } = &mut self.stats.times;
        *project += projected - start;
        *sort += sorted - projected;
        *bin += binned - sorted;
        *blend += binned.elapsed();
        let counts = &mut self.stats.counts;
        counts.num_projected += num_projected;
        counts.num_splats += num_splats;
        counts.num_pairs += num_pairs;
        counts.num_block_blends += num_block_blends;
        Ok(())
    }

    /// Blends the binned tiles; returns the number of blended splat-block pairs.
    fn blend(&self, grid: TileGrid, outputs: &mut Vec<P::TileOutput>) -> u64 {
        let precision = self.settings.effective_accuracy().precision;
        let tiles = (0..grid.len()).into_par_iter().with_max_len(1);
        let (blends, new): (Vec<u64>, Vec<P::TileOutput>) = match precision {
            Precision::Exact => tiles.map(|tile_idx| self.blend_tile::<Exact>(grid, tile_idx)).unzip(),
            Precision::Quick => tiles.map(|tile_idx| self.blend_tile::<Quick>(grid, tile_idx)).unzip(),
        };
        outputs.extend(new);
        blends.into_iter().sum()
    }

    /// Blends one tile and writes it onto the canvas: the picture of the view or, in a sweep, as many pictures as the tile
    /// needs.
    fn blend_tile<A: Arithmetic>(&self, grid: TileGrid, tile_idx: usize) -> (u64, P::TileOutput) {
        let Buffers { splats, bins, workspaces, .. } = &*self.buffers;
        let column_row = [tile_idx % grid.across, grid.first_row + tile_idx / grid.across];
        let origin_px = column_row.map(|position| position * TILE_PX);
        let area = TileArea { origin_px, width: self.view.width as usize, height: self.view.height as usize };
        let mut sink = self.payload.sink(area);
        workspaces.with(|workspace| {
            let mut num_blends = 0;
            let mut blend = |sample: Option<&Sample>, workspace: &mut Workspace| {
                let places = bins.of_tile(tile_idx);
                let (view, sink, arithmetic) = (self.view, &mut sink, PhantomData::<A>);
                let tile =
                    Tile { origin_px, places, splats, view, sample, workspace: &mut *workspace, sink, arithmetic };
                let num_taken = view.instructions.dispatch(tile);
                num_blends += workspace.num_block_blends();
                num_taken
            };
            let num_taken = blend(None, workspace);
            if P::Sink::TAKES_WEIGHTS {
                return (num_blends, self.payload.finish(sink, area));
            }
            let seen = || bins.of_tile(tile_idx).flatten().take(num_taken).map(|&place| splats.get(place));
            match self.sweep.map(|sweep| sweep.pattern_of(seen())) {
                None => self.write(column_row, workspace, None),
                Some(None) => self.write(column_row, workspace, Some((1.0, true))),
                Some(Some(pattern)) => {
                    let is_seen = pattern.center_weight > 0.0;
                    if is_seen {
                        self.write(column_row, workspace, Some((pattern.center_weight, true)));
                    }
                    for (idx, sample) in pattern.around.iter().enumerate() {
                        blend(Some(sample), workspace);
                        self.write(column_row, workspace, Some((sample.weight, idx == 0 && !is_seen)));
                    }
                }
            }
            (num_blends, self.payload.finish(sink, area))
        })
    }

    /// Writes a blended tile onto the canvas, with its share in a sum of light.
    fn write(&self, [column, row]: [usize; 2], workspace: &Workspace, share: Option<(f32, bool)>) {
        let (pixels, band, width) = (workspace.pixels(), &self.bands[row], self.view.width as usize);
        let background = self.settings.visible_background().to_array();
        self.view.instructions.dispatch(FinishedTile { pixels, band, column, width, background, share });
    }
}
