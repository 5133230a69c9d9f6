use std::ops::ControlFlow;
use std::time::Instant;

use glam::DQuat;

use super::load::{Load, LoadTime};
use super::report::{Film, Outcome, PromiseRow};
use crate::cli::bench::temporary_film::TemporaryFilm;
use crate::cli::failure::Failure;
use cinesplat::files::Existing;
use cinesplat::geometry::{Camera, Intrinsics};
use cinesplat::pipeline::{self, FilmReport, FilmSettings, PipelineError, Promised, Requirements};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Easing, KeyOptics, Keyframe, SceneRef, Shot};
use cinesplat::video::VideoSettings;

/// Frames per second of the films.
const RATE_FPS: f64 = 24.0;
/// Lengths of the moves over the size of the scene, and their turns in degrees; a film takes one of each.
const TRAVELS: [f64; 3] = [0.25, -0.1, 0.05];
const TURNS_DEG: [f64; 4] = [0.0, 30.0, -60.0, 120.0];

/// A film that is to keep requirements.
pub(super) struct PromisedFilm<'a> {
    pub(super) renderer: &'a Renderer<'a>,
    pub(super) shot: &'a Shot,
    pub(super) settings: &'a FilmSettings,
}

impl PromisedFilm<'_> {
    /// Films with a least PSNR, and compares every frame with `reference`.
    pub(super) fn with_psnr(&self, film: &Film, requirements: Requirements) -> Result<PromiseRow, Failure> {
        let asked = requirements.min_psnr_db.unwrap_or_default();
        let row = |outcome| PromiseRow::new(film.clone(), asked, &outcome);
        let Some((_, report)) = self.film(requirements, None)? else { return Ok(row(Outcome::Refused)) };
        let path = CameraPath::new(self.shot)?;
        let mut worst_db = f64::INFINITY;
        for &(frame_idx, quality) in &report.qualities {
            let camera = pipeline::camera_at(&path, self.shot, frame_idx);
            let at = |quality| RenderSettings { quality, ..self.settings.render };
            let exact = self.renderer.render(&camera, &at(Quality::Reference))?;
            worst_db = worst_db.min(self.renderer.render(&camera, &at(quality))?.psnr_db(&exact));
        }
        let is_kept = worst_db >= asked;
        Ok(row(Outcome::Filmed { got: worst_db, is_kept, is_doubted: false, report: Box::new(report) }))
    }

    /// Films with a budget while another process takes a core. The time counts from the forecast to the finished file.
    pub(super) fn with_budget(
        &self,
        film: &Film,
        requirements: Requirements,
        load: LoadTime,
    ) -> Result<PromiseRow, Failure> {
        let asked = requirements.budget.unwrap_or_default().as_secs_f64();
        let row = |outcome| PromiseRow::new(film.clone(), asked, &outcome);
        let busy = (load == LoadTime::Throughout).then(Load::start).transpose()?;
        let start = Instant::now();
        let found = self.film(requirements, Some(load))?;
        let got = start.elapsed().as_secs_f64();
        drop(busy);
        let Some((promised, report)) = found else { return Ok(row(Outcome::Refused)) };
        let is_doubted = promised.doubt.is_some();
        Ok(row(Outcome::Filmed { got, is_kept: got <= asked, is_doubted, report: Box::new(report) }))
    }

    /// The film, unless its requirements are refused. A load from the first frame on starts here.
    fn film(
        &self,
        requirements: Requirements,
        load: Option<LoadTime>,
    ) -> Result<Option<(Promised, FilmReport)>, Failure> {
        let output = TemporaryFilm::new();
        let promised = pipeline::promised(self.renderer, self.shot, &output.0, self.settings, requirements);
        let promised = match promised {
            Err(PipelineError::Unreachable { .. }) => return Ok(None),
            other => other?,
        };
        let render = RenderSettings { quality: promised.forecast.quality, ..self.settings.render };
        let video = VideoSettings { existing: Existing::Replace, ..VideoSettings::default() };
        let settings = FilmSettings { render, video, promise: Some(promised.promise.clone()), ..self.settings.clone() };
        let busy = (load == Some(LoadTime::FromFirstFrame)).then(Load::start).transpose()?;
        let mut watch = |_| ControlFlow::Continue(());
        let report = pipeline::film(self.renderer, self.shot, &output.0, &settings, &mut watch)?;
        drop(busy);
        Ok(Some((promised, report)))
    }
}

/// Seconds of the forecast of all qualities and of a film at `draft`, without load.
pub(super) fn draft_secs(renderer: &Renderer<'_>, shot: &Shot, settings: &FilmSettings) -> Result<f64, Failure> {
    let output = TemporaryFilm::new();
    let start = Instant::now();
    pipeline::forecast(renderer, shot, &output.0, settings, &[Quality::Draft, Quality::Standard, Quality::Final])?;
    let render = RenderSettings { quality: Quality::Draft, ..settings.render };
    let settings = FilmSettings { render, ..settings.clone() };
    pipeline::film(renderer, shot, &output.0, &settings, &mut |_| ControlFlow::Continue(()))?;
    Ok(start.elapsed().as_secs_f64())
}

/// A move along the view axis with a turn and a zoom, at constant speed; `idx` chooses their amounts.
pub(super) fn travel(scene: &Scene, camera: &Camera, num_frames: usize, idx: usize) -> Shot {
    let duration_secs = num_frames as f64 / RATE_FPS;
    let (length, turn_deg) = (TRAVELS[idx % TRAVELS.len()], TURNS_DEG[idx % TURNS_DEG.len()]);
    let key = |share: f64| {
        let mut pose = camera.pose;
        pose.position += pose.forward() * length * share * scene.bounds().size();
        pose.rotation = DQuat::from_axis_angle(scene.up, (turn_deg * share).to_radians()) * pose.rotation;
        Keyframe {
            time_secs: duration_secs * share,
            pose,
            fov_y_rad: camera.intrinsics.fov_y_rad() * (1.0 - 0.3 * share),
            focus_distance: None,
            optics: KeyOptics::default(),
            easing: Easing::Linear,
            cut: false,
            intent: None,
        }
    };
    let Intrinsics { width, height, .. } = camera.intrinsics;
    let keyframes = [0.0, 0.25, 0.5, 0.75, 1.0].map(key).to_vec();
    let scene = SceneRef { up: Some(scene.up), ..SceneRef::default() };
    Shot { scene, ..Shot::from_keyframes([width, height], RATE_FPS, duration_secs, keyframes) }
}
