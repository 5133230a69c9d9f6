//! The operator: makes a program exact, safe and smooth.
//!
//! Enters: a scene prepared as [`World`], a [`Program`] of steps, and poses that the director suggests. Leaves: keyframes
//! whose path does what each step says by the definitions of the contract ("Moves, exactly"), and a report of what was
//! wanted and got. Within what the steps leave open (from where a subject is seen, how far a push goes) a bounded,
//! seeded search looks for a film that keeps its subjects in the frame and unhidden, stays clear of matter and in the
//! space that the capture shows from its good side. Never does IO.

mod clearance;
mod clearing;
mod draft;
mod dutch;
mod framing;
mod grid;
mod judge;
mod moves;
mod pairs;
mod program;
mod report;
mod route;
mod search;
mod suggested;
mod support;
mod view;
mod world;

pub use clearance::{ClearanceIndex, Nearest, SIGMA_LEVEL};
pub use framing::DEFAULT_ASPECT;
pub use pairs::{PairResult, PairSettings, try_pairs};
pub use program::{Amount, Framing, Part, Pass, Program, Speed, Step, Via};
pub use route::{NoRoute, Route, route};
pub use world::{DEFAULT_CAMERA_RADIUS_FRAC, Subject, World, default_camera_radius};

use cinesplat_scene::{Bounds, Gaussians, SOLID_OPACITY};
use cinesplat_trajectory::{CameraPath, CameraState, ClearanceProof, Keyframe, ReportLine, retime};
use draft::{StepLabels, keyframes};

/// How long the operator may look for a better film.
#[derive(
    Default,
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum SolveLevel {
    /// Not at all: the director's cameras joined by the path. A step without a suggestion takes the first choice
    /// that its move makes.
    Off,
    /// Some 300 tries for one step.
    Fast,
    /// Some 1,300 tries for one step, and 1,800 for each after it.
    #[default]
    Full,
}

/// Cameras that the director has in mind for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Suggestion {
    /// At its start.
    pub state: CameraState,
    /// At its end.
    pub end: CameraState,
    /// How long it takes from one to the other.
    pub secs: f64,
}

/// How to solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolveSettings {
    /// Time against how well the open choices are made.
    pub level: SolveLevel,
    /// Seed of the search.
    pub seed: u64,
    /// Factor on the number of tries of the level, for measuring accuracy against time.
    pub tries_factor: f64,
    /// Roll of the whole film, degrees clockwise: a dutch angle that the words ask for. The horizon is level without one.
    pub dutch_deg: Option<f64>,
}

impl Default for SolveSettings {
    fn default() -> Self {
        Self { level: SolveLevel::default(), seed: 0, tries_factor: 1.0, dutch_deg: None }
    }
}

/// A solved shot.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Keys in order of time, the first at 0.
    pub keyframes: Vec<Keyframe>,
    /// Length of the film.
    pub duration_secs: f64,
    /// What was wanted and got.
    pub report: Vec<ReportLine>,
    /// Index of the key at which each step of the program begins, and of the film's last key.
    pub step_keys: Vec<usize>,
    /// What was proved about the whole path's distance to matter.
    pub clearance: ClearanceProof,
    /// What the search minimized: below 3 everything asked for was found.
    pub cost: f64,
}

/// Shortest film and shortest part that a total duration squeezes things into.
const LEAST_PART_SECS: f64 = 0.3;

/// Keyframes that do what a program says.
///
/// `prompt` is the sentence, for the report; `suggestions` has one camera a step (or fewer). An empty program gives a
/// held view of the scene.
pub fn realize(
    world: &World,
    program: &Program,
    prompt: &str,
    suggestions: &[Suggestion],
    settings: &SolveSettings,
) -> Solution {
    let held;
    let program = if program.steps.is_empty() {
        held = Program { steps: vec![Step::of(cinesplat_trajectory::Move::Static)], ..program.clone() };
        &held
    } else {
        program
    };
    let task = search::Task { world, program, suggestions };
    let film = search::best_film(&task, settings);
    let cost = film.cost();
    let mut parts: Vec<draft::Part> = film.parts.into_iter().flatten().collect();
    // Without a search the cameras stay as they are: the report says what is in their way.
    let detours = if settings.level == SolveLevel::Off {
        parts = suggested::as_suggested(parts, suggestions);
        Vec::new()
    } else {
        clearing::lead_around(world, program, &mut parts)
    };
    fit_duration(&mut parts, program.duration_secs);
    if let Some(degrees) = settings.dutch_deg {
        dutch::roll(&mut parts, degrees);
    }
    let labels: Vec<StepLabels> = (0..program.steps.len()).map(|i| labels(program, i)).collect();
    let mut keys = keyframes(&parts, &labels);
    retime(&mut keys, Some(world.frame));
    let duration_secs = parts.iter().map(|part| part.secs).sum();
    let clearance = clearing::proof(world, &keys);
    let mut report = report::report(world, program, prompt, &parts);
    report.extend(clearing::clearance_lines(world, (program, prompt), &parts, &detours, &clearance));
    report.extend(settings.dutch_deg.map(|_| dutch::line(world, &keys)));
    let step_keys = step_keys(&parts, program.steps.len());
    Solution { keyframes: keys, duration_secs, report, step_keys, cost, clearance }
}

/// What can be proved about the distance between a path and the matter of a scene, for a camera of the default radius.
pub fn prove_clear(gaussians: &Gaussians, path: &CameraPath) -> ClearanceProof {
    let index = ClearanceIndex::new(gaussians, SOLID_OPACITY, SIGMA_LEVEL);
    clearance::prove(&index, path, default_camera_radius(&Bounds::of(gaussians)))
}

/// Scales the parts whose length is free so that the whole lasts as long as the words say.
fn fit_duration(parts: &mut [draft::Part], wanted_secs: Option<f64>) {
    let Some(wanted) = wanted_secs.filter(|&secs| secs > 0.0) else { return };
    let sum = |parts: &[draft::Part], bound: bool| -> f64 {
        parts.iter().filter(|part| part.secs_bind == bound).map(|part| part.secs).sum()
    };
    let (bound, free) = (sum(parts, true), sum(parts, false));
    let factor = (wanted - bound) / free;
    let all = free <= 0.0 || factor * free < LEAST_PART_SECS;
    let factor = if all { wanted / (bound + free) } else { factor };
    for part in parts.iter_mut().filter(|part| all || !part.secs_bind) {
        part.secs *= factor;
    }
}

/// What the keys of a step say about themselves: its framings, with what went before where they are empty.
fn labels(program: &Program, index: usize) -> StepLabels {
    let step = &program.steps[index];
    let earlier = || {
        let named =
            |s: &Step| [&s.end, &s.start].into_iter().find(|f| !f.subjects.is_empty()).map(|f| f.subjects.clone());
        program.steps[..index].iter().rev().find_map(named).unwrap_or_default()
    };
    let filled = |framing: &Framing, other: &Framing| match (framing.subjects.is_empty(), other.subjects.is_empty()) {
        (false, _) => framing.subjects.clone(),
        (true, false) => other.subjects.clone(),
        (true, true) => earlier(),
    };
    StepLabels {
        start_subjects: filled(&step.start, &step.end),
        end_subjects: filled(&step.end, &step.start),
        start_size: step.start.size,
        end_size: step.end.size,
        start_angle: step.start.angle,
        end_angle: step.end.angle,
        words: step.words,
    }
}

/// Key at which each step begins (its join included), and the last key.
fn step_keys(parts: &[draft::Part], num_steps: usize) -> Vec<usize> {
    let mut out = vec![0; num_steps + 1];
    let mut key = 0;
    let mut seen = None;
    for (p, part) in parts.iter().enumerate() {
        if part.cut && p > 0 {
            key += 1;
        }
        if seen != Some(part.step) {
            out[part.step] = key;
            seen = Some(part.step);
        }
        key += part.states.len() - 1;
    }
    out[num_steps] = key;
    out
}
