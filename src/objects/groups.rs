//! The voxels of one object.

/// The voxels of one object, before it has an id.
pub(crate) struct VoxelGroup {
    /// Positions in the grid's voxels.
    pub(crate) voxels: Vec<usize>,
    /// The object is only a level surface.
    pub(crate) is_surface: bool,
    /// Index of the group that this one is a part of.
    pub(crate) parent: Option<usize>,
    /// Name of a part, such as `neck`; `None` where a description has to do.
    pub(crate) name: Option<&'static str>,
}

impl VoxelGroup {
    /// A group that is no part of another one.
    pub(crate) fn whole(voxels: Vec<usize>, is_surface: bool) -> Self {
        Self { voxels, is_surface, parent: None, name: None }
    }
}
