//! Rays against the solids that stand in for parts, for baked light: a bounding volume hierarchy over boxes, ellipsoids
//! and upright drums. All `f32`, world frame, m.

use glam::{DVec3, Mat3A, Quat, Vec3, Vec3A};

use super::place::Place;

/// Deepest hierarchy that a ray can walk.
const STACK: usize = 96;

/// Most blockers in a leaf.
const LEAF: usize = 2;

/// Unit shape of a blocker in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Solid {
    /// Cube of half extent one.
    Box,
    /// Ball of radius one.
    Ellipsoid,
    /// Drum of radius one about y, half height one.
    Cylinder,
}

/// A solid in the world that stops light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blocker {
    solid: Solid,
    object: u16,
    /// Part that it stands for, counted over the scene.
    part: u32,
    /// Whether it cannot be seen, so that it hides nothing.
    ghost: bool,
    center: Vec3,
    /// World to own axes in units of the half extents.
    unit_from_world: Mat3A,
    world_from_own: Quat,
    half: Vec3,
    low: Vec3A,
    high: Vec3A,
}

/// What a ray meets first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// Distance along the ray.
    pub(super) distance: f32,
    /// Outward normal there.
    pub(super) normal: Vec3,
}

/// A ray that leaves a surface of an object.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    /// Start.
    pub(super) origin: Vec3,
    /// Unit direction.
    pub(super) direction: Vec3,
    /// Object that it leaves: its own solids do not count while the ray starts inside them.
    pub(super) object: u16,
    /// Part that it leaves, for rays that ask what hides it: boxes of other parts of the same object count even from
    /// inside, ghosts do not.
    pub(super) part: Option<u32>,
}

impl Blocker {
    /// A solid of half extents `half` at a place.
    pub(super) fn new(solid: Solid, place: Place, half: DVec3, (object, part): (u16, u32)) -> Self {
        let reach = DVec3::AXES
            .iter()
            .zip(half.to_array())
            .fold(DVec3::ZERO, |sum, (axis, h)| sum + (place.rotation * *axis * h).abs());
        Self {
            solid,
            object,
            part,
            ghost: false,
            center: place.translation.as_vec3(),
            unit_from_world: Mat3A::from_diagonal(half.as_vec3().recip())
                * Mat3A::from_quat(place.rotation.conjugate().as_quat()),
            world_from_own: place.rotation.as_quat(),
            half: half.as_vec3(),
            low: (place.translation - reach).as_vec3().into(),
            high: (place.translation + reach).as_vec3().into(),
        }
    }

    /// The same, stopping light without being seen.
    pub(super) fn unseen(self, ghost: bool) -> Self {
        Self { ghost, ..self }
    }

    /// Whether a point lies inside by at least `margin`.
    fn holds(&self, point: Vec3, margin: f32) -> bool {
        let inner = (self.half - margin).max(Vec3::ZERO) / self.half;
        let own = (self.unit_from_world * (point - self.center)).abs();
        match self.solid {
            Solid::Box => own.cmple(inner).all(),
            Solid::Ellipsoid => own.length() <= inner.min_element(),
            Solid::Cylinder => own.y <= inner.y && own.x.hypot(own.z) <= inner.x.min(inner.z),
        }
    }

    /// First entry closer than `far`. A ray that starts inside a solid of another object is stopped at once.
    fn hit(&self, ray: &Ray, far: f32) -> Option<Hit> {
        if self.ghost && ray.part.is_some() {
            return None;
        }
        let origin = self.unit_from_world * (ray.origin - self.center);
        let direction = self.unit_from_world * ray.direction;
        let (near, leave, axis) = match self.solid {
            Solid::Box => slabs(origin, direction),
            Solid::Ellipsoid => quadric(origin, direction, Vec3::ONE),
            Solid::Cylinder => drum(origin, direction),
        }?;
        if near <= 0.0 {
            let foreign = ray.object != self.object;
            let other_box = self.solid == Solid::Box && ray.part.is_some_and(|part| part != self.part);
            return (leave > 0.0 && (foreign || other_box)).then_some(Hit { distance: 0.0, normal: -ray.direction });
        }
        if near >= far {
            return None;
        }
        let at = origin + direction * near;
        let local = match axis {
            Some(axis) => -Vec3::AXES[axis] * direction[axis].signum(),
            None if self.solid == Solid::Cylinder => Vec3::new(at.x, 0.0, at.z) / self.half,
            None => at / self.half,
        };
        Some(Hit { distance: near, normal: (self.world_from_own * local).normalize_or(-ray.direction) })
    }
}

type Entry = Option<(f32, f32, Option<usize>)>;

fn slabs(origin: Vec3, direction: Vec3) -> Entry {
    let inverse = direction.recip();
    let (a, b) = ((-1.0 - origin) * inverse, (1.0 - origin) * inverse);
    let (near, far) = (a.min(b), a.max(b));
    let (enter, leave) = (near.max_element(), far.min_element());
    (enter < leave && leave > 0.0).then(|| (enter, leave, Some(near.max_position())))
}

/// Unit sphere, or the upright unit tube where `mask` drops y.
fn quadric(origin: Vec3, direction: Vec3, mask: Vec3) -> Entry {
    let (o, d) = (origin * mask, direction * mask);
    let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
    let root = b * b - a * c;
    if a < 1e-12 {
        return (c < 0.0).then_some((f32::NEG_INFINITY, f32::INFINITY, None));
    }
    if root <= 0.0 {
        return None;
    }
    let root = root.sqrt();
    let leave = (-b + root) / a;
    (leave > 0.0).then(|| ((-b - root) / a, leave, None))
}

fn drum(origin: Vec3, direction: Vec3) -> Entry {
    let (tube_near, tube_far, _) = quadric(origin, direction, Vec3::new(1.0, 0.0, 1.0))?;
    let inverse = direction.y.recip();
    let (a, b) = ((-1.0 - origin.y) * inverse, (1.0 - origin.y) * inverse);
    let (cap_near, cap_far) = (a.min(b), a.max(b));
    let (enter, leave) = (tube_near.max(cap_near), tube_far.min(cap_far));
    let axis = (cap_near > tube_near).then_some(1);
    (enter < leave && leave > 0.0).then_some((enter, leave, axis))
}

#[derive(Debug, Clone, Copy)]
struct Node {
    low: Vec3A,
    high: Vec3A,
    /// First blocker of a leaf, or index of the second child (the first follows its parent).
    start: u32,
    /// Blockers in the leaf; 0 for an inner node.
    count: u32,
    /// Axis along which the children of an inner node lie, the first lower.
    axis: usize,
}

/// Blockers, arranged for fast rays.
pub(super) struct Blockers {
    blockers: Vec<Blocker>,
    nodes: Vec<Node>,
}

impl Blockers {
    /// Arranges blockers so that rays meet few of them (surface area heuristic).
    pub(super) fn new(mut blockers: Vec<Blocker>) -> Self {
        let mut nodes = Vec::with_capacity(blockers.len());
        let count = blockers.len();
        if count > 0 {
            split(&mut blockers, 0, STACK - 32, &mut nodes);
        }
        Self { blockers, nodes }
    }

    /// What the ray meets first within `far`.
    pub(super) fn first(&self, ray: &Ray, far: f32) -> Option<Hit> {
        self.walk(ray, far, false)
    }

    /// Whether anything lies between the start and `far`.
    pub(super) fn blocked(&self, ray: &Ray, far: f32) -> bool {
        self.walk(ray, far, true).is_some()
    }

    /// Whether a point of a part lies inside another part by at least `margin`.
    pub(super) fn bury(&self, point: Vec3, part: u32, margin: f32) -> bool {
        let at = Vec3A::from(point);
        let mut stack = vec![0_u32; usize::from(!self.nodes.is_empty())];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if at.cmplt(node.low).any() || at.cmpgt(node.high).any() {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.start, index + 1]);
            } else if self.leaf(node).iter().any(|b| b.part != part && !b.ghost && b.holds(point, margin)) {
                return true;
            }
        }
        false
    }

    fn leaf(&self, node: &Node) -> &[Blocker] {
        &self.blockers[node.start as usize..(node.start + node.count) as usize]
    }

    fn walk(&self, ray: &Ray, mut far: f32, any: bool) -> Option<Hit> {
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
                // The nearer child is taken next.
                let forward = ray.direction[node.axis] >= 0.0;
                let (near, far_child) = if forward { (at + 1, node.start) } else { (node.start, at + 1) };
                stack[depth] = far_child;
                stack[depth + 1] = near;
                depth += 2;
                continue;
            }
            for blocker in self.leaf(node) {
                if let Some(hit) = blocker.hit(ray, far) {
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

/// Appends the hierarchy of blockers from `start` on; below `budget` levels it halves, so that its depth stays bounded.
fn split(blockers: &mut [Blocker], start: usize, budget: usize, nodes: &mut Vec<Node>) {
    let low = blockers.iter().fold(Vec3A::INFINITY, |sum, b| sum.min(b.low));
    let high = blockers.iter().fold(Vec3A::NEG_INFINITY, |sum, b| sum.max(b.high));
    let own = nodes.len();
    nodes.push(Node { low, high, start: start as u32, count: blockers.len() as u32, axis: 0 });
    if blockers.len() <= LEAF {
        return;
    }
    let (axis, best) = best_split(blockers);
    let half = if budget > 0 { best } else { blockers.len() / 2 };
    sort_along(blockers, axis);
    let (left, right) = blockers.split_at_mut(half);
    let budget = budget.saturating_sub(1);
    split(left, start, budget, nodes);
    let second = nodes.len() as u32;
    split(right, start + half, budget, nodes);
    nodes[own] = Node { low, high, start: second, count: 0, axis };
}

fn sort_along(blockers: &mut [Blocker], axis: usize) {
    blockers.sort_by(|a, b| (a.low + a.high)[axis].total_cmp(&(b.low + b.high)[axis]));
}

/// Axis and size of the first group for which area times count, summed over both groups, is least.
fn best_split(blockers: &mut [Blocker]) -> (usize, usize) {
    let mut best = (f32::INFINITY, 0, blockers.len() / 2);
    for axis in 0..3 {
        sort_along(blockers, axis);
        let grown = |pair: &mut (Vec3A, Vec3A), b: &Blocker| {
            *pair = (pair.0.min(b.low), pair.1.max(b.high));
            let size = pair.1 - pair.0;
            Some(size.x * size.y + size.y * size.z + size.z * size.x)
        };
        let empty = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        let first: Vec<f32> = blockers.iter().scan(empty, grown).collect();
        let mut second: Vec<f32> = blockers.iter().rev().scan(empty, grown).collect();
        second.reverse();
        for count in 1..blockers.len() {
            let cost = first[count - 1] * count as f32 + second[count] * (blockers.len() - count) as f32;
            if cost < best.0 {
                best = (cost, axis, count);
            }
        }
    }
    (best.1, best.2)
}
