//! Color of a Gaussian from the view direction: real spherical harmonics up to degree 3 with the signs of 3D Gaussian
//! splatting.
//!
//! Source: Kerbl et al. 2023; the constants are sqrt((2 l + 1) / (4 pi) (l - |m|)! / (l + |m|)!) and its sqrt(2)
//! multiples, with the Condon-Shortley phase.

use glam::{DVec3, Vec3};

/// Value of the constant basis function.
const DEGREE_0: f64 = 0.282_094_791_773_878_14;
const DEGREE_1: f64 = 0.488_602_511_902_919_9;
const DEGREE_2: [f64; 3] = [1.092_548_430_592_079_2, 0.315_391_565_252_520_05, 0.546_274_215_296_039_6];
const DEGREE_3: [f64; 5] = [
    0.590_043_589_926_643_5,
    2.890_611_442_640_554,
    0.457_045_799_464_465_8,
    0.373_176_332_590_115_4,
    1.445_305_721_320_277,
];

/// Basis functions of degrees 1..=3 at a unit direction, in the order of a Gaussian's coefficients.
pub(super) fn basis(direction: DVec3) -> [f64; 15] {
    let DVec3 { x, y, z } = direction;
    let (xx, yy, zz) = (x * x, y * y, z * z);
    let [d0, d1, d2] = DEGREE_2;
    let [t0, t1, t2, t3, t4] = DEGREE_3;
    [
        -DEGREE_1 * y,
        DEGREE_1 * z,
        -DEGREE_1 * x,
        d0 * x * y,
        -d0 * y * z,
        d1 * (2.0 * zz - xx - yy),
        -d0 * x * z,
        d2 * (xx - yy),
        -t0 * y * (3.0 * xx - yy),
        t1 * x * y * z,
        -t2 * y * (4.0 * zz - xx - yy),
        t3 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy),
        -t2 * x * (4.0 * zz - xx - yy),
        t4 * z * (xx - yy),
        -t0 * x * (xx - 3.0 * yy),
    ]
}

/// Color in the direction of `offset` (mean minus camera center, any length), in `f64`; 0 or more.
///
/// If `offset` is zero there is no direction, and only degree 0 is used.
pub(super) fn color(offset: DVec3, sh_dc: Vec3, sh_rest: &[Vec3]) -> DVec3 {
    let mut sum = sh_dc.as_dvec3() * DEGREE_0 + 0.5;
    if let Some(direction) = offset.try_normalize().filter(|_| !sh_rest.is_empty()) {
        for (coefficient, value) in sh_rest.iter().zip(basis(direction)) {
            sum += coefficient.as_dvec3() * value;
        }
    }
    sum.max(DVec3::ZERO)
}

/// Color from degree 0 alone, in `f32`.
pub(super) fn base_color(sh_dc: Vec3) -> Vec3 {
    (sh_dc * DEGREE_0 as f32 + 0.5).max(Vec3::ZERO)
}

/// As [`color`], with the sum in `f32`.
pub(super) fn color_f32(offset: DVec3, sh_dc: Vec3, sh_rest: &[Vec3]) -> Vec3 {
    let mut sum = sh_dc * DEGREE_0 as f32 + 0.5;
    if let Some(direction) = offset.try_normalize().filter(|_| !sh_rest.is_empty()) {
        for (coefficient, value) in sh_rest.iter().zip(basis(direction)) {
            sum += *coefficient * value as f32;
        }
    }
    sum.max(Vec3::ZERO)
}
