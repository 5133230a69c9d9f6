use std::iter;
use std::path::{Path, PathBuf};

use clap::Args;

use super::choice::choice;
use super::failure::Failure;
use super::model_args::ModelArgs;
use super::takes::TakesArgs;
use super::{console, heading, outputs};
use cinesplat::export::shot_json;
use cinesplat::lens::{self, Called, EffectChoice};
use cinesplat::objects::{self, Object, ObjectSet};
use cinesplat::operator::SolveLevel;
use cinesplat::pipeline::{self, DirectSettings, Directed, FilmChoice, Interpreter};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{ReportLine, Shot, retimed};

/// How `plan` and `render` make a shot.
#[derive(Debug, Clone, Args)]
pub(super) struct ShotArgs {
    /// Objects file [default: the scene's own objects, else a search]
    ///
    /// It holds ids, boxes or labels, and names for the prompt. `cinesplat objects SCENE -o objects.json` writes one.
    #[arg(long, value_name = "OBJECTS.JSON", help_heading = heading::SCENE)]
    pub(super) objects: Option<PathBuf>,
    /// Frame size in pixels [default: 1280x720, or the shot's]
    #[arg(long, value_name = "WxH", help_heading = heading::SHOT, value_parser = parse_size)]
    size: Option<(u32, u32)>,
    /// Frames per second [default: 30, or the shot's]
    #[arg(long, value_name = "FPS", help_heading = heading::SHOT, value_parser = parse_rate)]
    fps: Option<f64>,
    /// Length in seconds [default: from the words, else from the moves]
    #[arg(long, value_name = "SECS", help_heading = heading::SHOT, value_parser = parse_duration)]
    duration: Option<f64>,
    /// Lens effects: auto, off, or names separated by commas
    #[arg(long, value_name = "LIST", help_heading = heading::SHOT, default_value = "auto", long_help = effects_help())]
    effects: EffectChoice,
    /// Seed of the camera search [default: 0, or the shot's]
    #[arg(long, value_name = "N", help_heading = heading::SHOT, hide_short_help = true)]
    seed: Option<u64>,
    /// Move the inner keys in time so that the camera's speed is constant
    #[arg(long, help_heading = heading::SHOT, hide_short_help = true)]
    retime: bool,
    #[command(flatten)]
    pub(super) takes: TakesArgs,
    #[command(flatten)]
    solve: SolveArgs,
    #[command(flatten)]
    models: ModelArgs,
}

impl ShotArgs {
    /// Which effects the user allows.
    pub(super) fn effects(&self) -> &EffectChoice {
        &self.effects
    }

    /// Takes the network's cameras as they are: whether the words are understood is known without a search.
    pub(super) fn skip_search(&mut self) {
        self.solve.level = SolveLevel::Off;
    }

    /// Loads the models that read prompts.
    pub(super) fn interpreter(&self) -> Result<Interpreter, Failure> {
        self.models.interpreter()
    }

    /// Turns a prompt into a shot. Prints guesses and unmet requirements to stderr.
    pub(super) fn direct(
        &self,
        interpreter: &Interpreter,
        (scene, objects): (&Scene, &ObjectSet),
        prompt: &str,
    ) -> Result<Directed, Failure> {
        let (width, height) = self.size.unwrap_or_else(|| stated_size(prompt, objects));
        let settings = DirectSettings {
            width,
            height,
            rate_fps: self.fps.unwrap_or_else(|| stated_rate(prompt)),
            duration_secs: self.duration,
            seed: self.seed.unwrap_or(0),
            solve: self.solve.level,
            effects: self.effects.clone(),
            choice: FilmChoice { num_takes: usize::from(self.takes.count), ..FilmChoice::default() },
        };
        if let Some(duration_secs) = settings.duration_secs {
            // Before the search, which takes seconds.
            Shot::from_keyframes([width, height], settings.rate_fps, duration_secs, Vec::new()).check_frames()?;
        }
        let mut directed = pipeline::direct(scene, objects, prompt, interpreter, &settings)?;
        if self.retime {
            for shot in iter::once(&mut directed.shot).chain(&mut directed.takes) {
                *shot = retimed(shot);
                pipeline::certify(scene, shot)?;
            }
        }
        if self.size.is_none() && directed.effects.effects.iter().any(|called| called.effect.is_panorama()) {
            // All directions are twice as wide as high.
            console::note(&format!("all directions in one picture: {}x{height}", 2 * height));
            for shot in iter::once(&mut directed.shot).chain(&mut directed.takes) {
                shot.width = 2 * height;
            }
        }
        self.takes.note_fewer(directed.takes.len());
        print_gaps(&directed);
        Ok(directed)
    }

    /// Reads a shot and applies the flags to it.
    pub(super) fn read_shot(&self, path: &Path, (scene, objects): (&Scene, &ObjectSet)) -> Result<Shot, Failure> {
        let shot = read_file(path, &objects.objects)?;
        print_other_scene(path, &shot, scene);
        let mut shot = self.changed(shot);
        print_warnings(&shot);
        let called = pipeline::complete_effects(&mut shot, &self.effects, scene.bounds().size());
        print_effects(&called);
        pipeline::certify(scene, &mut shot)?;
        print_clearance(&shot);
        Ok(shot)
    }

    fn changed(&self, mut shot: Shot) -> Shot {
        (shot.width, shot.height) = self.size.unwrap_or((shot.width, shot.height));
        shot.fps = self.fps.unwrap_or(shot.fps);
        if let Some(wanted) = self.duration {
            // A shot without length has no times that could be scaled.
            let factor = if shot.duration_secs > 0.0 { wanted / shot.duration_secs } else { 1.0 };
            shot.keyframes.iter_mut().for_each(|key| key.time_secs *= factor);
            shot.duration_secs = wanted;
        }
        if self.retime { retimed(&shot) } else { shot }
    }
}

/// Reads a shot; its keyframes may look at `objects`.
pub(super) fn read_file(path: &Path, objects: &[Object]) -> Result<Shot, Failure> {
    let text = outputs::read_text(path)?;
    let find = |name: &str| match objects {
        [] => Err("a point, or an object of --objects OBJECTS.JSON".to_owned()),
        _ => objects::named(objects, name).map(|object| object.center).map_err(|expected| {
            let is_unnamed = objects.iter().all(|object| objects::is_description(&object.label));
            let hint = if is_unnamed { " (names that you gave are read with --objects OBJECTS.JSON)" } else { "" };
            format!("{expected}{hint}")
        }),
    };
    let read = shot_json::read_in(&text, &find).map_err(|error| Failure::from(error).in_file(path))?;
    console::file_warnings(path, &read.notes);
    console::file_warnings(path, &lens::unknown_names(&read.shot.effects));
    Ok(read.shot)
}

/// Whether a shot looks at objects by their names, so that it can't be read without them.
pub(super) fn names_objects(path: &Path) -> Result<bool, Failure> {
    outputs::read_text(path).map(|text| shot_json::names_objects(&text))
}

/// Warns of a shot that was made for another scene.
pub(super) fn print_other_scene(path: &Path, shot: &Shot, scene: &Scene) {
    if !shot.scene.sha256.is_empty() && shot.scene.sha256 != scene.sha256 {
        console::warnings([format!("{} was made for another scene: {}", path.display(), shot.scene.path)]);
    }
}

/// Warns of keys after the end of the film and of a film without length.
pub(super) fn print_warnings(shot: &Shot) {
    console::warnings(shot.warnings());
}

/// Flags with the values that decide the result, for the command that reproduces it.
pub(super) fn deciding(shot: &Shot) -> [(&'static str, String); 3] {
    [
        ("--size", format!("{}x{}", shot.width, shot.height)),
        ("--fps", shot.fps.to_string()),
        ("--seed", shot.seed.to_string()),
    ]
}

/// Warns of a camera path that comes too close to Gaussians.
fn print_clearance(shot: &Shot) {
    let Some((proof, failure)) = shot.clearance.as_ref().and_then(|proof| Some((proof, proof.failure?))) else {
        return;
    };
    console::warnings([format!(
        "the camera comes too close to Gaussian {} from {:.2} to {:.2} s: distance {:.4}, camera radius {:.4}",
        failure.gaussian_idx, failure.from_secs, failure.to_secs, failure.distance, proof.camera_radius
    )]);
}

/// Prints guesses, effects, and every line of the report that is not met.
fn print_gaps(directed: &Directed) {
    console::warnings(&directed.warnings);
    print_effects(&directed.effects);
    let is_effect = |clause: &str| directed.effects.unmet.iter().any(|unmet| unmet.call.because == clause);
    for line in directed.shot.report.iter().filter(|line| !line.met && !is_effect(&line.clause)) {
        console::note(&not_met(line));
    }
}

/// What a line of the report says that is not met: of words that lead to nothing there is nothing to measure.
fn not_met(line: &ReportLine) -> String {
    let ReportLine { clause, wanted, got, note, .. } = line;
    let is_measured = *got != 0.0 || wanted.contains(|c: char| c.is_ascii_digit());
    match (is_measured, note.is_empty()) {
        (true, _) => format!("not met: {clause}: wanted {wanted}, got {got:.3}: {note}"),
        (false, true) => format!("not met: \"{clause}\" is not {wanted}"),
        (false, false) => format!("not met: \"{clause}\": {note}"),
    }
}

/// Prints the calls that lead to no effect.
fn print_effects(called: &Called) {
    for unmet in &called.unmet {
        console::note(&format!("effect: {}", unmet.sentence()));
    }
}

/// Effort of the camera search.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(super) struct SolveArgs {
    /// Effort of the camera search
    ///
    /// `off` takes the network's cameras as they are, `fast` and `full` search for better ones.
    #[arg(long = "solve", value_name = "EFFORT", help_heading = heading::SHOT, default_value = "full", value_parser = choice::<SolveLevel>())]
    pub(super) level: SolveLevel,
}

fn effects_help() -> String {
    let names = lens::names().collect::<Vec<&str>>().join(" ");
    format!(
        "Lens effects: auto, off, or names separated by commas\n\n`auto` takes the effects that the words call for. Names: {names}."
    )
}

/// The frame size that a prompt states, with a note; the default where it states none.
fn stated_size(prompt: &str, objects: &ObjectSet) -> (u32, u32) {
    let Some(([width, height], words)) = pipeline::stated_size(prompt, objects) else {
        let default = DirectSettings::default();
        return (default.width, default.height);
    };
    console::note(&format!("frame: {width}x{height}, because of \"{words}\" (--size overrules)"));
    (width, height)
}

/// The frame rate that a prompt states, with a note; the default where it states none.
fn stated_rate(prompt: &str) -> f64 {
    let Some((rate_fps, words)) = pipeline::stated_rate(prompt) else { return DirectSettings::default().rate_fps };
    console::note(&format!("{rate_fps} frames per second, because of \"{words}\" (--fps overrules)"));
    rate_fps
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let number = |digits: &str| digits.parse::<u32>().ok().filter(|n| (1..=16384).contains(n));
    let size = text.split_once(['x', 'X']).and_then(|(width, height)| Some((number(width)?, number(height)?)));
    size.ok_or_else(|| "expected WIDTHxHEIGHT in pixels such as 1280x720, each 1 to 16384".to_owned())
}

pub(super) fn parse_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| (0.01..=1000.0).contains(rate));
    rate.ok_or_else(|| "expected 0.01 to 1000 frames per second".to_owned())
}

fn parse_duration(text: &str) -> Result<f64, String> {
    let secs = text.parse().ok().filter(|secs: &f64| *secs > 0.0 && *secs <= 86_400.0);
    secs.ok_or_else(|| "expected seconds, above 0 and at most 86400".to_owned())
}
