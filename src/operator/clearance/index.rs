//! The ellipsoid nearest to a point, by a bounding volume hierarchy with eight boxes per node in flat arrays.
//!
//! The ellipsoids are sorted by size class, then by the Morton code of their means, so that large ones do not enlarge
//! the boxes of small ones. Every eight neighbors share a node, and every eight nodes share a parent. The boxes are
//! `f32`, widened by more than the rounding error of a query: a box is never farther from a point than its contents.

use glam::DVec3;
use rayon::prelude::*;

use super::ellipsoid::Ellipsoid;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};

/// Number of standard deviations of a Gaussian that count as matter. There its opacity has fallen to a third of its
/// peak: a Gaussian of opacity 0.5 hides a sixth of the light.
pub const SIGMA_LEVEL: f64 = 1.5;
/// Children per node.
const WIDTH: usize = 8;
/// Thresholds between the size classes: largest half extent over the extent of all means.
const LARGE_FRACS: [f64; 3] = [1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0];
/// Widening of a box over the largest coordinate: four rounding errors of `f32`.
const BOX_ROUNDING: f64 = 2.5e-7;
/// Factor that turns a computed squared distance to a box into a lower bound.
const LOWER_BOUND_FACTOR: f32 = 1.0 - 4e-6;

/// The matter of a scene, indexed for nearest-neighbor queries.
#[derive(Debug, Clone)]
pub struct ClearanceIndex {
    origin: DVec3,
    ellipsoids: Vec<Ellipsoid>,
    /// Index of each ellipsoid's Gaussian in the scene.
    gaussians: Vec<u32>,
    /// Levels of nodes. The children of the first level are the ellipsoids; the last level is the root.
    levels: Vec<Vec<BoxNode>>,
}

/// The ellipsoid nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Distance to its surface, scene units; 0 inside.
    pub distance: f64,
    /// Index of its Gaussian in the scene.
    pub gaussian_idx: u32,
}

/// The boxes of eight children, axis by axis. A missing child has an empty box, which is infinitely far from every
/// point.
#[derive(Debug, Clone, Copy)]
struct BoxNode {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
}

const EMPTY: BoxNode = BoxNode { low: [[f32::INFINITY; WIDTH]; 3], high: [[f32::NEG_INFINITY; WIDTH]; 3] };

impl ClearanceIndex {
    /// Indexes the ellipsoids of all Gaussians of at least [`SOLID_OPACITY`], out to [`SIGMA_LEVEL`] standard
    /// deviations.
    pub fn new(gaussians: &Gaussians) -> Self {
        let ellipsoid = |i: u32| {
            let i = i as usize;
            Ellipsoid { mean: gaussians.means[i], rotation: gaussians.rotations[i], scales: gaussians.scales[i] }
        };
        let solid: Vec<u32> =
            (0..gaussians.len() as u32).filter(|&i| gaussians.opacities[i as usize] >= SOLID_OPACITY).collect();
        let half_extents: Vec<DVec3> = solid.par_iter().map(|&i| ellipsoid(i).half_extents(SIGMA_LEVEL)).collect();
        let order = order(gaussians, &solid, &half_extents);
        let ellipsoids: Vec<Ellipsoid> = order.par_iter().map(|&at| ellipsoid(solid[at as usize])).collect();
        let reach = |i: &u32| gaussians.means[*i as usize].abs().max_element();
        let widening = BOX_ROUNDING * f64::from(solid.iter().map(reach).fold(0.0, f32::max));
        let bounds = |(ellipsoid, &at): (&Ellipsoid, &u32)| {
            let half = half_extents[at as usize] * (1.0 + BOX_ROUNDING) + widening;
            let mean = ellipsoid.mean.as_dvec3();
            ((mean - half).as_vec3().to_array(), (mean + half).as_vec3().to_array())
        };
        let boxes: Vec<([f32; 3], [f32; 3])> = ellipsoids.par_iter().zip(&order).map(bounds).collect();
        let gaussians_of = order.iter().map(|&at| solid[at as usize]).collect();
        Self { origin: gaussians.origin, ellipsoids, gaussians: gaussians_of, levels: levels(&boxes) }
    }

    /// Number of ellipsoids.
    pub fn len(&self) -> usize {
        self.ellipsoids.len()
    }

    /// Whether the scene has no matter.
    pub fn is_empty(&self) -> bool {
        self.ellipsoids.is_empty()
    }

    /// The ellipsoid nearest to a world point; `None` where none is nearer than `cutoff`, scene units.
    ///
    /// The distance exceeds the true one by at most 1e-12 of the coordinates' magnitude.
    pub fn nearest_within(&self, point: DVec3, cutoff: f64) -> Option<Nearest> {
        let point = point - self.origin;
        let single = point.as_vec3().to_array();
        let mut best = cutoff;
        let mut found = None;
        let mut stack: Vec<(f32, u32, u32)> = Vec::with_capacity(64);
        stack.extend(self.levels.len().checked_sub(1).map(|top| (0.0, top as u32, 0)));
        while let Some((squared, level, at)) = stack.pop() {
            if f64::from(squared) >= best * best {
                continue;
            }
            let squares = self.levels[level as usize][at as usize].squared_distances(single);
            let first = stack.len();
            for (child, &squared) in squares.iter().enumerate() {
                if f64::from(squared) < best * best {
                    stack.push((squared, level.wrapping_sub(1), at * WIDTH as u32 + child as u32));
                }
            }
            // The nearest child goes last on the stack, so that it is visited first.
            stack[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.2.cmp(&a.2)));
            if level > 0 {
                continue;
            }
            while stack.len() > first {
                let Some((squared, _, at)) = stack.pop() else { break };
                if f64::from(squared) >= best * best {
                    continue;
                }
                if let Some(distance) = self.ellipsoids[at as usize].distance_below(point, SIGMA_LEVEL, best) {
                    (best, found) = (distance, Some(at));
                }
            }
        }
        found.map(|at| Nearest { distance: best, gaussian_idx: self.gaussians[at as usize] })
    }
}

impl BoxNode {
    /// Lower bounds on the squared distances from a point to the eight boxes.
    fn squared_distances(&self, point: [f32; 3]) -> [f32; WIDTH] {
        let mut sum = [0.0_f32; WIDTH];
        for ((low, high), at) in self.low.iter().zip(&self.high).zip(point) {
            for ((sum, low), high) in sum.iter_mut().zip(low).zip(high) {
                let apart = (low - at).max(at - high).max(0.0);
                *sum += apart * apart;
            }
        }
        sum.map(|squared| squared * LOWER_BOUND_FACTOR)
    }

    /// The bounding box of all children.
    fn hull(&self) -> ([f32; 3], [f32; 3]) {
        let low = self.low.map(|axis| axis.into_iter().fold(f32::INFINITY, f32::min));
        let high = self.high.map(|axis| axis.into_iter().fold(f32::NEG_INFINITY, f32::max));
        (low, high)
    }
}

/// Positions in `solid`, sorted by size class, then Morton code of the mean, then position.
fn order(gaussians: &Gaussians, solid: &[u32], half_extents: &[DVec3]) -> Vec<u32> {
    let mean = |at: usize| gaussians.means[solid[at] as usize].as_dvec3();
    let (low, high) = (0..solid.len())
        .map(mean)
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), mean| (low.min(mean), high.max(mean)));
    let extent = (high - low).max_element().max(f64::MIN_POSITIVE);
    let key = |at: usize| {
        let half = half_extents[at].max_element() / extent;
        let class = LARGE_FRACS.iter().filter(|&&frac| half > frac).count() as u64;
        let cell = ((mean(at) - low) / extent * f64::from((1 << 20) - 1)).as_uvec3();
        (class << 60 | spaced(cell.x) << 2 | spaced(cell.y) << 1 | spaced(cell.z), at as u32)
    };
    let mut keys: Vec<(u64, u32)> = (0..solid.len()).into_par_iter().map(key).collect();
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, at)| at).collect()
}

/// The lowest 20 bits, with two zeros after each.
fn spaced(bits: u32) -> u64 {
    let mut x = u64::from(bits) & 0xF_FFFF;
    for (shift, mask) in [
        (32, 0x001F_0000_0000_FFFF),
        (16, 0x001F_0000_FF00_00FF),
        (8, 0x100F_00F0_0F00_F00F),
        (4, 0x10C3_0C30_C30C_30C3),
        (2, 0x1249_2492_4924_9249),
    ] {
        x = (x | x << shift) & mask;
    }
    x
}

/// The nodes of every level, from the boxes of single ellipsoids up to the root.
fn levels(boxes: &[([f32; 3], [f32; 3])]) -> Vec<Vec<BoxNode>> {
    let mut levels: Vec<Vec<BoxNode>> = Vec::new();
    let mut below = boxes.to_vec();
    while below.len() > 1 || (levels.is_empty() && !below.is_empty()) {
        let nodes: Vec<BoxNode> = below.par_chunks(WIDTH).map(node).collect();
        below = nodes.iter().map(BoxNode::hull).collect();
        levels.push(nodes);
    }
    levels
}

fn node(boxes: &[([f32; 3], [f32; 3])]) -> BoxNode {
    let mut node = EMPTY;
    for (child, (low, high)) in boxes.iter().enumerate() {
        for axis in 0..3 {
            node.low[axis][child] = low[axis];
            node.high[axis][child] = high[axis];
        }
    }
    node
}
