/// A splat relative to a tile's corner: u = `ux` x + `uy` y + `u0`, v = `vy` y + `v0` at pixel (x, y) of the tile, all in
/// the units of an [`super::kernel::Arithmetic`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record {
    pub(super) ux: f32,
    pub(super) uy: f32,
    pub(super) u0: f32,
    pub(super) vy: f32,
    pub(super) v0: f32,
    pub(super) level: f32,
    pub(super) color: [f32; 3],
    pub(super) depth: f32,
    pub(super) gaussian_idx: u32,
}

/// Splats that a tile looks at together: as many as a byte can number.
pub(super) const RECORDS_LEN: usize = 256;
