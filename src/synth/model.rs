//! Objects as lists of parts in their own frame: floor at y = 0, front toward +z, m.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3, Vec3};

use super::bake::Lamp;
use super::color::Hue;
use super::paint::Paint;
use super::place::Place;
use super::shape::{ALL_FACES, Part, Shape, Surface};

/// A flat place on an object where others can stand: a rectangle in the object's frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Top {
    /// Middle.
    pub(super) center: DVec3,
    /// Half extents along x and z.
    pub(super) half: DVec2,
    /// Free height above it.
    pub(super) headroom: f64,
}

/// An object to be placed.
#[derive(Clone)]
pub(super) struct Model {
    /// What it is, such as `floor lamp`.
    pub(super) kind: &'static str,
    /// Its color word, where one sees a color.
    pub(super) color: Option<&'static str>,
    /// Pieces.
    pub(super) parts: Vec<Part>,
    /// Where others can stand.
    pub(super) tops: Vec<Top>,
    /// Lights, in the object's frame.
    pub(super) lamps: Vec<Lamp>,
}

impl Model {
    /// Nothing yet.
    pub(super) fn new(kind: &'static str) -> Self {
        Self { kind, color: None, parts: Vec::new(), tops: Vec::new(), lamps: Vec::new() }
    }

    /// Nothing yet, named after a color too.
    pub(super) fn colored(kind: &'static str, hue: &Hue) -> Self {
        Self { color: Some(hue.name), ..Self::new(kind) }
    }

    fn push(&mut self, shape: Shape, center: DVec3, paint: Paint) -> &mut Part {
        let index = self.parts.len();
        self.parts.push(Part {
            shape,
            paint,
            place: Place::at(center),
            coarseness: 1.0,
            stretch: 1.0,
            solid: true,
            ghost: false,
        });
        &mut self.parts[index]
    }

    /// A box with rounded edges.
    pub(super) fn block(&mut self, center: [f64; 3], size: [f64; 3], round: f64, paint: Paint) -> &mut Part {
        let half = DVec3::from(size) / 2.0;
        self.push(Shape::Block { half, round, faces: ALL_FACES }, center.into(), paint)
    }

    /// A superellipsoid.
    pub(super) fn pillow(&mut self, center: [f64; 3], size: [f64; 3], power: f64, paint: Paint) -> &mut Part {
        self.push(Shape::Pillow { half: DVec3::from(size) / 2.0, power }, center.into(), paint)
    }

    /// A body of revolution about the upright axis through `base`.
    pub(super) fn lathe(&mut self, base: [f64; 3], profile: &[[f64; 2]], paint: Paint) -> &mut Part {
        let profile = profile.iter().map(|p| DVec2::from(*p)).collect();
        self.push(Shape::Lathe { profile }, base.into(), paint)
    }

    /// As [`Self::lathe`] with a smooth curve through the points.
    pub(super) fn turned(&mut self, base: [f64; 3], profile: &[[f64; 2]], paint: Paint) -> &mut Part {
        let points: Vec<DVec3> = profile.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        let smooth: Vec<[f64; 2]> = rounded(&points, 5).iter().map(|p| [p.x.max(0.0), p.y]).collect();
        self.lathe(base, &smooth, paint)
    }

    /// A straight round rod that may taper.
    pub(super) fn rod(&mut self, from: [f64; 3], to: [f64; 3], radii: [f64; 2], paint: Paint) -> &mut Part {
        let points = vec![DVec3::from(from), DVec3::from(to)];
        self.push(Shape::Tube { points, radii: radii.to_vec() }, DVec3::ZERO, paint)
    }

    /// A bent round rod: a smooth curve through the points.
    pub(super) fn pipe(&mut self, points: &[[f64; 3]], radius: f64, paint: Paint) -> &mut Part {
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::from(*p)).collect();
        let points = rounded(&points, 6);
        let radii = vec![radius; points.len()];
        self.push(Shape::Tube { points, radii }, DVec3::ZERO, paint)
    }

    /// A free surface over the unit square of about this size.
    pub(super) fn sheet(
        &mut self,
        size: [f64; 2],
        paint: Paint,
        surface: impl Fn(f64, f64) -> DVec3 + Send + Sync + 'static,
    ) -> &mut Part {
        let surface: Surface = Arc::new(surface);
        self.push(Shape::Sheet { surface, size: size.into() }, DVec3::ZERO, paint)
    }

    /// A place to put things.
    pub(super) fn top(&mut self, center: [f64; 3], half: [f64; 2], headroom: f64) {
        self.tops.push(Top { center: center.into(), half: half.into(), headroom });
    }

    /// A light of a luminous `intensity` in a color.
    pub(super) fn lamp(&mut self, center: [f64; 3], radius: f32, intensity: Vec3) {
        self.lamps.push(Lamp { center: DVec3::from(center).as_vec3(), radius, intensity });
    }

    /// Four legs under a rectangle, `spread` m further out at the floor.
    pub(super) fn legs(&mut self, half: [f64; 2], height: f64, radii: [f64; 2], spread: f64, paint: Paint) {
        for (x, z) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            let foot = [x * (half[0] + spread), 0.0, z * (half[1] + spread)];
            self.rod(foot, [x * half[0], height, z * half[1]], radii, paint);
        }
    }

    /// All parts of another object, placed in this one; its tops and lamps are left behind.
    pub(super) fn include(&mut self, other: &Self, place: &Place) {
        let moved = other.parts.iter().map(|part| Part { place: place.after(&part.place), ..part.clone() });
        self.parts.extend(moved);
    }

    /// Cells of all parts so far relative to the scene's.
    pub(super) fn fine(mut self, coarseness: f64) -> Self {
        for part in &mut self.parts {
            part.coarseness *= coarseness;
        }
        self
    }

    /// Lowest and highest corner in its own frame.
    pub(super) fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.parts.iter().fold(start, |(low, high), part| {
            let (a, b) = part.bounds(&Place::at(DVec3::ZERO));
            (low.min(a), high.max(b))
        })
    }

    /// Moved so that it stands on y = 0 and its box is centered in x and z.
    pub(super) fn centered(mut self) -> Self {
        let (low, high) = self.bounds();
        let shift = -DVec3::new(f64::midpoint(low.x, high.x), low.y, f64::midpoint(low.z, high.z));
        for part in &mut self.parts {
            part.place.translation += shift;
        }
        for top in &mut self.tops {
            top.center += shift;
        }
        for lamp in &mut self.lamps {
            lamp.center += shift.as_vec3();
        }
        self
    }

    /// Extent of its box.
    pub(super) fn size(&self) -> DVec3 {
        let (low, high) = self.bounds();
        high - low
    }
}

impl Part {
    /// Turned about an axis through its own middle.
    pub(super) fn turn(&mut self, axis: DVec3, angle_rad: f64) -> &mut Self {
        self.place.rotation = DQuat::from_axis_angle(axis, angle_rad) * self.place.rotation;
        self
    }

    /// Cells relative to the scene's.
    pub(super) fn cells(&mut self, coarseness: f64) -> &mut Self {
        self.coarseness = coarseness;
        self
    }

    /// Only some faces of a block.
    pub(super) fn only(&mut self, shown: u8) -> &mut Self {
        if let Shape::Block { faces, .. } = &mut self.shape {
            *faces = shown;
        }
        self
    }

    /// Lets light by.
    pub(super) fn airy(&mut self) -> &mut Self {
        self.solid = false;
        self
    }

    /// Only stops light, for crowds of parts that do not one by one.
    pub(super) fn ghost(&mut self) -> &mut Self {
        self.ghost = true;
        self
    }

    /// Cells longer along the longest axis.
    pub(super) fn stretched(&mut self, stretch: f64) -> &mut Self {
        self.stretch = stretch;
        self
    }
}

/// Centripetal-looking uniform Catmull-Rom curve through points, `count` pieces between neighbors.
fn rounded(points: &[DVec3], count: u32) -> Vec<DVec3> {
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
