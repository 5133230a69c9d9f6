use super::error::PipelineError;
use super::phases::{Phase, PhaseTimes};
use cinesplat_director::{Direction, Director, SceneContext};
use cinesplat_language::{Linked, NamedObject};
use cinesplat_lens::{Decision, EffectCall, EffectChoice, EffectKind};
use cinesplat_objects::{CloudSettings, ObjectSet};
use cinesplat_operator::{Solution, SolveLevel, SolveSettings, Step, World};
use cinesplat_scene::Scene;
use cinesplat_trajectory::{ReportLine, SceneRef, Shot};

/// The name under which words ask for a slanted horizon, and the roll that it gets: in the middle of 5 to 35 degrees, what
/// storyboards mean by it.
const DUTCH: &str = "dutch-angle";
const DUTCH_DEG: f64 = 15.0;

/// What a shot is to be like beyond its words.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectSettings {
    /// Frame width in pixels.
    pub width: u32,
    /// Frame height in pixels.
    pub height: u32,
    /// Frames a second.
    pub rate_fps: f64,
    /// Length of the film; `None` = as the words say, or as the moves need.
    pub duration_secs: Option<f64>,
    /// Seed of the search for cameras.
    pub seed: u64,
    /// How well open choices are made, against time.
    pub solve: SolveLevel,
    /// Effects of the lens.
    pub effects: EffectChoice,
}

impl Default for DirectSettings {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 720,
            rate_fps: 30.0,
            duration_secs: None,
            seed: 0,
            solve: SolveLevel::default(),
            effects: EffectChoice::default(),
        }
    }
}

/// A shot, and how its prompt was understood.
#[derive(Debug, Clone, PartialEq)]
pub struct Directed {
    /// The shot.
    pub shot: Shot,
    /// Every step of the prompt's program.
    pub steps: Vec<StepReading>,
    /// What becomes of each effect.
    pub effects: Vec<Decision>,
    /// What was guessed or taken with doubt, one sentence each.
    pub warnings: Vec<String>,
    /// Wall time per phase.
    pub times: PhaseTimes,
}

/// How one stretch of the prompt was understood.
#[derive(Debug, Clone, PartialEq)]
pub struct StepReading {
    /// The words, as they stand in the prompt; empty where the step has none of its own.
    pub words: String,
    /// What they were understood as.
    pub step: Step,
    /// How sure the network is of all of it, 0..=1.
    pub probability: f64,
    /// The choice that it is least sure of, and its probability.
    pub weakest: (&'static str, f64),
}

/// Makes the sparse clouds of all objects that lack one, which the director needs.
///
/// # Errors
/// [`PipelineError::Objects`].
pub fn prepare_objects(scene: &Scene, set: &mut ObjectSet) -> Result<(), PipelineError> {
    Ok(cinesplat_objects::fill_clouds(scene, set, &CloudSettings::default())?)
}

/// A sentence about a scene as a shot: words to a program, program to keyframes.
///
/// The same scene, objects, prompt and settings give the same shot. Objects that the director looks at get a cloud
/// where they have none.
///
/// # Errors
/// [`PipelineError::Language`] for words that name what the scene lacks; else the failing stage's error.
pub fn direct(
    scene: &Scene,
    objects: &ObjectSet,
    prompt: &str,
    director: &Director,
    settings: &DirectSettings,
) -> Result<Directed, PipelineError> {
    let mut times = PhaseTimes::default();
    let linked = times.measure(Phase::Direct, || cinesplat_language::link(prompt, &names(objects)))?;
    let objects = times.measure(Phase::Objects, || with_clouds(scene, objects, &linked))?;
    let bounds = scene.bounds();
    let context =
        SceneContext { objects: &objects.objects, up: scene.up, center: bounds.center(), size: bounds.size() };
    let mut direction = times.measure(Phase::Direct, || director.direct(&linked, &context))?;
    if settings.duration_secs.is_some() {
        direction.program.duration_secs = settings.duration_secs;
    }
    let ids = direction.program.object_ids();
    let world = times.measure(Phase::World, || World::new(&scene.gaussians, scene.up, &objects, &ids))?;
    let mut calls = calls(&linked)?;
    let dutch =
        calls.iter().position(|call| call.kind == EffectKind::Other(DUTCH.to_owned())).map(|at| calls.remove(at));
    let dutch_deg = dutch.map(|_| DUTCH_DEG);
    let (level, seed) = (settings.solve, settings.seed);
    let solve = SolveSettings { level, seed, dutch_deg, ..SolveSettings::default() };
    let solution = times.measure(Phase::Solve, || {
        cinesplat_operator::realize(&world, &direction.program, prompt, &direction.step_cameras, &solve)
    });
    let mut shot = shot_of(scene, prompt, solution, settings);
    let effects = cinesplat_lens::decide(&settings.effects, &calls);
    shot.model = Some(director.model_ref());
    shot.effects = effects.iter().filter_map(Decision::request).collect();
    shot.report.extend(effects.iter().filter_map(Decision::report_line));
    shot.report.extend(linked.unknown.iter().map(unknown_name));
    let steps = readings(prompt, &direction);
    Ok(Directed { shot: shot.validated()?, steps, effects, warnings: linked.warnings, times })
}

/// The shot of solved keyframes: no director had a part in it, no effects.
pub fn shot_of(scene: &Scene, prompt: &str, solution: Solution, settings: &DirectSettings) -> Shot {
    let path = scene.path.to_string_lossy().into_owned();
    Shot {
        scene: SceneRef { path, sha256: scene.sha256.clone(), up: Some(scene.up) },
        prompt: prompt.to_owned(),
        seed: settings.seed,
        model: None,
        width: settings.width,
        height: settings.height,
        fps: settings.rate_fps,
        duration_secs: solution.duration_secs,
        keyframes: solution.keyframes,
        effects: Vec::new(),
        report: solution.report,
        clearance: Some(super::clearance::in_file_order(scene, solution.clearance)),
    }
}

fn names(objects: &ObjectSet) -> Vec<NamedObject> {
    objects.objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect()
}

/// The objects, those that the network looks at with their clouds.
fn with_clouds(scene: &Scene, objects: &ObjectSet, linked: &Linked) -> Result<ObjectSet, PipelineError> {
    let seen = Director::looks_at(linked, &objects.objects);
    let (seen, mut rest): (Vec<_>, Vec<_>) =
        objects.objects.iter().cloned().partition(|object| seen.contains(&object.id));
    let mut set = ObjectSet { objects: seen, labels: objects.labels.clone() };
    prepare_objects(scene, &mut set)?;
    set.objects.append(&mut rest);
    set.objects.sort_by_key(|object| object.id);
    Ok(set)
}

fn calls(linked: &Linked) -> Result<Vec<EffectCall>, PipelineError> {
    let called = cinesplat_language::effect_mentions(linked)?;
    Ok(called.into_iter().map(|call| EffectCall { kind: call.kind.as_str().into(), because: call.words }).collect())
}

fn unknown_name(unknown: &cinesplat_language::UnknownName) -> ReportLine {
    let nearest = unknown.nearest.join(", ");
    ReportLine {
        clause: unknown.name.clone(),
        wanted: "an object of the scene".to_owned(),
        got: 0.0,
        met: false,
        note: format!("no object has this name; nearest: {nearest}"),
    }
}

fn readings(prompt: &str, direction: &Direction) -> Vec<StepReading> {
    let words = |step: &Step| step.words.and_then(|[start, end]| prompt.get(start..end)).unwrap_or_default().to_owned();
    let paired = direction.program.steps.iter().zip(&direction.certainty);
    paired
        .map(|(step, sure)| StepReading {
            words: words(step),
            step: step.clone(),
            probability: sure.probability,
            weakest: (sure.weakest.0.into(), sure.weakest.1),
        })
        .collect()
}
