//! Discrete Fourier transform of a real signal.

use std::f64::consts::TAU;

/// Magnitudes of bins 0..=len/2 of the transform of `signal`, padded with zeros to `len`, a power of two.
///
/// Radix 2, decimation in time, in place (Cooley and Tukey 1965).
pub(super) fn magnitudes(signal: &[f64], len: usize) -> Vec<f64> {
    let num_bits = len.trailing_zeros();
    let mut re = vec![0.0; len];
    let mut im = vec![0.0; len];
    for (idx, value) in signal.iter().take(len).enumerate() {
        let place = if num_bits == 0 { 0 } else { idx.reverse_bits() >> (usize::BITS - num_bits) };
        re[place] = *value;
    }
    let mut half = 1;
    while half < len {
        for start in (0..len).step_by(2 * half) {
            for k in 0..half {
                let (sin, cos) = (-TAU * k as f64 / (2 * half) as f64).sin_cos();
                let (a, b) = (start + k, start + k + half);
                let (x, y) = (re[b] * cos - im[b] * sin, re[b] * sin + im[b] * cos);
                (re[b], im[b]) = (re[a] - x, im[a] - y);
                (re[a], im[a]) = (re[a] + x, im[a] + y);
            }
        }
        half *= 2;
    }
    (0..=len / 2).filter_map(|bin| Some(re.get(bin)?.hypot(*im.get(bin)?))).collect()
}
