use super::choose_film::{Critique, FilmChoice, choose_film};
use super::clearance::reach_of;
use super::error::PipelineError;
use super::facing::face_people;
use super::interpreter::{Interpreter, names};
use super::phases::{Phase, PhaseTimes};
use super::reading::{Problem, Reading, read};
use super::slant::{level_out, slant_of};
use super::{few_things, guessed_things, lone_thing, other_kinds};
use cinesplat_critic::Subjects;
use cinesplat_director::{Direction, Director, SceneContext};
use cinesplat_language::{DUTCH_ANGLE, EffectMention, LanguageError, Linked, forbidding_words};
use cinesplat_lens::{Call, Called, CalledEffect, Calls, EffectChoice, Unmet};
use cinesplat_objects::{CloudSettings, ObjectSet};
use cinesplat_operator::{Pass, Program, Solution, SolveLevel, SolveSettings, Step, World};
use cinesplat_scene::Scene;
use cinesplat_trajectory::{ModelRef, Move, ReportLine, SceneRef, Shot, ShotAngle};

/// Settings of a shot beyond its prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectSettings {
    /// Frame width in pixels.
    pub width: u32,
    /// Frame height in pixels.
    pub height: u32,
    /// Frames per second.
    pub rate_fps: f64,
    /// Length of the film in seconds; `None` = from the words, else from the moves.
    pub duration_secs: Option<f64>,
    /// Seed of the camera search.
    pub seed: u64,
    /// Effort of the camera search.
    pub solve: SolveLevel,
    /// Which lens effects the shot gets.
    pub effects: EffectChoice,
    /// How the critic chooses among the films that the search finishes.
    pub choice: FilmChoice,
}

impl DirectSettings {
    /// Width over height of the frame.
    fn aspect(&self) -> f64 {
        f64::from(self.width.max(1)) / f64::from(self.height.max(1))
    }
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
            choice: FilmChoice::default(),
        }
    }
}

/// A shot, with the interpretation of its prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Directed {
    /// The shot.
    pub shot: Shot,
    /// The best shots that clearly differ, the one in `shot` first; as many as there are, up to
    /// [`FilmChoice::num_takes`].
    pub takes: Vec<Shot>,
    /// What the critic said about the films that it chose from; `None` without a search.
    pub critique: Option<Critique>,
    /// The steps of the prompt's program, in order.
    pub steps: Vec<StepReading>,
    /// The program itself: what it says of the whole film is in no step.
    pub program: Program,
    /// The effects that the shot calls for, and the calls that lead to none.
    pub effects: Called,
    /// What the prompt asks for and the program does not contain.
    pub problems: Vec<Problem>,
    /// Guesses and doubtful choices, one sentence each.
    pub warnings: Vec<String>,
    /// Wall time per phase.
    pub times: PhaseTimes,
}

/// The interpretation of one clause of the prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct StepReading {
    /// The words of the prompt; empty for a step without words of its own.
    pub words: String,
    /// The step that they mean.
    pub step: Step,
    /// Probability of the whole step according to the model, 0..=1.
    pub probability: f64,
    /// The least probable choice of the step, and its probability.
    pub weakest: (&'static str, f64),
}

/// Takes a low camera along things on a table, or one at the height of the table, for one at their level: from below there is
/// only the table.
fn level_with_things(program: &mut Program, objects: &ObjectSet, up: glam::DVec3) {
    let bears = |id: &u32| objects.borne_heights(*id, up).is_some();
    let feet = || objects.objects.iter().flat_map(cinesplat_objects::Object::corners).map(|corner| corner.dot(up));
    let floor = || feet().fold(f64::INFINITY, f64::min);
    for step in &mut program.steps {
        let along = step.via.as_ref().is_some_and(|via| via.how == Pass::Along && via.objects.iter().any(bears));
        for framing in [&mut step.start, &mut step.end] {
            let bearer = framing.subjects.first().and_then(|id| objects.bearer_of(*id, up));
            let are_borne = framing.subjects.len() > 1
                && bearer.is_some()
                && framing.subjects.iter().all(|id| objects.bearer_of(*id, up) == bearer);
            // `At bench height` along a bench is the height of what stands on it.
            let is_below =
                |id: &u32, height: f64| objects.borne_heights(*id, up).is_some_and(|[low, _]| height < low - floor());
            let passed = step.via.as_ref().filter(|_| along && bearer.is_some());
            if let (Some(via), Some(height)) = (passed, framing.height)
                && via.objects.iter().any(|id| is_below(id, height))
            {
                (framing.height, framing.angle) = (None, Some(ShotAngle::EyeLevel));
            }
            if framing.angle == Some(ShotAngle::Low) && (along || are_borne) {
                framing.angle = Some(ShotAngle::EyeLevel);
            }
        }
    }
}

/// Gives every object without a sparse cloud one. The director needs these clouds.
///
/// # Errors
/// [`PipelineError::Objects`] when the views of the objects cannot be rendered.
pub fn prepare_objects(scene: &Scene, set: &mut ObjectSet) -> Result<(), PipelineError> {
    Ok(cinesplat_objects::fill_clouds(scene, set, &CloudSettings::default())?)
}

/// Turns a sentence about a scene into a shot: words to a program, program to keyframes.
///
/// The same scene, objects, prompt and settings give the same shot. Objects that the director reads get a cloud if they
/// have none.
///
/// # Errors
/// [`PipelineError::Language`] for a prompt that names an unknown object; otherwise the error of the stage that fails.
pub fn direct(
    scene: &Scene,
    objects: &ObjectSet,
    prompt: &str,
    interpreter: &Interpreter,
    settings: &DirectSettings,
) -> Result<Directed, PipelineError> {
    let mut times = PhaseTimes::default();
    let up = scene.up.normalize_or_zero();
    let found = objects;
    let named = few_things::named(prompt, found).or_else(|| guessed_things::named(prompt, found, up));
    let objects = named.as_ref().map_or(found, |named| &named.objects);
    let said = named.as_ref().and_then(|named| named.prompt.as_deref()).unwrap_or(prompt);
    let (mut linked, objects) =
        times.measure(Phase::Direct, || lone_thing::link(&interpreter.director, said, objects, scene))?;
    named.iter().for_each(|named| named.warn(&mut linked));
    guessed_things::take_guesses(&mut linked, found, up);
    other_kinds::warn(said, &mut linked, &objects);
    linked.name_what_stands(prompt, &|id| objects.things_on(id, up));
    let objects = times.measure(Phase::Objects, || with_clouds(scene, &objects, &linked))?;
    let bounds = scene.bounds();
    let context =
        SceneContext { objects: &objects.objects, up: scene.up, center: bounds.center(), size: bounds.size() };
    let Reading { linked, mut direction, effects, problems } =
        times.measure(Phase::Direct, || read(prompt, linked, interpreter, &context))?;
    refuse_missing(&linked, &direction)?;
    level_with_things(&mut direction.program, &objects, up);
    level_out(&effects, &mut direction.program, prompt);
    lone_thing::show(prompt, &mut direction.program, &objects);
    let model = Some(interpreter.model_ref());
    film(
        (scene, &objects),
        prompt,
        Script { direction, effects, problems, warnings: linked.warnings, model },
        settings,
        times,
    )
}

/// The shot of a program that was not read from the prompt, chosen as that of a prompt is. It calls for no effects.
///
/// # Errors
/// The error of the stage that fails.
pub fn direct_program(
    scene: &Scene,
    objects: &ObjectSet,
    prompt: &str,
    program: &Program,
    settings: &DirectSettings,
) -> Result<Directed, PipelineError> {
    let script = Script { direction: Direction::of(program.clone()), ..Script::default() };
    film((scene, objects), prompt, script, settings, PhaseTimes::default())
}

/// What a film is made from.
#[derive(Default)]
struct Script {
    direction: Direction,
    effects: Vec<EffectMention>,
    problems: Vec<Problem>,
    warnings: Vec<String>,
    /// The network that read the prompt.
    model: Option<ModelRef>,
}

/// Tells a world the fronts of its subjects. All of a scan of one thing has the front of that thing, as a neck has that of its
/// guitar.
fn turn_to_fronts(
    (scene, objects): (&Scene, &ObjectSet),
    (subjects, ids): (&Subjects, &[u32]),
    world: &mut World,
) -> Result<(), PipelineError> {
    if let Some(whole) = objects.only_whole() {
        let alone = (!ids.contains(&whole.id)).then(|| Subjects::new(&scene.gaussians, objects, &[whole.id]));
        let front = alone.as_ref().unwrap_or(subjects).front(whole.id, &world.frame)?;
        let mut all = objects.parts_of(whole.id);
        all.push(whole.id);
        front.into_iter().for_each(|direction| world.set_front_of_whole(&all, direction));
    } else {
        let fronts = subjects.fronts(&world.frame)?;
        fronts.into_iter().for_each(|(id, direction)| world.set_front(id, direction));
    }
    Ok(())
}

/// Searches the cameras of a script and chooses among the films.
fn film(
    (scene, objects): (&Scene, &ObjectSet),
    prompt: &str,
    script: Script,
    settings: &DirectSettings,
    mut times: PhaseTimes,
) -> Result<Directed, PipelineError> {
    let Script { mut direction, effects, problems, warnings, model } = script;
    if settings.duration_secs.is_some() {
        direction.program.duration_secs = settings.duration_secs;
    }
    let ids = direction.program.object_ids();
    let mut world = times.measure(Phase::World, || World::new(&scene.gaussians, scene.up, objects, &ids))?;
    world.aspect = settings.aspect();
    // Without a search nobody looks at the film.
    let looks = settings.solve != SolveLevel::Off;
    let subjects = looks.then(|| times.measure(Phase::Judge, || Subjects::new(&scene.gaussians, objects, &ids)));
    if let Some(subjects) = subjects.as_ref().filter(|_| !world.is_indoor()) {
        times.measure(Phase::Judge, || turn_to_fronts((scene, objects), (subjects, &ids), &mut world))?;
    }
    if looks && world.is_indoor() {
        times.measure(Phase::World, || face_people(&scene.gaussians, objects, &ids, &mut world));
    }
    let program = &direction.program;
    // A shaky camera keeps clear wherever the hand takes it.
    let called = called(&effects, (program, prompt), settings, scene.bounds().size());
    world.add_reach(reach_of(&called));
    let (level, seed, slant) = (settings.solve, settings.seed, slant_of(&effects, program, prompt));
    let solve = SolveSettings { level, seed, slant, ..SolveSettings::default() };
    let num = settings.choice.num_finalists(level);
    let mut solutions = times.measure(Phase::Solve, || {
        cinesplat_operator::finalists(&world, (program, prompt), &direction.step_cameras, &solve, num)
    });
    let size_px = [settings.width, settings.height];
    let judge = |subjects: &Subjects| {
        let choose = || choose_film((scene, &world), (program, subjects), &mut solutions, size_px, &settings.choice);
        times.measure(Phase::Judge, choose)
    };
    let critique = subjects.as_ref().map(judge).transpose()?;
    solutions.truncate(settings.choice.num_takes.max(1));
    let finished = |solution| {
        let mut shot = shot_of(scene, prompt, solution, settings);
        shot.model.clone_from(&model);
        shot.effects = called.effects.iter().map(CalledEffect::request).collect();
        let missing = called.unmet.iter().filter(|unmet| unmet.is_missing());
        shot.report.extend(missing.map(missing_effect));
        shot.report.extend(problems.iter().map(Problem::report_line));
        shot.validated()
    };
    let mut takes: Vec<Shot> = solutions.into_iter().map(finished).collect::<Result<_, _>>()?;
    for shot in &mut takes {
        super::focus::focus(scene, objects, shot)?;
    }
    let shot = takes[0].clone();
    let steps = readings(prompt, &direction);
    let program = direction.program;
    Ok(Directed { shot, takes, critique, steps, program, effects: called, problems, warnings, times })
}

/// A shot of solved keyframes, without a director's model and without effects.
pub fn shot_of(scene: &Scene, prompt: &str, solution: Solution, settings: &DirectSettings) -> Shot {
    let path = scene.path.to_string_lossy().into_owned();
    let size_px = [settings.width, settings.height];
    Shot {
        scene: SceneRef { path, sha256: scene.sha256.clone(), up: Some(scene.up) },
        prompt: prompt.to_owned(),
        seed: settings.seed,
        report: solution.report,
        clearance: Some(super::clearance::in_file_order(scene, solution.clearance)),
        ..Shot::from_keyframes(size_px, settings.rate_fps, solution.duration_secs, solution.keyframes)
    }
}

/// The frame size of the shape that a prompt states, such as `portrait`, and the words that state it; its shorter side is
/// that of the default size.
pub fn stated_size<'a>(prompt: &'a str, objects: &ObjectSet) -> Option<([u32; 2], &'a str)> {
    let shape = cinesplat_language::frame_shape(prompt, &names(&objects.objects))?;
    let [start, end] = shape.bytes;
    Some((shape.size_px(DirectSettings::default().height), prompt.get(start..end).unwrap_or_default()))
}

/// The frame rate that a prompt states, frames per second, and the words that state it.
pub fn stated_rate(prompt: &str) -> Option<(f64, &str)> {
    let rate = cinesplat_language::frame_rate(prompt)?;
    let [start, end] = rate.bytes;
    Some((rate.fps, prompt.get(start..end).unwrap_or_default()))
}

/// The objects; those that the network reads have clouds.
fn with_clouds(scene: &Scene, objects: &ObjectSet, linked: &Linked) -> Result<ObjectSet, PipelineError> {
    let seen = Director::looks_at(linked, &objects.objects);
    let mut set = objects.clone();
    cinesplat_objects::fill_clouds_of(scene, &mut set, &seen, &CloudSettings::default())?;
    Ok(set)
}

/// The effects that the words and the moves of a program call for.
fn called(
    mentions: &[EffectMention],
    (program, prompt): (&Program, &str),
    settings: &DirectSettings,
    scene_size: f64,
) -> Called {
    let wanted = mentions.iter().filter(|mention| !mention.is_forbidden && mention.call.name != DUTCH_ANGLE);
    let calls: Vec<Call> = wanted.map(|mention| mention.call.clone()).collect();
    let forbidden = mentions.iter().filter(|mention| mention.is_forbidden);
    let words = |mention: &EffectMention| {
        let [start, end] = forbidding_words(prompt, mention, mentions);
        prompt.get(start..end).unwrap_or_default().to_lowercase()
    };
    let forbidden: Vec<_> = forbidden.map(|mention| (mention.call.name.clone(), words(mention))).collect();
    let moves = program.steps.iter().flat_map(|step| std::iter::once(step.movement).chain(step.with.iter().copied()));
    let moves: Vec<Move> = moves.collect();
    let seed = settings.seed;
    let calls = Calls { calls: &calls, forbidden: &forbidden, moves: &moves, keyframes: &[], scene_size, seed };
    Called::of(&settings.effects, &calls)
}

/// The report's line of a call that the film lacks.
fn missing_effect(unmet: &Unmet) -> ReportLine {
    let (clause, wanted) = (unmet.call.because.clone(), unmet.call.name.clone());
    ReportLine { clause, wanted, got: 0.0, met: false, note: unmet.sentence() }
}

/// Refuses a program that is about something that the scene lacks, and one without steps.
fn refuse_missing(linked: &Linked, direction: &Direction) -> Result<(), PipelineError> {
    let missing = direction.program.object_ids().into_iter().find_map(|id| linked.missing(id));
    match missing {
        Some(group) => {
            Err(LanguageError::UnknownObject { name: group.name.clone(), nearest: group.nearest.clone() }.into())
        }
        None if direction.program.steps.is_empty() => Err(LanguageError::NothingToDo.into()),
        None => Ok(()),
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
            weakest: sure.weakest,
        })
        .collect()
}
