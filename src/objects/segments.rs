//! Groups of voxels: what touches, and what within it differs in color.

use super::color;
use super::voxels::VoxelGrid;

/// Disjoint sets with sizes (Tarjan 1975).
#[derive(Debug, Clone)]
pub(crate) struct Sets {
    parents: Vec<usize>,
    sizes: Vec<usize>,
}

impl Sets {
    /// `len` sets of one.
    pub(crate) fn new(len: usize) -> Self {
        Self { parents: (0..len).collect(), sizes: vec![1; len] }
    }

    /// The one member that stands for an item's set.
    pub(crate) fn find(&mut self, mut item: usize) -> usize {
        while self.parents[item] != item {
            self.parents[item] = self.parents[self.parents[item]];
            item = self.parents[item];
        }
        item
    }

    /// Number of items in an item's set.
    pub(crate) fn size(&mut self, item: usize) -> usize {
        let root = self.find(item);
        self.sizes[root]
    }

    /// Makes one set of two; returns the member that stands for it.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> usize {
        let (a, b) = (self.find(a), self.find(b));
        let (small, large) = if (self.sizes[a], b) < (self.sizes[b], a) { (a, b) } else { (b, a) };
        if small != large {
            self.parents[small] = large;
            self.sizes[large] += self.sizes[small];
        }
        large
    }

    /// The sets among `items`, each in order of `items`, in order of their first members.
    pub(crate) fn groups(&mut self, items: &[usize]) -> Vec<Vec<usize>> {
        let mut group_of_root = vec![usize::MAX; self.parents.len()];
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &item in items {
            let root = self.find(item);
            if group_of_root[root] == usize::MAX {
                group_of_root[root] = groups.len();
                groups.push(Vec::new());
            }
            groups[group_of_root[root]].push(item);
        }
        groups
    }
}

/// The connected parts of some voxels: two are neighbors when they are at most `reach` cells apart.
pub(crate) fn components(grid: &VoxelGrid, voxels: &[usize], reach: i32) -> Vec<Vec<usize>> {
    let mut chosen = vec![false; grid.voxels.len()];
    for &voxel in voxels {
        chosen[voxel] = true;
    }
    let mut sets = Sets::new(grid.voxels.len());
    for &voxel in voxels {
        for other in grid.neighbors(voxel, reach).filter(|&other| other < voxel && chosen[other]) {
            sets.join(voxel, other);
        }
    }
    sets.groups(voxels)
}

/// Splits touching voxels where color or direction changes, by the graph-based segmentation of Felzenszwalb and
/// Huttenlocher (2004): two parts stay apart when the weakest edge between them is stronger than the strongest needed
/// inside either, plus `scale` over its size. Parts of fewer than `min_voxels` join the neighbor most like them.
pub(crate) fn split_by_color(grid: &VoxelGrid, voxels: &[usize], scale: f32, min_voxels: usize) -> Vec<Vec<usize>> {
    let edges = edges(grid, voxels);
    let mut sets = Sets::new(grid.voxels.len());
    let mut thresholds = vec![scale; grid.voxels.len()];
    for &(weight, a, b) in &edges {
        let (a, b) = (sets.find(a), sets.find(b));
        if a != b && weight <= thresholds[a].min(thresholds[b]) {
            let joined = sets.join(a, b);
            thresholds[joined] = weight + scale / sets.size(joined) as f32;
        }
    }
    for &(_, a, b) in &edges {
        if sets.size(a) < min_voxels || sets.size(b) < min_voxels {
            sets.join(a, b);
        }
    }
    sets.groups(voxels)
}

/// Color units that a right angle between two surfaces counts for. Heavier (20), the folds of a curtain and the sides of
/// a chair fell apart; at 0, a white cupboard could not be told from the white wall beside it.
const TURN_WEIGHT: f32 = 6.0;

/// Edges between touching voxels of a set, weakest first: `(difference, voxel, voxel)`. The difference is that of the
/// colors (CIE Lab) and of the surfaces' directions, where a right angle counts [`TURN_WEIGHT`].
fn edges(grid: &VoxelGrid, voxels: &[usize]) -> Vec<(f32, usize, usize)> {
    let mut chosen = vec![false; grid.voxels.len()];
    for &voxel in voxels {
        chosen[voxel] = true;
    }
    let mut edges = Vec::new();
    for &a in voxels {
        for b in grid.neighbors(a, 1).filter(|&b| b < a && chosen[b]) {
            let (one, two) = (&grid.voxels[a], &grid.voxels[b]);
            let color = color::difference(one.color_lab, two.color_lab);
            let turned = if one.normal.length_squared() * two.normal.length_squared() > 0.0 {
                1.0 - one.normal.dot(two.normal).abs()
            } else {
                0.0
            };
            edges.push((color + TURN_WEIGHT * turned, a, b));
        }
    }
    edges.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    edges
}
