//! The `f32` path from Gaussians to a picture: the four stages one after the other.

use std::marker::PhantomData;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use rayon::prelude::*;

use super::bin::{Bins, TILE_PX, TileGrid};
use super::blend::{Tile, Workspace};
use super::canvas::{Canvas, Finished};
use super::groups::{Groups, LANES};
use super::kernel::{Arithmetic, Exact, Quick};
use super::memory::Budget;
use super::order::DepthOrder;
use super::payload::{Payload, TileArea};
use super::sort::DepthKey;
use super::splats::{self, Splats};
use super::{Precision, RenderError, RenderSettings, RenderStats, StageTimes, View, WorkCounts};
use crate::scene::Gaussians;

/// Most bytes that a splat takes until its pairs are listed: itself, two keys, the tiles that it touches.
const BYTES_A_SPLAT: usize = splats::BYTES_A_SPLAT + 2 * size_of::<DepthKey>() + size_of::<[u16; 4]>();

/// Work lists of one picture, kept for the next.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    splats: Splats,
    order: DepthOrder,
    bins: Bins,
    workspaces: Pool<Workspace>,
}

impl Buffers {
    /// Bytes that they hold on to.
    pub(super) fn bytes(&self) -> u64 {
        self.order.bytes() + self.splats.bytes() + self.bins.bytes() + self.workspaces.sum(|_| Workspace::BYTES as u64)
    }
}

/// Things that are lent one at a time.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<T: Default> Pool<T> {
    /// Calls `work` with a thing of the pool, or with a new one while all are lent.
    pub(super) fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let free = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut thing = free.unwrap_or_default();
        let result = work(&mut thing);
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(thing);
        result
    }

    /// Sum over all things that are not lent.
    pub(super) fn sum(&self, size: impl Fn(&T) -> u64) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().map(size).sum()
    }
}

/// Renders onto a canvas of the view's size.
///
/// # Errors
/// [`RenderError::Cost`] and [`RenderError::Memory`] where the picture exceeds the limits.
pub(super) fn render<P: Payload>(
    (gaussians, groups): (&Gaussians, &Groups),
    view: &View,
    settings: &RenderSettings,
    buffers: &mut Buffers,
    (canvas, payload): (Canvas<'_>, &P),
) -> Result<(RenderStats, Vec<P::Part>), RenderError> {
    let Buffers { splats, order, bins, workspaces } = buffers;
    let mut budget = Budget::of_picture(view, &settings.limits)?;
    budget.take("the renderer's copy of the Gaussians", groups.bytes())?;
    budget.take("buffers of the threads", (rayon::current_num_threads() * Workspace::BYTES) as u64)?;
    budget.take("the splats", (groups.packs.len() * LANES * BYTES_A_SPLAT + gaussians.len() * 4) as u64)?;
    let start = Instant::now();
    let num_projected = splats.fill(gaussians, groups, view);
    let projected = Instant::now();
    let keys = order.of(splats, view, gaussians);
    let sorted = Instant::now();
    let num_pairs = bins.fill(keys, splats, view, &mut budget)?;
    payload.allow(budget.left_bytes());
    let binned = Instant::now();
    let tiles = (&*splats, &*bins);
    let precision =
        if view.alpha_cut < 1.0 / 256.0 { Precision::Exact } else { settings.effective_accuracy().precision };
    let (num_block_blends, parts) = match precision {
        Precision::Exact => blend_tiles::<Exact, P>(tiles, view, settings, workspaces, (canvas, payload)),
        Precision::Quick => blend_tiles::<Quick, P>(tiles, view, settings, workspaces, (canvas, payload)),
    };
    let stats = RenderStats {
        times: StageTimes {
            project: projected - start,
            sort: sorted - projected,
            bin: binned - sorted,
            blend: binned.elapsed(),
        },
        counts: WorkCounts { num_projected, num_splats: keys.len() as u64, num_pairs, num_block_blends },
    };
    Ok((stats, parts))
}

/// Blends all tiles; returns the number of overlaps between splats and blocks, and what the payload leaves of each tile.
fn blend_tiles<A: Arithmetic + Send, P: Payload>(
    (splats, bins): (&Splats, &Bins),
    view: &View,
    settings: &RenderSettings,
    workspaces: &Pool<Workspace>,
    (canvas, payload): (Canvas<'_>, &P),
) -> (u64, Vec<P::Part>) {
    let width = view.width as usize;
    let grid = TileGrid::of(view);
    let bands = canvas.into_bands(width);
    let blend = |tile_idx: usize| {
        workspaces.with(|workspace| {
            let (column, row) = (tile_idx % grid.across, tile_idx / grid.across);
            let origin_px = [column * TILE_PX, row * TILE_PX];
            let places = bins.of_tile(tile_idx);
            let area = TileArea { origin_px, width, height: view.height as usize };
            let mut sink = payload.sink(area);
            let (workspace, arithmetic) = (&mut *workspace, PhantomData::<A>);
            let tile =
                Tile { origin_px, places, splats, view, workspace: &mut *workspace, sink: &mut sink, arithmetic };
            view.instructions.dispatch(tile);
            let background = settings.background.to_array();
            let pixels = workspace.pixels();
            view.instructions.dispatch(Finished { pixels, band: &bands[row], column, width, background });
            (workspace.num_block_blends(), payload.part(sink, area))
        })
    };
    let (blends, parts): (Vec<u64>, Vec<P::Part>) = (0..grid.len()).into_par_iter().with_max_len(1).map(blend).unzip();
    (blends.into_iter().sum(), parts)
}
