use super::outputs::Overwrite;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::choice::choice;
use super::failure::{Exit, Failure};
use super::interrupt::Interrupt;
use super::progress::FrameProgress;
use super::scene_args::{PictureArgs, SceneArgs, print_up, print_up_of};
use super::shot_args::{ShotArgs, deciding};
use super::{console, outputs, reproduce};
use cinesplat::export::shot_json;
use cinesplat::pipeline::{self, FilmReport, FilmSettings, Forecast, FrameRange, Phase, PhaseTimes, Requirements};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::{self, VideoSettings, X264Preset};

/// Films a sentence or a shot.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat render room.spz -p \"push in on the lamp\" --objects objects.json -o lamp.mp4
  cinesplat render room.spz --shot shot.json -o frames/%05d.png --frames 0..120 --quality final
Ctrl-C ends after the frame in work and keeps what is there (a film as NAME.partial.EXT); twice ends at once.")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    source: ShotSource,
    /// The film (.mp4 .mkv .webm .mov), or pictures such as frames/%05d.png
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    shot: ShotArgs,
    #[command(flatten)]
    picture: PictureArgs,
    /// Longest time for the film, rendered and encoded, such as 90s, 5m or 1h; chooses the quality
    #[arg(long, value_name = "TIME", value_parser = parse_time, conflicts_with = "quality")]
    budget: Option<Duration>,
    /// Least PSNR of the worst frame against `reference`, dB; chooses the fastest quality that has it
    #[arg(long, value_name = "DB", value_parser = parse_decibels, conflicts_with = "quality")]
    min_psnr: Option<f64>,
    /// Prints what was predicted and what was measured on stdout
    #[arg(long)]
    json: bool,
    /// Part of the film's frames, B one after the last
    #[arg(long, value_name = "A..B", default_value = "..")]
    frames: FrameRange,
    /// Quality of the encoder: lower is better and larger, 18 is hard to tell from the frames
    #[arg(long, value_name = "N", default_value_t = 18)]
    crf: u8,
    /// Effort of the H.264 encoder: ultrafast, veryfast, fast, medium, slow or veryslow
    #[arg(long, value_name = "PRESET", default_value = "medium", value_parser = choice::<X264Preset>())]
    preset: X264Preset,
    /// Writes the shot too
    #[arg(long, value_name = "SHOT.JSON")]
    save_shot: Option<PathBuf>,
    /// Writes a contact sheet too: twelve small frames of the film
    #[arg(long, value_name = "SHEET.PNG")]
    sheet: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

#[derive(Debug, clap::Args)]
#[group(required = true, multiple = false)]
struct ShotSource {
    /// What the camera does, in words; objects by name or as <obj-ID>
    #[arg(short, long, value_name = "PROMPT")]
    prompt: Option<String>,
    /// A shot made before, instead of words
    #[arg(long = "shot", value_name = "SHOT.JSON")]
    file: Option<PathBuf>,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let start = Instant::now();
        self.check_outputs()?;
        self.picture.bound_threads()?;
        let mut times = PhaseTimes::default();
        let (scene, shot) = self.open(&mut times)?;
        // Once more, now that size and number of frames are known.
        let format = video::check_output(&self.output, &self.video(&shot)?)?;
        if let Some(note) = video::odd_size_note(&format, shot.width, shot.height) {
            console::note(&note);
        }
        if let Some(path) = &self.save_shot {
            let mut saved = shot.clone();
            saved.scene.path = outputs::relative_to(path, &scene.path);
            self.overwrite.write(path, shot_json::write(&saved).as_bytes())?;
        }
        let renderer = Renderer::new(&scene.gaussians);
        let render = self.picture.settings(&scene, Quality::Standard, None, None);
        let video = self.video(&shot)?;
        let mut settings = FilmSettings { render, video, frames: self.frames, sheet: self.sheet.clone() };
        let predicted = times.measure(Phase::Predict, || self.predict(&renderer, &shot, &settings))?;
        settings.render.quality = predicted.quality;
        let report = self.film(&renderer, &shot, &settings)?;
        times.add(Phase::Render, report.render_time);
        times.add(Phase::Encode, report.encode_time);
        print_times(&times, &report, start.elapsed());
        let psnr_db = pipeline::checked_psnr_db(&renderer, &shot, &settings)?;
        self.print_comparison(&predicted, &report, psnr_db)?;
        let mut decided = deciding(&shot).to_vec();
        if self.requirements() != Requirements::default() {
            // On another machine, or another day, the same wish may choose another quality.
            decided.push(("--quality", predicted.quality.as_ref().to_owned()));
        }
        reproduce::print(&decided);
        finish(&report)
    }

    /// Everything that can be refused before the scene is read.
    fn check_outputs(&self) -> Result<(), Failure> {
        let video = VideoSettings {
            crf: self.crf,
            preset: self.preset,
            existing: self.overwrite.existing(),
            ..Default::default()
        };
        video::check_output(&self.output, &video)?;
        for path in self.save_shot.iter().chain(&self.sheet) {
            self.overwrite.check(path)?;
        }
        Ok(())
    }

    fn open(&self, times: &mut PhaseTimes) -> Result<(Scene, Shot), Failure> {
        if let Some(file) = &self.source.file {
            let scene = times.measure(Phase::Load, || self.scene.open())?.scene;
            let shot = self.shot.read_shot(file, &scene)?;
            match shot.scene.up {
                Some(up) => print_up_of(up, "the shot"),
                None => print_up(&scene),
            }
            return Ok((scene, shot));
        }
        let prompt = self.source.prompt.as_deref().unwrap_or_default();
        let (scene, objects) =
            times.measure(Phase::Load, || self.scene.open_with_objects(self.shot.objects.as_deref()))?;
        let directed = self.shot.direct(&scene, &objects, prompt)?;
        times.extend(&directed.times);
        Ok((scene, directed.shot))
    }

    fn video(&self, shot: &Shot) -> Result<VideoSettings, Failure> {
        let frames = self.frames.of_film(shot.num_frames())?;
        Ok(VideoSettings {
            width: shot.width,
            height: shot.height,
            rate_fps: shot.fps,
            crf: self.crf,
            preset: self.preset,
            first_frame: frames.start,
            num_frames: frames.len(),
            existing: self.overwrite.existing(),
        })
    }

    fn requirements(&self) -> Requirements {
        Requirements { budget: self.budget, min_psnr_db: self.min_psnr }
    }

    /// What the film will cost at the quality that holds what is wished for.
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
        Ok(predicted)
    }

    /// Predicted and measured figures beside each other.
    fn print_comparison(&self, predicted: &Forecast, report: &FilmReport, psnr_db: f64) -> Result<(), Failure> {
        let measured = report.total_time.as_secs_f64();
        // A film that was stopped took its part of the time.
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
        // JSON has no infinity: null is exact. Predicted are the halves alone; measured are both side by side.
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

    fn film(&self, renderer: &Renderer<'_>, shot: &Shot, settings: &FilmSettings) -> Result<FilmReport, Failure> {
        let interrupt = Interrupt::listen()?;
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

/// Wall time of every stage; encoding runs beside rendering, so the parts are more than the whole.
fn print_times(times: &PhaseTimes, report: &FilmReport, total: Duration) {
    let phases: Vec<String> =
        times.iter().map(|(phase, time)| format!("{phase} {:.2} s", time.as_secs_f64())).collect();
    let rate_fps = report.num_frames as f64 / report.total_time.as_secs_f64().max(1e-9);
    console::note(&format!(
        "{}: {} frames; {} (beside render); all {:.2} s, film {rate_fps:.1} fps",
        report.path.display(),
        report.num_frames,
        phases.join(", "),
        total.as_secs_f64()
    ));
}

/// A film that was stopped is no success, but what is there is kept.
fn finish(report: &FilmReport) -> Result<(), Failure> {
    if !report.is_partial() {
        return Ok(());
    }
    let (done, wanted) = (report.num_frames, report.num_wanted);
    let found = format!("{}: stopped after {done} of {wanted} frames", report.path.display());
    Err(Failure::new(
        "STOPPED",
        found,
        format!("render the rest with --frames, from frame {done} of this part on"),
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
