//! Shadow proxies of primitives: boxes, ellipsoids and cylinders that rays hit in place of the exact shape.

use cinesplat_scene::SOLID_OPACITY;
use glam::{DMat3, DQuat, DVec2, DVec3};

use super::occluder::{Occluder, Owner, ProxyShape};
use super::placement::Placement;
use super::primitive::{Primitive, Shape, Surface, Visibility};

impl Primitive {
    /// Appends the occluders that approximate the primitive. Emissive and mostly transparent ones cast no shadow.
    pub(super) fn add_occluders(&self, world_from_object: &Placement, owner: Owner, out: &mut Vec<Occluder>) {
        let casts_none = self.visibility == Visibility::NoShadow;
        if casts_none || self.material.emission > 0.0 || self.material.opacity < SOLID_OPACITY {
            return;
        }
        let world_from_primitive = world_from_object.after(&self.object_from_primitive);
        let mut add = |shape: ProxyShape, primitive_from_proxy: Placement, half: DVec3| {
            let world_from_proxy = world_from_primitive.after(&primitive_from_proxy);
            let mut occluder = Occluder::new(shape, world_from_proxy, half.max(DVec3::splat(1e-3)), owner);
            occluder.shadow_only = self.visibility == Visibility::ShadowOnly;
            out.push(occluder);
        };
        let origin = Placement::at(DVec3::ZERO);
        match &self.shape {
            Shape::Block { half, round, .. } => add(ProxyShape::Box, origin, *half - *round * 0.25),
            Shape::Superellipsoid { half, power } if *power < 2.6 => add(ProxyShape::Ellipsoid, origin, *half * 0.97),
            Shape::Superellipsoid { half, .. } => add(ProxyShape::Box, origin, *half * 0.84),
            Shape::Lathe { profile } => {
                for (radius, low, high) in cylinders(profile) {
                    let half = DVec3::new(radius, (high - low) / 2.0, radius);
                    add(ProxyShape::Cylinder, Placement::at(DVec3::Y * (high + low) / 2.0), half);
                }
            }
            Shape::Tube { points, radii } => {
                let stride = (points.len() / 6).max(1);
                let mut from = 0;
                while from + 1 < points.len() {
                    let to = (from + stride).min(points.len() - 1);
                    let axis = points[to] - points[from];
                    let turn = DQuat::from_rotation_arc(DVec3::Y, axis.normalize_or(DVec3::Y));
                    let middle = Placement { rotation: turn, translation: (points[to] + points[from]) / 2.0 };
                    add(ProxyShape::Cylinder, middle, DVec3::new(radii[from], axis.length() / 2.0, radii[from]));
                    from = to;
                }
            }
            Shape::Sheet { surface, .. } => add_sheet(surface, &mut add),
        }
    }
}

/// Adds thin boxes over a 3 x 3 subdivision of a surface.
fn add_sheet(surface: &Surface, add: &mut impl FnMut(ProxyShape, Placement, DVec3)) {
    for k in 0..9_u32 {
        let (u, v) = (f64::from(k % 3) / 3.0, f64::from(k / 3) / 3.0);
        let at = |du: f64, dv: f64| surface(u + du / 3.0, v + dv / 3.0);
        let (across, along) = (at(1.0, 0.5) - at(0.0, 0.5), at(0.5, 1.0) - at(0.5, 0.0));
        let Some(normal) = across.cross(along).try_normalize() else { continue };
        let x = across.normalize();
        let rotation = DQuat::from_mat3(&DMat3::from_cols(x, normal.cross(x), normal));
        let half = DVec3::new(across.length() / 2.0, along.length() / 2.0, 0.002);
        add(ProxyShape::Box, Placement { rotation, translation: at(0.5, 0.5) }, half);
    }
}

/// At most four cylinders (radius, low, high) that approximate a profile.
fn cylinders(profile: &[DVec2]) -> Vec<(f64, f64, f64)> {
    let low = profile.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let high = profile.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let count = 4_u32.min(profile.len() as u32);
    (0..count)
        .map(|i| {
            let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(count);
            let (a, b) = (at(i), at(i + 1));
            (0.96 * radius_at(profile, f64::midpoint(a, b)), a, b)
        })
        .filter(|cylinder| cylinder.0 > 1e-3)
        .collect()
}

/// Largest radius of a profile at a height.
fn radius_at(profile: &[DVec2], height: f64) -> f64 {
    let radius = |pair: &[DVec2]| {
        let (a, b) = (pair[0], pair[1]);
        let t = if (b.y - a.y).abs() < 1e-9 { 0.0 } else { (height - a.y) / (b.y - a.y) };
        if (0.0..=1.0).contains(&t) && (height - a.y) * (height - b.y) <= 0.0 { a.x + (b.x - a.x) * t } else { 0.0 }
    };
    profile.windows(2).map(radius).fold(0.0, f64::max)
}
