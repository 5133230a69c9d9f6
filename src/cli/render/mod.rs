mod filming;
mod outputs;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::choice::choice;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::job_args::JobArgs;
use super::outputs::Overwrite;
use super::prompts_file::{self, NamedPrompt};
use super::scene_args::{PictureArgs, SceneArgs, print_up, print_up_of};
use super::shot_args::{ShotArgs, names_objects};
use super::{console, heading, map, takes};
use cinesplat::files::{self, Existing, Limits};
use cinesplat::objects::{self, ObjectSet};
use cinesplat::pipeline::{self, FrameRange, Phase, PhaseTimes};
use cinesplat::render::Renderer;
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::X264Preset;

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
    /// A number with a unit, such as 90s, 5m or 1h, counted from the forecast on. The film steps down to a faster quality
    /// when the machine becomes slower.
    #[arg(long, value_name = "TIME", help_heading = heading::PICTURE, value_parser = parse_time, conflicts_with = "quality")]
    budget: Option<Duration>,
    /// Least PSNR of the worst frame in dB; chooses the quality [default: none]
    ///
    /// The fastest quality but `draft` whose worst frame, with its effects, is this close to `reference`. Frames are checked
    /// while the film is made, and rendered better where they fall short.
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
    /// Effort of the H.264 encoder [default: ultrafast for draft, veryfast for standard, medium for final, slow for reference]
    ///
    /// More effort makes the file smaller at the same loss, and the film slower.
    #[arg(long, value_name = "PRESET", help_heading = heading::OUTPUT, hide_short_help = true, value_parser = choice::<X264Preset>())]
    preset: Option<X264Preset>,
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

/// How far a film came that is stopped before it is begun.
pub(super) const BEFORE_FRAMES: &str = "stopped before the first frame was begun";

#[derive(Debug, Clone, clap::Args)]
#[group(required = true, multiple = false)]
struct ShotSource {
    /// What the camera does, in words
    ///
    /// Objects are named by their labels or as <obj-ID>.
    #[arg(short, long, value_name = "PROMPT", allow_hyphen_values = true, help_heading = heading::SHOT)]
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
        self.run_with(Interrupt::before_work(BEFORE_FRAMES)?)
    }

    fn run_with(self, interrupt: Interrupt) -> Result<(), Failure> {
        if let Some(file) = &self.source.prompts {
            return self.run_prompts(&prompts_file::read(file)?, interrupt);
        }
        let start = Instant::now();
        self.check_outputs()?;
        self.picture.bound_threads()?;
        let mut times = PhaseTimes::default();
        let (scene, objects, shots) = self.open(&mut times)?;
        let renderer = Renderer::new(&scene.gaussians);
        self.render_takes((&scene, &objects, &renderer), &shots, (times, start), &interrupt.begun())
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
            ("--part", self.job.part.is_some()),
            ("--no-job", self.job.no_job),
            ("--frames", self.frames != FrameRange::default()),
        ];
        if let Some((flag, _)) = refused.iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::usage(format!("{flag} with several programs"), "leave it out, or use `render`"));
        }
        self.remove_leftovers()?;
        self.check_names()?;
        pipeline::check_shared_job(&self.output)?;
        Ok(self.output.clone())
    }

    /// Reads scene, objects, shot and words, as the programs will that render the film.
    pub(super) fn check_inputs(&self) -> Result<(), Failure> {
        let mut checked = self.clone();
        checked.shot.skip_search();
        let (.., shots) = checked.open(&mut PhaseTimes::default())?;
        for shot in &shots {
            shot.check_frames()?;
        }
        Ok(())
    }

    /// The film, or the pattern of its pictures.
    pub(super) fn output(&self) -> &Path {
        &self.output
    }

    /// Whether frames of an earlier run are thrown away.
    pub(super) fn starts_fresh(&self) -> bool {
        self.job.fresh
    }

    /// One film per prompt of a file; scene, director and renderer are prepared once.
    fn run_prompts(&self, prompts: &[NamedPrompt], interrupt: Interrupt) -> Result<(), Failure> {
        let mut jobs: Vec<(NamedPrompt, Self)> =
            prompts.iter().map(|named| Ok((named.clone(), self.for_prompt(named)?))).collect::<Result<_, Failure>>()?;
        jobs.iter().try_for_each(|(_, job)| job.remove_leftovers())?;
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
        let interrupt = interrupt.begun();
        prompts_file::for_each(&jobs, |named, job| {
            let start = Instant::now();
            let directed = job.shot.direct(&interpreter, (&scene, &objects), &named.prompt)?;
            job.render_takes((&scene, &objects, &renderer), &directed.takes, (directed.times, start), &interrupt)
        })
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
            job.make_picture_folder()?;
            job.write_map((scene, objects), shot)?;
            job.render((scene, renderer), shot, (times.clone(), start), interrupt)
        };
        if !self.shot.takes.is_several() {
            return shots.iter().try_for_each(|shot| render(self, shot));
        }
        let existing = if self.takes_go_on() { Existing::Replace } else { self.overwrite.existing() };
        self.make_picture_folder()?;
        takes::write_sheet((scene, renderer), shots, &self.sheet_of_takes(), existing)?;
        let takes: Vec<(Self, &Shot)> = (1..).zip(shots).map(|(number, shot)| (self.for_take(number), shot)).collect();
        let missing: Vec<_> = takes.iter().filter(|(take, _)| !self.has(take)).collect();
        missing.into_iter().try_for_each(|(take, shot)| render(take, shot))
    }

    /// What the frames depend on besides the path and the settings.
    fn inputs(&self, scene: &Scene, shot: &Shot) -> Result<Vec<(&'static str, String)>, Failure> {
        let is_file = !scene.sha256.is_empty();
        let content = if is_file { scene.sha256.clone() } else { scene.path.to_string_lossy().into_owned() };
        let mut inputs = vec![("scene", content)];
        if self.source.file.is_none() {
            let objects =
                self.shot.objects.as_deref().map(|path| files::read(path, Limits::DEFAULT.text_bytes)).transpose()?;
            inputs.push(("objects", objects.map(|bytes| files::sha256_hex(&bytes)).unwrap_or_default()));
            inputs.push(("weights", shot.model.as_ref().map(|model| model.sha256.clone()).unwrap_or_default()));
            inputs.push(("prompt", shot.prompt.clone()));
        }
        Ok(inputs)
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
            // The film needs objects only where the shot looks at them by name; the map names them.
            let needs_objects = self.map.is_some() || names_objects(file)?;
            if let Some(unused) = self.shot.objects.as_deref().filter(|_| !needs_objects) {
                objects::read_boxes(unused)?;
            }
            let (scene, objects) =
                times.measure(Phase::Load, || if needs_objects { with_objects() } else { opened() })?;
            let shot = self.shot.read_shot(file, (&scene, &objects))?;
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
