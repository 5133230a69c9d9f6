//! Occluders: boxes, ellipsoids and cylinders that block light rays in place of primitives. World frame, m, `f32`.

use glam::{DVec3, Mat3A, Quat, Vec3, Vec3A};

use super::placement::Placement;

/// Shape of an occluder in its unit frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ProxyShape {
    /// Cube of half extent 1.
    Box,
    /// Ball of radius 1.
    Ellipsoid,
    /// Cylinder of radius 1 about y, of half height 1.
    Cylinder,
}

/// The object and the primitive that an occluder or a ray belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Owner {
    /// Object id; 0 = the room itself.
    pub(super) object: u16,
    /// Index of the primitive in the scene.
    pub(super) primitive: u32,
}

/// A convex solid that blocks light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Occluder {
    shape: ProxyShape,
    /// Primitive that it approximates.
    pub(super) owner: Owner,
    /// Whether the primitive is invisible: it then hides no surfels.
    pub(super) shadow_only: bool,
    center: Vec3,
    /// Unit frame of the shape from world, without the translation.
    unit_from_world: Mat3A,
    world_from_own: Quat,
    half: Vec3,
    /// Lowest corner of the bounding box.
    pub(super) low: Vec3A,
    /// Highest corner of the bounding box.
    pub(super) high: Vec3A,
}

/// Intersection of a ray with an occluder.
#[derive(Debug, Clone, Copy)]
pub(super) struct RayHit {
    /// Distance along the ray; 0 if the ray starts inside.
    pub(super) distance: f32,
    /// Outward unit normal at the intersection.
    pub(super) normal: Vec3,
}

/// A ray that starts at a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    /// Start point.
    pub(super) origin: Vec3,
    /// Unit direction.
    pub(super) direction: Vec3,
    /// Object at which the ray starts. Occluders of this object do not block a ray that starts inside them.
    pub(super) object: u16,
    /// Primitive at which a visibility ray starts; `None` for light rays. A visibility ray that starts inside a box of
    /// another primitive is blocked, even by the same object, and shadow-only occluders do not block it.
    pub(super) primitive: Option<u32>,
}

impl Occluder {
    /// An occluder with the half extents `half` along its own axes.
    pub(super) fn new(shape: ProxyShape, world_from_own: Placement, half: DVec3, owner: Owner) -> Self {
        let Placement { rotation, translation } = world_from_own;
        let world_half = DVec3::AXES
            .iter()
            .zip(half.to_array())
            .fold(DVec3::ZERO, |sum, (axis, h)| sum + (rotation * *axis * h).abs());
        Self {
            shape,
            owner,
            shadow_only: false,
            center: translation.as_vec3(),
            unit_from_world: Mat3A::from_diagonal(half.as_vec3().recip())
                * Mat3A::from_quat(rotation.conjugate().as_quat()),
            world_from_own: rotation.as_quat(),
            half: half.as_vec3(),
            low: (translation - world_half).as_vec3().into(),
            high: (translation + world_half).as_vec3().into(),
        }
    }

    /// Whether a point lies at least `margin` inside.
    pub(super) fn contains(&self, point: Vec3, margin: f32) -> bool {
        let inner = (self.half - margin).max(Vec3::ZERO) / self.half;
        let own = (self.unit_from_world * (point - self.center)).abs();
        match self.shape {
            ProxyShape::Box => own.cmple(inner).all(),
            ProxyShape::Ellipsoid => own.length() <= inner.min_element(),
            ProxyShape::Cylinder => own.y <= inner.y && own.x.hypot(own.z) <= inner.x.min(inner.z),
        }
    }

    /// Nearest intersection closer than `far`. A ray that starts inside another object hits at distance 0.
    pub(super) fn hit(&self, ray: &Ray, far: f32) -> Option<RayHit> {
        if self.shadow_only && ray.primitive.is_some() {
            return None;
        }
        let origin = self.unit_from_world * (ray.origin - self.center);
        let direction = self.unit_from_world * ray.direction;
        let (near, leave, axis) = match self.shape {
            ProxyShape::Box => slabs(origin, direction),
            ProxyShape::Ellipsoid => quadric(origin, direction, Vec3::ONE),
            ProxyShape::Cylinder => cylinder(origin, direction),
        }?;
        if near <= 0.0 {
            let foreign = ray.object != self.owner.object;
            let other_box = self.shape == ProxyShape::Box
                && ray.primitive.is_some_and(|primitive| primitive != self.owner.primitive);
            return (leave > 0.0 && (foreign || other_box)).then_some(RayHit { distance: 0.0, normal: -ray.direction });
        }
        if near >= far {
            return None;
        }
        let at = origin + direction * near;
        let local = match axis {
            Some(axis) => -Vec3::AXES[axis] * direction[axis].signum(),
            None if self.shape == ProxyShape::Cylinder => Vec3::new(at.x, 0.0, at.z) / self.half,
            None => at / self.half,
        };
        Some(RayHit { distance: near, normal: (self.world_from_own * local).normalize_or(-ray.direction) })
    }
}

/// Distances at which a ray enters and leaves a unit shape, and the axis of the flat face that it enters through; `None`
/// for the curved surface.
type RayOverlap = Option<(f32, f32, Option<usize>)>;

/// Overlap with the unit cube, by the slab method.
fn slabs(origin: Vec3, direction: Vec3) -> RayOverlap {
    let inverse = direction.recip();
    let (a, b) = ((-1.0 - origin) * inverse, (1.0 - origin) * inverse);
    let (near, far) = (a.min(b), a.max(b));
    let (enter, leave) = (near.max_element(), far.min_element());
    (enter < leave && leave > 0.0).then(|| (enter, leave, Some(near.max_position())))
}

/// Overlap with the unit sphere, or with the infinite unit cylinder about y if `mask` zeroes y.
fn quadric(origin: Vec3, direction: Vec3, mask: Vec3) -> RayOverlap {
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

/// Overlap with the unit cylinder about y.
fn cylinder(origin: Vec3, direction: Vec3) -> RayOverlap {
    let (side_near, side_far, _) = quadric(origin, direction, Vec3::new(1.0, 0.0, 1.0))?;
    let inverse = direction.y.recip();
    let (a, b) = ((-1.0 - origin.y) * inverse, (1.0 - origin.y) * inverse);
    let (cap_near, cap_far) = (a.min(b), a.max(b));
    let (enter, leave) = (side_near.max(cap_near), side_far.min(cap_far));
    let axis = (cap_near > side_near).then_some(1);
    (enter < leave && leave > 0.0).then_some((enter, leave, axis))
}
