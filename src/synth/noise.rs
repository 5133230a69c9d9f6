//! Functions that textures are made of: a hash of integer cells, value noise, fractional Brownian motion, `smoothstep`.

/// Hash of a cell (Wellons' `lowbias32` over the combined coordinates).
pub(super) fn hash(x: i32, y: i32, seed: u32) -> u32 {
    let mut h =
        (x as u32).wrapping_mul(0x8DA6_B343) ^ (y as u32).wrapping_mul(0xD816_3841) ^ seed.wrapping_mul(0xCB1A_B31F);
    h = (h ^ (h >> 16)).wrapping_mul(0x7FEB_352D);
    h = (h ^ (h >> 15)).wrapping_mul(0x846C_A68B);
    h ^ (h >> 16)
}

/// The hash of a cell as a number in 0..1.
pub(super) fn unit_hash(x: i32, y: i32, seed: u32) -> f64 {
    f64::from(hash(x, y, seed)) / 4_294_967_296.0
}

/// Value noise in 0..1 with features of size 1.
pub(super) fn value_noise(x: f64, y: f64, seed: u32) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (a, b) = (ease(x - i), ease(y - j));
    let at = |dx: i32, dy: i32| unit_hash(i as i32 + dx, j as i32 + dy, seed);
    let low = at(0, 0) + (at(1, 0) - at(0, 0)) * a;
    let high = at(0, 1) + (at(1, 1) - at(0, 1)) * a;
    low + (high - low) * b
}

/// Fractional Brownian motion in 0..1: three octaves of [`value_noise`].
pub(super) fn fbm(x: f64, y: f64, seed: u32) -> f64 {
    let octave = |k: u32| value_noise(x * f64::from(1 << k), y * f64::from(1 << k), seed ^ k.wrapping_mul(0x9E37_79B9));
    (octave(0) * 4.0 + octave(1) * 2.0 + octave(2)) / 7.0
}

/// Cubic step: 0 up to `low`, 1 from `high`; falling if `low > high`.
pub(super) fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
