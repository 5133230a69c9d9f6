//! A bounding volume hierarchy over occluders.
//!
//! Enters: occluders and rays. Leaves: nearest intersections and occlusion. Invariant: the depth is bounded, so that a
//! traversal stack of fixed size suffices.

use glam::{Vec3, Vec3A};

use super::occluder::{Occluder, Ray, RayHit};

/// Size of the traversal stack.
const STACK: usize = 96;

/// Maximum number of occluders per leaf.
const LEAF: usize = 2;

#[derive(Debug, Clone, Copy)]
struct Node {
    low: Vec3A,
    high: Vec3A,
    /// First occluder of a leaf, or index of the second child of an inner node (the first child follows its parent).
    start: u32,
    /// Number of occluders in a leaf; 0 for an inner node.
    count: u32,
    /// Split axis of an inner node; the first child has the lower centers.
    axis: usize,
}

/// Occluders in a hierarchy of bounding boxes.
pub(super) struct OccluderBvh {
    occluders: Vec<Occluder>,
    nodes: Vec<Node>,
}

impl OccluderBvh {
    /// Builds the hierarchy by the surface area heuristic.
    pub(super) fn new(mut occluders: Vec<Occluder>) -> Self {
        let mut nodes = Vec::with_capacity(occluders.len());
        let count = occluders.len();
        if count > 0 {
            split(&mut occluders, 0, STACK - 32, &mut nodes);
        }
        Self { occluders, nodes }
    }

    /// The nearest intersection closer than `far`.
    pub(super) fn closest_hit(&self, ray: &Ray, far: f32) -> Option<RayHit> {
        self.traverse(ray, far, false)
    }

    /// Whether an occluder intersects the ray closer than `far`.
    pub(super) fn is_occluded(&self, ray: &Ray, far: f32) -> bool {
        self.traverse(ray, far, true).is_some()
    }

    /// Whether a point of a primitive lies at least `margin` inside another visible primitive.
    pub(super) fn is_buried(&self, point: Vec3, primitive: u32, margin: f32) -> bool {
        let at = Vec3A::from(point);
        let mut stack = vec![0_u32; usize::from(!self.nodes.is_empty())];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if at.cmplt(node.low).any() || at.cmpgt(node.high).any() {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.start, index + 1]);
            } else if self
                .leaf(node)
                .iter()
                .any(|b| b.owner.primitive != primitive && !b.shadow_only && b.contains(point, margin))
            {
                return true;
            }
        }
        false
    }

    fn leaf(&self, node: &Node) -> &[Occluder] {
        &self.occluders[node.start as usize..(node.start + node.count) as usize]
    }

    /// The nearest hit closer than `far`, or any hit if `any` is set.
    fn traverse(&self, ray: &Ray, mut far: f32, any: bool) -> Option<RayHit> {
        let (origin, inverse) = (Vec3A::from(ray.origin), Vec3A::from(ray.direction).recip());
        let mut best = None;
        let mut stack = [0_u32; STACK];
        let mut depth = usize::from(!self.nodes.is_empty());
        while depth > 0 {
            depth -= 1;
            let at = stack[depth];
            let node = &self.nodes[at as usize];
            let (a, b) = ((node.low - origin) * inverse, (node.high - origin) * inverse);
            let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
            if !(enter <= leave && enter < far) {
                continue;
            }
            if node.count == 0 {
                // The nearer child goes on top of the stack: a hit there prunes the farther one.
                let forward = ray.direction[node.axis] >= 0.0;
                let (near, far_child) = if forward { (at + 1, node.start) } else { (node.start, at + 1) };
                stack[depth] = far_child;
                stack[depth + 1] = near;
                depth += 2;
                continue;
            }
            for occluder in self.leaf(node) {
                if let Some(hit) = occluder.hit(ray, far) {
                    if any {
                        return Some(hit);
                    }
                    far = hit.distance;
                    best = Some(hit);
                }
            }
        }
        best
    }
}

/// Appends the subtree of occluders, the first of which has the index `start`. After `budget` levels it splits at the
/// median, which bounds the depth.
fn split(occluders: &mut [Occluder], start: usize, budget: usize, nodes: &mut Vec<Node>) {
    let low = occluders.iter().fold(Vec3A::INFINITY, |sum, b| sum.min(b.low));
    let high = occluders.iter().fold(Vec3A::NEG_INFINITY, |sum, b| sum.max(b.high));
    let own = nodes.len();
    nodes.push(Node { low, high, start: start as u32, count: occluders.len() as u32, axis: 0 });
    if occluders.len() <= LEAF {
        return;
    }
    let (axis, best) = best_split(occluders);
    let half = if budget > 0 { best } else { occluders.len() / 2 };
    sort_along(occluders, axis);
    let (left, right) = occluders.split_at_mut(half);
    let budget = budget.saturating_sub(1);
    split(left, start, budget, nodes);
    let second = nodes.len() as u32;
    split(right, start + half, budget, nodes);
    nodes[own] = Node { low, high, start: second, count: 0, axis };
}

fn sort_along(occluders: &mut [Occluder], axis: usize) {
    occluders.sort_by(|a, b| (a.low + a.high)[axis].total_cmp(&(b.low + b.high)[axis]));
}

/// Axis and size of the first group with the least surface area cost: area times count, summed over both groups.
fn best_split(occluders: &mut [Occluder]) -> (usize, usize) {
    let mut best = (f32::INFINITY, 0, occluders.len() / 2);
    for axis in 0..3 {
        sort_along(occluders, axis);
        let grown = |pair: &mut (Vec3A, Vec3A), b: &Occluder| {
            *pair = (pair.0.min(b.low), pair.1.max(b.high));
            let size = pair.1 - pair.0;
            Some(size.x * size.y + size.y * size.z + size.z * size.x)
        };
        let empty = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        let first: Vec<f32> = occluders.iter().scan(empty, grown).collect();
        let mut second: Vec<f32> = occluders.iter().rev().scan(empty, grown).collect();
        second.reverse();
        for count in 1..occluders.len() {
            let cost = first[count - 1] * count as f32 + second[count] * (occluders.len() - count) as f32;
            if cost < best.0 {
                best = (cost, axis, count);
            }
        }
    }
    (best.1, best.2)
}
