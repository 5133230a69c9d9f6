//! The frames that matter for a least PSNR: small pictures along the whole path find those with the largest errors, which
//! are then compared at full size.

use super::Forecast;
use super::accuracy::ReferenceSample;
use crate::pipeline::accuracy::{at, mean_square, psnr_db};
use crate::pipeline::promise::{final_bound_db, rank};
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};

/// Positions of the film at which small pictures are compared.
const NUM_SEARCHED: usize = 24;
/// Side of the small pictures over that of the film.
const SMALL_FRAC: f64 = 0.25;
/// Positions with the largest errors that are compared at full size, per quality.
const NUM_COMPARED: usize = 3;
/// Positions at which crops of `final` are compared with `reference`.
const NUM_EXACT: usize = 6;

/// Replaces the worst PSNR of forecasts by that of the frames that matter. Takes no account of the clock: the same film gets
/// the same figures.
///
/// # Errors
/// Those of the renderer.
pub(super) fn sample_worst<'a>(
    renderer: &Renderer<'_>,
    cameras: &'a [Camera],
    settings: &RenderSettings,
    forecasts: &mut [Forecast],
) -> Result<(), RenderError> {
    let num = NUM_SEARCHED.min(cameras.len());
    let places: Vec<&'a Camera> = (0..num).map(|idx| &cameras[(cameras.len() - 1) * idx / (num - 1).max(1)]).collect();
    let step = places.len().div_ceil(NUM_EXACT).max(1);
    let mut of_crops = Vec::new();
    for camera in places.iter().step_by(step) {
        of_crops.push(10_f64.powf(-ReferenceSample::of(renderer, camera, settings)?.final_db / 10.0));
    }
    let num_pixels =
        cameras.first().map_or(1.0, |camera| f64::from(camera.intrinsics.width) * f64::from(camera.intrinsics.height));
    let final_db = psnr_db(of_crops.into_iter(), f64::INFINITY).min(final_bound_db(num_pixels));
    for forecast in forecasts.iter_mut().filter(|forecast| forecast.quality != Quality::Reference) {
        let mut worst = 0.0;
        if rank(forecast.quality) < rank(Quality::Final) {
            let error = |camera: &Camera| difference(renderer, camera, settings, forecast.quality);
            let small = |camera: &Camera| Camera { intrinsics: camera.intrinsics.scaled(SMALL_FRAC), ..*camera };
            let compared = |camera: &&'a Camera| Ok::<_, RenderError>((error(&small(camera))?, *camera));
            let mut errors = places.iter().map(compared).collect::<Result<Vec<_>, _>>()?;
            errors.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (_, camera) in errors.iter().take(NUM_COMPARED) {
                worst = f64::max(worst, error(camera)?);
            }
        }
        forecast.worst_psnr_db = psnr_db(std::iter::once(worst), final_db);
    }
    Ok(())
}

/// Mean square difference of a quality to `final`.
fn difference(
    renderer: &Renderer<'_>,
    camera: &Camera,
    settings: &RenderSettings,
    quality: Quality,
) -> Result<f64, RenderError> {
    let best = renderer.render(camera, &at(settings, Quality::Final))?;
    Ok(mean_square(&renderer.render(camera, &at(settings, quality))?, &best))
}
