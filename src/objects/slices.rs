//! Pieces of a thing across an axis.

use glam::{Vec3, Vec4};

/// A piece of a thing across its axis.
pub(crate) struct Slice {
    pub(crate) voxels: Vec<usize>,
    /// Binary logarithm of the width, and color.
    pub(crate) features: Vec4,
    /// Distance of the voxels from their middle, root mean square, scene units.
    pub(crate) width: f32,
    /// Mean color, CIE Lab.
    pub(crate) color_lab: Vec3,
    /// Share of the voxels that have the color of skin.
    pub(crate) skin_frac: f32,
}
