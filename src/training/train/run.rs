//! The training loop.
//!
//! Enters: the prompt sampler, and shards of realized shots. Leaves: the three files of a model. The same settings and shots
//! give the same weights for any number of threads, with or without interruptions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use candle_core::Var;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::augmentation::Augmentation;
use super::base::Base;
use super::checkpoint;
use super::error::TrainError;
use super::evaluation::{EvaluationSplit, evaluate_director};
use super::examples::{Example, ExampleSampler};
use super::gradients::{BatchSettings, TrainableNetwork};
use super::metrics::ProgramMetrics;
use super::modifiers::Modifiers;
use super::optimizer::{AdamSettings, AdamW, learning_rate};
use super::phrases::Phrases;
use super::progress::{ProgressCallback, TrainingProgress};
use super::sentences::Sentences;
use super::settings::TrainSettings;
use super::transfer::transfer;
use crate::corpus::read_folder;
use crate::dataset::{RealizedShot, read_shards};
use crate::sampler::PromptSampler;
use crate::workers::map_on_threads;
use cinesplat_director::inputs::Vocabulary;
use cinesplat_director::network::{Dropout, ModelConfig, Network, Parameters};
use cinesplat_director::{Director, ModelFiles};
use cinesplat_files::{Existing, check_free, create_folder, write};
use cinesplat_language::{link, sense_names};

/// Name of the checkpoint in the output folder.
const CHECKPOINT_FILE: &str = "checkpoint.safetensors";
/// Examples per part of a batch, which one thread computes.
const PART_SIZE: usize = 16;
/// One of this many realized shots is held out of training.
const HELD_OUT_EVERY: usize = 20;
/// Examples of the held-out loss.
const HELD_OUT_EXAMPLES: u64 = 64;

/// Facts about a finished training.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainSummary {
    /// Number of parameters of the network.
    pub num_parameters: usize,
    /// Number of tokens of its vocabulary.
    pub vocabulary: usize,
    /// Number of realized shots in the training data.
    pub num_shots: usize,
    /// SHA-256 of the weights file, hexadecimal.
    pub sha256: String,
}

/// Trains a network and writes its model files and a checkpoint to the folder `out`. `report` receives progress every
/// [`TrainSettings::report_every`] steps and after every checkpoint.
///
/// # Errors
/// [`TrainError::Stopped`] when `report` returns `Break`, after a checkpoint was written ·
/// [`TrainError::BadCheckpoint`] for a checkpoint of other settings · [`TrainError::Diverged`] when the loss is not finite ·
/// [`TrainError::File`] for a model or checkpoint that exists, unless the settings resume or replace it, and
/// [`TrainError::File`], [`TrainError::Dataset`] and [`TrainError::Director`] for files that cannot be read or written.
///
/// # Panics
/// A panic on a worker thread resumes in the caller.
pub fn train(
    settings: &TrainSettings,
    out: &Path,
    report: &mut ProgressCallback<'_>,
) -> Result<TrainSummary, TrainError> {
    let prompts = PromptSampler::embedded()?;
    create_folder(out)?;
    if !settings.resume {
        let names = ModelFiles::NAMES.into_iter().chain([CHECKPOINT_FILE]);
        names.map(|name| out.join(name)).try_for_each(|path| check_free(&path, settings.existing))?;
    }
    let shots = settings.shots.as_deref().map(read_shards).transpose()?.unwrap_or_default();
    let held_out_shots: Vec<RealizedShot> = shots.iter().step_by(HELD_OUT_EVERY).cloned().collect();
    let learned: Vec<RealizedShot> =
        shots.into_iter().enumerate().filter(|(idx, _)| idx % HELD_OUT_EVERY != 0).map(|(_, shot)| shot).collect();
    let writers = settings.sentences.as_deref().map(read_folder).transpose()?.unwrap_or_default();
    let sentences = Sentences::of(&writers, settings.max_sentences, settings.seed);
    let mut corpus = corpus(settings, prompts)?;
    // The sentences of people weigh as much as the sampled ones.
    let repeats = corpus.len() / sentences.len().max(1);
    for _ in 0..repeats.max(1) {
        corpus.extend(sentences.texts().map(str::to_owned));
    }
    corpus.extend(Phrases::embedded().texts());
    corpus.extend(Modifiers::embedded().texts());
    let words = words(&corpus);
    let from = settings.from.as_deref().map(ModelFiles::read).transpose()?;
    let base = settings.base.as_deref().map(Base::read).transpose()?;
    // A resumed training keeps the vocabulary of its last checkpoint, even if the lists of words have changed since.
    let is_kept = settings.resume && ModelFiles::NAMES.iter().all(|name| out.join(name).exists());
    let continued = from.as_ref().filter(|files| files.is_current() && !settings.new_vocabulary);
    let vocabulary = match (&base, continued) {
        _ if is_kept => ModelFiles::read(out)?.vocabulary()?,
        (Some(base), _) => base.vocabulary(&corpus)?,
        (None, Some(files)) => files.vocabulary()?,
        (None, None) => Vocabulary::train(&corpus, settings.vocabulary)?,
    };
    let bert = match (&base, continued) {
        (Some(base), _) => Some(base.config()),
        (None, Some(files)) => files.config()?.bert,
        (None, None) => None,
    };
    let config = ModelConfig { bert, ..ModelConfig::shipped(vocabulary.size(), sense_names()?.len()) };
    let mut parameters = Parameters::seeded(settings.seed);
    let network = Network::new(&mut parameters, &config)?;
    let vars = trainable(&mut parameters, from.as_ref(), &vocabulary)?;
    if let Some(base) = &base {
        base.load(&vars, &vocabulary)?;
    }
    let shots_frac = if learned.is_empty() { 0.0 } else { settings.shots_frac };
    let sampler = ExampleSampler {
        prompts,
        vocabulary: &vocabulary,
        words: &words,
        sentences: &sentences,
        sentences_frac: settings.sentences_frac,
        shots: &learned,
        shots_frac,
        augmentation: Augmentation::default(),
    };
    let optimizer = AdamW::default();
    let mut training =
        Training { settings, out, config, network, vars, optimizer, sampler, held_out_shots: &held_out_shots };
    training.resume()?;
    training.run(report)?;
    training.summary()
}

/// Linked texts of sampled prompts.
fn corpus(settings: &TrainSettings, prompts: PromptSampler) -> Result<Vec<String>, TrainError> {
    let mut rng = Pcg64::seed_from_u64(settings.seed ^ 0x000c_0de5);
    let mut line = |_| {
        let objects = prompts.invent_objects(8, &mut rng);
        Ok(link(&prompts.sample(&objects, &mut rng).prompt, &objects)?.tokens_text)
    };
    (0..settings.corpus).map(&mut line).collect()
}

/// The different words of a corpus, in lexical order.
fn words(corpus: &[String]) -> Vec<String> {
    let words: BTreeSet<&str> = corpus.iter().flat_map(|line| line.split(' ')).collect();
    words.into_iter().filter(|word| word.chars().all(char::is_alphabetic)).map(str::to_owned).collect()
}

/// The drawn parameters, with the values of the model `from` if there is one.
fn trainable(
    parameters: &mut Parameters,
    from: Option<&ModelFiles>,
    vocabulary: &Vocabulary,
) -> Result<BTreeMap<String, Var>, TrainError> {
    let Parameters::Fresh { vars, .. } = parameters else { return Ok(BTreeMap::new()) };
    let vars = std::mem::take(vars);
    if let Some(files) = from {
        transfer(&vars, files, vocabulary)?;
    }
    Ok(vars)
}

/// A training in progress.
struct Training<'a> {
    settings: &'a TrainSettings,
    out: &'a Path,
    config: ModelConfig,
    network: Network,
    vars: BTreeMap<String, Var>,
    optimizer: AdamW,
    sampler: ExampleSampler<'a>,
    held_out_shots: &'a [RealizedShot],
}

impl Training<'_> {
    fn checkpoint_path(&self) -> PathBuf {
        self.out.join(CHECKPOINT_FILE)
    }

    /// All settings that change the weights, as JSON. A checkpoint can only be resumed with the same.
    fn fingerprint(&self) -> Result<String, TrainError> {
        let num_shots = self.sampler.shots.len();
        serde_json::to_string(&(self.settings, &self.config, num_shots))
            .map_err(|error| TrainError::BadCheckpoint { path: self.checkpoint_path(), found: error.to_string() })
    }

    /// Reads the checkpoint if the settings request it.
    fn resume(&mut self) -> Result<(), TrainError> {
        if self.settings.resume {
            self.optimizer = checkpoint::read(&self.checkpoint_path(), &self.vars, &self.fingerprint()?)?;
        }
        Ok(())
    }

    /// Makes all remaining steps.
    fn run(&mut self, report: &mut ProgressCallback<'_>) -> Result<(), TrainError> {
        let total = self.settings.steps;
        let (mut choice_loss, mut pose_loss, mut since) = (0.0, 0.0, 0.0);
        while self.optimizer.steps < total {
            let losses = self.step()?;
            choice_loss += losses[0];
            pose_loss += losses[1];
            since += 1.0;
            let done = self.optimizer.steps;
            if done.is_multiple_of(self.settings.report_every.max(1)) || done == total {
                let rate = self.rate();
                let (choice_loss, pose_loss) =
                    (std::mem::take(&mut choice_loss) / since, std::mem::take(&mut pose_loss) / since);
                since = 0.0;
                let progress = TrainingProgress::Steps { done, total, choice_loss, pose_loss, rate };
                if report(&progress).is_break() && done < total {
                    self.write_checkpoint()?;
                    return Err(TrainError::Stopped { step: done });
                }
            }
            if done.is_multiple_of(self.settings.checkpoint_every.max(1)) || done == total {
                // The result is ignored: the next report of steps can stop the training.
                let _ = report(&self.checkpoint()?);
            }
        }
        Ok(())
    }

    /// Learning rate of the next step.
    fn rate(&self) -> f32 {
        learning_rate(self.optimizer.steps, self.settings.warm_up, self.settings.steps, self.settings.peak_rate)
    }

    /// Makes one step, and returns the losses of choices and poses before it.
    fn step(&mut self) -> Result<[f64; 2], TrainError> {
        let step = self.optimizer.steps;
        let mut examples = self.examples(step)?;
        let batch = BatchSettings {
            threads: self.settings.threads,
            part_size: PART_SIZE,
            dropout: self.settings.dropout,
            seed: self.settings.seed ^ (step + 1).wrapping_mul(0x2545_f491_4f6c_dd1d),
        };
        let trainable = TrainableNetwork { network: &self.network, config: &self.config, vars: &self.vars };
        let result = trainable.gradients(&mut examples, &batch)?;
        let rate = self.rate();
        let adam = AdamSettings { base_rate_frac: self.settings.base_rate_frac, ..AdamSettings::default() };
        let norm = self.optimizer.step(&self.vars, &result.gradients, rate, &adam, self.settings.threads)?;
        let found = result.choice_loss + result.pose_loss + f64::from(norm);
        if !found.is_finite() {
            return Err(TrainError::Diverged { step, found });
        }
        Ok([result.choice_loss, result.pose_loss])
    }

    /// The examples of a step, drawn on several threads.
    fn examples(&self, step: u64) -> Result<Vec<Example>, TrainError> {
        let batch = self.settings.batch as u64;
        let numbers = (step * batch..(step + 1) * batch).collect();
        let draw = |number: u64| self.sampler.example(self.settings.seed, number);
        map_on_threads(self.settings.threads, numbers, draw).into_iter().collect()
    }

    fn write_checkpoint(&self) -> Result<(), TrainError> {
        checkpoint::write(&self.checkpoint_path(), &self.vars, &self.optimizer, &self.fingerprint()?)
    }

    /// Writes the checkpoint and the model, and evaluates the model with the written weights.
    fn checkpoint(&self) -> Result<TrainingProgress, TrainError> {
        self.write_checkpoint()?;
        let files = self.files()?;
        for (name, bytes) in files.named() {
            write(&self.out.join(name), bytes, Existing::Replace)?;
        }
        let director = Director::from_files(&files)?;
        let count = self.settings.evaluation_prompts;
        let hand_written = match count {
            0 => ProgramMetrics::default(),
            _ => evaluate_director(&director, EvaluationSplit::HandWritten)?,
        };
        Ok(TrainingProgress::Checkpoint {
            done: self.optimizer.steps,
            held_out_loss: self.held_out_loss()?,
            held_out: Box::new(evaluate_director(&director, EvaluationSplit::HeldOut { count })?),
            hand_written: Box::new(hand_written),
        })
    }

    /// The model files with the current weights.
    fn files(&self) -> Result<ModelFiles, TrainError> {
        let mut tensors = BTreeMap::new();
        for (name, var) in &self.vars {
            tensors.insert(name.clone(), (var.dims().to_vec(), var.flatten_all()?.to_vec1::<f32>()?));
        }
        Ok(ModelFiles::pack(&self.settings.name, &self.config, self.sampler.vocabulary, &tensors)?)
    }

    /// Mean losses per key of choices and poses, without augmentation, on sentences of another seed and held-out shots.
    fn held_out_loss(&self) -> Result<[f64; 2], TrainError> {
        let shots_frac = if self.held_out_shots.is_empty() { 0.0 } else { 0.5 };
        let augmentation = Augmentation::NONE;
        let sampler = ExampleSampler { shots: self.held_out_shots, shots_frac, augmentation, ..self.sampler.clone() };
        let examples = (0..HELD_OUT_EXAMPLES).map(|number| sampler.example(!self.settings.seed, number));
        let mut examples = examples.collect::<Result<Vec<_>, _>>()?;
        examples.sort_by_key(|example| example.prompt.tokens.len());
        let num_keys: usize = examples.iter().map(|example| example.keys.len()).sum();
        let num_posed: usize = examples.iter().map(|example| example.poses.len()).sum();
        let trainable = TrainableNetwork { network: &self.network, config: &self.config, vars: &self.vars };
        let mut sums = [0.0; 2];
        for part in examples.chunks(PART_SIZE) {
            let (choices, poses) = trainable.losses(&part.iter().collect::<Vec<_>>(), &Dropout::off())?;
            sums[0] += f64::from(choices.to_scalar::<f32>()?);
            sums[1] += poses.map_or(Ok(0.0), |poses| poses.to_scalar::<f32>().map(f64::from))?;
        }
        Ok([sums[0] / num_keys.max(1) as f64, sums[1] / num_posed.max(1) as f64])
    }

    /// Facts about the network in its current state.
    fn summary(&self) -> Result<TrainSummary, TrainError> {
        Ok(TrainSummary {
            num_parameters: self.vars.values().map(|var| var.elem_count()).sum(),
            vocabulary: self.sampler.vocabulary.size(),
            num_shots: self.sampler.shots.len(),
            sha256: self.files()?.weights_sha256(),
        })
    }
}
