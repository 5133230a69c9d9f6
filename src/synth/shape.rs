//! Shapes of parts: how each is covered by surfels, how far it reaches, and what stands in for it when rays are cast.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use cinesplat_scene::SOLID_OPACITY;
use glam::{DQuat, DVec2, DVec3};

use super::paint::{Paint, Texel};
use super::place::Place;
use super::ray::{Blocker, Solid};
use super::surfel::{Brush, Cell, Surfel, between, edged_spans, loop_spans, spans};

/// A surface over the unit square.
pub(super) type Surface = Arc<dyn Fn(f64, f64) -> DVec3 + Send + Sync>;

/// Geometry of a part in its own frame, m.
#[derive(Clone)]
pub(super) enum Shape {
    /// Box with rounded edges. `faces`: bit `2 axis + (1 for the positive side)`.
    Block { half: DVec3, round: f64, faces: u8 },
    /// Superellipsoid: 2 is an ellipsoid, 4 a plump cushion.
    Pillow { half: DVec3, power: f64 },
    /// Profile of (radius, height) turned about y, from the bottom outside to the top.
    Lathe { profile: Vec<DVec2> },
    /// Round rod along a polyline, radius at each of its points.
    Tube { points: Vec<DVec3>, radii: Vec<f64> },
    /// Any surface over the unit square of about this size.
    Sheet { surface: Surface, size: DVec2 },
}

/// All faces of a block.
pub(super) const ALL_FACES: u8 = 0x3f;

/// A piece of an object: shape, material, where it sits, how fine it is.
#[derive(Clone)]
pub(super) struct Part {
    /// Geometry.
    pub(super) shape: Shape,
    /// Material.
    pub(super) paint: Paint,
    /// Part to object.
    pub(super) place: Place,
    /// Cell size relative to the scene's.
    pub(super) coarseness: f64,
    /// Cell length along the longest axis of a block over its width.
    pub(super) stretch: f64,
    /// Whether it stops light.
    pub(super) solid: bool,
    /// Whether it only stops light and cannot be seen itself.
    pub(super) ghost: bool,
}

impl Part {
    /// Surfels with cells of about `step` m times the part's coarseness.
    pub(super) fn surfels(&self, world_from_object: &Place, object: u16, step: f64) -> Vec<Surfel> {
        if self.ghost {
            return Vec::new();
        }
        let step = step * self.coarseness;
        let place = world_from_object.after(&self.place);
        let extent = self.half_extent();
        let grain = if extent.x >= extent.y.max(extent.z) { 0 } else { 1 + usize::from(extent.z > extent.y) };
        let mut brush = Brush { place, paint: &self.paint, grain, object, out: Vec::new() };
        match &self.shape {
            Shape::Block { half, round, faces } => {
                cover_block(&mut brush, *half, (*round, *faces), [step, self.stretch]);
            }
            Shape::Pillow { half, power } => cover_pillow(&mut brush, *half, *power, step),
            Shape::Lathe { profile } => cover_lathe(&mut brush, profile, step),
            Shape::Tube { points, radii } => cover_tube(&mut brush, points, radii, step),
            Shape::Sheet { surface, size } => {
                let cells = [spans(0.0, 1.0, step / size.x), spans(0.0, 1.0, step / size.y)];
                brush.cover([&cells[0], &cells[1]], *size, |u, v| surface(u, v));
            }
        }
        brush.out
    }

    /// Half of the extent in the part's frame, about.
    fn half_extent(&self) -> DVec3 {
        match &self.shape {
            Shape::Block { half, .. } | Shape::Pillow { half, .. } => *half,
            Shape::Sheet { size, .. } => DVec3::new(size.x / 2.0, size.y / 2.0, 0.0),
            Shape::Lathe { .. } | Shape::Tube { .. } => DVec3::Y,
        }
    }

    /// Lowest and highest corner in the frame of `outer`.
    pub(super) fn bounds(&self, outer: &Place) -> (DVec3, DVec3) {
        let place = outer.after(&self.place);
        let points: Vec<(DVec3, f64)> = match &self.shape {
            Shape::Block { half, .. } | Shape::Pillow { half, .. } => corners(*half).map(|p| (p, 0.0)).to_vec(),
            Shape::Lathe { profile } => {
                let ring = |p: &DVec2, k: u8| {
                    let angle = TAU * f64::from(k) / 16.0;
                    (DVec3::new(p.x * angle.cos(), p.y, p.x * angle.sin()), 0.0)
                };
                profile.iter().flat_map(|p| (0..16).map(move |k| ring(p, k))).collect()
            }
            Shape::Tube { points, radii } => points.iter().copied().zip(radii.iter().copied()).collect(),
            Shape::Sheet { surface, .. } => {
                let at = |k: u32| surface(f64::from(k % 9) / 8.0, f64::from(k / 9) / 8.0);
                (0..81).map(|k| (at(k), 0.0)).collect()
            }
        };
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        points.iter().fold(start, |(low, high), (p, radius)| {
            let q = place.apply(*p);
            (low.min(q - *radius), high.max(q + *radius))
        })
    }

    /// Solids that stop light in its place.
    pub(super) fn blockers(&self, world_from_object: &Place, owner: (u16, u32), out: &mut Vec<Blocker>) {
        if !self.solid || self.paint.glow > 0.0 || self.paint.opacity < SOLID_OPACITY {
            return;
        }
        let place = world_from_object.after(&self.place);
        let mut add = |solid: Solid, inner: Place, half: DVec3| {
            let at = place.after(&inner);
            out.push(Blocker::new(solid, at, half.max(DVec3::splat(1e-3)), owner).unseen(self.ghost));
        };
        let origin = Place::at(DVec3::ZERO);
        match &self.shape {
            Shape::Block { half, round, .. } => add(Solid::Box, origin, *half - *round * 0.25),
            Shape::Pillow { half, power } if *power < 2.6 => add(Solid::Ellipsoid, origin, *half * 0.97),
            Shape::Pillow { half, .. } => add(Solid::Box, origin, *half * 0.84),
            Shape::Lathe { profile } => {
                for (radius, low, high) in drums(profile) {
                    let half = DVec3::new(radius, (high - low) / 2.0, radius);
                    add(Solid::Cylinder, Place::at(DVec3::Y * (high + low) / 2.0), half);
                }
            }
            Shape::Tube { points, radii } => {
                let stride = (points.len() / 6).max(1);
                let mut from = 0;
                while from + 1 < points.len() {
                    let to = (from + stride).min(points.len() - 1);
                    let axis = points[to] - points[from];
                    let turn = DQuat::from_rotation_arc(DVec3::Y, axis.normalize_or(DVec3::Y));
                    let middle = Place { rotation: turn, translation: (points[to] + points[from]) / 2.0 };
                    add(Solid::Cylinder, middle, DVec3::new(radii[from], axis.length() / 2.0, radii[from]));
                    from = to;
                }
            }
            Shape::Sheet { surface, .. } => add_sheet(surface, &mut add),
        }
    }
}

/// Thin boxes over a 3 x 3 cut of a surface.
fn add_sheet(surface: &Surface, add: &mut impl FnMut(Solid, Place, DVec3)) {
    for k in 0..9_u32 {
        let (u, v) = (f64::from(k % 3) / 3.0, f64::from(k / 3) / 3.0);
        let at = |du: f64, dv: f64| surface(u + du / 3.0, v + dv / 3.0);
        let (across, along) = (at(1.0, 0.5) - at(0.0, 0.5), at(0.5, 1.0) - at(0.5, 0.0));
        let Some(normal) = across.cross(along).try_normalize() else { continue };
        let x = across.normalize();
        let rotation = DQuat::from_mat3(&glam::DMat3::from_cols(x, normal.cross(x), normal));
        let half = DVec3::new(across.length() / 2.0, along.length() / 2.0, 0.002);
        add(Solid::Box, Place { rotation, translation: at(0.5, 0.5) }, half);
    }
}

/// A profile as at most five drums of (radius, low, high).
fn drums(profile: &[DVec2]) -> Vec<(f64, f64, f64)> {
    let low = profile.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let high = profile.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let count = 4_u32.min(profile.len() as u32);
    (0..count)
        .map(|i| {
            let at = |k: u32| low + (high - low) * f64::from(k) / f64::from(count);
            let (a, b) = (at(i), at(i + 1));
            (0.96 * radius_at(profile, f64::midpoint(a, b)), a, b)
        })
        .filter(|drum| drum.0 > 1e-3)
        .collect()
}

/// Widest radius of a profile at a height.
fn radius_at(profile: &[DVec2], height: f64) -> f64 {
    let reach = |pair: &[DVec2]| {
        let (a, b) = (pair[0], pair[1]);
        let t = if (b.y - a.y).abs() < 1e-9 { 0.0 } else { (height - a.y) / (b.y - a.y) };
        if (0.0..=1.0).contains(&t) && (height - a.y) * (height - b.y) <= 0.0 { a.x + (b.x - a.x) * t } else { 0.0 }
    };
    profile.windows(2).map(reach).fold(0.0, f64::max)
}

fn corners(half: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|i| half * DVec3::from_array(std::array::from_fn(|a| if i >> a & 1 == 1 { 1.0 } else { -1.0 })))
}

/// Axis vectors of a face such that first x second = outward.
fn face_axes(face: u8) -> (DVec3, DVec3, DVec3) {
    let axis = usize::from(face / 2);
    let (b, c) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
    if face % 2 == 1 { (DVec3::AXES[axis], b, c) } else { (-DVec3::AXES[axis], c, b) }
}

fn cover_block(brush: &mut Brush, half: DVec3, (round, faces): (f64, u8), [step, stretch]: [f64; 2]) {
    let round = if round < 0.3 * step { 0.0 } else { round.min(half.min_element()) };
    for face in (0..6).filter(|f| faces >> f & 1 == 1) {
        let (out, first, second) = face_axes(face);
        // Pictures and spines read left to right on the upright faces: the horizontal direction goes first there.
        let (u, v) = if second.y == 0.0 && first.y != 0.0 { (-second, first) } else { (first, second) };
        let reach = DVec2::new(half.dot(u.abs()), half.dot(v.abs()));
        let grain = DVec3::AXES[brush.grain];
        let pace = |axis: DVec3| step * if axis.dot(grain) == 0.0 { 1.0 } else { stretch };
        let cells = [edged_spans(reach.x, round, pace(u)), edged_spans(reach.y, round, pace(v))];
        let surface = |a: f64, b: f64| {
            let cube = half * out + u * a + v * b;
            let core = cube.clamp(round - half, half - round);
            core + round * (cube - core).normalize_or_zero()
        };
        brush.cover([&cells[0], &cells[1]], reach * 2.0, surface);
    }
}

fn cover_pillow(brush: &mut Brush, half: DVec3, power: f64, step: f64) {
    for face in 0..6 {
        let (out, u, v) = face_axes(face);
        let reach = DVec2::new(half.dot(u.abs()), half.dot(v.abs()));
        let count = (reach * 2.0 / step).round().max(DVec2::ONE);
        let grid = |n: f64| loop_spans(-1.0, 1.0, n as usize);
        let cells = [grid(count.x), grid(count.y)];
        let surface = |a: f64, b: f64| {
            let cube = out + u * (a * PI / 4.0).tan() + v * (b * PI / 4.0).tan();
            let norm = cube.abs().to_array().iter().map(|c| c.powf(power)).sum::<f64>().powf(1.0 / power);
            half * cube / norm
        };
        brush.cover([&cells[0], &cells[1]], reach * 2.0, surface);
    }
}

fn cover_lathe(brush: &mut Brush, profile: &[DVec2], step: f64) {
    let total: f64 = profile.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut done = 0.0;
    for pair in profile.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let length = from.distance(to);
        if length < 1e-6 {
            continue;
        }
        for ring in between_ends(length, step) {
            let t = ring.middle() / length;
            let at = from.lerp(to, t);
            let (low, high) = ring.ends();
            let width = (to - from) * ((high - low) / length);
            lay_ring(brush, at, width, step, (done + ring.middle(), total));
        }
        done += length;
    }
}

/// Intervals of a stretch that joins others at both ends: no shrinking there.
fn between_ends(length: f64, step: f64) -> Vec<super::surfel::Span> {
    let count = (length / step).round().max(1.0) as usize;
    if count < 3 {
        let breaks: Vec<f64> = (0..=count).map(|i| length * i as f64 / count as f64).collect();
        return between(&breaks);
    }
    loop_spans(0.0, length, count)
}

/// One ring of a lathe: middle (radius, height), its width vector along the profile, place along the whole profile.
fn lay_ring(brush: &mut Brush, at: DVec2, width: DVec2, step: f64, (done, total): (f64, f64)) {
    let count = ((TAU * at.x / step).round().max(5.0)) as usize;
    let around = TAU * at.x / count as f64;
    // Every other ring is turned by half a cell, so that seams do not line up.
    let phase = (done / step).floor().rem_euclid(2.0) / 2.0;
    for k in 0..count {
        let angle = TAU * (k as f64 + phase) / count as f64;
        let (sin, cos) = angle.sin_cos();
        let middle = DVec3::new(at.x * cos, at.y, at.x * sin);
        let frac = DVec2::new((k as f64 + phase) / count as f64 % 1.0, done / total.max(1e-9));
        brush.dab(&Cell {
            middle,
            across: DVec3::new(sin, 0.0, -cos) * around,
            along: DVec3::new(width.x * cos, width.y, width.x * sin),
            sigma_frac: DVec2::splat(0.72),
            texel: Texel { along: frac * DVec2::new(TAU * at.x, total), frac, local: middle },
        });
    }
}

fn cover_tube(brush: &mut Brush, points: &[DVec3], radii: &[f64], step: f64) {
    let total: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut done = 0.0;
    for (i, pair) in points.windows(2).enumerate() {
        let axis = pair[1] - pair[0];
        let length = axis.length();
        let Some(along) = axis.try_normalize() else { continue };
        let turn = DQuat::from_rotation_arc(DVec3::Y, along);
        for ring in spans(0.0, length, (1.6 * step).min(length)) {
            let t = ring.middle() / length;
            let radius = radii[i] + (radii[i + 1] - radii[i]) * t;
            let count = ((TAU * radius / step).round().max(4.0)) as usize;
            let (low, high) = ring.ends();
            for k in 0..count {
                let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
                let middle = pair[0] + axis * t + turn * DVec3::new(cos, 0.0, sin) * radius;
                let frac = DVec2::new(k as f64 / count as f64, (done + ring.middle()) / total);
                brush.dab(&Cell {
                    middle,
                    across: turn * DVec3::new(sin, 0.0, -cos) * (TAU * radius / count as f64),
                    along: along * (high - low),
                    sigma_frac: DVec2::new(0.72, 0.74),
                    texel: Texel { along: frac * DVec2::new(TAU * radius, total), frac, local: middle },
                });
            }
        }
        done += length;
    }
}
