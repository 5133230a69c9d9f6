//! A box of cubic cells in the world.

use glam::{DVec3, IVec3, UVec3};

use cinesplat_scene::Bounds;

/// Cells along the scene's size. Time and memory grow with its cube; a coarser grid closes narrow gaps. At 110 a room
/// of 7 m has cells of 6 cm, which resolve table legs and bottles.
const CELLS_ALONG_SIZE: f64 = 110.0;
/// Margin for the camera around the scene's core box (of the middle 96 % of the solid Gaussians), over the scene size:
/// sideways, and along up.
const MARGIN_FRAC: (f64, f64) = (0.55, 0.3);
/// Limit on the number of cells; the cells grow to meet it.
const MAX_CELLS: f64 = 6e6;

/// A box of cubic cells in the world.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    /// Lowest corner, world.
    pub(super) low: DVec3,
    /// Edge of a cell, scene units.
    pub(super) cell: f64,
    /// Number of cells along each axis.
    pub(super) dims: UVec3,
}

impl Grid {
    /// Cells over the scene's core box and a margin around it.
    pub(super) fn around(bounds: &Bounds, up: DVec3) -> Self {
        let size = bounds.size().max(1e-9);
        let upright = up.abs();
        let margin = (DVec3::splat(MARGIN_FRAC.0) * (1.0 - upright) + upright * MARGIN_FRAC.1) * size;
        let (low, high) = (bounds.core_min - margin, bounds.core_max + margin);
        Self::over(low, high, size / CELLS_ALONG_SIZE)
    }

    /// Cells with edge `cell` over a box; larger ones where there would be too many.
    pub(super) fn over(low: DVec3, high: DVec3, cell: f64) -> Self {
        let extent = high - low;
        let volume = extent.x * extent.y * extent.z;
        let cell = cell.max((volume / MAX_CELLS).cbrt());
        Self { low, cell, dims: (extent / cell).ceil().max(DVec3::ONE).as_uvec3() }
    }

    /// Number of cells.
    pub(super) fn len(&self) -> usize {
        self.dims.x as usize * self.dims.y as usize * self.dims.z as usize
    }

    /// Index of the cell at integer coordinates; `None` outside.
    pub(super) fn index_of(&self, at: IVec3) -> Option<usize> {
        let inside = at.cmpge(IVec3::ZERO).all() && at.cmplt(self.dims.as_ivec3()).all();
        inside.then(|| self.unchecked_index(at))
    }

    /// Index of the cell at integer coordinates that lie inside.
    pub(super) fn unchecked_index(&self, at: IVec3) -> usize {
        (at.x as usize * self.dims.y as usize + at.y as usize) * self.dims.z as usize + at.z as usize
    }

    /// Integer coordinates of a cell.
    pub(super) fn cell_of(&self, index: usize) -> IVec3 {
        let (ny, nz) = (self.dims.y as usize, self.dims.z as usize);
        IVec3::new((index / (ny * nz)) as i32, (index / nz % ny) as i32, (index % nz) as i32)
    }

    /// Middle of a cell, world.
    pub(super) fn middle(&self, index: usize) -> DVec3 {
        self.low + (self.cell_of(index).as_dvec3() + 0.5) * self.cell
    }

    /// Index of the cell that contains a world point; `None` outside.
    pub(super) fn index_at(&self, point: DVec3) -> Option<usize> {
        self.index_of(((point - self.low) / self.cell).floor().as_ivec3())
    }
}
