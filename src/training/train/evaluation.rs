//! Evaluation of a director on prompts whose programs are known.

use cinesplat_director::{Director, DirectorError, SceneContext};
use cinesplat_language::{NamedObject, link};
use cinesplat_objects::Object;
use cinesplat_operator::Program;
use glam::{DQuat, DVec3};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::error::TrainError;
use super::metrics::ProgramMetrics;
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
        metrics.add(item.prompt, item.program, understood);
    }
    Ok(metrics)
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
    let objects: Vec<Object> = objects.iter().enumerate().map(|(idx, object)| placeholder(idx, object)).collect();
    let size = objects.len() as f64 + 2.0;
    let scene = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size };
    match director.direct(&linked, &scene) {
        Ok(direction) => Ok(direction.program),
        Err(DirectorError::EmptyPrompt | DirectorError::PromptTooLong { .. }) => Ok(Program::default()),
        Err(error) => Err(error.into()),
    }
}

/// A box without a cloud for a named object.
fn placeholder(idx: usize, object: &NamedObject) -> Object {
    Object {
        id: object.id,
        label: object.label.clone(),
        center: DVec3::new(idx as f64, 0.0, (idx % 3) as f64),
        half_extents: DVec3::splat(0.3),
        rotation: DQuat::IDENTITY,
        num_gaussians: 0,
        points: Vec::new(),
        shape_radius: 0.0,
        mask_iou: 0.0,
    }
}
