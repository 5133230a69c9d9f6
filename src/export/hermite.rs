//! The cubic Hermite curve, which several of the formats interpolate by.

/// Weights of the value and the slope at the start and of those at the end, at a fraction of the way; slopes are per way.
pub(super) fn hermite_weights(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2]
}
