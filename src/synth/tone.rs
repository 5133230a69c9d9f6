use glam::Vec3;

use super::bake::{Baked, Lit, luminance};
use super::color::encode;
use super::surfel::Surfel;

/// Zeroth and first spherical-harmonic constants.
const SH_C0: f32 = 0.282_094_8;
const SH_C1: f32 = 0.488_602_5;

/// Linear luminance that the power mean (exponent one half, which bright spots and hidden sides hardly move) of a room is
/// exposed to.
const KEY: f32 = 0.195;

/// Display colors as spherical-harmonic coefficients.
pub(super) struct Toned {
    /// Degree 0.
    pub(super) dc: Vec<Vec3>,
    /// Degree 1, three a surfel.
    pub(super) first: Vec<Vec3>,
}

/// Exposes, compresses and display-encodes the radiance; the sheen becomes degree-1 coefficients.
pub(super) fn tone(surfels: &[Surfel], baked: &Baked) -> Toned {
    let exposure = KEY / mean_luminance(surfels, baked).max(1e-6);
    let mut toned = Toned { dc: Vec::with_capacity(surfels.len()), first: Vec::with_capacity(3 * surfels.len()) };
    for (i, surfel) in surfels.iter().enumerate() {
        let glow = surfel.albedo * surfel.glow;
        // Shining things are meant for the screen: their glow is added after exposure.
        let linear = (baked.radiance[i] - glow) * exposure + glow;
        let display = film(linear);
        toned.dc.push((display - 0.5) / SH_C0);
        toned.first.extend(sheen(surfel, &baked.direct[i], exposure));
    }
    toned
}

fn mean_luminance(surfels: &[Surfel], baked: &Baked) -> f32 {
    let (mut sum, mut weight) = (0.0_f64, 0.0_f64);
    for (surfel, radiance) in surfels.iter().zip(&baked.radiance) {
        if surfel.glow <= 0.0 {
            let area = f64::from(surfel.scale.x * surfel.scale.y);
            sum += area * f64::from(luminance(*radiance).max(0.0).sqrt());
            weight += area;
        }
    }
    if weight > 0.0 { (sum / weight).powi(2) as f32 } else { 1.0 }
}

/// Filmic shoulder (Narkowicz 2015, fitted to ACES) and display encoding.
fn film(linear: Vec3) -> Vec3 {
    let curve = |x: f32| x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    let x = linear.max(Vec3::ZERO) * 0.8;
    // A little of the luminance in each channel keeps bright saturated colors from turning neon.
    let mixed = x.lerp(Vec3::splat(luminance(x)), 0.1);
    Vec3::new(encode(curve(mixed.x)), encode(curve(mixed.y)), encode(curve(mixed.z)))
}

/// Linear lobe toward the mirror direction of the light. Seen from the unit direction v (surfel to camera) it adds a (v . r).
fn sheen(surfel: &Surfel, lit: &Lit, exposure: f32) -> [Vec3; 3] {
    let Some(toward) = lit.toward.try_normalize() else { return [Vec3::ZERO; 3] };
    let mirror = surfel.normal * (2.0 * surfel.normal.dot(toward)) - toward;
    let strength = (luminance(lit.irradiance) * exposure).sqrt().min(1.2);
    let amplitude = 0.16 * surfel.gloss * strength;
    // The basis is -C1 y, C1 z, -C1 x of the direction camera to surfel, which is -v.
    [mirror.y, -mirror.z, mirror.x].map(|m| Vec3::splat(amplitude * m / SH_C1))
}
