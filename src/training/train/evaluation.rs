//! Evaluation of a director on prompts whose programs are known.

use std::time::Instant;

use cinesplat_director::{Direction, Director, DirectorError, SceneContext};
use cinesplat_language::{Linked, NamedObject, link};
use cinesplat_objects::Object;
use cinesplat_operator::Program;
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::error::TrainError;
use super::metrics::{ProgramMetrics, Tally, are_equal, right_steps};
use crate::corpus::{SentenceKind, Writer};
use crate::sampler::{LabeledPrompt, PromptSampler, TemplateSplit, exam, exam_objects};

/// The prompts that a director is evaluated on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EvaluationSplit {
    /// Hand-written sentences.
    HandWritten,
    /// Sampled prompts with wordings that are held out of training.
    HeldOut {
        /// Number of prompts.
        count: usize,
    },
    /// Sampled prompts with the wordings of training, drawn with another seed.
    Training {
        /// Number of prompts.
        count: usize,
    },
}

/// Metrics of a director on a split. A prompt that cannot be linked, or that the director rejects, counts as an empty
/// program.
///
/// # Errors
/// [`TrainError::Language`] when the embedded sentences or the grammar are damaged · [`TrainError::Director`] when the
/// network fails.
pub fn evaluate_director(director: &Director, split: EvaluationSplit) -> Result<ProgramMetrics, TrainError> {
    let mut metrics = ProgramMetrics::default();
    for (item, objects) in items(split)? {
        let understood = understand(director, &item.prompt, &objects)?;
        metrics.add(item.prompt, &[item.program], understood);
    }
    Ok(metrics)
}

/// How the mentions of objects in a sentence are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum Mentions {
    /// Those that the corpus marks.
    Given,
    /// Those that the director finds.
    Found,
}

/// What a director makes of sentences of the corpus.
#[derive(Debug, Clone, Default)]
pub struct Examination {
    /// Understood programs compared with the intended ones.
    pub metrics: ProgramMetrics,
    /// For each understood step, its probability and whether it is right.
    pub certainty: Vec<(f64, bool)>,
    /// Time per sentence in seconds.
    pub latencies_secs: Vec<f64>,
    /// Sentences on whose programs their two readers agree; a sentence with one reading counts as agreed.
    pub readers: Tally,
}

impl Examination {
    /// Adds what the director made of other sentences.
    pub fn extend(&mut self, other: Self) {
        self.metrics.extend(other.metrics);
        self.certainty.extend(other.certainty);
        self.latencies_secs.extend(other.latencies_secs);
        self.readers.extend(other.readers);
    }
}

/// Examines a director on the sentences of writers: those of one kind, or all.
///
/// A sentence that the director rejects counts as an empty program. All things that the scene lacks count as one.
///
/// # Errors
/// [`TrainError::Director`] when the network fails.
pub fn examine(
    director: &Director,
    writers: &[&Writer],
    kind: Option<SentenceKind>,
    mentions: Mentions,
) -> Result<Examination, TrainError> {
    let mut examination = Examination::default();
    for (writer, sentence) in writers.iter().flat_map(|writer| writer.sentences.iter().map(move |s| (writer, s))) {
        if kind.is_some_and(|kind| kind != sentence.kind) {
            continue;
        }
        let objects = writer.scenes.get(&sentence.scene).map_or(&[][..], Vec::as_slice);
        let start = Instant::now();
        let linked = match mentions {
            Mentions::Given => Some(sentence.linked.clone()),
            Mentions::Found => director.link(&sentence.prompt, objects).ok(),
        };
        let direction = linked.as_ref().map(|linked| direction(director, linked, objects)).transpose()?.flatten();
        examination.latencies_secs.push(start.elapsed().as_secs_f64());
        let readings = std::iter::once(&sentence.program).chain(&sentence.second);
        let readings: Vec<Program> = readings.map(|program| one_missing(&sentence.linked, program.clone())).collect();
        examination.readers.add(readings.windows(2).all(|pair| are_equal(&pair[0], &pair[1])));
        let understood = match (direction, &linked) {
            (Some(direction), Some(linked)) => {
                let understood = one_missing(linked, direction.program);
                let right = right_steps(&readings, &understood);
                let probabilities = direction.certainty.iter().map(|certainty| certainty.probability);
                examination.certainty.extend(probabilities.zip(right));
                understood
            }
            _ => Program::default(),
        };
        examination.metrics.add(sentence.prompt.clone(), &readings, understood);
    }
    Ok(examination)
}

/// The program with one id for all things that the scene lacks.
fn one_missing(linked: &Linked, program: Program) -> Program {
    program.with_ids(&|ids| {
        let of = |id: &u32| if linked.missing(*id).is_some() { u32::MAX } else { *id };
        let mut ids: Vec<u32> = ids.iter().map(of).collect();
        ids.dedup();
        ids
    })
}

/// The prompts of a split with their programs, each with the objects that it may name.
fn items(split: EvaluationSplit) -> Result<Vec<(LabeledPrompt, Vec<NamedObject>)>, TrainError> {
    let (count, wordings) = match split {
        EvaluationSplit::HandWritten => {
            let objects = exam_objects()?;
            return Ok(exam()?.into_iter().map(|item| (item, objects.clone())).collect());
        }
        EvaluationSplit::HeldOut { count } => (count, TemplateSplit::HeldOut),
        EvaluationSplit::Training { count } => (count, TemplateSplit::Train),
    };
    let sampler = PromptSampler::embedded()?.with_split(wordings);
    let mut rng = Pcg64::seed_from_u64(0x00e8_a3c5);
    let draw = |_| {
        let objects = sampler.invent_objects(8, &mut rng);
        let item = sampler.sample(&objects, &mut rng);
        (item, objects)
    };
    Ok((0..count).map(draw).collect())
}

/// The director's program for a prompt; the objects are placed in a row.
fn understand(director: &Director, prompt: &str, objects: &[NamedObject]) -> Result<Program, TrainError> {
    let Ok(linked) = link(prompt, objects) else { return Ok(Program::default()) };
    understand_linked(director, &linked, objects)
}

fn understand_linked(director: &Director, linked: &Linked, objects: &[NamedObject]) -> Result<Program, TrainError> {
    Ok(direction(director, linked, objects)?.map(|direction| direction.program).unwrap_or_default())
}

/// The director's output for a linked prompt; `None` for a prompt that it rejects.
fn direction(director: &Director, linked: &Linked, objects: &[NamedObject]) -> Result<Option<Direction>, TrainError> {
    let objects: Vec<Object> = objects.iter().enumerate().map(|(idx, object)| placeholder(idx, object)).collect();
    let size = objects.len() as f64 + 2.0;
    let scene = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size };
    match director.direct(linked, &scene) {
        Ok(direction) => Ok(Some(direction)),
        Err(DirectorError::EmptyPrompt | DirectorError::PromptTooLong { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// A box without a cloud for a named object.
fn placeholder(idx: usize, object: &NamedObject) -> Object {
    let center = DVec3::new(idx as f64, 0.0, (idx % 3) as f64);
    Object::from_box(object.id, &object.label, center, DVec3::splat(0.3))
}
