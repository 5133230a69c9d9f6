use super::outputs::Overwrite;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::choice::choice;
use super::failure::Failure;
use super::film_report;
use super::interrupt::Interrupt;
use super::job_args::JobArgs;
use super::progress::FrameProgress;
use super::prompts_file::{self, NamedPrompt};
use super::scene_args::{PictureArgs, SceneArgs, print_up, print_up_of};
use super::shot_args::{ShotArgs, deciding};
use super::{console, figures, heading, map, outputs, reproduce, takes};
use cinesplat::export::shot_json;
use cinesplat::files::{self, Existing, MAX_TEXT_BYTES};
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, FrameRange, Phase, PhaseTimes, Requirements};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::{self, VideoFormat, VideoSettings, X264Preset};

/// Render a film from a sentence or a shot
///
/// Predicts time and accuracy first, renders, then prints both as measured and the command that reproduces the film.
/// Finished frames are kept in OUT.job until the film is whole: after Ctrl-C, a full disk or a loss of power the same
/// command goes on from there. Ctrl-C ends after the current frame, a second one ends at once.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat render room.spz --prompts moves.txt --objects objects.json -o films/{}.mp4
  cinesplat render room.spz -p \"push in on the lamp\" --objects objects.json -o lamp.mp4
  cinesplat render room.spz --shot shot.json -o frames/%05d.png --frames 0..120 --quality final")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    source: ShotSource,
    /// Film (.mp4 .mkv .webm .mov), or pictures such as frames/%05d.png or .exr
    ///
    /// With --prompts a name with {} in it, such as films/{}.mp4.
    #[arg(short, long, value_name = "OUT", help_heading = heading::OUTPUT)]
    output: PathBuf,
    #[command(flatten)]
    shot: ShotArgs,
    #[command(flatten)]
    picture: PictureArgs,
    /// Longest time to render and encode; chooses the quality [default: none]
    ///
    /// A number with a unit, such as 90s, 5m or 1h.
    #[arg(long, value_name = "TIME", help_heading = heading::PICTURE, value_parser = parse_time, conflicts_with = "quality")]
    budget: Option<Duration>,
    /// Least PSNR of the worst frame in dB; chooses the quality [default: none]
    ///
    /// The fastest quality whose worst frame is predicted to be this close to `reference`.
    #[arg(long, value_name = "DB", help_heading = heading::PICTURE, value_parser = parse_decibels, conflicts_with = "quality")]
    min_psnr: Option<f64>,
    /// Print predicted and measured figures as JSON
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true)]
    json: bool,
    /// Range of frames to render; B is one past the last
    #[arg(long, value_name = "A..B", help_heading = heading::OUTPUT, default_value = "..")]
    frames: FrameRange,
    /// Rate factor of the encoder: lower is better, with larger files
    ///
    /// At 18 the loss is hard to see.
    #[arg(long, value_name = "N", help_heading = heading::OUTPUT, hide_short_help = true, default_value_t = 18)]
    crf: u8,
    /// Effort of the H.264 encoder
    #[arg(long, value_name = "PRESET", help_heading = heading::OUTPUT, hide_short_help = true, default_value = "medium", value_parser = choice::<X264Preset>())]
    preset: X264Preset,
    /// Write the shot too
    #[arg(long, value_name = "SHOT.JSON", help_heading = heading::OUTPUT, hide_short_help = true)]
    save_shot: Option<PathBuf>,
    /// Write a contact sheet too: twelve small frames of the film, or with --takes the takes side by side
    #[arg(long, value_name = "SHEET.PNG", help_heading = heading::OUTPUT, hide_short_help = true)]
    sheet: Option<PathBuf>,
    /// Write a map of the shot too: the path in its scene, from above and from the side (.svg, .png or .pdf)
    #[arg(long, value_name = "MAP", help_heading = heading::OUTPUT, hide_short_help = true)]
    map: Option<PathBuf>,
    #[command(flatten)]
    job: JobArgs,
    #[command(flatten)]
    overwrite: Overwrite,
}

#[derive(Debug, Clone, clap::Args)]
#[group(required = true, multiple = false)]
struct ShotSource {
    /// What the camera does, in words
    ///
    /// Objects are named by their labels or as <obj-ID>.
    #[arg(short, long, value_name = "PROMPT", help_heading = heading::SHOT)]
    prompt: Option<String>,
    /// File of prompts, one film per line
    ///
    /// A line is a prompt, or a name, a tab and a prompt. Blank lines and lines that start with # are skipped. The name,
    /// or the line's number in three digits, takes the place of {} in the outputs.
    #[arg(long, value_name = "FILE", help_heading = heading::SHOT)]
    prompts: Option<PathBuf>,
    /// Shot to render instead of words
    #[arg(long = "shot", value_name = "SHOT.JSON", help_heading = heading::SHOT)]
    file: Option<PathBuf>,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.run_with(Interrupt::default())
    }

    /// `interrupt` listens already, or starts to when the film does: before that, Ctrl-C ends the program at once.
    fn run_with(self, interrupt: Interrupt) -> Result<(), Failure> {
        if let Some(file) = &self.source.prompts {
            return self.run_prompts(&prompts_file::read(file)?);
        }
        let start = Instant::now();
        self.check_outputs()?;
        self.picture.bound_threads()?;
        let mut times = PhaseTimes::default();
        let (scene, objects, shots) = self.open(&mut times)?;
        let renderer = Renderer::new(&scene.gaussians);
        self.render_takes((&scene, &objects, &renderer), &shots, (times, start), &interrupt.listening()?)
    }

    /// As [`Args::run`], after several programs have rendered the frames.
    pub(super) fn run_after(mut self, interrupt: Interrupt) -> Result<(), Failure> {
        self.job.go_on();
        self.run_with(interrupt)
    }

    /// Checks the line before several programs render its film. Returns the output.
    pub(super) fn check_shared(&self) -> Result<PathBuf, Failure> {
        let refused = [
            ("--prompts", self.source.prompts.is_some()),
            ("--takes", self.shot.takes.is_several()),
            ("--budget", self.budget.is_some()),
            ("--min-psnr", self.min_psnr.is_some()),
            ("--part", self.job.part),
            ("--no-job", self.job.no_job),
            ("--frames", self.frames != FrameRange::default()),
        ];
        if let Some((flag, _)) = refused.iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::usage(format!("{flag} with several programs"), "leave it out, or use `render`"));
        }
        self.check_outputs()?;
        Ok(self.output.clone())
    }

    /// Whether frames of an earlier run are thrown away.
    pub(super) fn starts_fresh(&self) -> bool {
        self.job.fresh
    }

    /// One film per prompt of a file; scene, director and renderer are prepared once.
    fn run_prompts(&self, prompts: &[NamedPrompt]) -> Result<(), Failure> {
        let mut jobs: Vec<(NamedPrompt, Self)> =
            prompts.iter().map(|named| Ok((named.clone(), self.for_prompt(named)?))).collect::<Result<_, Failure>>()?;
        // The films before one that was stopped are there already.
        if self.overwrite.existing() == Existing::Keep && jobs.iter().any(|(_, job)| job.job.goes_on(&job.output)) {
            let (finished, left): (Vec<_>, Vec<_>) = jobs.into_iter().partition(|(_, job)| job.is_finished());
            for (_, job) in finished {
                console::note(&format!("{}: exists already, left as it is", job.output.display()));
            }
            jobs = left;
        }
        jobs.iter().try_for_each(|(_, job)| job.check_outputs())?;
        self.picture.bound_threads()?;
        let (scene, objects) = self.scene.open_with_objects(self.shot.objects.as_deref())?;
        let interpreter = self.shot.interpreter()?;
        let renderer = Renderer::new(&scene.gaussians);
        let interrupt = Interrupt::listen()?;
        prompts_file::for_each(&jobs, |named, job| {
            let start = Instant::now();
            let directed = job.shot.direct(&interpreter, (&scene, &objects), &named.prompt)?;
            job.render_takes((&scene, &objects, &renderer), &directed.takes, (directed.times, start), &interrupt)
        })
    }

    /// The arguments that render one of several takes. Their sheet is written apart.
    fn for_take(&self, number: usize) -> Self {
        let output = |path: &PathBuf| takes::output_of(path, number);
        Self {
            output: output(&self.output),
            save_shot: self.save_shot.as_ref().map(output),
            map: self.map.as_ref().map(output),
            sheet: None,
            ..self.clone()
        }
    }

    /// The sheet of several takes: as given, or beside the output.
    fn sheet_of_takes(&self) -> PathBuf {
        self.sheet.clone().unwrap_or_else(|| takes::sheet_beside(&self.output))
    }

    /// Renders the film of each take; with several, a sheet of them first.
    fn render_takes(
        &self,
        (scene, objects, renderer): (&Scene, &ObjectSet, &Renderer<'_>),
        shots: &[Shot],
        (times, start): (PhaseTimes, Instant),
        interrupt: &Interrupt,
    ) -> Result<(), Failure> {
        let render = |job: &Self, shot: &Shot| {
            job.write_map((scene, objects), shot)?;
            job.render((scene, renderer), shot, (times.clone(), start), interrupt)
        };
        if !self.shot.takes.is_several() {
            return shots.iter().try_for_each(|shot| render(self, shot));
        }
        let existing = if self.takes_go_on() { Existing::Replace } else { self.overwrite.existing() };
        takes::write_sheet((scene, renderer), shots, &self.sheet_of_takes(), existing)?;
        let takes: Vec<(Self, &Shot)> = (1..).zip(shots).map(|(number, shot)| (self.for_take(number), shot)).collect();
        let missing: Vec<_> = takes.iter().filter(|(take, _)| !self.has(take)).collect();
        missing.into_iter().try_for_each(|(take, shot)| render(take, shot))
    }

    /// Whether the film is there, and no frames to go on from.
    fn is_finished(&self) -> bool {
        let first = match VideoFormat::from_path(&self.output) {
            Ok(VideoFormat::Sequence(pattern)) => pattern.path(self.frames.start),
            _ => self.output.clone(),
        };
        !self.job.goes_on(&self.output) && first.exists()
    }

    /// The arguments that render one prompt of a file.
    fn for_prompt(&self, named: &NamedPrompt) -> Result<Self, Failure> {
        let output = |path: &PathBuf| prompts_file::output_of(path, &named.name);
        Ok(Self {
            output: output(&self.output)?,
            save_shot: self.save_shot.as_ref().map(output).transpose()?,
            sheet: self.sheet.as_ref().map(output).transpose()?,
            map: self.map.as_ref().map(output).transpose()?,
            ..self.clone()
        })
    }

    /// Renders the film of a shot and reports on it.
    fn render(
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
        if let Some(path) = &self.save_shot {
            let mut saved = shot.clone();
            let render = self.picture.settings(scene, Quality::Standard, None, None);
            pipeline::plan_effects((renderer, &render), shot, self.shot.effects())?.write_to(&mut saved);
            saved.scene.path = outputs::relative_to(path, &scene.path);
            self.overwrite.write_once(path, shot_json::write(&saved).as_bytes())?;
        }
        let render = self.picture.settings(scene, Quality::Standard, None, None);
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

    /// What the frames depend on besides the path and the settings.
    fn inputs(&self, scene: &Scene, shot: &Shot) -> Result<Vec<(&'static str, String)>, Failure> {
        let is_file = !scene.sha256.is_empty();
        let content = if is_file { scene.sha256.clone() } else { scene.path.to_string_lossy().into_owned() };
        let mut inputs = vec![("scene", content)];
        if self.source.file.is_none() {
            let objects = self.shot.objects.as_deref().map(|path| files::read(path, MAX_TEXT_BYTES)).transpose()?;
            inputs.push(("objects", objects.map(|bytes| files::sha256_hex(&bytes)).unwrap_or_default()));
            inputs.push(("weights", shot.model.as_ref().map(|model| model.sha256.clone()).unwrap_or_default()));
            inputs.push(("prompt", shot.prompt.clone()));
        }
        Ok(inputs)
    }

    /// Refuses wrong outputs before the scene is read.
    fn check_outputs(&self) -> Result<(), Failure> {
        if !self.shot.takes.is_several() {
            return self.check_own_outputs();
        }
        if self.source.file.is_some() {
            return Err(Failure::usage(
                "--takes with --shot: a shot is one take",
                "leave --takes out, or give a prompt",
            ));
        }
        if !self.takes_go_on() {
            self.overwrite.check(&self.sheet_of_takes())?;
        }
        let missing = self.shot.takes.numbers().map(|number| self.for_take(number)).filter(|take| !self.has(take));
        missing.into_iter().try_for_each(|take| take.check_own_outputs())
    }

    /// Whether an earlier run left frames of one of the takes.
    fn takes_go_on(&self) -> bool {
        self.shot.takes.numbers().any(|number| self.job.goes_on(&self.for_take(number).output))
    }

    /// Whether an earlier run, whose frames are there, finished this take.
    fn has(&self, take: &Self) -> bool {
        self.takes_go_on() && take.is_finished()
    }

    /// Refuses wrong outputs of one film.
    fn check_own_outputs(&self) -> Result<(), Failure> {
        let format = video::check_format(&self.output, &self.encoder())?;
        let goes_on = self.job.goes_on(&self.output);
        if !matches!(format, VideoFormat::Sequence(_)) || !(goes_on || self.job.part) {
            video::check_output(&self.output, &self.encoder())?;
        }
        self.job.check(&self.output)?;
        // A stopped film may have written them already; they are written again only if they differ.
        for path in self.save_shot.iter().chain(&self.sheet).filter(|_| !goes_on) {
            self.overwrite.check(path)?;
        }
        let check_map =
            |path: &Path| if goes_on { figures::check_name(path) } else { figures::check(path, self.overwrite) };
        self.map.as_deref().map_or(Ok(()), check_map)?;
        let shot = self.save_shot.as_deref().map(|path| ("--save-shot", path));
        let sheet = self.sheet.as_deref().map(|path| ("--sheet", path));
        let map = self.map.as_deref().map(|path| ("--map", path));
        outputs::check_distinct([("--output", self.output.as_path())].into_iter().chain(shot).chain(sheet).chain(map))
    }

    /// Writes the map of the shot, if one is asked for.
    fn write_map(&self, scene: (&Scene, &ObjectSet), shot: &Shot) -> Result<(), Failure> {
        self.map.as_deref().map_or(Ok(()), |path| map::write(path, scene, shot, self.overwrite))
    }

    /// The scene, its objects as far as they are needed, and the shots.
    fn open(&self, times: &mut PhaseTimes) -> Result<(Scene, ObjectSet, Vec<Shot>), Failure> {
        if let Some(file) = &self.source.file {
            let opened = || self.scene.open().map(|opened| (opened.scene, ObjectSet::default()));
            let with_objects = || self.scene.open_with_objects(self.shot.objects.as_deref());
            // The film needs no objects; the map names them.
            let (scene, objects) =
                times.measure(Phase::Load, || if self.map.is_some() { with_objects() } else { opened() })?;
            let shot = self.shot.read_shot(file, &scene)?;
            match shot.scene.up {
                Some(up) => print_up_of(up, "the shot"),
                None => print_up(&scene),
            }
            return Ok((scene, objects, vec![shot]));
        }
        let prompt = self.source.prompt.as_deref().unwrap_or_default();
        let (scene, objects) =
            times.measure(Phase::Load, || self.scene.open_with_objects(self.shot.objects.as_deref()))?;
        let interpreter = times.measure(Phase::Load, || self.shot.interpreter())?;
        let directed = self.shot.direct(&interpreter, (&scene, &objects), prompt)?;
        times.extend(&directed.times);
        Ok((scene, objects, directed.takes))
    }

    /// Encoder settings before the shot is known.
    fn encoder(&self) -> VideoSettings {
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

fn parse_time(text: &str) -> Result<Duration, String> {
    let units = [("ms", 0.001), ("s", 1.0), ("m", 60.0), ("h", 3600.0), ("", 1.0)];
    let read = units.into_iter().find_map(|(unit, secs)| {
        let number: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
        (number > 0.0 && number * secs <= 1e9).then(|| Duration::from_secs_f64(number * secs))
    });
    read.ok_or_else(|| "expected a time above 0 such as 90s, 5m or 1h".to_owned())
}

fn parse_decibels(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|db: &f64| (0.0..=300.0).contains(db)).ok_or("expected 0 to 300 dB".to_owned())
}
