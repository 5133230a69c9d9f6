/// Features of the patches of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatchGrid {
    /// Number of patches from left to right.
    pub columns: usize,
    /// Number of patches from top to bottom.
    pub rows: usize,
    /// Numbers per patch.
    pub num_channels: usize,
    /// `[(row * columns + column) * num_channels + channel]`
    pub values: Vec<f32>,
}
