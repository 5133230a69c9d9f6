//! One film: predicted, rendered and reported on.

use std::ops::ControlFlow;
use std::time::Instant;

use super::Args;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::FrameProgress;
use crate::cli::shot_args::deciding;
use crate::cli::{console, film_report, outputs, reproduce};
use cinesplat::export::shot_json;
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, FrameRange, Phase, PhaseTimes, Requirements};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::{self, VideoFormat, VideoSettings};

impl Args {
    /// Renders the film of a shot and reports on it.
    pub(super) fn render(
        &self,
        (scene, renderer): (&Scene, &Renderer<'_>),
        shot: &Shot,
        (mut times, start): (PhaseTimes, Instant),
        interrupt: &Interrupt,
    ) -> Result<(), Failure> {
        // A second check, now that size and number of frames are known. Pictures of a stopped sequence are checked when its
        // job folder is opened.
        let frames = self.frames.of_film(shot.num_frames())?;
        let video = pipeline::video_of(shot, &frames, &self.encoder());
        let is_partly_there = self.job.part || self.job.goes_on(&self.output);
        let check = if is_partly_there { video::check_format } else { video::check_output };
        let format = check(&self.output, &video)?;
        if let Some(note) = video::odd_size_note(&format, shot.width, shot.height) {
            console::note(&note);
        }
        let render = self.picture.settings(scene, Quality::Standard, None, None);
        if let Some(path) = &self.save_shot {
            let mut saved = shot.clone();
            pipeline::plan_effects((renderer, &render), shot, self.shot.effects())?.write_to(&mut saved);
            saved.scene.path = outputs::relative_to(path, &scene.path);
            self.overwrite.write_once(path, shot_json::write(&saved).as_bytes())?;
        }
        let frames = if self.job.part { FrameRange::default() } else { self.frames };
        let job = self.job.settings(self.inputs(scene, shot)?);
        let mut settings = FilmSettings {
            render,
            effects: self.shot.effects().clone(),
            video,
            frames,
            sheet: self.sheet.clone(),
            job,
        };
        if self.job.part {
            self.film(renderer, shot, &settings, interrupt)?;
            console::note(&format!(
                "frames are in {}; the same line without --part makes the film",
                pipeline::job_folder(&self.output).display()
            ));
            return Ok(());
        }
        self.note_lost_opacity(&format, shot);
        let predicted = times.measure(Phase::Predict, || self.predict(renderer, shot, &mut settings))?;
        settings.render.quality = predicted.quality;
        let report = self.film(renderer, shot, &settings, interrupt)?;
        times.add(Phase::Render, report.render_time);
        times.add(Phase::Keep, report.keep_time);
        times.add(Phase::Encode, report.encode_time);
        film_report::print_times(&times, &report, start.elapsed());
        film_report::print_effects(&report);
        let psnr_db = pipeline::checked_psnr_db(renderer, shot, &settings)?;
        let summary = film_report::compare(&predicted, &report, psnr_db);
        if self.json {
            console::data(&format!("{summary:#}\n"))?;
        }
        let mut decided = deciding(shot).to_vec();
        if self.requirements() != Requirements::default() {
            // The same requirements may choose another quality on another machine.
            decided.push(("--quality", predicted.quality.as_ref().to_owned()));
        }
        reproduce::print(&decided);
        Ok(())
    }

    /// Says that a film of this format cannot be transparent, where the shot asks for it.
    fn note_lost_opacity(&self, format: &VideoFormat, shot: &Shot) {
        let called = pipeline::called_effects(shot, self.shot.effects(), 1.0);
        let is_transparent = called.effects.iter().any(|called| called.effect.is_transparent());
        if is_transparent && !matches!(format, VideoFormat::Sequence(_)) {
            console::note(
                "a transparent background needs pictures such as frames/%05d.png or .exr: this film is over black",
            );
        }
    }

    /// Encoder settings before the shot is known.
    pub(super) fn encoder(&self) -> VideoSettings {
        let existing = self.overwrite.existing();
        VideoSettings { crf: self.crf, preset: self.preset, existing, ..VideoSettings::default() }
    }

    fn requirements(&self) -> Requirements {
        Requirements { budget: self.budget, min_psnr_db: self.min_psnr }
    }

    /// Forecast of the film at the quality that meets the requirements.
    fn predict(&self, renderer: &Renderer<'_>, shot: &Shot, settings: &mut FilmSettings) -> Result<Forecast, Failure> {
        let mut requirements = self.requirements();
        if let Some(quality) = self.kept_quality().filter(|_| requirements != Requirements::default()) {
            requirements = Requirements::default();
            settings.render.quality = quality;
        }
        let forecast = |qualities: &[Quality]| pipeline::forecast(renderer, shot, &self.output, settings, qualities);
        let forecasts = if requirements == Requirements::default() {
            forecast(&[settings.render.quality])?
        } else {
            let mut forecasts = forecast(&[Quality::Draft, Quality::Standard, Quality::Final])?;
            if requirements.may_need_reference(&forecasts) {
                forecasts.extend(forecast(&[Quality::Reference])?);
            }
            forecasts
        };
        let quality = pipeline::choose(&forecasts, requirements)?;
        let chosen = forecasts.iter().find(|forecast| forecast.quality == quality).copied();
        let predicted = chosen.ok_or_else(|| Failure::fault("a quality without a forecast"))?;
        console::note(&format!("predicted for {} frames: {}", settings.video.num_frames, predicted.sentence()));
        if predicted.is_empty {
            console::warnings([format!(
                "no sampled frame shows a Gaussian, the film will be background alone: check the camera path, \
                 the scene's opacities and --near (now {})",
                settings.render.near
            )]);
        }
        Ok(predicted)
    }

    /// The quality of the frames that are kept: a forecast may choose another one than it did when they were rendered.
    fn kept_quality(&self) -> Option<Quality> {
        let is_used = self.job.goes_on(&self.output);
        pipeline::job_field(&self.output, "quality").filter(|_| is_used)?.parse().ok()
    }

    /// Renders the film, or a part of it into its job folder.
    fn film(
        &self,
        renderer: &Renderer<'_>,
        shot: &Shot,
        settings: &FilmSettings,
        interrupt: &Interrupt,
    ) -> Result<FilmReport, Failure> {
        let (mut bar, mut said) = (FrameProgress::new(), false);
        let mut watch = |progress: pipeline::FilmProgress| {
            if progress.num_kept > 0 && !said {
                said = true;
                let folder = pipeline::job_folder(&self.output);
                console::note(&format!("going on: {} finished frames are in {}", progress.num_kept, folder.display()));
            }
            bar.show(progress.done, progress.total);
            if interrupt.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let report = if self.job.part {
            pipeline::film_part(renderer, shot, &self.output, (settings, self.frames), &mut watch)
        } else {
            pipeline::film(renderer, shot, &self.output, settings, &mut watch)
        };
        bar.finish();
        let report = report.map_err(|error| film_report::with_line_to_go_on(error.into(), &self.output))?;
        if report.num_damaged > 0 {
            console::warnings([format!("{} damaged frames were rendered again", report.num_damaged)]);
        }
        if report.is_partial() {
            Err(film_report::stopped(&report, &self.output, settings.job.is_some()))
        } else {
            Ok(report)
        }
    }
}
