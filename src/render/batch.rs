use super::splat::Splat;

/// Bytes that a splat takes in a batch.
pub(super) const BYTES_PER_SPLAT: usize = size_of::<Splat>() + size_of::<HotFields>();

/// The fields of a splat that sorting and binning read.
#[derive(Debug, Clone, Copy)]
pub(super) struct HotFields {
    /// Tiles that the splat overlaps: first and last column, first and last row.
    pub(super) rect: [u16; 4],
    /// Index of the Gaussian.
    pub(super) gaussian_idx: u32,
    /// Depth along the view axis, scene units.
    pub(super) depth: f32,
}

/// The splats of one batch of groups.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// The splats.
    pub(super) splats: Vec<Splat>,
    /// The hot fields of each splat, in an array of their own because sorting and binning visit splats in random order.
    pub(super) hot_fields: Vec<HotFields>,
}

impl Batch {
    /// Adds a splat and the tiles that it overlaps; see [`Splat::tile_rect`].
    #[inline(always)]
    pub(super) fn push(&mut self, splat: Splat, rect: [u16; 4]) {
        self.splats.push(splat);
        self.hot_fields.push(HotFields { rect, gaussian_idx: splat.gaussian_idx, depth: splat.depth });
    }
}
