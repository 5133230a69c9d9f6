use glam::Vec3;

use super::bake::{BakedLight, DirectLight, luminance};
use super::color::encode;
use super::surfel::Surfel;

/// Constants of the spherical harmonics of degree 0 and 1.
const SH_C0: f32 = 0.282_094_8;
const SH_C1: f32 = 0.488_602_5;

/// Linear luminance to which the mean luminance of a room is exposed. The mean is a power mean with exponent 1/2, which is
/// robust against bright spots.
const KEY: f32 = 0.195;

/// Display-encoded colors as spherical-harmonic coefficients.
pub(super) struct ToneMapped {
    /// Degree 0, one per surfel.
    pub(super) degree_0: Vec<Vec3>,
    /// Degree 1, three per surfel.
    pub(super) degree_1: Vec<Vec3>,
}

/// Exposes, tone-maps and display-encodes the radiance; the sheen becomes coefficients of degree 1.
pub(super) fn tone_map(surfels: &[Surfel], baked: &BakedLight) -> ToneMapped {
    let exposure = KEY / mean_luminance(surfels, baked).max(1e-6);
    let mut toned =
        ToneMapped { degree_0: Vec::with_capacity(surfels.len()), degree_1: Vec::with_capacity(3 * surfels.len()) };
    for (i, surfel) in surfels.iter().enumerate() {
        let emitted = surfel.albedo * surfel.emission;
        // Emission is given in units of exposed white, so it is added after the exposure.
        let linear = (baked.radiance[i] - emitted) * exposure + emitted;
        let display = filmic_curve(linear);
        toned.degree_0.push((display - 0.5) / SH_C0);
        toned.degree_1.extend(sheen(surfel, &baked.direct[i], exposure));
    }
    toned
}

/// Area-weighted power mean of the luminance of the surfels without emission.
fn mean_luminance(surfels: &[Surfel], baked: &BakedLight) -> f32 {
    let (mut sum, mut weight) = (0.0_f64, 0.0_f64);
    for (surfel, radiance) in surfels.iter().zip(&baked.radiance) {
        if surfel.emission <= 0.0 {
            let area = f64::from(surfel.scale.x * surfel.scale.y);
            sum += area * f64::from(luminance(*radiance).max(0.0).sqrt());
            weight += area;
        }
    }
    if weight > 0.0 { (sum / weight).powi(2) as f32 } else { 1.0 }
}

/// Filmic tone curve (Narkowicz 2015, a fit of ACES) and display encoding.
fn filmic_curve(linear: Vec3) -> Vec3 {
    let curve = |x: f32| x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    let x = linear.max(Vec3::ZERO) * 0.8;
    // Mixing 10 % of the luminance into each channel limits the saturation of bright colors.
    let mixed = x.lerp(Vec3::splat(luminance(x)), 0.1);
    Vec3::new(encode(curve(mixed.x)), encode(curve(mixed.y)), encode(curve(mixed.z)))
}

/// Coefficients of degree 1 for a specular lobe about the mirror direction r of the light: seen from the unit direction v
/// (surfel to camera) it adds a (v . r).
fn sheen(surfel: &Surfel, lit: &DirectLight, exposure: f32) -> [Vec3; 3] {
    let Some(toward) = lit.toward.try_normalize() else { return [Vec3::ZERO; 3] };
    let mirror = surfel.normal * (2.0 * surfel.normal.dot(toward)) - toward;
    let strength = (luminance(lit.irradiance) * exposure).sqrt().min(1.2);
    let amplitude = 0.16 * surfel.gloss * strength;
    // The basis is -C1 y, C1 z, -C1 x of the direction camera to surfel, which is -v.
    [mirror.y, -mirror.z, mirror.x].map(|m| Vec3::splat(amplitude * m / SH_C1))
}
