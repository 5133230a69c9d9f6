//! Segmentation of voxels: connected components, and regions of similar color and direction.

use super::color;
use super::voxels::VoxelGrid;

/// Disjoint sets with sizes (union-find, Tarjan 1975).
#[derive(Debug, Clone)]
pub(crate) struct DisjointSets {
    parents: Vec<usize>,
    sizes: Vec<usize>,
}

impl DisjointSets {
    /// `len` sets of one item.
    pub(crate) fn new(len: usize) -> Self {
        Self { parents: (0..len).collect(), sizes: vec![1; len] }
    }

    /// The representative of an item's set.
    fn find(&mut self, mut item: usize) -> usize {
        while self.parents[item] != item {
            self.parents[item] = self.parents[self.parents[item]];
            item = self.parents[item];
        }
        item
    }

    /// Number of items in an item's set.
    fn size(&mut self, item: usize) -> usize {
        let root = self.find(item);
        self.sizes[root]
    }

    /// Joins two sets; returns the representative of the union.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> usize {
        let (a, b) = (self.find(a), self.find(b));
        let (small, large) = if (self.sizes[a], b) < (self.sizes[b], a) { (a, b) } else { (b, a) };
        if small != large {
            self.parents[small] = large;
            self.sizes[large] += self.sizes[small];
        }
        large
    }

    /// The sets of `items`, sorted by their first members; each keeps the order of `items`.
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

/// The connected components of some voxels; neighbors are at most `reach` cells apart.
pub(crate) fn components(grid: &VoxelGrid, voxels: &[usize], reach: i32) -> Vec<Vec<usize>> {
    let mut chosen = vec![false; grid.voxels.len()];
    for &voxel in voxels {
        chosen[voxel] = true;
    }
    let mut sets = DisjointSets::new(grid.voxels.len());
    for &voxel in voxels {
        for other in grid.neighbors(voxel, reach).filter(|&other| other < voxel && chosen[other]) {
            sets.join(voxel, other);
        }
    }
    sets.groups(voxels)
}

/// Splits touching voxels where color or direction changes, by the graph-based segmentation of Felzenszwalb and
/// Huttenlocher (2004): two regions stay separate where the weakest edge between them exceeds the strongest edge of the
/// spanning tree of either, plus `scale` over its size. Regions of fewer than `min_voxels` join their most similar
/// neighbor.
pub(crate) fn split_by_color(grid: &VoxelGrid, voxels: &[usize], scale: f32, min_voxels: usize) -> Vec<Vec<usize>> {
    let edges = edges(grid, voxels);
    let mut sets = DisjointSets::new(grid.voxels.len());
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

/// Weight of a right angle between two surfaces, in color units. At 20 the folds of a curtain and the sides of a chair
/// became separate objects; at 0 a white cupboard merged with the white wall beside it.
const TURN_WEIGHT: f32 = 6.0;

/// Edges between touching voxels of a set, weakest first: `(weight, voxel, voxel)`. The weight is the color difference
/// plus the difference of the surfaces' directions, where a right angle counts [`TURN_WEIGHT`].
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
