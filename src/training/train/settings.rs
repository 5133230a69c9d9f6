use std::path::PathBuf;

use serde::Serialize;

/// How to train.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrainSettings {
    /// Seed of everything: first weights, lessons, damage, dropout.
    pub seed: u64,
    /// Optimizer steps.
    pub steps: u64,
    /// Lessons a step.
    pub batch: usize,
    /// Highest learning rate.
    pub peak_rate: f32,
    /// Steps over which the rate rises to it.
    pub warm_up: u64,
    /// Share of numbers that dropout takes out.
    pub dropout: f32,
    /// Share of the lessons that are realized shots, where there are any.
    pub shots_frac: f64,
    /// Tokens of the vocabulary.
    pub vocabulary: usize,
    /// Prompts that the vocabulary is learned from.
    pub corpus: usize,
    /// Name of the model.
    pub name: String,
    /// Folder of realized shots; without one only the words are learned.
    #[serde(skip)]
    pub shots: Option<PathBuf>,
    /// Where the model and the checkpoint go.
    #[serde(skip)]
    pub out: PathBuf,
    /// A model to start from instead of drawn weights (with its vocabulary).
    #[serde(skip)]
    pub from: Option<PathBuf>,
    /// Threads that share a batch.
    #[serde(skip)]
    pub threads: usize,
    /// Steps between two checkpoints with their examination.
    #[serde(skip)]
    pub checkpoint_every: u64,
    /// Steps between two reports.
    #[serde(skip)]
    pub report_every: u64,
    /// Prompts of the phrasebook's reserved wordings that a checkpoint is examined on; 0 leaves the exam out too.
    #[serde(skip)]
    pub exam_prompts: usize,
    /// Go on from the checkpoint in `out`.
    #[serde(skip)]
    pub resume: bool,
}

impl Default for TrainSettings {
    fn default() -> Self {
        Self {
            seed: 8,
            steps: 6000,
            batch: 64,
            peak_rate: 1.5e-3,
            warm_up: 300,
            dropout: 0.05,
            shots_frac: 0.35,
            vocabulary: 2400,
            corpus: 40_000,
            name: "director-1".into(),
            shots: None,
            out: PathBuf::new(),
            from: None,
            threads: 2,
            checkpoint_every: 500,
            report_every: 10,
            exam_prompts: 150,
            resume: false,
        }
    }
}
