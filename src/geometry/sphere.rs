//! Directions all around a point.

use glam::DVec3;

/// Evenly distributed unit directions (Fibonacci spiral).
pub fn sphere_directions(count: usize) -> Vec<DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let direction = |i: usize| {
        let y = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
        let ring = (1.0 - y * y).sqrt();
        let (sin, cos) = (golden * i as f64).sin_cos();
        DVec3::new(ring * cos, y, ring * sin)
    };
    (0..count).map(direction).collect()
}
