use super::outputs::{Overwrite, relative_to};
use std::path::{Path, PathBuf};
use strum::VariantArray;

use super::failure::Failure;
use super::interrupt::Interrupt;
use super::plan_outputs::PlanOutputs;
use super::prompts_file::{self, NamedPrompt};
use super::scene_args::{PictureArgs, SceneArgs};
use super::shot_args::{ShotArgs, deciding};
use super::{console, explain, heading, map, outputs, reproduce, takes};
use cinesplat::export::shot_json;
use cinesplat::lens::{EffectChoice, EffectPlan};
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline::{self, Directed, FilmSettings, Interpreter};
use cinesplat::render::{Quality, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;

/// Turn a sentence into keyframes
///
/// Writes a shot.json without rendering it. The file may be edited by hand: move keys in time, add or remove keys, then
/// `render --shot shot.json`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat plan room.spz -p \"push in on <obj-3>\" --objects objects.json -o shot.json
  cinesplat plan room.spz -p \"orbit the lamp\" -o shot.json --takes 3
  cinesplat plan synth:demo -p \"push in on the sofa, then crane up\" -o shot.json --map map.svg")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    words: Words,
    /// Shot to write, or - for stdout
    ///
    /// With --prompts a name with {} in it, such as shots/{}.json.
    #[arg(short, long, value_name = "SHOT.JSON", help_heading = heading::OUTPUT, required_unless_present_any = ["json", "explain", "map"])]
    output: Option<PathBuf>,
    /// Draw the path in its scene, from above and from the side (.svg, .png or .pdf)
    ///
    /// With --prompts a name with {} in it, such as maps/{}.svg.
    #[arg(long, value_name = "MAP", help_heading = heading::OUTPUT)]
    map: Option<PathBuf>,
    #[command(flatten)]
    shot: ShotArgs,
    /// Print the shot on stdout
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true)]
    json: bool,
    /// Print how each clause is understood and what the shot achieves
    #[arg(long, help_heading = heading::OUTPUT)]
    explain: bool,
    /// Write a sheet of the takes side by side (PNG) [default with --takes: NAME.takes.png]
    ///
    /// With --prompts a name with {} in it.
    #[arg(long, value_name = "SHEET.PNG", help_heading = heading::OUTPUT, hide_short_help = true)]
    sheet: Option<PathBuf>,
    /// Fail with exit code 65 when a clause is not understood or cannot be met
    #[arg(long, help_heading = heading::SHOT)]
    strict: bool,
    #[command(flatten)]
    picture: PictureArgs,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// One prompt or a file of them.
#[derive(Debug, Clone, clap::Args)]
#[group(required = true, multiple = false)]
struct Words {
    /// What the camera does, in words
    ///
    /// Objects are named by their labels or as <obj-ID>.
    #[arg(short, long, value_name = "PROMPT", allow_hyphen_values = true, help_heading = heading::SHOT)]
    prompt: Option<String>,
    /// File of prompts, one shot per line
    ///
    /// A line is a prompt, or a name, a tab and a prompt. Blank lines and lines that start with # are skipped. The name,
    /// or the line's number in three digits, takes the place of {} in the output.
    #[arg(long, value_name = "FILE", help_heading = heading::SHOT)]
    prompts: Option<PathBuf>,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let prompts = self.words.prompts.as_deref().map(prompts_file::read).transpose()?;
        let jobs = self.jobs(prompts)?;
        jobs.iter().try_for_each(|(_, outputs)| self.check_outputs(outputs))?;
        Interrupt::before_work("stopped before the plan was whole")?;
        self.picture.bound_threads()?;
        let (scene, objects) = self.scene.open_with_objects(self.shot.objects.as_deref())?;
        let interpreter = self.shot.interpreter()?;
        let plan = |named: &NamedPrompt, outputs: &PlanOutputs| {
            self.plan(&interpreter, (&scene, &objects), &named.prompt, outputs)
        };
        match jobs.as_slice() {
            [(named, outputs)] if self.words.prompts.is_none() => plan(named, outputs),
            jobs => prompts_file::for_each(jobs, plan),
        }
    }

    /// Refuses wrong outputs of one prompt.
    fn check_outputs(&self, planned: &PlanOutputs) -> Result<(), Failure> {
        planned.check(self.overwrite)?;
        let sheet = planned.sheet();
        let takes = self.shot.takes.numbers().map(|number| planned.of_take(number)).collect::<Vec<_>>();
        let numbered = takes.iter().flat_map(|[shot, map]| [("--output", shot.as_ref()), ("--map", map.as_ref())]);
        let named = numbered.chain([("--sheet", sheet.as_ref())]);
        let inputs = [
            ("the scene", Some(self.scene.scene.as_path())),
            ("the prompts", self.words.prompts.as_deref()),
            ("the objects", self.shot.objects.as_deref()),
        ];
        outputs::check_not_inputs(named.filter_map(|(flag, path)| Some((flag, path?.as_path()))), inputs)
    }

    /// Every prompt with its outputs.
    fn jobs(&self, prompts: Option<Vec<NamedPrompt>>) -> Result<Vec<(NamedPrompt, PlanOutputs)>, Failure> {
        let outputs = PlanOutputs {
            shot: self.output.clone(),
            map: self.map.clone(),
            named_sheet: self.sheet.clone(),
            takes: self.shot.takes,
        };
        let Some(prompts) = prompts else {
            let prompt = self.words.prompt.clone().unwrap_or_default();
            return Ok(vec![(NamedPrompt { name: String::new(), prompt }, outputs)]);
        };
        prompts.into_iter().map(|named| Ok((named.clone(), outputs.for_prompt(&named.name)?))).collect()
    }

    /// Writes the shot and the map of a take.
    fn write_take(
        &self,
        (scene, objects): (&Scene, &ObjectSet),
        shot: &Shot,
        [output, map]: [Option<PathBuf>; 2],
    ) -> Result<(), Failure> {
        if let Some(output) = output {
            let mut saved = shot.clone();
            saved.scene.path = relative_to(&output, &scene.path);
            self.overwrite.write(&output, shot_json::write(&saved).as_bytes())?;
            let (keys, secs) = (shot.keyframes.len(), shot.duration_secs);
            console::note(&format!("{}: {keys} keys, {secs:.2} s", output.display()));
        }
        map.map_or(Ok(()), |path| map::write(&path, (scene, objects), shot, self.overwrite))
    }

    fn plan(
        &self,
        interpreter: &Interpreter,
        (scene, objects): (&Scene, &ObjectSet),
        prompt: &str,
        outputs: &PlanOutputs,
    ) -> Result<(), Failure> {
        let mut directed = self.shot.direct(interpreter, (scene, objects), prompt)?;
        let effects = self.plan_effects(scene, &mut directed)?;
        if self.strict
            && let Some(line) = directed.shot.report.iter().find(|line| !line.met)
        {
            return Err(Failure::not_met(line));
        }
        for (number, shot) in (1..).zip(&directed.takes) {
            self.write_take((scene, objects), shot, outputs.of_take(number))?;
        }
        if let Some(sheet) = outputs.sheet() {
            let renderer = Renderer::new(&scene.gaussians);
            takes::write_sheet((scene, &renderer), &directed.takes, &sheet, self.overwrite.existing())?;
        }
        if self.explain {
            self.print_forecasts(scene, &directed.shot)?;
            let text = explain::explanation(&directed, &effects, objects);
            if self.json { console::note(&text) } else { console::text(&text)? }
        }
        if self.json {
            console::data(&shot_json::write(&directed.shot))?;
        }
        reproduce::print(&deciding(&directed.shot));
        Ok(())
    }

    /// Finds out on which frames the effects of each take run, and returns the plan of the first.
    fn plan_effects(&self, scene: &Scene, directed: &mut Directed) -> Result<EffectPlan, Failure> {
        if directed.effects.effects.is_empty() {
            return Ok(EffectPlan::default());
        }
        let renderer = Renderer::new(&scene.gaussians);
        let render = self.picture.settings(scene, Quality::Standard, None, None);
        let plan_of = |shot: &Shot| pipeline::plan_effects((&renderer, &render), shot, &EffectChoice::Auto);
        let first = plan_of(&directed.shot)?;
        for take in &mut directed.takes {
            // One of the takes is the shot itself.
            if *take == directed.shot { first.write_to(take) } else { plan_of(take)?.write_to(take) }
        }
        first.write_to(&mut directed.shot);
        Ok(first)
    }

    /// Prints forecasts of the film as H.264 with the defaults of `render`. They go to stderr because they differ from run
    /// to run.
    fn print_forecasts(&self, scene: &Scene, shot: &Shot) -> Result<(), Failure> {
        let render = self.picture.settings(scene, Quality::Standard, None, None);
        let settings = FilmSettings { render, ..FilmSettings::default() };
        let renderer = Renderer::new(&scene.gaussians);
        let num_frames = shot.num_frames();
        let forecasts = pipeline::forecast(&renderer, shot, Path::new("film.mp4"), &settings, Quality::VARIANTS)?;
        for forecast in forecasts {
            console::note(&format!("predicted for {num_frames} frames: {}", forecast.sentence()));
        }
        Ok(())
    }
}
