//! The frames that matter for a least PSNR: small pictures along the whole path find those with the largest errors, which
//! are then compared at full size. Of frames with effects a few are compared at once: how much a small picture is blurred, in
//! pixels, says little about a large one.

use std::time::Instant;

use super::Forecast;
use super::accuracy::ReferenceSample;
use crate::pipeline::accuracy::{at, mean_square, psnr_db};
use crate::pipeline::film::{Compared, MovingFrames};
use crate::pipeline::promise::{final_bound_db, rank};
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};

/// Positions of the film at which small pictures are compared.
const NUM_SEARCHED: usize = 24;
/// Side of the small pictures over that of the film.
const SMALL_FRAC: f64 = 0.25;
/// Positions with the largest errors that are compared at full size, per quality.
const NUM_COMPARED: usize = 3;
/// Positions at which crops of `final` are compared with `reference`, and frames with effects with the samples of it.
const NUM_EXACT: usize = 6;

/// What the worst frames show besides the PSNR of the forecasts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Worst {
    /// PSNR of `final` without effects, dB.
    pub(super) final_db: f64,
    /// The same with effects, with the samples of `reference`.
    pub(super) finest_db: f64,
    /// Seconds per check of a frame with its effects; 0 for films without.
    pub(super) check_secs: f64,
}

/// Replaces the worst PSNR of forecasts by that of the frames that matter. Takes no account of the clock: the same film gets
/// the same figures.
///
/// # Errors
/// Those of the renderer.
pub(super) fn sample_worst(
    compared: &Compared<'_>,
    moving: &MovingFrames,
    forecasts: &mut [Forecast],
) -> Result<Worst, RenderError> {
    let Compared { renderer, settings, filmed } = compared;
    let cameras = &moving.cameras;
    let num = NUM_SEARCHED.min(cameras.len());
    let places: Vec<usize> = (0..num).map(|idx| (cameras.len() - 1) * idx / (num - 1).max(1)).collect();
    let few: Vec<usize> = places.iter().copied().step_by(places.len().div_ceil(NUM_EXACT).max(1)).collect();
    let mut of_crops = Vec::new();
    for &place in &few {
        of_crops.push(10_f64.powf(-ReferenceSample::of(renderer, &cameras[place], settings)?.final_db / 10.0));
    }
    let num_pixels =
        cameras.first().map_or(1.0, |camera| f64::from(camera.intrinsics.width) * f64::from(camera.intrinsics.height));
    let final_db = psnr_db(of_crops.into_iter(), f64::INFINITY).min(final_bound_db(num_pixels));
    let is_approximate = |forecast: &&mut Forecast| forecast.quality != Quality::Reference;
    if !filmed.develops() {
        let at_places: Vec<&Camera> = places.iter().map(|place| &cameras[*place]).collect();
        for forecast in forecasts.iter_mut().filter(is_approximate) {
            let worst = worst_plain(compared, &at_places, forecast.quality)?;
            forecast.worst_psnr_db = psnr_db(std::iter::once(worst), final_db);
        }
        return Ok(Worst { final_db, finest_db: final_db, check_secs: 0.0 });
    }
    let (start, mut of_finest) = (Instant::now(), 0.0);
    let qualities: Vec<Quality> = forecasts.iter().map(|forecast| forecast.quality).collect();
    let mut of_each = vec![0.0; forecasts.len()];
    for &place in &few {
        let frame_idx = moving.numbers[place];
        of_finest = f64::max(of_finest, compared.floor(frame_idx)?);
        for (worst, found) in of_each.iter_mut().zip(compared.found(frame_idx, &qualities)?) {
            *worst = f64::max(*worst, found.bound());
        }
    }
    let check_secs = start.elapsed().as_secs_f64() / few.len() as f64;
    for (worst, forecast) in of_each.into_iter().zip(forecasts).filter(|(_, forecast)| is_approximate(forecast)) {
        forecast.worst_psnr_db = psnr_db(std::iter::once(worst), final_db);
    }
    Ok(Worst { final_db, finest_db: psnr_db(std::iter::once(of_finest), final_db), check_secs })
}

/// The largest mean square difference to `final` of a quality.
fn worst_plain(compared: &Compared<'_>, places: &[&Camera], quality: Quality) -> Result<f64, RenderError> {
    let Compared { renderer, settings, .. } = compared;
    let mut worst = 0.0;
    if rank(quality) < rank(Quality::Final) {
        let error = |camera: &Camera| difference(renderer, camera, settings, quality);
        let small = |camera: &Camera| Camera { intrinsics: camera.intrinsics.scaled(SMALL_FRAC), ..*camera };
        let mut errors = Vec::with_capacity(places.len());
        for camera in places {
            errors.push((error(&small(camera))?, camera));
        }
        errors.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, camera) in errors.iter().take(NUM_COMPARED) {
            worst = f64::max(worst, error(camera)?);
        }
    }
    Ok(worst)
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
