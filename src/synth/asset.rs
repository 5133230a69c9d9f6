//! Assets: objects as lists of primitives in their own frame. Floor at y = 0, front toward +z, m.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};

use super::color::NamedColor;
use super::faces;
use super::lights::Lamp;
use super::material::Material;
use super::placement::Placement;
use super::primitive::{Primitive, Shape, Surface, Visibility};

/// A horizontal rectangle on which other objects can stand, in the asset's frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct SupportSurface {
    /// Center.
    pub(super) center: DVec3,
    /// Half extents along x and z.
    pub(super) half: DVec2,
    /// Free height above the rectangle.
    pub(super) headroom: f64,
}

/// An object before its placement in a scene.
#[derive(Clone)]
pub(super) struct Asset {
    /// Kind, such as `floor lamp`.
    pub(super) kind: &'static str,
    /// Color word for its label; `None` if it has no single color.
    pub(super) color: Option<&'static str>,
    /// Primitives in the asset's frame.
    pub(super) primitives: Vec<Primitive>,
    /// Surfaces on which other objects can stand.
    pub(super) supports: Vec<SupportSurface>,
    /// Lights in the asset's frame.
    pub(super) lamps: Vec<Lamp>,
}

impl Asset {
    /// An asset without primitives.
    pub(super) fn new(kind: &'static str) -> Self {
        Self { kind, color: None, primitives: Vec::new(), supports: Vec::new(), lamps: Vec::new() }
    }

    /// An asset without primitives whose label names a color.
    pub(super) fn colored(kind: &'static str, color: &NamedColor) -> Self {
        Self { color: Some(color.name), ..Self::new(kind) }
    }

    fn push(&mut self, shape: Shape, center: DVec3, material: Material) -> &mut Primitive {
        let index = self.primitives.len();
        self.primitives.push(Primitive {
            shape,
            material,
            object_from_primitive: Placement::at(center),
            cell_scale: 1.0,
            cell_stretch: 1.0,
            visibility: Visibility::Full,
        });
        &mut self.primitives[index]
    }

    /// Adds a box with rounded edges.
    pub(super) fn block(&mut self, center: [f64; 3], size: [f64; 3], round: f64, material: Material) -> &mut Primitive {
        let half = DVec3::from(size) / 2.0;
        self.push(Shape::Block { half, round, faces: faces::ALL }, center.into(), material)
    }

    /// Adds a superellipsoid.
    pub(super) fn superellipsoid(
        &mut self,
        center: [f64; 3],
        size: [f64; 3],
        power: f64,
        material: Material,
    ) -> &mut Primitive {
        self.push(Shape::Superellipsoid { half: DVec3::from(size) / 2.0, power }, center.into(), material)
    }

    /// Adds a surface of revolution about the up axis through `base`; the profile holds (radius, height).
    pub(super) fn lathe(&mut self, base: [f64; 3], profile: &[[f64; 2]], material: Material) -> &mut Primitive {
        let profile = profile.iter().map(|p| DVec2::from(*p)).collect();
        self.push(Shape::Lathe { profile }, base.into(), material)
    }

    /// As [`Self::lathe`], with a Catmull-Rom curve through the profile.
    pub(super) fn smooth_lathe(&mut self, base: [f64; 3], profile: &[[f64; 2]], material: Material) -> &mut Primitive {
        let points: Vec<DVec3> = profile.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        let smooth: Vec<[f64; 2]> = catmull_rom(&points, 5).iter().map(|p| [p.x.max(0.0), p.y]).collect();
        self.lathe(base, &smooth, material)
    }

    /// Adds a straight rod with a radius at each end.
    pub(super) fn rod(&mut self, from: [f64; 3], to: [f64; 3], radii: [f64; 2], material: Material) -> &mut Primitive {
        let points = vec![DVec3::from(from), DVec3::from(to)];
        self.push(Shape::Tube { points, radii: radii.to_vec() }, DVec3::ZERO, material)
    }

    /// Adds a tube along a Catmull-Rom curve through the points.
    pub(super) fn pipe(&mut self, points: &[[f64; 3]], radius: f64, material: Material) -> &mut Primitive {
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::from(*p)).collect();
        let points = catmull_rom(&points, 6);
        let radii = vec![radius; points.len()];
        self.push(Shape::Tube { points, radii }, DVec3::ZERO, material)
    }

    /// Adds a parametric surface over the unit square with its approximate size.
    pub(super) fn sheet(
        &mut self,
        size: [f64; 2],
        material: Material,
        surface: impl Fn(f64, f64) -> DVec3 + Send + Sync + 'static,
    ) -> &mut Primitive {
        let surface: Surface = Arc::new(surface);
        self.push(Shape::Sheet { surface, size: size.into() }, DVec3::ZERO, material)
    }

    /// Adds a surface on which other objects can stand.
    pub(super) fn support(&mut self, center: [f64; 3], half: [f64; 2], headroom: f64) {
        self.supports.push(SupportSurface { center: center.into(), half: half.into(), headroom });
    }

    /// Adds a spherical light.
    pub(super) fn lamp(&mut self, center: [f64; 3], radius: f32, intensity: Vec3) {
        self.lamps.push(Lamp { center: DVec3::from(center).as_vec3(), radius, intensity });
    }

    /// Adds four legs under a rectangle; at the floor they stand `spread` m farther out.
    pub(super) fn legs(&mut self, half: [f64; 2], height: f64, radii: [f64; 2], spread: f64, material: Material) {
        for (x, z) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            let foot = [x * (half[0] + spread), 0.0, z * (half[1] + spread)];
            self.rod(foot, [x * half[0], height, z * half[1]], radii, material);
        }
    }

    /// Adds the primitives of another asset, without its support surfaces and lamps.
    pub(super) fn attach(&mut self, other: &Self, self_from_other: &Placement) {
        let moved = other.primitives.iter().map(|primitive| Primitive {
            object_from_primitive: self_from_other.after(&primitive.object_from_primitive),
            ..primitive.clone()
        });
        self.primitives.extend(moved);
    }

    /// Multiplies the cell size of all primitives added so far.
    pub(super) fn scale_cells(mut self, cell_scale: f64) -> Self {
        for primitive in &mut self.primitives {
            primitive.cell_scale *= cell_scale;
        }
        self
    }

    /// Lowest and highest corner of the bounding box in the asset's frame.
    pub(super) fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.primitives.iter().fold(start, |(low, high), primitive| {
            let (a, b) = primitive.bounds(&Placement::at(DVec3::ZERO));
            (low.min(a), high.max(b))
        })
    }

    /// The same asset, translated so that it stands on y = 0 and its bounding box is centered in x and z.
    pub(super) fn centered(mut self) -> Self {
        let (low, high) = self.bounds();
        let shift = -DVec3::new(f64::midpoint(low.x, high.x), low.y, f64::midpoint(low.z, high.z));
        for primitive in &mut self.primitives {
            primitive.object_from_primitive.translation += shift;
        }
        for support in &mut self.supports {
            support.center += shift;
        }
        for lamp in &mut self.lamps {
            lamp.center += shift.as_vec3();
        }
        self
    }

    /// Extent of the bounding box.
    pub(super) fn size(&self) -> DVec3 {
        let (low, high) = self.bounds();
        high - low
    }
}

/// Uniform Catmull-Rom curve through points as a polyline, with `count` segments between neighbors.
fn catmull_rom(points: &[DVec3], count: u32) -> Vec<DVec3> {
    let last = points.len().saturating_sub(1);
    let at = |i: isize| points[i.clamp(0, last as isize) as usize];
    let mut out = Vec::new();
    for i in 0..last as isize {
        let (a, b, c, d) = (at(i - 1), at(i), at(i + 1), at(i + 2));
        for k in 0..count {
            let t = f64::from(k) / f64::from(count);
            let curve = b * 2.0
                + (c - a) * t
                + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t)
                + (b * 3.0 - a - c * 3.0 + d) * (t * t * t);
            out.push(curve / 2.0);
        }
    }
    out.extend(points.last());
    out
}
