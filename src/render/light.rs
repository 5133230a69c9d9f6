//! Pictures as light, and back: the transfer function of sRGB (IEC 61966-2-1), in polynomials that vectorize.
//!
//! A film exposes light. The mean of pictures is therefore that of their light, not that of their color values: a bright
//! lamp outshines the dark wall that it is blurred into.

/// Light of a color value, both 0..=1; clamps. Error below 6e-6.
#[inline(always)]
#[allow(clippy::manual_clamp, reason = "a value that is no number becomes 0")]
pub(super) fn light(value: f32) -> f32 {
    const TERMS: [f32; 7] =
        [-5.556_313e-2, 0.229_708_03, -0.438_403_07, 0.719_386_5, 0.510_713_93, 3.324_237_5e-2, 9.097_09e-4];
    let value = value.max(0.0).min(1.0);
    let bright = TERMS.iter().fold(0.0, |sum, term| sum * value + term);
    if value <= 0.040_45 { value * (1.0 / 12.92) } else { bright }
}

/// Color value of light, both 0..=1; clamps. Error below 8e-6: a polynomial in the fourth root.
#[inline(always)]
#[allow(clippy::manual_clamp, reason = "a value that is no number becomes 0")]
pub(super) fn color_value(light: f32) -> f32 {
    const TERMS: [f32; 6] = [-6.811_363e-2, 0.289_430_02, -0.577_362_9, 1.255_338_7, 0.162_043_2, -6.134_184e-2];
    let light = light.max(0.0).min(1.0);
    let root = light.sqrt().sqrt();
    let bright = TERMS.iter().fold(0.0, |sum, term| sum * root + term);
    if light <= 0.003_130_8 { light * 12.92 } else { bright }
}
