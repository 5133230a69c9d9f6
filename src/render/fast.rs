//! The `f32` path from Gaussians to a picture: the four stages one after the other.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::bin::{Bins, TILE_PX, TileGrid};
use super::blend::{Tile, Workspace};
use super::groups::Groups;
use super::payload::{Payload, TileArea};
use super::sort::{self, DepthKey};
use super::splats::Splats;
use super::{Frame, RenderError, RenderSettings, RenderStats, StageTimes, View, WorkCounts};
use crate::scene::Gaussians;

/// Work lists of one picture, kept for the next.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    splats: Splats,
    keys: Vec<DepthKey>,
    spare_keys: Vec<DepthKey>,
    bins: Bins,
    workspaces: Pool<Workspace>,
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
}

/// Renders into a frame of the view's size.
///
/// # Errors
/// [`RenderError::Cost`] and [`RenderError::Memory`] where the picture exceeds the limits.
pub(super) fn render<P: Payload>(
    (gaussians, groups): (&Gaussians, &Groups),
    view: &View,
    settings: &RenderSettings,
    buffers: &mut Buffers,
    (frame, payload): (&mut Frame, &P),
) -> Result<Vec<P::Part>, RenderError> {
    let Buffers { splats, keys, spare_keys, bins, workspaces } = buffers;
    let start = Instant::now();
    let num_projected = splats.fill(gaussians, groups, view);
    let projected = Instant::now();
    splats.write_keys(keys);
    sort::sort(keys, spare_keys, |place| splats.gaussian_idx(place));
    let sorted = Instant::now();
    let num_pairs = bins.fill(keys, splats, view, &settings.limits)?;
    let binned = Instant::now();
    let (num_block_blends, parts) = blend_tiles((splats, bins), view, settings, workspaces, (frame, payload));
    frame.stats = RenderStats {
        times: StageTimes {
            project: projected - start,
            sort: sorted - projected,
            bin: binned - sorted,
            blend: binned.elapsed(),
        },
        counts: WorkCounts { num_projected, num_splats: keys.len() as u64, num_pairs, num_block_blends },
    };
    Ok(parts)
}

/// Rows of the picture that a row of tiles writes to: color and transmittance.
type Band<'a> = Mutex<(&'a mut [f32], &'a mut [f32])>;

/// Blends all tiles; returns the number of overlaps between splats and blocks, and what the payload leaves of each tile.
fn blend_tiles<P: Payload>(
    (splats, bins): (&Splats, &Bins),
    view: &View,
    settings: &RenderSettings,
    workspaces: &Pool<Workspace>,
    (frame, payload): (&mut Frame, &P),
) -> (u64, Vec<P::Part>) {
    let width = view.width as usize;
    let grid = TileGrid::of(view);
    let rows = frame.rgb.chunks_mut(width * 3 * TILE_PX).zip(frame.transmittance.chunks_mut(width * TILE_PX));
    let bands: Vec<Band<'_>> = rows.map(Mutex::new).collect();
    let blend = |tile_idx: usize| {
        workspaces.with(|workspace| {
            let (column, row) = (tile_idx % grid.across, tile_idx / grid.across);
            let origin_px = [column * TILE_PX, row * TILE_PX];
            let places = bins.of_tile(tile_idx);
            let area = TileArea { origin_px, width, height: view.height as usize };
            let mut sink = payload.sink(area);
            let tile = Tile { origin_px, places, splats, view, workspace: &mut *workspace, sink: &mut sink };
            view.instructions.dispatch(tile);
            let background = settings.background.to_array();
            view.instructions.dispatch(Finished { workspace, band: &bands[row], column, width, background });
            (workspace.num_block_blends(), payload.part(sink, area))
        })
    };
    let (blends, parts): (Vec<u64>, Vec<P::Part>) = (0..grid.len()).into_par_iter().with_max_len(1).map(blend).unzip();
    (blends.into_iter().sum(), parts)
}

/// A finished tile on its way into the picture, compiled for every instruction set.
struct Finished<'a, 'frame> {
    workspace: &'a Workspace,
    band: &'a Band<'frame>,
    column: usize,
    width: usize,
    background: [f32; 3],
}

impl WithSimd for Finished<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { workspace, band, column, width, background } = self;
        let mut band = band.lock().unwrap_or_else(PoisonError::into_inner);
        let (left, right) = (column * TILE_PX, ((column + 1) * TILE_PX).min(width));
        let (rgb, transmittance) = &mut *band;
        let rows = rgb.chunks_mut(width * 3).zip(transmittance.chunks_mut(width)).enumerate();
        for (row, (rgb, transmittance)) in rows {
            workspace.write_row(row, background, &mut rgb[left * 3..right * 3], &mut transmittance[left..right]);
        }
    }
}
