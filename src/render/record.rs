/// A splat relative to the corner of a tile: u = `ux` x + `uy` y + `u0` and v = `vy` y + `v0` at position (x, y) in the
/// tile, all in the units of an [`super::kernel::Arithmetic`].
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

/// Splats per chunk of a tile: as many as a byte can number.
pub(super) const RECORDS_LEN: usize = 256;
