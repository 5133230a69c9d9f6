use super::outputs::Overwrite;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::choice::choice;
use super::failure::{Exit, Failure};
use super::interrupt::Interrupt;
use super::progress::FrameProgress;
use super::prompts_file::{self, NamedPrompt};
use super::scene_args::{PictureArgs, SceneArgs, print_up, print_up_of};
use super::shot_args::{ShotArgs, deciding};
use super::{console, heading, map, outputs, reproduce, takes};
use cinesplat::export::shot_json;
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, FrameRange, Phase, PhaseTimes, Requirements};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::{self, VideoSettings, X264Preset};

/// Render a film from a sentence or a shot
///
/// Predicts time and accuracy first, renders, then prints both as measured and the command that reproduces the film.
/// Ctrl-C ends after the current frame and keeps the finished frames, those of a film as NAME.partial.EXT. A second
/// Ctrl-C ends at once.
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
    /// Film (.mp4 .mkv .webm .mov), or pictures such as frames/%05d.png
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
    /// Write a map of the shot too: the path in its scene, from above and from the side (.svg or .png)
    #[arg(long, value_name = "MAP", help_heading = heading::OUTPUT, hide_short_help = true)]
    map: Option<PathBuf>,
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
        if let Some(file) = &self.source.prompts {
            return self.run_prompts(&prompts_file::read(file)?);
        }
        let start = Instant::now();
        self.check_outputs()?;
        self.picture.bound_threads()?;
        let mut times = PhaseTimes::default();
        let (scene, objects, shots) = self.open(&mut times)?;
        let renderer = Renderer::new(&scene.gaussians);
        self.render_takes((&scene, &objects, &renderer), &shots, (times, start), &Interrupt::listen()?)
    }

    /// One film per prompt of a file; scene, director and renderer are prepared once.
    fn run_prompts(&self, prompts: &[NamedPrompt]) -> Result<(), Failure> {
        let jobs: Vec<(NamedPrompt, Self)> =
            prompts.iter().map(|named| Ok((named.clone(), self.for_prompt(named)?))).collect::<Result<_, Failure>>()?;
        jobs.iter().try_for_each(|(_, job)| job.check_outputs())?;
        self.picture.bound_threads()?;
        let (scene, objects) = self.scene.open_with_objects(self.shot.objects.as_deref())?;
        let director = self.shot.director()?;
        let renderer = Renderer::new(&scene.gaussians);
        let interrupt = Interrupt::listen()?;
        prompts_file::for_each(&jobs, |named, job| {
            let start = Instant::now();
            let directed = job.shot.direct(&director, (&scene, &objects), &named.prompt)?;
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
        takes::write_sheet((scene, renderer), shots, &self.sheet_of_takes(), self.overwrite.existing())?;
        (1..).zip(shots).try_for_each(|(number, shot)| render(&self.for_take(number), shot))
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
        // A second check, now that size and number of frames are known.
        let frames = self.frames.of_film(shot.num_frames())?;
        let video = pipeline::video_of(shot, &frames, &self.encoder());
        let format = video::check_output(&self.output, &video)?;
        if let Some(note) = video::odd_size_note(&format, shot.width, shot.height) {
            console::note(&note);
        }
        if let Some(path) = &self.save_shot {
            let mut saved = shot.clone();
            saved.scene.path = outputs::relative_to(path, &scene.path);
            self.overwrite.write(path, shot_json::write(&saved).as_bytes())?;
        }
        let render = self.picture.settings(scene, Quality::Standard, None, None);
        let mut settings = FilmSettings { render, video, frames: self.frames, sheet: self.sheet.clone() };
        let predicted = times.measure(Phase::Predict, || self.predict(renderer, shot, &settings))?;
        settings.render.quality = predicted.quality;
        let report = self.film(renderer, shot, &settings, interrupt)?;
        times.add(Phase::Render, report.render_time);
        times.add(Phase::Encode, report.encode_time);
        print_times(&times, &report, start.elapsed());
        let psnr_db = pipeline::checked_psnr_db(renderer, shot, &settings)?;
        self.print_comparison(&predicted, &report, psnr_db)?;
        let mut decided = deciding(shot).to_vec();
        if self.requirements() != Requirements::default() {
            // The same requirements may choose another quality on another machine.
            decided.push(("--quality", predicted.quality.as_ref().to_owned()));
        }
        reproduce::print(&decided);
        finish(&report)
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
        self.overwrite.check(&self.sheet_of_takes())?;
        self.shot.takes.numbers().try_for_each(|number| self.for_take(number).check_own_outputs())
    }

    /// Refuses wrong outputs of one film.
    fn check_own_outputs(&self) -> Result<(), Failure> {
        video::check_output(&self.output, &self.encoder())?;
        for path in self.save_shot.iter().chain(&self.sheet) {
            self.overwrite.check(path)?;
        }
        self.map.as_deref().map_or(Ok(()), |path| map::check(path, self.overwrite))?;
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
        let director = times.measure(Phase::Load, || self.shot.director())?;
        let directed = self.shot.direct(&director, (&scene, &objects), prompt)?;
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
    fn predict(&self, renderer: &Renderer<'_>, shot: &Shot, settings: &FilmSettings) -> Result<Forecast, Failure> {
        let requirements = self.requirements();
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

    /// Prints predicted and measured figures side by side.
    fn print_comparison(&self, predicted: &Forecast, report: &FilmReport, psnr_db: f64) -> Result<(), Failure> {
        let measured = report.total_time.as_secs_f64();
        // A film that was stopped took a share of the predicted time.
        let share = report.num_frames as f64 / report.num_wanted as f64;
        let expected = |time: Duration| time.as_secs_f64() * share;
        let film_secs = expected(predicted.film_time);
        let off_percent = (measured / film_secs.max(1e-9) - 1.0) * 100.0;
        let quality = predicted.quality.as_ref();
        console::note(&format!(
            "{quality}: filmed in {measured:.2} s (predicted {film_secs:.2} s: {off_percent:+.0} %), {psnr_db:.1} dB \
             (predicted {:.1} dB)",
            predicted.psnr_db
        ));
        if !self.json {
            return Ok(());
        }
        // JSON has no infinity: null stands for an exact picture. Predicted render and encode times are those of each alone,
        // measured ones are parallel.
        let summary = serde_json::json!({
            "path": report.path.to_string_lossy(), "frames": report.num_frames, "quality": quality,
            "predicted": {"film_secs": film_secs, "render_secs": expected(predicted.render_time),
                "encode_secs": expected(predicted.encode_time), "psnr_db": predicted.psnr_db,
                "worst_psnr_db": predicted.worst_psnr_db, "memory_bytes": predicted.memory_bytes},
            "measured": {"film_secs": measured, "render_secs": report.render_time.as_secs_f64(),
                "encode_secs": report.encode_time.as_secs_f64(), "psnr_db": psnr_db},
        });
        console::data(&format!("{summary:#}\n"))
    }

    fn film(
        &self,
        renderer: &Renderer<'_>,
        shot: &Shot,
        settings: &FilmSettings,
        interrupt: &Interrupt,
    ) -> Result<FilmReport, Failure> {
        let mut bar = FrameProgress::new();
        let mut watch = |progress: pipeline::FilmProgress| {
            bar.show(progress.done, progress.total);
            if interrupt.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let report = pipeline::film(renderer, shot, &self.output, settings, &mut watch);
        bar.finish();
        Ok(report?)
    }
}

/// Prints the wall time per phase. Encoding runs beside rendering, so the phases sum to more than the total.
fn print_times(times: &PhaseTimes, report: &FilmReport, total: Duration) {
    let phases: Vec<String> =
        times.iter().map(|(phase, time)| format!("{phase} {:.2} s", time.as_secs_f64())).collect();
    let rate_fps = report.num_frames as f64 / report.total_time.as_secs_f64().max(1e-9);
    console::note(&format!(
        "{}: {} frames; {} (parallel to render); total {:.2} s, film {rate_fps:.1} fps",
        report.path.display(),
        report.num_frames,
        phases.join(", "),
        total.as_secs_f64()
    ));
}

/// A film that was stopped is a failure; its finished frames are kept.
fn finish(report: &FilmReport) -> Result<(), Failure> {
    if !report.is_partial() {
        return Ok(());
    }
    let (done, wanted) = (report.num_frames, report.num_wanted);
    let found = format!("{}: stopped after {done} of {wanted} frames", report.path.display());
    Err(Failure::new(
        "STOPPED",
        found,
        format!("render the rest with --frames, from frame {done} of this range on"),
        Exit::Stopped,
    ))
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
