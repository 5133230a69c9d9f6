//! Procedural textures.
//!
//! Enters: a material and a surface point. Leaves: the linear reflectance there. Invariant: the result depends on nothing
//! else, so that surfels can be textured in any order.

use glam::{DVec2, DVec3, Vec3};

use super::artwork;
use super::material::{Material, Pattern};
use super::noise::{self, smoothstep};
use super::surface_point::SurfacePoint;

/// Linear reflectance of a material at a surface point. `grain` is the longest axis of the primitive, 0..=2.
pub(super) fn albedo(material: &Material, at: &SurfacePoint, grain: usize) -> Vec3 {
    let (x, y) = (at.along.x / material.scale, at.along.y / material.scale);
    let blend = |t: f64| material.color.lerp(material.accent, t.clamp(0.0, 1.0) as f32);
    match material.pattern {
        Pattern::Plain => material.color * (0.985 + 0.03 * noise::value_noise(x, y, material.seed) as f32),
        Pattern::Wood => blend(rings(material, at.local, grain)),
        Pattern::Weave => blend(0.65 * noise::fbm(x * 0.12, y * 0.12, material.seed) + 0.5 * thread(x, y) - 0.2),
        Pattern::Stripes => blend(f64::from((x.floor() as i32).rem_euclid(2))),
        Pattern::Marble => blend(veins(material, at.local)),
        Pattern::Speckle => blend(1.6 * noise::fbm(x * 1.7, y * 1.7, material.seed) - 0.3),
        Pattern::Leaf => blend(leaf_shade(at.frac)),
        Pattern::Spine => blend(spine(at.frac, material.seed)),
        Pattern::Clock => blend(clock(at.frac)),
        Pattern::Screen => blend(screen(at.frac, material.seed)),
        Pattern::Globe => blend(smoothstep(0.47, 0.53, noise::fbm(x, y, material.seed))),
        Pattern::Keys => blend(keys(at.along)),
        Pattern::Outside => outside(material, at.frac),
        _ => artwork::albedo(material, at),
    }
}

/// Darkness of wood grain, 0..=1: rings, stretched along the grain, modulated by slow noise.
fn rings(material: &Material, local: DVec3, grain: usize) -> f64 {
    let (b, c) = (local[(grain + 1) % 3], local[(grain + 2) % 3]);
    let (along, across) = (local[grain] / material.scale, (b + 0.73 * c) / material.scale);
    let drift = noise::fbm(along * 0.08, across * 0.5, material.seed);
    let fine = noise::value_noise(along * 0.12, across * 1.3, material.seed ^ 0x5bd1);
    0.5 * (1.0 - (2.0 * (drift * 5.0).fract() - 1.0).abs()) * drift + 0.35 * fine
}

/// Darkness of marble, about 0..=1.
fn veins(material: &Material, local: DVec3) -> f64 {
    let (x, y) = (local.x / material.scale + local.y * 3.0, local.z / material.scale + local.y * 4.0);
    let warp = 2.0 * noise::fbm(x, y, material.seed);
    (1.0 - 7.0 * ((x * 0.7 + y * 0.4 + warp).fract() - 0.5).abs()).max(0.0) * 0.8 + 0.15 * noise::value_noise(x, y, 7)
}

/// Sky, trees and hedge behind a window, by the fractions (right, up).
fn outside(material: &Material, frac: DVec2) -> Vec3 {
    let (x, y) = (frac.x * 16.0, frac.y);
    let sky = material.color.lerp(Vec3::new(0.86, 0.93, 1.0), (1.0 - y).powi(2) as f32);
    let tree_line = 0.46 + 0.14 * noise::fbm(x, 0.3, material.seed);
    let hedge_line = 0.36 + 0.03 * noise::fbm(x * 1.9, 7.7, material.seed);
    let clump = noise::fbm(x * 6.0, y * 50.0, material.seed ^ 0x77) as f32;
    let tree = material.accent * (0.65 + 0.9 * clump);
    let hedge = material.accent * Vec3::new(0.75, 0.8, 0.6) * (0.45 + 0.8 * clump);
    let far = sky.lerp(tree, smoothstep(0.02, -0.02, y - tree_line) as f32);
    far.lerp(hedge, smoothstep(0.01, -0.01, y - hedge_line) as f32)
}

/// 0 and 0.6 alternately, as a checkerboard of unit cells.
fn thread(x: f64, y: f64) -> f64 {
    f64::from((x.floor() as i32 + y.floor() as i32).rem_euclid(2)) * 0.6
}

/// Share of the vein color on a leaf, 0..=1.
fn leaf_shade(frac: DVec2) -> f64 {
    let off = (frac.x - 0.5).abs();
    let rib = smoothstep(0.09, 0.02, off);
    let side = smoothstep(0.35, 0.05, ((frac.y * 7.0 - off * 3.0).fract() - 0.5).abs()) * 0.35;
    (rib * 0.8).max(side)
}

/// 1 on the bands and the title of a book spine, else 0.
fn spine(frac: DVec2, seed: u32) -> f64 {
    let band = |low: f64, high: f64| frac.y > low && frac.y < high;
    let title = seed & 3 != 0 && band(0.42, 0.78) && noise::unit_hash((frac.y * 40.0) as i32, 0, seed) > 0.3;
    f64::from(u8::from(band(0.08, 0.13) || band(0.87, 0.92) || (title && (frac.x - 0.5).abs() < 0.3)))
}

/// 1 on the hour marks and hands of a clock face, else 0.
fn clock(frac: DVec2) -> f64 {
    let p = frac * 2.0 - 1.0;
    let (radius, angle) = (p.length(), p.x.atan2(p.y));
    let hour = (angle / std::f64::consts::TAU * 12.0 + 0.5).rem_euclid(1.0) - 0.5;
    let mark = radius > 0.72 && radius < 0.88 && hour.abs() * radius < 0.055;
    let hand = |at: f64, length: f64| {
        let d = DVec2::new(at.sin(), at.cos());
        p.dot(d) > -0.1 && p.dot(d) < length && p.perp_dot(d).abs() < 0.045
    };
    f64::from(u8::from(mark || hand(5.3, 0.5) || hand(0.9, 0.7) || radius < 0.06))
}

/// Share of the text color on a screen, 0..=1.
fn screen(frac: DVec2, seed: u32) -> f64 {
    let row = (frac.y * 14.0) as i32;
    let length = 0.25 + 0.6 * noise::unit_hash(row, 0, seed);
    let inside = frac.x > 0.08 && frac.x < length && (frac.y * 14.0).fract() > 0.45 && row > 1;
    if frac.y > 0.9 { 0.7 } else { f64::from(u8::from(inside)) }
}

/// 1 on the gaps between keys, else 0.
fn keys(along: DVec2) -> f64 {
    let gap = |v: f64| (v / 0.019).fract() < 0.16;
    f64::from(u8::from(gap(along.x) || gap(along.y)))
}
