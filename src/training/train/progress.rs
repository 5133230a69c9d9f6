//! Progress reports of a training run.

use std::ops::ControlFlow;

use super::metrics::ProgramMetrics;

/// Receives progress reports; [`ControlFlow::Break`] stops the training.
pub type ProgressCallback<'a> = dyn FnMut(&TrainingProgress) -> ControlFlow<()> + 'a;

/// A progress report.
#[derive(Debug, Clone, PartialEq)]
pub enum TrainingProgress {
    /// Some optimizer steps are done.
    Steps {
        /// Steps done.
        done: u64,
        /// Steps of the whole training.
        total: u64,
        /// Mean loss of the choices per key since the last report.
        choice_loss: f64,
        /// Mean loss of the poses per key since the last report.
        pose_loss: f64,
        /// Current learning rate.
        rate: f32,
    },
    /// A checkpoint was written and evaluated.
    Checkpoint {
        /// Steps done.
        done: u64,
        /// Mean losses of choices and of poses on examples that training never sees.
        held_out_loss: [f64; 2],
        /// Metrics on sampled prompts with held-out wordings.
        held_out: Box<ProgramMetrics>,
        /// Metrics on the hand-written sentences.
        hand_written: Box<ProgramMetrics>,
    },
}
