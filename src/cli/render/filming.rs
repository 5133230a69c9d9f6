//! One film: predicted, rendered and reported on.

use std::ops::ControlFlow;
use std::time::Instant;

use super::Args;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::FrameProgress;
use crate::cli::shot_args::deciding;
use crate::cli::{console, film_report, memory, outputs, reproduce};
use cinesplat::export::shot_json;
use cinesplat::lens::EffectPlan;
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, FrameRange, Phase, PhaseTimes, Requirements};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::{self, VideoSettings};

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
        let part = if self.job.part.is_some() { FrameRange::default() } else { self.frames };
        let mut settings = FilmSettings {
            render: self.picture.settings(scene, Quality::Standard, None, None),
            effects: self.shot.effects().clone(),
            video: pipeline::video_of(shot, &frames, &self.encoder()),
            frames: part,
            sheet: self.sheet.clone(),
            job: None,
            promise: None,
        };
        let video = settings.video_for(shot, &frames);
        let is_partly_there = self.job.part.is_some() || self.job.goes_on(&self.output);
        let check = if is_partly_there { video::check_format } else { video::check_output };
        let format = check(&self.output, &video)?;
        if let Some(note) = video::odd_size_note(&format, &video) {
            console::note(&note);
        }
        console::warnings(video::panorama_warning(&format, &video));
        settings.job = self.job.settings(self.inputs(scene, shot)?);
        if self.job.part.is_some() {
            self.write_shot((scene, renderer), shot, &settings)?;
            self.film(renderer, shot, (&settings, None), interrupt)?;
            console::note(&format!(
                "frames are in {}; when all are there, this makes the film: {}",
                pipeline::job_folder(&self.output).display(),
                reproduce::line_of_film()
            ));
            return Ok(());
        }
        if video.has_alpha && !format.holds_alpha() {
            console::note(
                "a transparent background needs a .mov, or pictures such as frames/%05d.png or .exr: this film is over black",
            );
        }
        let predicted = times.measure(Phase::Predict, || self.predict(renderer, shot, &mut settings))?;
        settings.render.quality = predicted.quality;
        let planned = self.write_shot((scene, renderer), shot, &settings)?;
        let report = self.film(renderer, shot, (&settings, planned), interrupt)?;
        film_report::print_promise(&settings, &report);
        times.add(Phase::Render, report.render_time);
        times.add(Phase::Keep, report.keep_time);
        times.add(Phase::Encode, report.encode_time);
        film_report::print_times(&times, &report, start.elapsed());
        film_report::print_effects(&report);
        // The figure is that of most frames.
        let is_finest = 2 * report.num_finest > report.qualities.len();
        let psnr_db = pipeline::checked_psnr_db(renderer, shot, (&settings, is_finest))?;
        let summary = film_report::compare(&predicted, &report, psnr_db);
        if self.json {
            console::data(&format!("{summary:#}\n"))?;
        }
        let mut decided = deciding(shot).to_vec();
        let is_even = report.num_kept == 0
            && !report.qualities.is_empty()
            && report.qualities.iter().all(|(_, quality)| *quality == predicted.quality);
        if self.budget.is_some() && is_even {
            // The same budget may choose another quality on another machine. A least PSNR chooses the same one.
            decided.push(("--quality", predicted.quality.as_ref().to_owned()));
        }
        reproduce::print(&decided);
        Ok(())
    }

    /// Writes the shot with the plan of its effects at the quality of the film, if it is asked for. Returns the plan.
    fn write_shot(
        &self,
        (scene, renderer): (&Scene, &Renderer<'_>),
        shot: &Shot,
        settings: &FilmSettings,
    ) -> Result<Option<EffectPlan>, Failure> {
        let Some(path) = &self.save_shot else { return Ok(None) };
        let mut saved = shot.clone();
        let planned = pipeline::plan_effects((renderer, &settings.render), shot, &settings.effects)?;
        planned.write_to(&mut saved);
        saved.scene.path = outputs::relative_to(path, &scene.path);
        self.overwrite.write_once(path, shot_json::write(&saved).as_bytes())?;
        Ok(Some(planned))
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
        let requirements = self.requirements();
        let predicted = if requirements == Requirements::default() {
            let forecasts = pipeline::forecast(renderer, shot, &self.output, settings, &[settings.render.quality])?;
            forecasts.first().copied().ok_or_else(|| Failure::fault("a quality without a forecast"))?
        } else {
            let promised = pipeline::promised(renderer, shot, &self.output, settings, requirements)?;
            console::warnings(&promised.doubt);
            settings.promise = Some(promised.promise);
            match self.kept_quality() {
                // Frames of an earlier run began with another quality, and go on with it.
                Some(quality) if quality != promised.forecast.quality => {
                    let again = pipeline::forecast(renderer, shot, &self.output, settings, &[quality])?;
                    again.first().copied().unwrap_or(promised.forecast)
                }
                _ => promised.forecast,
            }
        };
        console::note(&format!("predicted for {} frames: {}", settings.video.num_frames, predicted.sentence()));
        // The renderer holds its part already.
        if let Some((needed, left)) = memory::lacks(predicted.memory_bytes.saturating_sub(renderer.memory_bytes())) {
            return Err(Failure::over_memory("the film", needed, left));
        }
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
        (settings, planned): (&FilmSettings, Option<EffectPlan>),
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
        let report = if let Some(piece) = self.job.part {
            pipeline::film_part(renderer, shot, &self.output, (settings, self.frames, piece), &mut watch)
        } else {
            pipeline::film_planned(renderer, shot, &self.output, (settings, planned), &mut watch)
        };
        bar.finish();
        let report = report.map_err(|error| film_report::with_line_to_go_on(error.into(), &self.output))?;
        if report.num_removed > 0 {
            console::note(&format!("{} pictures of a longer film were removed", report.num_removed));
        }
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
