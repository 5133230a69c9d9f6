//! The gradients against finite differences.
//!
//! candle drops the gradients of some of its own operations without a word, and several operations here are written by
//! hand: so the derivative of the whole loss is checked by changing each parameter.

use std::collections::BTreeMap;

use candle_core::{Device, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::TrainError;
use super::lesson::{Damage, Lesson, School};
use super::shards::{BatchSettings, Trainee};
use crate::sampler::PromptSampler;
use cinesplat_director::model::{Dropout, ModelConfig, Network, Parameters, PoseCode};
use cinesplat_director::vocabulary::Vocabulary;
use cinesplat_language::link;

/// How far a parameter is moved along its gradient, either way.
const STEP: f32 = 0.01;

/// One parameter's gradient, two ways.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientCheck {
    /// Name of the parameter.
    pub name: String,
    /// Length of its gradient by backpropagation.
    pub backward: f64,
    /// Slope of the loss along that gradient by central differences.
    pub numeric: f64,
}

/// What an audit found.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientAudit {
    /// One a parameter.
    pub checks: Vec<GradientCheck>,
    /// Loss of all lessons together, padded to the longest of each part.
    pub batch_loss: f64,
    /// Sum of the losses of the lessons one by one.
    pub single_losses: f64,
}

/// Checks a tiny network with `num_lessons` lessons of the phrasebook, in parts of `part_size`.
///
/// # Errors
/// [`TrainError`] when the phrasebook or the network fails.
pub fn audit_gradients(seed: u64, num_lessons: u64, part_size: usize) -> Result<GradientAudit, TrainError> {
    let vocabulary = small_vocabulary(seed)?;
    let config = ModelConfig::tiny(vocabulary.size());
    let mut parameters = Parameters::seeded(seed);
    let network = Network::new(&mut parameters, &config)?;
    let vars = match parameters {
        Parameters::Fresh { vars, .. } => vars,
        Parameters::Stored { .. } => BTreeMap::new(),
    };
    let trainee = Trainee { network: &network, config: &config, vars: &vars };
    let mut lessons = posed_lessons(seed, num_lessons, &vocabulary)?;
    let batch = BatchSettings { threads: 2, part_size, dropout: 0.0, seed };
    let result = trainee.gradients(&mut lessons, &batch)?;
    let num_keys: usize = lessons.iter().map(|lesson| lesson.keys.len()).sum();
    let loss = |lessons: &[&Lesson]| -> Result<f64, TrainError> {
        let (choices, poses) = trainee.losses(lessons, &Dropout::off())?;
        let poses = poses.map_or(Ok(0.0), |poses| poses.to_scalar::<f32>())?;
        Ok((f64::from(choices.to_scalar::<f32>()?) + f64::from(poses)) / num_keys as f64)
    };
    let all: Vec<&Lesson> = lessons.iter().collect();
    let mut checks = Vec::with_capacity(vars.len());
    for ((name, var), gradient) in vars.iter().zip(&result.gradients) {
        let backward = gradient.iter().map(|g| f64::from(*g) * f64::from(*g)).sum::<f64>().sqrt();
        let numeric = slope(var, gradient, backward, &|| loss(&all))?;
        checks.push(GradientCheck { name: name.clone(), backward, numeric });
    }
    let single_losses = lessons.iter().map(|lesson| loss(&[lesson])).sum::<Result<f64, _>>()?;
    Ok(GradientAudit { checks, batch_loss: result.choice_loss + result.pose_loss, single_losses })
}

/// Slope of `loss` along the gradient of a parameter, which is put back afterwards.
fn slope(
    var: &Var,
    gradient: &[f32],
    length: f64,
    loss: &dyn Fn() -> Result<f64, TrainError>,
) -> Result<f64, TrainError> {
    if length == 0.0 {
        return Ok(0.0);
    }
    let values = var.flatten_all()?.to_vec1::<f32>()?;
    let moved = |step: f32| -> Result<f64, TrainError> {
        let scale = step / length as f32;
        let moved: Vec<f32> = values.iter().zip(gradient).map(|(value, g)| value + scale * g).collect();
        var.set(&Tensor::from_vec(moved, var.shape(), &Device::Cpu)?)?;
        loss()
    };
    let slope = (moved(STEP)? - moved(-STEP)?) / f64::from(2.0 * STEP);
    moved(0.0)?;
    Ok(slope)
}

fn small_vocabulary(seed: u64) -> Result<Vocabulary, TrainError> {
    let phrasebook = PromptSampler::embedded()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut lines = Vec::new();
    for _ in 0..200 {
        let cast = phrasebook.invent_objects(5, &mut rng);
        lines.push(link(&phrasebook.sample(&cast, &mut rng).prompt, &cast)?.tokens_text);
    }
    Ok(Vocabulary::train(&lines, 400)?)
}

/// Lessons whose keys have poses from anywhere.
fn posed_lessons(seed: u64, count: u64, vocabulary: &Vocabulary) -> Result<Vec<Lesson>, TrainError> {
    let phrasebook = PromptSampler::embedded()?;
    let school = School { phrasebook, vocabulary, words: &[], shots: &[], shots_frac: 0.0, damage: Damage::NONE };
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut lessons = (0..count).map(|number| school.lesson(seed, number)).collect::<Result<Vec<_>, _>>()?;
    for lesson in &mut lessons {
        let mut any = || rng.random_range(-0.5..0.5);
        let pose = |_: &_| PoseCode {
            position: [any(), any(), any()],
            rotation_6d: [any(), any(), any(), any(), any(), any()],
            log_fov: any(),
            log_wait: any() + 0.5,
        };
        lesson.poses = lesson.keys.iter().map(pose).collect();
        lesson.seen_poses = lesson.poses.clone();
    }
    Ok(lessons)
}
