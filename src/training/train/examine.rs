//! How well a director understands: its programs against those that were meant.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::TrainError;
use crate::sampler::{LabeledPrompt, PromptSampler, TemplateSplit, exam, exam_objects};
use cinesplat_director::{Director, DirectorError, Stage};
use cinesplat_language::{NamedObject, link};
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Program, Step};
use glam::{DQuat, DVec3};

/// What was right, out of how many.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Marks {
    /// Prompts whose whole program is right.
    pub programs: [usize; 2],
    /// Steps that are right in every field, of the steps meant; a wrong number of steps makes the missing ones wrong.
    pub steps: [usize; 2],
    /// By field, over steps that stand at the same place in both.
    pub fields: Vec<(&'static str, [usize; 2])>,
    /// Prompts that were not understood as meant: prompt, meant, understood.
    pub misses: Vec<Miss>,
}

/// A prompt that was not understood as meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Miss {
    /// The prompt.
    pub prompt: String,
    /// Its meaning.
    pub meant: Program,
    /// What the director made of it.
    pub understood: Program,
    /// Fields that differ.
    pub fields: Vec<&'static str>,
}

/// What an examination is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paper {
    /// Sentences written by people.
    Exam,
    /// Prompts of the phrasebook with wordings that training never saw.
    HeldOut {
        /// How many.
        count: usize,
    },
    /// Prompts of the phrasebook as in training, of another seed.
    Seen {
        /// How many.
        count: usize,
    },
}

/// Examines a director.
///
/// # Errors
/// [`TrainError`] when the embedded exam is damaged or the network fails. A prompt that cannot be linked counts as not
/// understood.
pub fn examine(director: &Director, paper: Paper) -> Result<Marks, TrainError> {
    let mut marks = Marks { fields: FIELDS.iter().map(|(name, _)| (*name, [0, 0])).collect(), ..Marks::default() };
    for (item, cast) in items(paper)? {
        let understood = understand(director, &item.prompt, &cast)?;
        mark(&mut marks, item, understood);
    }
    Ok(marks)
}

fn items(paper: Paper) -> Result<Vec<(LabeledPrompt, Vec<NamedObject>)>, TrainError> {
    let (count, split) = match paper {
        Paper::Exam => {
            let cast = exam_objects()?;
            return Ok(exam()?.into_iter().map(|item| (item, cast.clone())).collect());
        }
        Paper::HeldOut { count } => (count, TemplateSplit::HeldOut),
        Paper::Seen { count } => (count, TemplateSplit::Train),
    };
    let phrasebook = PromptSampler::embedded()?.with_split(split);
    let mut rng = Pcg64::seed_from_u64(0x00e8_a3c5);
    let draw = |_| {
        let cast = phrasebook.invent_objects(8, &mut rng);
        let sample = phrasebook.sample(&cast, &mut rng);
        (sample, cast)
    };
    Ok((0..count).map(draw).collect())
}

/// The director's program for a prompt about objects that stand in a row.
fn understand(director: &Director, prompt: &str, cast: &[NamedObject]) -> Result<Program, TrainError> {
    let Ok(linked) = link(prompt, cast) else { return Ok(Program::default()) };
    let objects: Vec<Object> = cast.iter().enumerate().map(|(place, object)| stand_in(place, object)).collect();
    let stage = Stage { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size: cast.len() as f64 + 2.0 };
    match director.direct(&linked, &stage) {
        Ok(direction) => Ok(direction.program),
        // A prompt that the director refuses counts as one that it did not understand.
        Err(DirectorError::EmptyPrompt | DirectorError::PromptTooLong { .. }) => Ok(Program::default()),
        Err(error) => Err(error.into()),
    }
}

fn stand_in(place: usize, object: &NamedObject) -> Object {
    Object {
        id: object.id,
        label: object.label.clone(),
        center: DVec3::new(place as f64, 0.0, (place % 3) as f64),
        half_extents: DVec3::splat(0.3),
        rotation: DQuat::IDENTITY,
        num_gaussians: 0,
        points: Vec::new(),
        shape_radius: 0.0,
        mask_iou: 0.0,
    }
}

type SameField = fn(&Step, &Step) -> bool;

/// The fields that are marked.
const FIELDS: [(&str, SameField); 16] = [
    ("move", |a, b| a.movement == b.movement || (a.either_way && b.either_way && opposite(a, b))),
    ("second move", |a, b| a.with == b.with),
    ("either way", |a, b| a.either_way == b.either_way),
    ("start subjects", |a, b| a.start.subjects == b.start.subjects),
    ("end subjects", |a, b| a.end.subjects == b.end.subjects),
    ("start size", |a, b| a.start.size == b.start.size),
    ("end size", |a, b| a.end.size == b.end.size),
    ("angles", |a, b| a.start.angle == b.start.angle && a.end.angle == b.end.angle),
    ("parts", |a, b| a.start.part == b.start.part && a.end.part == b.end.part),
    ("whole", |a, b| a.start.whole == b.start.whole && a.end.whole == b.end.whole),
    ("via", |a, b| a.via == b.via),
    ("amount", |a, b| a.amount == b.amount),
    ("duration", |a, b| a.duration_secs == b.duration_secs),
    ("speed", |a, b| a.speed == b.speed),
    ("easing", |a, b| a.easing == b.easing),
    ("cut, return", |a, b| a.cut == b.cut && a.returns == b.returns),
];

/// Where the direction is open, either side of a pair will do.
fn opposite(a: &Step, b: &Step) -> bool {
    let stem = |step: &Step| <&str>::from(step.movement).rsplit_once('-').map(|(stem, _)| stem);
    stem(a).is_some() && stem(a) == stem(b)
}

fn mark(marks: &mut Marks, item: LabeledPrompt, understood: Program) {
    let meant = &item.program;
    let mut wrong: Vec<&'static str> = Vec::new();
    if meant.steps.len() != understood.steps.len() {
        wrong.push("number of steps");
    }
    if meant.duration_secs != understood.duration_secs {
        wrong.push("film length");
    }
    for (step_idx, step) in meant.steps.iter().enumerate() {
        let mut all_right = false;
        if let Some(other) = understood.steps.get(step_idx) {
            all_right = true;
            for ((name, same), (_, tally)) in FIELDS.iter().zip(&mut marks.fields) {
                let right = same(&plain(step), &plain(other));
                tally[0] += usize::from(right);
                tally[1] += 1;
                all_right &= right;
                if !right && !wrong.contains(name) {
                    wrong.push(name);
                }
            }
        }
        marks.steps[0] += usize::from(all_right);
        marks.steps[1] += 1;
    }
    marks.programs[0] += usize::from(wrong.is_empty());
    marks.programs[1] += 1;
    if !wrong.is_empty() {
        let meant = item.program;
        marks.misses.push(Miss { prompt: item.prompt, meant, understood, fields: wrong });
    }
}

/// A step without what makes no difference: the order of subjects that are all wholly in the frame.
fn plain(step: &Step) -> Step {
    let plain = |framing: &Framing| {
        let mut framing = framing.clone();
        if framing.whole {
            framing.subjects.sort_unstable();
        }
        framing
    };
    Step { start: plain(&step.start), end: plain(&step.end), ..step.clone() }
}
