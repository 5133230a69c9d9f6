//! Tessellation of primitives into surfels.
//!
//! Enters: a primitive, its placement in the world and a step, m. Leaves: surfels that cover the shape, spaced by about the
//! step. Invariant: cells cover the surface without gaps.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2, DVec3};

use super::intervals::{ParamInterval, edge_refined_intervals, intervals, intervals_between, periodic_intervals};
use super::placement::Placement;
use super::primitive::{Primitive, Shape, Visibility};
use super::surface_point::SurfacePoint;
use super::surfel::Surfel;
use super::surfel_emitter::{SurfaceCell, SurfelEmitter};

impl Primitive {
    /// The surfels of the primitive, with cells of about `step` m times its cell scale; none for an invisible one.
    pub(super) fn surfels(&self, world_from_object: &Placement, object: u16, step: f64) -> Vec<Surfel> {
        if self.visibility == Visibility::ShadowOnly {
            return Vec::new();
        }
        let step = step * self.cell_scale;
        let world_from_primitive = world_from_object.after(&self.object_from_primitive);
        let extent = self.half_extents();
        let grain = if extent.x >= extent.y.max(extent.z) { 0 } else { 1 + usize::from(extent.z > extent.y) };
        let mut emitter =
            SurfelEmitter { world_from_primitive, material: &self.material, grain, object, out: Vec::new() };
        match &self.shape {
            Shape::Block { half, round, faces } => {
                tessellate_block(&mut emitter, *half, (*round, *faces), [step, self.cell_stretch]);
            }
            Shape::Superellipsoid { half, power } => tessellate_superellipsoid(&mut emitter, *half, *power, step),
            Shape::Lathe { profile } => tessellate_lathe(&mut emitter, profile, step),
            Shape::Tube { points, radii } => tessellate_tube(&mut emitter, points, radii, step),
            Shape::Sheet { surface, size } => {
                let cells = [intervals(0.0, 1.0, step / size.x), intervals(0.0, 1.0, step / size.y)];
                emitter.emit_grid([&cells[0], &cells[1]], *size, |u, v| surface(u, v));
            }
        }
        emitter.out
    }
}

/// Outward normal and two axes of a face; first x second = outward.
fn face_axes(face: u8) -> (DVec3, DVec3, DVec3) {
    let axis = usize::from(face / 2);
    let (b, c) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
    if face % 2 == 1 { (DVec3::AXES[axis], b, c) } else { (-DVec3::AXES[axis], c, b) }
}

fn tessellate_block(emitter: &mut SurfelEmitter, half: DVec3, (round, faces): (f64, u8), [step, stretch]: [f64; 2]) {
    let round = if round < 0.3 * step { 0.0 } else { round.min(half.min_element()) };
    for face in (0..6).filter(|f| faces >> f & 1 == 1) {
        let (out, first, second) = face_axes(face);
        // The horizontal direction comes first on upright faces, so that pictures and book spines are not rotated.
        let (u, v) = if second.y == 0.0 && first.y != 0.0 { (-second, first) } else { (first, second) };
        let reach = DVec2::new(half.dot(u.abs()), half.dot(v.abs()));
        let grain = DVec3::AXES[emitter.grain];
        let step_along = |axis: DVec3| step * if axis.dot(grain) == 0.0 { 1.0 } else { stretch };
        let cells = [
            edge_refined_intervals(reach.x, round, step_along(u)),
            edge_refined_intervals(reach.y, round, step_along(v)),
        ];
        let surface = |a: f64, b: f64| {
            let cube = half * out + u * a + v * b;
            let core = cube.clamp(round - half, half - round);
            core + round * (cube - core).normalize_or_zero()
        };
        emitter.emit_grid([&cells[0], &cells[1]], reach * 2.0, surface);
    }
}

fn tessellate_superellipsoid(emitter: &mut SurfelEmitter, half: DVec3, power: f64, step: f64) {
    for face in 0..6 {
        let (out, u, v) = face_axes(face);
        let reach = DVec2::new(half.dot(u.abs()), half.dot(v.abs()));
        let count = (reach * 2.0 / step).round().max(DVec2::ONE);
        let grid = |n: f64| periodic_intervals(-1.0, 1.0, n as usize);
        let cells = [grid(count.x), grid(count.y)];
        let surface = |a: f64, b: f64| {
            let cube = out + u * (a * PI / 4.0).tan() + v * (b * PI / 4.0).tan();
            let norm = cube.abs().to_array().iter().map(|c| c.powf(power)).sum::<f64>().powf(1.0 / power);
            half * cube / norm
        };
        emitter.emit_grid([&cells[0], &cells[1]], reach * 2.0, surface);
    }
}

fn tessellate_lathe(emitter: &mut SurfelEmitter, profile: &[DVec2], step: f64) {
    let total: f64 = profile.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut done = 0.0;
    for pair in profile.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let length = from.distance(to);
        if length < 1e-6 {
            continue;
        }
        for ring in joined_intervals(length, step) {
            let t = ring.middle / length;
            let at = from.lerp(to, t);
            let (low, high) = (ring.low, ring.high);
            let width = (to - from) * ((high - low) / length);
            emit_ring(emitter, at, width, step, (done + ring.middle, total));
        }
        done += length;
    }
}

/// Intervals of a section that continues at both ends: from 3 intervals up, surfels keep their size there.
fn joined_intervals(length: f64, step: f64) -> Vec<ParamInterval> {
    let count = (length / step).round().max(1.0) as usize;
    if count < 3 {
        let breaks: Vec<f64> = (0..=count).map(|i| length * i as f64 / count as f64).collect();
        return intervals_between(&breaks);
    }
    periodic_intervals(0.0, length, count)
}

/// Emits one ring of a lathe: middle (radius, height), width vector along the profile, position along the whole profile.
fn emit_ring(emitter: &mut SurfelEmitter, at: DVec2, width: DVec2, step: f64, (done, total): (f64, f64)) {
    let count = ((TAU * at.x / step).round().max(5.0)) as usize;
    let around = TAU * at.x / count as f64;
    // Every other ring is rotated by half a cell, so that seams do not align.
    let phase = (done / step).floor().rem_euclid(2.0) / 2.0;
    for k in 0..count {
        let angle = TAU * (k as f64 + phase) / count as f64;
        let (sin, cos) = angle.sin_cos();
        let middle = DVec3::new(at.x * cos, at.y, at.x * sin);
        let frac = DVec2::new((k as f64 + phase) / count as f64 % 1.0, done / total.max(1e-9));
        emitter.emit(&SurfaceCell {
            middle,
            across: DVec3::new(sin, 0.0, -cos) * around,
            along: DVec3::new(width.x * cos, width.y, width.x * sin),
            sigma_frac: DVec2::splat(0.72),
            point: SurfacePoint { along: frac * DVec2::new(TAU * at.x, total), frac, local: middle },
        });
    }
}

fn tessellate_tube(emitter: &mut SurfelEmitter, points: &[DVec3], radii: &[f64], step: f64) {
    let total: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut done = 0.0;
    for (i, pair) in points.windows(2).enumerate() {
        let axis = pair[1] - pair[0];
        let length = axis.length();
        let Some(along) = axis.try_normalize() else { continue };
        let turn = DQuat::from_rotation_arc(DVec3::Y, along);
        for ring in intervals(0.0, length, (1.6 * step).min(length)) {
            let t = ring.middle / length;
            let radius = radii[i] + (radii[i + 1] - radii[i]) * t;
            let count = ((TAU * radius / step).round().max(4.0)) as usize;
            let (low, high) = (ring.low, ring.high);
            for k in 0..count {
                let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
                let middle = pair[0] + axis * t + turn * DVec3::new(cos, 0.0, sin) * radius;
                let frac = DVec2::new(k as f64 / count as f64, (done + ring.middle) / total);
                emitter.emit(&SurfaceCell {
                    middle,
                    across: turn * DVec3::new(sin, 0.0, -cos) * (TAU * radius / count as f64),
                    along: along * (high - low),
                    sigma_frac: DVec2::new(0.72, 0.74),
                    point: SurfacePoint { along: frac * DVec2::new(TAU * radius, total), frac, local: middle },
                });
            }
        }
        done += length;
    }
}
