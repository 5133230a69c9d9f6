//! The samples of an exposure: points of the aperture and moments of the shutter.

use std::f64::consts::TAU;

use glam::{DMat2, DVec2};

/// What becomes of the blur between the samples of an exposure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Between {
    /// It is left out: each sample is a sharp picture.
    Sharp,
    /// The splats of each sample are blurred by it.
    Blurred,
}

/// The golden angle.
const TURN_RAD: f64 = 2.399_963_229_728_653;
/// Variance of a uniform disk of radius 1 along any axis.
const DISK_VARIANCE: f64 = 0.25;

/// `num` points of a disk of radius 1, evenly spread on Vogel's spiral (Vogel, A better way to construct the sunflower
/// head, 1979). Their mean is the center. From three points on their variance is equal along all axes: that of the
/// disk, or, with blur between them, that of the centers of `num` parts of equal area.
pub(super) fn lens_points(num: usize, between: Between) -> Vec<DVec2> {
    let spiral = |idx: usize| {
        let radius = ((idx as f64 + 0.5) / num as f64).sqrt();
        DVec2::from_angle(idx as f64 * TURN_RAD) * radius
    };
    let mut points: Vec<DVec2> = (0..num).map(spiral).collect();
    let mean = points.iter().sum::<DVec2>() / num as f64;
    points.iter_mut().for_each(|point| *point -= mean);
    let variance = match between {
        Between::Sharp => DISK_VARIANCE,
        Between::Blurred => DISK_VARIANCE * (1.0 - 1.0 / num as f64),
    };
    let moment = |of: fn(&DVec2) -> f64| points.iter().map(of).sum::<f64>() / num as f64;
    let (xx, xy, yy) = (moment(|p| p.x * p.x), moment(|p| p.x * p.y), moment(|p| p.y * p.y));
    // Cholesky factor L of the covariance: L^-1 makes it the identity.
    let (a, b) = (xx.sqrt(), xy / xx.sqrt());
    let c = (yy - b * b).max(0.0).sqrt();
    if c > 1e-3 {
        let scale = variance.sqrt();
        let whiten = DMat2::from_cols(DVec2::new(1.0 / a, -b / (a * c)), DVec2::new(0.0, 1.0 / c)) * scale;
        points.iter_mut().for_each(|point| *point = whiten * *point);
    }
    points
}

/// Four to seven points of a disk of radius 1 with weights: the center, and a ring around it. Mean and variance are those of
/// the disk, and so is the fourth moment of the radius (Gauss-Radau; seven points are exact to the fifth degree: Radon 1948).
pub(super) fn weighted_ring(num: usize) -> Vec<(DVec2, f64)> {
    let around = num - 1;
    let place = |idx: usize| DVec2::from_angle((idx as f64 + 0.25) * TAU / around as f64) * (2.0_f64 / 3.0).sqrt();
    let ring = (0..around).map(|idx| (place(idx), 0.75 / around as f64));
    std::iter::once((DVec2::ZERO, 0.25)).chain(ring).collect()
}

/// Start, middle and end of `num` equal parts of the exposure, as fractions of it.
pub(super) fn moments(num: usize) -> impl Iterator<Item = [f64; 3]> {
    (0..num).map(move |part| [0.0, 0.5, 1.0].map(|place| (part as f64 + place) / num as f64))
}
