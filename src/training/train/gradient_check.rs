//! Gradients compared with finite differences.
//!
//! candle silently drops the gradients of some of its operations, and several operations here have hand-written gradients.
//! So the derivative of the whole loss is checked by changing each parameter.

use std::collections::BTreeMap;

use candle_core::{Device, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::augmentation::Augmentation;
use super::error::TrainError;
use super::examples::{Example, ExampleSampler};
use super::gradients::{BatchSettings, TrainableNetwork};
use super::sentences::Sentences;
use crate::sampler::PromptSampler;
use cinesplat_director::codes::PoseCode;
use cinesplat_director::inputs::Vocabulary;
use cinesplat_director::network::{Dropout, ModelConfig, Network, Parameters};
use cinesplat_language::{link, sense_names};

/// Distance that a parameter moves along its gradient, in both directions.
const STEP: f32 = 0.01;

/// Gradient of one parameter, computed in two ways.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterCheck {
    /// Name of the parameter.
    pub name: String,
    /// Norm of its gradient by backpropagation.
    pub backward: f64,
    /// Slope of the loss along that gradient by central differences; equal to the norm when both are right.
    pub numeric: f64,
}

/// Result of a gradient check.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientCheck {
    /// One per parameter.
    pub parameters: Vec<ParameterCheck>,
    /// Mean loss per key of all examples in one batch, padded to the longest of each part.
    pub batch_loss: f64,
    /// The same loss, summed over batches of one example.
    pub single_losses: f64,
}

/// Checks the gradients of a tiny network on `num_examples` sampled examples, in parts of `part_size`.
///
/// # Errors
/// [`TrainError::Language`] when the grammar is damaged · [`TrainError::Director`] when the network fails ·
/// [`TrainError::NoExample`] when no example can be drawn.
pub fn check_gradients(seed: u64, num_examples: u64, part_size: usize) -> Result<GradientCheck, TrainError> {
    let vocabulary = small_vocabulary(seed)?;
    let config = ModelConfig::tiny(vocabulary.size(), sense_names()?.len());
    let mut parameters = Parameters::seeded(seed);
    let network = Network::new(&mut parameters, &config)?;
    let vars = match parameters {
        Parameters::Fresh { vars, .. } => vars,
        Parameters::Stored { .. } => BTreeMap::new(),
    };
    let trainable = TrainableNetwork { network: &network, config: &config, vars: &vars };
    let mut examples = posed_examples(seed, num_examples, &vocabulary)?;
    let batch = BatchSettings { threads: 2, part_size, dropout: 0.0, seed };
    let result = trainable.gradients(&mut examples, &batch)?;
    let num_keys: usize = examples.iter().map(|example| example.keys.len()).sum();
    let loss = |examples: &[&Example]| -> Result<f64, TrainError> {
        let (choices, poses) = trainable.losses(examples, &Dropout::off())?;
        let poses = poses.map_or(Ok(0.0), |poses| poses.to_scalar::<f32>())?;
        Ok((f64::from(choices.to_scalar::<f32>()?) + f64::from(poses)) / num_keys as f64)
    };
    let all: Vec<&Example> = examples.iter().collect();
    let mut parameters_checked = Vec::with_capacity(vars.len());
    for ((name, var), gradient) in vars.iter().zip(&result.gradients) {
        let backward = gradient.iter().map(|g| f64::from(*g) * f64::from(*g)).sum::<f64>().sqrt();
        let numeric = slope(var, gradient, backward, &|| loss(&all))?;
        parameters_checked.push(ParameterCheck { name: name.clone(), backward, numeric });
    }
    let single_losses = examples.iter().map(|example| loss(&[example])).sum::<Result<f64, _>>()?;
    Ok(GradientCheck {
        parameters: parameters_checked,
        batch_loss: result.choice_loss + result.pose_loss,
        single_losses,
    })
}

/// Slope of `loss` along the gradient of a parameter; the parameter gets its old value back. `length` is the norm of the
/// gradient.
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
    let prompts = PromptSampler::embedded()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut lines = Vec::new();
    for _ in 0..200 {
        let objects = prompts.invent_objects(5, &mut rng);
        lines.push(link(&prompts.sample(&objects, &mut rng).prompt, &objects)?.tokens_text);
    }
    Ok(Vocabulary::train(&lines, 400)?)
}

/// Examples whose keys have random poses.
fn posed_examples(seed: u64, count: u64, vocabulary: &Vocabulary) -> Result<Vec<Example>, TrainError> {
    let prompts = PromptSampler::embedded()?;
    let augmentation = Augmentation::NONE;
    let sentences = Sentences::default();
    let sampler = ExampleSampler {
        prompts,
        vocabulary,
        words: &[],
        sentences: &sentences,
        sentences_frac: 0.0,
        shots: &[],
        shots_frac: 0.0,
        augmentation,
    };
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut examples = (0..count).map(|number| sampler.example(seed, number)).collect::<Result<Vec<_>, _>>()?;
    for example in &mut examples {
        let mut any = || rng.random_range(-0.5..0.5);
        let pose = |_: &_| PoseCode {
            position: [any(), any(), any()],
            rotation_6d: [any(), any(), any(), any(), any(), any()],
            log_fov: any(),
            log_wait: any() + 0.5,
        };
        example.poses = example.keys.iter().map(pose).collect();
        example.noisy_poses = example.poses.clone();
    }
    Ok(examples)
}
