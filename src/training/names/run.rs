//! The training loop of the network of names. The same settings and sentences give the same weights.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use candle_core::{Tensor, Var};
use cinesplat_director::names::{MentionBatch, NUM_TAGS, NamesConfig, NamesNetwork, Sentence, SentenceBatch};
use cinesplat_director::network::{Dropout, Parameters};
use cinesplat_director::{Names, NamesFiles};
use cinesplat_files::{Existing, check_free, create_folder, write};
use rand::SeedableRng;
use rand::seq::{IndexedRandom, SliceRandom};
use rand_pcg::{Pcg64, Pcg64Mcg};

use super::augmentation::Augmentation;
use super::example::{Example, Labels, RawExample, examples_of};
use crate::corpus::Writer;
use crate::train::{AdamSettings, AdamW, TrainError, learning_rate, whole_rows};

/// Weight of the tags; a decision of the pointer has weight 1.
const TAG_WEIGHT: f32 = 1.0;

/// Batches that are drawn at once and sorted by length.
const BATCHES_PER_DRAW: usize = 8;

/// Settings of the training.
#[derive(Debug, Clone, PartialEq)]
pub struct NameSettings {
    /// Seed of the initial weights, the examples and the dropout.
    pub seed: u64,
    /// Number of steps.
    pub steps: u64,
    /// Examples per step.
    pub batch: usize,
    /// Highest learning rate.
    pub peak_rate: f32,
    /// Dropout rate, 0..1.
    pub dropout: f32,
    /// Network whose weights the training starts from, instead of random weights.
    pub from: Option<PathBuf>,
    /// What happens to files that exist.
    pub existing: Existing,
}

impl Default for NameSettings {
    fn default() -> Self {
        Self { seed: 1, steps: 6000, batch: 32, peak_rate: 2e-3, dropout: 0.15, from: None, existing: Existing::Keep }
    }
}

/// Progress of the training.
#[derive(Debug, Clone, PartialEq)]
pub struct NameProgress {
    /// Steps done.
    pub done: u64,
    /// Mean loss per example since the last report.
    pub loss: f64,
}

/// Facts about a finished training.
#[derive(Debug, Clone, PartialEq)]
pub struct NameSummary {
    /// Number of parameters.
    pub num_parameters: usize,
    /// Number of sentences.
    pub num_sentences: usize,
    /// SHA-256 of the weights file, hexadecimal.
    pub sha256: String,
}

/// Trains the network on the sentences of `training` and writes its two files to the folder `out`. `report` receives the
/// progress every 200 steps.
///
/// # Errors
/// [`TrainError::File`] for files that exist or cannot be written · [`TrainError::Director`] when the network fails ·
/// [`TrainError::Diverged`] when the loss is not finite.
pub fn train_names(
    settings: &NameSettings,
    training: &[Writer],
    out: &Path,
    report: &mut dyn FnMut(&NameProgress),
) -> Result<NameSummary, TrainError> {
    create_folder(out)?;
    let paths: Vec<PathBuf> = NamesFiles::NAMES.iter().map(|name| out.join(name)).collect();
    paths.iter().try_for_each(|path| check_free(path, settings.existing))?;
    let examples = examples_of(training);
    let mut pool: Vec<String> = training
        .iter()
        .flat_map(|writer| writer.scenes.values().flatten())
        .map(|object| object.label.clone())
        .collect();
    pool.sort();
    pool.dedup();
    let config = NamesConfig::default();
    let mut parameters = Parameters::seeded(settings.seed);
    let network = NamesNetwork::new(&mut parameters, &config)?;
    let vars = match parameters {
        Parameters::Fresh { vars, .. } => vars,
        Parameters::Stored { .. } => BTreeMap::new(),
    };
    if let Some(path) = &settings.from {
        start_from(path, &vars)?;
    }
    let mut labels = Labels::default();
    let mut optimizer = AdamW::default();
    let mut rng = Pcg64::seed_from_u64(settings.seed);
    let augmentation = Augmentation { pool: &pool };
    let (mut sum, mut since) = (0.0, 0.0);
    let mut batches: Vec<Vec<Example>> = Vec::new();
    while optimizer.steps < settings.steps && !examples.is_empty() {
        let step = optimizer.steps;
        if batches.is_empty() {
            batches = draw(&examples, &augmentation, settings.batch, &mut labels, &mut rng)?;
        }
        let batch = batches.pop().unwrap_or_default();
        let dropout = Dropout::new(
            settings.dropout,
            Pcg64Mcg::seed_from_u64(settings.seed ^ (step + 1).wrapping_mul(0x9e37_79b9)),
        );
        let loss = (loss(&network, &batch, &dropout)? * (1.0 / batch.len().max(1) as f64))?;
        let value = f64::from(loss.to_scalar::<f32>()?);
        if !value.is_finite() {
            return Err(TrainError::Diverged { step, found: value });
        }
        let store = loss.backward()?;
        let gradient = |var: &Var| match store.get(var) {
            Some(gradient) => gradient.flatten_all()?.to_vec1::<f32>(),
            None => Ok(vec![0.0; var.elem_count()]),
        };
        let gradients = vars.values().map(gradient).collect::<Result<Vec<_>, _>>()?;
        let rate = learning_rate(step, 100, settings.steps, settings.peak_rate);
        optimizer.step(&vars, &gradients, rate, &AdamSettings::default(), 1)?;
        sum += value;
        since += 1.0;
        if optimizer.steps.is_multiple_of(200) || optimizer.steps == settings.steps {
            report(&NameProgress { done: optimizer.steps, loss: sum / since });
            (sum, since) = (0.0, 0.0);
            write_files(&config, &vars, out)?;
        }
    }
    let files = write_files(&config, &vars, out)?;
    Ok(NameSummary {
        num_parameters: vars.values().map(|var| var.elem_count()).sum(),
        num_sentences: examples.len(),
        sha256: files.weights_sha256(),
    })
}

/// Gives the parameters the values of a stored network.
fn start_from(path: &Path, vars: &BTreeMap<String, Var>) -> Result<(), TrainError> {
    let files = NamesFiles::read(path)?;
    // Checks description, hash, names and shapes.
    Names::from_files(&files)?;
    let stored = files.tensors()?;
    for (name, var) in vars {
        if let Some(tensor) = stored.get(name) {
            var.set(tensor)?;
        }
    }
    Ok(())
}

/// Writes the network with its current weights.
fn write_files(config: &NamesConfig, vars: &BTreeMap<String, Var>, out: &Path) -> Result<NamesFiles, TrainError> {
    let mut tensors = BTreeMap::new();
    for (name, var) in vars {
        tensors.insert(name.clone(), (var.dims().to_vec(), var.flatten_all()?.to_vec1::<f32>()?));
    }
    let files = NamesFiles::pack(config, &tensors)?;
    for (name, bytes) in files.named() {
        write(&out.join(name), bytes, Existing::Replace)?;
    }
    Ok(files)
}

/// Batches of sentences of similar length, so that little is padded.
fn draw(
    examples: &[RawExample],
    augmentation: &Augmentation<'_>,
    size: usize,
    labels: &mut Labels,
    rng: &mut Pcg64,
) -> Result<Vec<Vec<Example>>, TrainError> {
    let mut drawn = Vec::with_capacity(size * BATCHES_PER_DRAW);
    for _ in 0..size * BATCHES_PER_DRAW {
        if let Some(raw) = examples.choose(rng) {
            drawn.push(Example::new(&augmentation.apply(raw, labels, rng), labels)?);
        }
    }
    drawn.sort_by_key(|example| example.tags.len());
    let mut batches: Vec<Vec<Example>> = drawn.chunks(size.max(1)).map(<[Example]>::to_vec).collect();
    batches.shuffle(rng);
    Ok(batches)
}

/// Sum of the losses of tags and pointers.
fn loss(network: &NamesNetwork, examples: &[Example], dropout: &Dropout) -> candle_core::Result<Tensor> {
    let sentences: Vec<&Sentence> = examples.iter().map(|example| &example.sentence).collect();
    let batch = SentenceBatch::new(&sentences)?;
    let states = network.states(&batch, dropout)?;
    let tags: Vec<Option<usize>> =
        examples.iter().flat_map(|example| (0..batch.num_words).map(|i| example.tags.get(i).copied())).collect();
    debug_assert!(tags.iter().flatten().all(|tag| *tag < NUM_TAGS));
    let tags = whole_rows(&network.tags(&states)?, TAG_WEIGHT, tags)?;
    let mentions: Vec<_> = examples
        .iter()
        .enumerate()
        .flat_map(|(at, example)| example.mentions.iter().map(move |mention| (at, mention)))
        .collect();
    if mentions.is_empty() {
        return Ok(tags);
    }
    let mention_batch = MentionBatch::new(&mentions, &sentences, &batch)?;
    let scores = network.point(&states, &mention_batch, dropout)?;
    let targets: Vec<(usize, &Vec<usize>)> =
        examples.iter().flat_map(|e| e.targets.iter().map(|target| (e.sentence.scene.objects.len(), target))).collect();
    let objects = targets
        .iter()
        .flat_map(|(count, target)| {
            (0..mention_batch.num_objects).map(move |at| (at < *count).then(|| usize::from(target.contains(&at))))
        })
        .collect();
    let missing = targets.iter().map(|(_, target)| Some(usize::from(target.is_empty()))).collect();
    let pointer = (whole_rows(&scores.objects, 1.0, objects)? + whole_rows(&scores.missing, 1.0, missing)?)?;
    tags + pointer
}
