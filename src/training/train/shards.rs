//! Gradients of a batch, computed in parts side by side.
//!
//! Each part runs on one thread; candle's own threads are kept at one by the environment. Parts are added up in their
//! order, so that the sum does not depend on which thread was faster.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use candle_core::{Device, Result, Tensor, Var};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::lesson::Lesson;
use super::loss::{choice_loss, pose_loss};
use cinesplat_director::decode::previous_poses;
use cinesplat_director::model::{Dropout, KeyBatch, ModelConfig, Network, POSE_WIDTH, PromptBatch};

/// Loss and gradients of a batch.
#[derive(Debug, Clone, Default)]
pub(super) struct BatchGradients {
    /// Loss of the choices a key.
    pub(super) choice_loss: f64,
    /// Loss of the poses a key that has one.
    pub(super) pose_loss: f64,
    /// One a parameter, in order of names.
    pub(super) gradients: Vec<Vec<f32>>,
}

/// How a batch is computed.
#[derive(Debug, Clone, Copy)]
pub(super) struct BatchSettings {
    pub(super) threads: usize,
    pub(super) part_size: usize,
    pub(super) dropout: f32,
    pub(super) seed: u64,
}

/// What is trained.
pub(super) struct Trainee<'a> {
    pub(super) network: &'a Network,
    pub(super) config: &'a ModelConfig,
    pub(super) vars: &'a BTreeMap<String, Var>,
}

impl Trainee<'_> {
    /// Gradients of the mean loss a key over lessons; they are sorted by length first, so that little is padded.
    pub(super) fn gradients(&self, lessons: &mut [Lesson], settings: &BatchSettings) -> Result<BatchGradients> {
        lessons.sort_by_key(|lesson| (lesson.poses.is_empty(), lesson.prompt.tokens.len()));
        let num_keys: usize = lessons.iter().map(|lesson| lesson.keys.len()).sum();
        let scale = 1.0 / num_keys.max(1) as f64;
        let parts: Vec<&[Lesson]> = lessons.chunks(settings.part_size.max(1)).collect();
        let results: Vec<Mutex<Option<Result<BatchGradients>>>> = parts.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let work = || {
            loop {
                let part_idx = next.fetch_add(1, Ordering::Relaxed);
                let (Some(part), Some(slot)) = (parts.get(part_idx), results.get(part_idx)) else { return };
                let seed = settings.seed ^ (part_idx as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                let dropout = Dropout::new(settings.dropout, Pcg64Mcg::seed_from_u64(seed));
                let result = self.part(&part.iter().collect::<Vec<_>>(), &dropout, scale);
                *slot.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(result);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..settings.threads.max(1) {
                scope.spawn(work);
            }
            work();
        });
        let mut sum = BatchGradients::default();
        for result in results {
            let result = result.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
            if let Some(part) = result {
                add(&mut sum, part?);
            }
        }
        Ok(sum)
    }

    /// Losses and gradients of one part, every loss times `scale`.
    fn part(&self, lessons: &[&Lesson], dropout: &Dropout, scale: f64) -> Result<BatchGradients> {
        let (choices, poses) = self.losses(lessons, dropout)?;
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

    /// Summed losses of the choices, and of the poses where any lesson has them.
    pub(super) fn losses(&self, lessons: &[&Lesson], dropout: &Dropout) -> Result<(Tensor, Option<Tensor>)> {
        let prompts: Vec<_> = lessons.iter().map(|lesson| &lesson.prompt).collect();
        let batch = PromptBatch::new(&prompts, self.config)?;
        let memory = self.network.remember(&batch, dropout)?;
        let keys: Vec<_> = lessons.iter().map(|lesson| lesson.keys.as_slice()).collect();
        let num_keys = keys.iter().map(|keys| keys.len()).max().unwrap_or(0).max(1);
        let key_batch = KeyBatch::new(&keys, &prompts, &batch)?;
        let states = self.network.states(Some(&key_batch), &memory, dropout)?;
        let states = states.narrow(1, 0, num_keys)?.contiguous()?; // [batch, keys, width]
        let choices = choice_loss(&self.network.scores(&states, &memory, &batch)?, lessons, num_keys)?;
        if lessons.iter().all(|lesson| lesson.poses.is_empty()) {
            return Ok((choices, None));
        }
        let previous: Vec<f32> =
            lessons.iter().flat_map(|lesson| previous_poses(&lesson.seen_poses, num_keys)).collect();
        let previous = Tensor::from_vec(previous, (lessons.len(), num_keys, POSE_WIDTH + 1), &Device::Cpu)?;
        let out = self.network.poses(&key_batch, &states, &previous, &memory, dropout)?;
        Ok((choices, Some(pose_loss(&out, lessons, num_keys)?)))
    }
}

fn add(sum: &mut BatchGradients, part: BatchGradients) {
    sum.choice_loss += part.choice_loss;
    sum.pose_loss += part.pose_loss;
    if sum.gradients.is_empty() {
        sum.gradients = part.gradients;
        return;
    }
    for (sum, part) in sum.gradients.iter_mut().zip(part.gradients) {
        for (sum, value) in sum.iter_mut().zip(part) {
            *sum += value;
        }
    }
}
