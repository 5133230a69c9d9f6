//! Drawn textures: rugs, and the paintings and prints on the walls.

use glam::{DVec2, Vec3};

use super::material::{Material, Pattern};
use super::noise::{self, smoothstep};
use super::surface_point::SurfacePoint;

const INK: Vec3 = Vec3::new(0.03, 0.035, 0.05);
const PAPER: Vec3 = Vec3::new(0.82, 0.77, 0.67);

/// Linear reflectance of a rug, painting or print at a surface point.
pub(super) fn albedo(material: &Material, at: &SurfacePoint) -> Vec3 {
    match material.pattern {
        Pattern::RugClassic => rug_classic(material, at),
        Pattern::RugModern => rug_modern(material, at),
        Pattern::RugStriped => rug_striped(material, at),
        Pattern::PictureHills => hills(material, at.frac),
        Pattern::PictureShapes => shapes(material, at.frac),
        _ => stem(material, at.frac),
    }
}

/// Distance from the border of the surface, m.
fn border_distance(at: &SurfacePoint) -> f64 {
    let size = at.along / at.frac.max(DVec2::splat(1e-6));
    at.along.min(size - at.along).min_element()
}

/// Brightness factor of carpet pile.
fn pile(at: &SurfacePoint, seed: u32) -> f32 {
    let worn = noise::fbm(at.along.x * 5.0, at.along.y * 5.0, seed);
    let tufts = noise::value_noise(at.along.x * 70.0, at.along.y * 70.0, seed ^ 1);
    (0.74 + 0.2 * worn + 0.3 * tufts) as f32
}

/// Border bands around a medallion in a lattice of diamonds.
fn rug_classic(material: &Material, at: &SurfacePoint) -> Vec3 {
    let edge = border_distance(at);
    let size = at.along / at.frac.max(DVec2::splat(1e-6));
    let middle = (at.along - size / 2.0).abs();
    let cell = (middle / 0.17).fract() - 0.5;
    let diamond = cell.x.abs() + cell.y.abs();
    let medallion = (middle.x / (size.x * 0.3)).hypot(middle.y / (size.y * 0.3)) + 0.05 * (middle.x * 60.0).cos();
    let light = Vec3::new(0.66, 0.56, 0.42);
    let tone = if edge < 0.05 {
        material.accent
    } else if edge < 0.07 || (edge > 0.2 && edge < 0.215) {
        light
    } else if edge < 0.2 {
        let along = if at.along.x.min(size.x - at.along.x) < 0.2 { at.along.y } else { at.along.x };
        let tooth = ((along / 0.13).fract() - 0.5).abs() * 0.13 + 0.02;
        if (edge - 0.135).abs() < tooth { material.accent } else { material.color * 0.6 }
    } else if medallion < 0.42 {
        if diamond < 0.22 { material.color } else { light }
    } else if medallion < 1.0 {
        if (medallion - 0.72).abs() < 0.05 || diamond < 0.16 { light } else { material.accent }
    } else if diamond < 0.13 {
        light
    } else if diamond > 0.42 && diamond < 0.5 {
        material.accent
    } else {
        material.color
    };
    tone * pile(at, material.seed)
}

/// Large overlapping discs.
fn rug_modern(material: &Material, at: &SurfacePoint) -> Vec3 {
    let p = at.frac;
    let aspect = (at.along.x / p.x.max(1e-6)) / (at.along.y / p.y.max(1e-6)).max(1e-6);
    let q = DVec2::new(p.x * aspect, p.y);
    let ring = |x: f64, y: f64, r: f64| q.distance(DVec2::new(x * aspect, y)) < r;
    let base = Vec3::new(0.7, 0.64, 0.54);
    let tone = if ring(0.12, 0.1, 0.42) {
        if ring(0.12, 0.1, 0.26) { material.accent } else { material.color }
    } else if ring(0.86, 0.95, 0.62) {
        if ring(0.86, 0.95, 0.48) { base } else { material.accent * 0.8 }
    } else if ring(0.7, 0.3, 0.13) {
        material.color
    } else {
        base
    };
    tone * pile(at, material.seed)
}

/// Stripes and zigzags.
fn rug_striped(material: &Material, at: &SurfacePoint) -> Vec3 {
    let band = (at.along.x / 0.19) as i32;
    let zigzag = ((at.along.y / 0.09).fract() - 0.5).abs() * 0.05 + (at.along.x / 0.19).fract() * 0.19 - 0.08;
    let base = Vec3::new(0.66, 0.6, 0.5);
    let tone = match band.rem_euclid(5) {
        0 => material.color,
        2 if zigzag > 0.0 && zigzag < 0.05 => material.accent,
        4 if (at.along.x / 0.063).fract() < 0.5 => material.accent,
        _ => base,
    };
    tone * pile(at, material.seed)
}

/// Layered hills under a sun.
fn hills(material: &Material, frac: DVec2) -> Vec3 {
    let sky = PAPER.lerp(material.accent, 0.55 * (1.0 - frac.y) as f32);
    let mut tone = if frac.distance(DVec2::new(0.66, 0.7)) < 0.12 { material.accent * 1.1 } else { sky };
    for layer in 0..4_u32 {
        let depth = f64::from(layer) / 3.0;
        let line = 0.58 - 0.17 * f64::from(layer)
            + 0.16 * noise::fbm(frac.x * (2.0 + depth), f64::from(layer) * 5.1, material.seed);
        let shade = PAPER.lerp(material.color, 0.45 + 0.55 * depth as f32) * (0.95 - 0.45 * depth as f32);
        tone = tone.lerp(shade, smoothstep(0.008, -0.008, frac.y - line) as f32);
    }
    tone
}

/// A 3 x 3 grid of arcs, discs and triangles.
fn shapes(material: &Material, frac: DVec2) -> Vec3 {
    let grid = frac * 3.0;
    let (i, j) = (grid.x.min(2.99) as i32, grid.y.min(2.99) as i32);
    let local = DVec2::new(grid.x.fract(), grid.y.fract());
    let tones = [material.color, material.accent, PAPER, INK * 2.0];
    let pick = |salt: u32| tones[(noise::hash(i, j, material.seed ^ salt) % 4) as usize];
    let corner = DVec2::new(f64::from(noise::hash(i, j, 3) & 1), f64::from(noise::hash(i, j, 5) & 1));
    let inside = match noise::hash(i, j, material.seed ^ 9) % 3 {
        0 => local.distance(corner) < 0.96,
        1 => local.distance(DVec2::splat(0.5)) < 0.4,
        _ => local.x > local.y,
    };
    if inside { pick(1) } else { PAPER.lerp(pick(2), 0.4) }
}

/// A stem with alternating leaves.
fn stem(material: &Material, frac: DVec2) -> Vec3 {
    let p = DVec2::new(frac.x - 0.5 - 0.06 * (frac.y * 5.0).sin(), frac.y);
    let t = ((p.y - 0.2) / 0.09).floor();
    let side = if t.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
    let root = DVec2::new(0.0, 0.2 + t * 0.09);
    let q = p - root;
    let along = q.dot(DVec2::new(side * 0.8, 0.6));
    let across = q.perp_dot(DVec2::new(side * 0.8, 0.6));
    let length = 0.3 - 0.18 * p.y;
    let leaf = along > 0.0 && along < length && across.abs() < 0.05 * (along / length * std::f64::consts::PI).sin();
    let stalk = p.x.abs() < 0.008 && p.y > 0.1 && p.y < 0.85;
    if (leaf && p.y < 0.84) || stalk { material.color * 0.8 } else { PAPER }
}
