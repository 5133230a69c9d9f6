//! How close a capture can be looked at.

use glam::DVec3;
use strum::VariantArray;

use cinesplat_geometry::Camera;
use cinesplat_trajectory::ShotSize;

/// Largest size of the splats over the frame's height at which a picture holds: 8 px in 720 lines. A splat of 8 px blurs an
/// edge over about as many pixels, which reads as soft focus; twice that reads as paint.
pub const MAX_SPLAT_FRAC: f64 = 8.0 / 720.0;

/// The closest size of shot that a subject holds to, where it is shown `height_frac` of the frame high with splats of
/// `splat_px` in a film of `film_height_px`. Splats and subject grow together.
pub fn holds_to(height_frac: f64, splat_px: f64, film_height_px: u32) -> ShotSize {
    let largest = height_frac * MAX_SPLAT_FRAC * f64::from(film_height_px) / splat_px;
    let fits = |size: &&ShotSize| size.height_band_frac().0 <= largest;
    ShotSize::VARIANTS.iter().find(fits).copied().unwrap_or(ShotSize::ExtremeLong)
}

/// Height of a projected box over the frame's height; `None` where a corner is not in front of the camera.
pub(super) fn height_frac(camera: &Camera, corners: &[DVec3; 8]) -> Option<f64> {
    let rows: Option<Vec<f64>> = corners.iter().map(|&corner| camera.project(corner).map(|(at, _)| at.y)).collect();
    let rows = rows?;
    let top = rows.iter().copied().fold(f64::INFINITY, f64::min);
    let bottom = rows.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Some((bottom - top) / f64::from(camera.intrinsics.height))
}
