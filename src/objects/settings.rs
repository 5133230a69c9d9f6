//! Settings of the search for objects.

/// Settings of [`find`](crate::find()).
#[derive(Debug, Clone, PartialEq)]
pub struct FindSettings {
    /// Cells along the scene's size. More cells separate smaller and closer objects; the cost grows with the square.
    pub resolution: f64,
    /// Least number of voxels (occupied cells) per object.
    pub min_voxels: usize,
    /// Limit on the number of objects; the most prominent ones are kept.
    pub max_objects: usize,
    /// Diagonal of a connected component, over the scene size, above which it is split by color.
    pub split_frac: f64,
    /// Scale of that split, CIE Lab units times voxels: a larger scale gives larger pieces.
    pub split_scale: f32,
    /// How far down the tree of wholes and parts to go: 0 = wholes alone, 1 = also the parts of captures that show single
    /// things, and what lies inside other objects of a room; 2 = also the parts of the things of a room.
    pub detail: u8,
    /// Seed of the plane search.
    pub seed: u64,
}

impl Default for FindSettings {
    fn default() -> Self {
        Self {
            resolution: 220.0,
            min_voxels: 24,
            max_objects: 100,
            split_frac: 0.3,
            split_scale: 140.0,
            detail: 1,
            seed: 0,
        }
    }
}
