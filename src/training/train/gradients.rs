//! Loss and gradients of a batch, computed in parts on several threads.
//!
//! Each part runs on one thread; the environment keeps candle's own pool at one thread. Parts are added in their order, so
//! that the sum does not depend on which thread is faster.

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::examples::Example;
use super::loss::{choice_loss, pose_loss};
use crate::workers::map_on_threads;
use cinesplat_director::codes::{POSE_WIDTH, previous_poses};
use cinesplat_director::network::{Dropout, KeyBatch, ModelConfig, Network, PromptBatch};

/// Loss and gradients of a batch.
#[derive(Debug, Clone, Default)]
pub(super) struct BatchGradients {
    /// Loss of the choices per key.
    pub(super) choice_loss: f64,
    /// Loss of the poses per key of the batch.
    pub(super) pose_loss: f64,
    /// One per parameter, in the order of their names.
    pub(super) gradients: Vec<Vec<f32>>,
}

/// Settings of the computation of a batch.
#[derive(Debug, Clone, Copy)]
pub(super) struct BatchSettings {
    /// Number of threads.
    pub(super) threads: usize,
    /// Examples per part.
    pub(super) part_size: usize,
    /// Dropout rate, 0..1.
    pub(super) dropout: f32,
    /// Seed of the dropout.
    pub(super) seed: u64,
}

/// A network with its trainable parameters.
pub(super) struct TrainableNetwork<'a> {
    pub(super) network: &'a Network,
    pub(super) config: &'a ModelConfig,
    pub(super) vars: &'a BTreeMap<String, Var>,
}

impl TrainableNetwork<'_> {
    /// Gradients of the mean loss per key over examples. The examples are sorted by length first, so that little is padded.
    pub(super) fn gradients(&self, examples: &mut [Example], settings: &BatchSettings) -> Result<BatchGradients> {
        examples.sort_by_key(|example| (example.poses.is_empty(), example.prompt.tokens.len()));
        let num_keys: usize = examples.iter().map(|example| example.keys.len()).sum();
        let scale = 1.0 / num_keys.max(1) as f64;
        // The longest first, so that no thread waits for another's long part at the end.
        let parts: Vec<_> = examples.chunks(settings.part_size.max(1)).enumerate().rev().collect();
        let work = |(part_idx, part): (usize, &[Example])| {
            let seed = settings.seed ^ (part_idx as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let dropout = Dropout::new(settings.dropout, Pcg64Mcg::seed_from_u64(seed));
            self.part(&part.iter().collect::<Vec<_>>(), &dropout, scale)
        };
        let results: Vec<_> = map_on_threads(settings.threads, parts, work).into_iter().rev().collect::<Result<_>>()?;
        Ok(sum(results, settings.threads))
    }

    /// Losses and gradients of one part; every loss is multiplied by `scale`.
    fn part(&self, examples: &[&Example], dropout: &Dropout, scale: f64) -> Result<BatchGradients> {
        let (choices, poses) = self.losses(examples, dropout)?;
        let choice_loss = f64::from(choices.to_scalar::<f32>()?) * scale;
        let pose_loss = poses.as_ref().map_or(Ok(0.0), |poses| poses.to_scalar::<f32>().map(f64::from))? * scale;
        let total = match poses {
            Some(poses) => (choices + poses)?,
            None => choices,
        };
        let store = (total * scale)?.backward()?;
        let gradient = |var: &Var| match store.get(var) {
            Some(gradient) => gradient.flatten_all()?.to_vec1::<f32>(),
            None => Ok(vec![0.0; var.elem_count()]),
        };
        let gradients = self.vars.values().map(gradient).collect::<Result<_>>()?;
        Ok(BatchGradients { choice_loss, pose_loss, gradients })
    }

    /// Sum of the losses of the choices, and of the poses if any example has poses.
    pub(super) fn losses(&self, examples: &[&Example], dropout: &Dropout) -> Result<(Tensor, Option<Tensor>)> {
        let prompts: Vec<_> = examples.iter().map(|example| &example.prompt).collect();
        let batch = PromptBatch::new(&prompts, self.config)?;
        let memory = self.network.encode(&batch, dropout)?;
        let keys: Vec<_> = examples.iter().map(|example| example.keys.as_slice()).collect();
        let num_keys = keys.iter().map(|keys| keys.len()).max().unwrap_or(0).max(1);
        let key_batch = KeyBatch::new(&keys, &prompts, &batch)?;
        let states = self.network.states(Some(&key_batch), &memory, dropout)?;
        let states = states.narrow(1, 0, num_keys)?.contiguous()?; // [batch, keys, width]
        let choices = choice_loss(&self.network.scores(&states, &memory, &batch)?, examples, num_keys)?;
        if examples.iter().all(|example| example.poses.is_empty()) {
            return Ok((choices, None));
        }
        let previous: Vec<f32> =
            examples.iter().flat_map(|example| previous_poses(&example.noisy_poses, num_keys)).collect();
        let previous = Tensor::from_vec(previous, (examples.len(), num_keys, POSE_WIDTH + 1), &Device::Cpu)?;
        let out = self.network.poses(&key_batch, &states, &previous, &memory, dropout)?;
        Ok((choices, Some(pose_loss(&out, examples, num_keys)?)))
    }
}

/// The sum of the parts, each parameter's in the order of the parts.
fn sum(parts: Vec<BatchGradients>, threads: usize) -> BatchGradients {
    let add = |(mut sum, part): (Vec<f32>, Vec<f32>)| {
        sum.iter_mut().zip(part).for_each(|(sum, value)| *sum += value);
        sum
    };
    let both = |sum: BatchGradients, part: BatchGradients| BatchGradients {
        choice_loss: sum.choice_loss + part.choice_loss,
        pose_loss: sum.pose_loss + part.pose_loss,
        gradients: map_on_threads(threads, sum.gradients.into_iter().zip(part.gradients).collect(), add),
    };
    parts.into_iter().reduce(both).unwrap_or_default()
}
