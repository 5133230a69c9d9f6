//! A film with requirements: the quality to begin with, and what to watch while it is made.

use std::path::Path;
use std::time::{Duration, Instant};

use super::worst::sample_worst;
use super::{Forecast, Requirements, SAMPLED_BUDGET_FRAC, TIME_LIMIT_SECS, TIME_MARGIN, choose, forecast_within};
use crate::pipeline::accuracy::at;
use crate::pipeline::error::PipelineError;
use crate::pipeline::film::{Compared, FilmSettings, Filmed};
use crate::pipeline::promise::{Promise, margin_db};
use cinesplat_render::{Quality, Renderer};
use cinesplat_trajectory::Shot;

/// Cores of a machine that another program may take while a film is made.
const CORES_AT_RISK: usize = 1;

/// A film whose requirements can be met.
#[derive(Debug, Clone, PartialEq)]
pub struct Promised {
    /// Forecast of the quality to begin with.
    pub forecast: Forecast,
    /// What to watch while the film is made: a field of [`FilmSettings`].
    pub promise: Promise,
    /// Why the film may still be late; `None` where it steps down in time whatever one other program does.
    pub doubt: Option<String>,
}

/// Forecasts a film at every quality, and chooses the one to begin with. The budget counts from the call.
///
/// # Errors
/// Those of [`forecast`](super::forecast()), and [`PipelineError::Unreachable`] for requirements that cannot be met.
pub fn promised(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    settings: &FilmSettings,
    requirements: Requirements,
) -> Result<Promised, PipelineError> {
    let start = Instant::now();
    let limit_secs = requirements
        .budget
        .map_or(TIME_LIMIT_SECS, |budget| TIME_LIMIT_SECS.min(SAMPLED_BUDGET_FRAC * budget.as_secs_f64()));
    let at = |qualities: &[Quality]| forecast_within((renderer, shot), output, settings, qualities, limit_secs);
    // No check of some frames shows that all frames of `draft` are good enough.
    let qualities = [Quality::Draft, Quality::Standard, Quality::Final];
    let mut forecasts = at(if requirements.min_psnr_db.is_some() { &qualities[1..] } else { &qualities })?;
    let final_db = match requirements.min_psnr_db {
        Some(least_db) => sample_frames((renderer, shot), settings, least_db, &mut forecasts)?,
        None => f64::INFINITY,
    };
    if requirements.may_need_reference(&forecasts) {
        forecasts.extend(at(&[Quality::Reference])?);
    }
    let left = requirements.budget.map(|budget| budget.saturating_sub(start.elapsed()));
    let quality = choose(&forecasts, Requirements { budget: left, ..requirements }).map_err(|error| match error {
        PipelineError::Unreachable { reachable, .. } => {
            PipelineError::Unreachable { wanted: requirements.sentence_after(start.elapsed()), reachable }
        }
        error => error,
    })?;
    let is_chosen = |forecast: &&Forecast| forecast.quality == quality;
    let chosen = forecasts.iter().find(is_chosen).copied().ok_or(PipelineError::Unreachable {
        wanted: quality.as_ref().to_owned(),
        reachable: "a quality without a forecast".to_owned(),
    })?;
    let promise = Promise {
        min_psnr_db: requirements.min_psnr_db,
        deadline: requirements.budget.map(|budget| start + budget),
        final_db,
        paces: forecasts.iter().map(|forecast| forecast.pace).collect(),
    };
    let doubt = left.and_then(|left| {
        // With a least PSNR the film cannot step down.
        let fastest = if requirements.min_psnr_db.is_some() { Some(&chosen) } else { forecasts.first() };
        let cores = super::num_cores();
        let slower = cores as f64 / cores.saturating_sub(CORES_AT_RISK).max(1) as f64;
        let needed = (fastest?.film_time + super::TIME_RESERVE).mul_f64(slower.max(TIME_MARGIN));
        (needed > left).then(|| {
            format!(
                "no reserve: if one more program takes a core, even {} needs {} of the {} that are left",
                fastest.map_or("", |forecast| forecast.quality.as_ref()),
                super::seconds(needed),
                super::seconds(left)
            )
        })
    });
    Ok(Promised { forecast: chosen, promise, doubt })
}

/// Looks for the frames with the largest errors. Where `final` falls short for the sake of its effects, and its samples are
/// enough when there are as many as those of `reference`, its forecast becomes one with these. Returns the PSNR of `final`
/// without effects, dB.
fn sample_frames(
    (renderer, shot): (&Renderer<'_>, &Shot),
    settings: &FilmSettings,
    least_db: f64,
    forecasts: &mut [Forecast],
) -> Result<f64, PipelineError> {
    let filmed = Filmed::new(shot, &settings.effects, &settings.render)?;
    let frames = settings.frames.of_film(shot.num_frames())?;
    let moving = filmed.moving_frames(frames.clone());
    let compared = Compared { renderer, filmed: &filmed, settings: &settings.render };
    let worst = sample_worst(&compared, &moving, forecasts)?;
    let is_short = |forecast: &Forecast| forecast.worst_psnr_db < least_db + margin_db(forecast.quality);
    for forecast in forecasts {
        if forecast.quality == Quality::Final && is_short(forecast) && worst.finest_db > forecast.worst_psnr_db {
            let render = at(&settings.render, Quality::Final);
            let factors = [Filmed::cost_factor, Filmed::finest_factor];
            let [few, many] = factors.map(|factor| factor(&filmed, &frames, (renderer, &render)));
            *forecast = forecast.slowed(forecast.render_time.mul_f64((many? / few?.max(1e-9) - 1.0).max(0.0)));
            forecast.worst_psnr_db = worst.finest_db;
            forecast.psnr_db = forecast.psnr_db.max(worst.finest_db);
        }
        *forecast = forecast.slowed(Duration::from_secs_f64(worst.check_secs * moving.cameras.len() as f64));
    }
    Ok(worst.final_db)
}
