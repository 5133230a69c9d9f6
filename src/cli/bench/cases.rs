use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Deserialize;

use crate::cli::console;
use crate::cli::failure::{Exit, Failure};
use crate::cli::model_args::ModelArgs;
use crate::cli::outputs;
use cinesplat::language::program_from_notation;
use cinesplat::objects::ObjectSet;
use cinesplat::operator::{Program, SolveLevel, SolveSettings, World, realize};
use cinesplat::pipeline::{self, DirectSettings, Directed, Interpreter};
use cinesplat::scene::{LoadOptions, Scene};
use cinesplat::trajectory::Shot;

/// Prompts on scenes, and how they are solved.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct CaseArgs {
    /// File of cases: JSON lines with id, scene, objects and prompt
    ///
    /// Scenes and objects files are looked for under --data, then in the folder of the cases. Without objects a case has
    /// those of its scene.
    #[arg(long, value_name = "CASES.JSONL")]
    cases: PathBuf,
    /// Folder of scenes and objects files [default: the folder of the cases]
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Programs by case id [default: the network's reading of each prompt]
    #[arg(long, value_name = "INTENTS.JSON")]
    intents: Option<PathBuf>,
    /// Use only cases whose id contains this text [default: all]
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true)]
    only: String,
    /// Seed of the camera search
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    models: ModelArgs,
}

/// A prompt on a scene.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct PromptCase {
    pub(super) id: String,
    scene: PathBuf,
    objects: Option<PathBuf>,
    pub(super) prompt: String,
    #[serde(skip)]
    program: Option<Program>,
}

/// A scene and its objects file.
type SceneFiles = (PathBuf, Option<PathBuf>);

/// A scene with its objects, up axis corrected by the objects file.
pub(super) struct CaseScene {
    pub(super) scene: Scene,
    objects: ObjectSet,
}

/// Opens scenes and turns cases into shots. The director is loaded only for cases without programs.
pub(super) struct CaseDirector {
    interpreter: Option<Interpreter>,
    scenes: BTreeMap<SceneFiles, CaseScene>,
    seed: u64,
}

impl CaseArgs {
    /// Reads the cases with their programs.
    pub(super) fn open(&self) -> Result<(Vec<PromptCase>, CaseDirector), Failure> {
        let programs = self.intents.as_deref().map(programs).transpose()?;
        let folder = self.cases.parent().unwrap_or(Path::new("."));
        let bad = |line: usize, found: &str| {
            let found = format!("{}: line {line}: {found}, expected a case", self.cases.display());
            Failure::new("BAD-CASE", found, "`cinesplat bench operator --help` explains the files", Exit::BadData)
        };
        let mut cases = Vec::new();
        for (number, line) in outputs::read_text(&self.cases)?.lines().enumerate() {
            let mut case: PromptCase =
                serde_json::from_str(line).map_err(|error| bad(number + 1, &error.to_string()))?;
            if !case.id.contains(&self.only) {
                continue;
            }
            case.scene = self.located(folder, case.scene);
            case.objects = case.objects.map(|objects| self.located(folder, objects));
            if let Some(programs) = &programs {
                let program = programs.get(&case.id).ok_or_else(|| bad(number + 1, "no program in the intents"))?;
                case.program = Some(program.clone());
            }
            cases.push(case);
        }
        let interpreter = if programs.is_none() { Some(self.models.interpreter()?) } else { None };
        Ok((cases, CaseDirector { interpreter, scenes: BTreeMap::new(), seed: self.seed }))
    }
}

impl CaseArgs {
    /// The place of a file that a case names; a generated scene stays as it is.
    fn located(&self, folder: &Path, name: PathBuf) -> PathBuf {
        if name.to_string_lossy().starts_with("synth:") {
            return name;
        }
        let under_data = self.data.as_deref().map(|data| data.join(&name)).filter(|path| path.exists());
        under_data.unwrap_or_else(|| folder.join(&name))
    }
}

/// The programs of an intents file.
fn programs(path: &Path) -> Result<BTreeMap<String, Program>, Failure> {
    let bad = |found: &str| {
        let found = format!("{}: {found}, expected programs by case id", path.display());
        Failure::new("BAD-INTENTS", found, "`cinesplat bench operator --help` explains the files", Exit::BadData)
    };
    let texts: BTreeMap<String, String> =
        serde_json::from_str(&outputs::read_text(path)?).map_err(|error| bad(&error.to_string()))?;
    let program = |(id, text): (String, String)| {
        program_from_notation(&text)
            .map(|program| (id.clone(), program))
            .map_err(|error| bad(&format!("{id}: {error}")))
    };
    texts.into_iter().map(program).collect()
}

impl CaseDirector {
    /// The scene of a case, opened on first use.
    pub(super) fn scene_of(&mut self, case: &PromptCase) -> Result<&CaseScene, Failure> {
        let key = (case.scene.clone(), case.objects.clone());
        if !self.scenes.contains_key(&key) {
            let opened = pipeline::open_scene(&case.scene, &LoadOptions::default())?;
            let num_printed = opened.scene.notes.len();
            let (scene, objects) = opened.with_objects(case.objects.as_deref())?;
            console::warnings(scene.notes.iter().skip(num_printed));
            self.scenes.insert(key.clone(), CaseScene { scene, objects });
        }
        self.scenes.get(&key).ok_or_else(|| Failure::fault("a scene that was opened is gone"))
    }

    /// The shot of a case.
    pub(super) fn direct(&mut self, case: &PromptCase, level: SolveLevel) -> Result<Shot, Failure> {
        self.scene_of(case)?;
        let opened = &self.scenes[&(case.scene.clone(), case.objects.clone())];
        let settings = DirectSettings { seed: self.seed, solve: level, ..DirectSettings::default() };
        let settings = opened.sized(settings, &case.prompt);
        if let Some(program) = &case.program {
            let solve = SolveSettings { level, seed: self.seed, ..SolveSettings::default() };
            return Ok(opened.direct(program, &case.prompt, &solve, &settings)?.0);
        }
        let interpreter = self.interpreter.as_ref().ok_or_else(|| Failure::fault("no director was opened"))?;
        Ok(pipeline::direct(&opened.scene, &opened.objects, &case.prompt, interpreter, &settings)?.shot)
    }

    /// The shot of a case as `plan` makes it, with what was said about it; that of its program where it has one.
    pub(super) fn direct_with(&mut self, case: &PromptCase, settings: &DirectSettings) -> Result<Directed, Failure> {
        self.scene_of(case)?;
        let opened = &self.scenes[&(case.scene.clone(), case.objects.clone())];
        let settings = opened.sized(DirectSettings { seed: self.seed, ..settings.clone() }, &case.prompt);
        let (scene, objects, prompt) = (&opened.scene, &opened.objects, &case.prompt);
        if let Some(program) = &case.program {
            return Ok(pipeline::direct_program(scene, objects, prompt, program, &settings)?);
        }
        let interpreter = self.interpreter.as_ref().ok_or_else(|| Failure::fault("no director was opened"))?;
        Ok(pipeline::direct(scene, objects, prompt, interpreter, &settings)?)
    }

    /// Shots of a case for several search settings, each with the time of its search. Needs programs.
    pub(super) fn direct_each(
        &mut self,
        case: &PromptCase,
        tries: &[SolveSettings],
    ) -> Result<Vec<(Shot, Duration)>, Failure> {
        let opened = self.scene_of(case)?;
        let program = case.program.as_ref().ok_or_else(|| Failure::usage("no programs", "add --intents"))?;
        let world = World::new(&opened.scene.gaussians, opened.scene.up, &opened.objects, &program.object_ids())?;
        let direct = |solve: &SolveSettings| {
            let start = Instant::now();
            let solution = realize(&world, program, &case.prompt, &[], solve);
            let time = start.elapsed();
            (pipeline::shot_of(&opened.scene, &case.prompt, solution, &DirectSettings::default()), time)
        };
        Ok(tries.iter().map(direct).collect())
    }
}

impl CaseScene {
    /// The objects of the scene.
    pub(super) fn objects(&self) -> &ObjectSet {
        &self.objects
    }

    /// The settings with the frame size that a prompt states.
    fn sized(&self, mut settings: DirectSettings, prompt: &str) -> DirectSettings {
        if let Some((size_px, _)) = pipeline::stated_size(prompt, &self.objects) {
            [settings.width, settings.height] = size_px;
        }
        settings
    }

    /// The shot of a program, with the times of preparing the scene and of solving.
    fn direct(
        &self,
        program: &Program,
        prompt: &str,
        solve: &SolveSettings,
        settings: &DirectSettings,
    ) -> Result<(Shot, [Duration; 2]), Failure> {
        let start = Instant::now();
        let world = World::new(&self.scene.gaussians, self.scene.up, &self.objects, &program.object_ids())?;
        let prepared = start.elapsed();
        let solution = realize(&world, program, prompt, &[], solve);
        let times = [prepared, start.elapsed().saturating_sub(prepared)];
        Ok((pipeline::shot_of(&self.scene, prompt, solution, settings), times))
    }
}
