//! The transfer function of sRGB (IEC 61966-2-1), one value at a time.

/// Light of a display's signal. Signals above 1 go on along the curve.
pub fn to_light(signal: f32) -> f32 {
    if signal <= 0.040_45 { signal / 12.92 } else { ((signal + 0.055) / 1.055).powf(2.4) }
}

/// The inverse of [`to_light`].
pub fn to_signal(light: f32) -> f32 {
    if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}
