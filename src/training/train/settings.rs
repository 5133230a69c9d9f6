//! Settings of a training run.

use std::path::PathBuf;

use serde::Serialize;

use cinesplat_files::Existing;

/// Settings of a training run. The serialized fields change the weights; a checkpoint stores them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrainSettings {
    /// Seed of the initial weights, the examples, their augmentation and the dropout.
    pub seed: u64,
    /// Number of optimizer steps.
    pub steps: u64,
    /// Examples per step.
    pub batch: usize,
    /// Highest learning rate.
    pub peak_rate: f32,
    /// Steps over which the learning rate rises to its peak.
    pub warm_up: u64,
    /// Dropout rate, 0..1.
    pub dropout: f32,
    /// Fraction of the examples that are realized shots if there are any, 0..=1.
    pub shots_frac: f64,
    /// Fraction of the examples that are sentences of the corpus if there is one, 0..=1.
    pub sentences_frac: f64,
    /// Limit on the number of sentences of the corpus, drawn at random; `None` = all.
    pub max_sentences: Option<usize>,
    /// Limit on the tokens of the vocabulary.
    pub vocabulary: usize,
    /// Number of sampled prompts from which the vocabulary is learned.
    pub corpus: usize,
    /// Name of the model, as shots store it.
    pub name: String,
    /// Folder of the corpus. Without one, the network learns from sampled prompts only.
    #[serde(skip)]
    pub sentences: Option<PathBuf>,
    /// Folder of realized shots. Without one, the network learns programs only, not poses.
    #[serde(skip)]
    pub shots: Option<PathBuf>,
    /// Highest learning rate of the text encoder that was trained beforehand, over that of the rest.
    pub base_rate_frac: f32,
    /// Folder of a text encoder that was trained beforehand (BERT as `transformers` stores it), instead of one with random
    /// weights. Its word pieces are the vocabulary.
    #[serde(skip)]
    pub base: Option<PathBuf>,
    /// Model whose weights and vocabulary the training starts from, instead of random weights.
    #[serde(skip)]
    pub from: Option<PathBuf>,
    /// Whether the vocabulary is learned anew although there is a model to start from; pieces that both have keep their
    /// embedding. A model of another format gets a new vocabulary in any case.
    #[serde(skip)]
    pub new_vocabulary: bool,
    /// Number of threads.
    #[serde(skip)]
    pub threads: usize,
    /// Steps between two checkpoints, which include an evaluation.
    #[serde(skip)]
    pub checkpoint_every: u64,
    /// Steps between two progress reports.
    #[serde(skip)]
    pub report_every: u64,
    /// Number of prompts with held-out wordings on which a checkpoint is evaluated; 0 skips the hand-written sentences too.
    #[serde(skip)]
    pub evaluation_prompts: usize,
    /// Whether to resume from the checkpoint in the output folder.
    #[serde(skip)]
    pub resume: bool,
    /// Whether a training that is not resumed may replace the model and checkpoint of the output folder.
    #[serde(skip)]
    pub existing: Existing,
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
            sentences_frac: 0.6,
            max_sentences: None,
            vocabulary: 2400,
            corpus: 40_000,
            name: "director-3".into(),
            sentences: None,
            shots: None,
            base_rate_frac: 0.1,
            base: None,
            from: None,
            new_vocabulary: false,
            threads: 2,
            checkpoint_every: 500,
            report_every: 10,
            evaluation_prompts: 150,
            resume: false,
            existing: Existing::Keep,
        }
    }
}
