//! Training: lessons, loss, optimizer, checkpoints, examination.
//!
//! Enters: the phrasebook, and shards of realized shots. Leaves: the three files of a model. The same settings and shots
//! give the same weights whatever the number of threads, stopped and resumed or not.

mod audit;
mod checkpoint;
mod error;
mod examine;
mod lesson;
mod loss;
mod optimizer;
mod settings;
mod shards;

pub use audit::{GradientAudit, GradientCheck, audit_gradients};
pub use error::TrainError;
pub use examine::{Marks, Miss, Paper, examine};
pub use settings::TrainSettings;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::Path;

use candle_core::Var;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::dataset::{RealizedShot, read_shards};
use crate::sampler::PromptSampler;
use cinesplat_director::Director;
use cinesplat_director::model::{Dropout, ModelConfig, Network, Parameters};
use cinesplat_director::vocabulary::Vocabulary;
use cinesplat_director::weights::{MANIFEST_FILE, Model, ModelFiles, TOKENIZER_FILE, WEIGHTS_FILE, pack};
use cinesplat_files::{Existing, create_folder, write};
use cinesplat_language::link;
use lesson::{Damage, Lesson, School};
use optimizer::{AdamSettings, AdamW, rate};
use shards::{BatchSettings, Trainee};

/// Lessons of a batch that are computed together by one thread.
const PART_SIZE: usize = 32;
/// Realized shots that are kept out of training: every so many-th.
const HELD_OUT_EVERY: usize = 20;

/// Hears where a training stands, and may stop it.
pub type Report<'a> = dyn FnMut(&Progress) -> ControlFlow<()> + 'a;

/// Where a training stands.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress {
    /// Some steps were made.
    Steps {
        /// Steps made.
        done: u64,
        /// Steps to make.
        total: u64,
        /// Mean loss of the choices since the last report.
        choice_loss: f64,
        /// Mean loss of the poses since the last report.
        pose_loss: f64,
        /// Learning rate now.
        rate: f32,
    },
    /// A checkpoint was written and examined.
    Checkpoint {
        /// Steps made.
        done: u64,
        /// Loss of choices and poses on lessons and shots that training never sees.
        held_out_loss: [f64; 2],
        /// Marks on the phrasebook's reserved wordings.
        held_out: Box<Marks>,
        /// Marks on the sentences that people wrote.
        exam: Box<Marks>,
    },
}

/// What a training made.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainSummary {
    /// Parameters of the network.
    pub num_parameters: usize,
    /// Tokens of its vocabulary.
    pub vocabulary: usize,
    /// Realized shots that it learned from.
    pub num_shots: usize,
    /// SHA-256 of the weights in hex.
    pub sha256: String,
}

/// Trains a network and writes it to the folder of the settings; `report` hears of some steps and every checkpoint.
///
/// # Errors
/// [`TrainError`]: files that cannot be read or written, a checkpoint of other settings, a loss that is no number;
/// [`TrainError::Stopped`] when `report` says so: a checkpoint is there then.
pub fn train(settings: &TrainSettings, report: &mut Report<'_>) -> Result<TrainSummary, TrainError> {
    let phrasebook = PromptSampler::embedded()?;
    create_folder(&settings.out)?;
    let shots = settings.shots.as_deref().map(read_shards).transpose()?.unwrap_or_default();
    let held_out: Vec<RealizedShot> = shots.iter().step_by(HELD_OUT_EVERY).cloned().collect();
    let learned: Vec<RealizedShot> =
        shots.into_iter().enumerate().filter(|(idx, _)| idx % HELD_OUT_EVERY != 0).map(|(_, shot)| shot).collect();
    let (words, vocabulary, config, mut parameters) = beginning(settings, phrasebook)?;
    let network = Network::new(&mut parameters, &config)?;
    let vars = trainable(&mut parameters, settings.from.as_deref())?;
    let shots_frac = if learned.is_empty() { 0.0 } else { settings.shots_frac };
    let school = School {
        phrasebook,
        vocabulary: &vocabulary,
        words: &words,
        shots: &learned,
        shots_frac,
        damage: Damage::default(),
    };
    let mut training =
        Training { settings, config, network, vars, optimizer: AdamW::default(), school, held_out: &held_out };
    training.resume()?;
    training.run(report)?;
    training.summary()
}

/// Words of the phrasebook, vocabulary, sizes, and parameters to build the network from.
fn beginning(
    settings: &TrainSettings,
    phrasebook: PromptSampler,
) -> Result<(Vec<String>, Vocabulary, ModelConfig, Parameters), TrainError> {
    let corpus = corpus(settings, phrasebook)?;
    let words: BTreeSet<&str> = corpus.iter().flat_map(|line| line.split(' ')).collect();
    let words = words.into_iter().filter(|word| word.chars().all(char::is_alphabetic)).map(str::to_owned).collect();
    let vocabulary = match &settings.from {
        Some(path) => Vocabulary::from_json(&ModelFiles::read(path)?.tokenizer)?,
        None => Vocabulary::train(&corpus, settings.vocabulary)?,
    };
    let config = ModelConfig::shipped(vocabulary.size());
    Ok((words, vocabulary, config, Parameters::seeded(settings.seed)))
}

/// Linked texts of the phrasebook.
fn corpus(settings: &TrainSettings, phrasebook: PromptSampler) -> Result<Vec<String>, TrainError> {
    let mut rng = Pcg64::seed_from_u64(settings.seed ^ 0x000c_0de5);
    let mut line = |_| {
        let cast = phrasebook.invent_objects(8, &mut rng);
        Ok(link(&phrasebook.sample(&cast, &mut rng).prompt, &cast)?.tokens_text)
    };
    (0..settings.corpus).map(&mut line).collect()
}

/// The drawn parameters, overwritten by those of a model where there is one to start from.
fn trainable(parameters: &mut Parameters, from: Option<&Path>) -> Result<BTreeMap<String, Var>, TrainError> {
    let Parameters::Fresh { vars, .. } = parameters else { return Ok(BTreeMap::new()) };
    let vars = std::mem::take(vars);
    if let Some(path) = from {
        let stored = cinesplat_director::weights::read_weights(&ModelFiles::read(path)?)?;
        for (name, var) in &vars {
            match stored.get(name) {
                Some(tensor) if tensor.dims() == var.dims() => var.set(tensor)?,
                found => {
                    return Err(TrainError::BadCheckpoint {
                        path: path.to_owned(),
                        found: format!("{name} of shape {:?}", found.map(candle_core::Tensor::dims)),
                    });
                }
            }
        }
    }
    Ok(vars)
}

struct Training<'a> {
    settings: &'a TrainSettings,
    config: ModelConfig,
    network: Network,
    vars: BTreeMap<String, Var>,
    optimizer: AdamW,
    school: School<'a>,
    held_out: &'a [RealizedShot],
}

impl Training<'_> {
    fn checkpoint_path(&self) -> std::path::PathBuf {
        self.settings.out.join("checkpoint.safetensors")
    }

    /// Everything that decides the numbers, for the checkpoint to be compared with.
    fn fingerprint(&self) -> String {
        let shots = self.school.shots.len();
        serde_json::to_string(&(self.settings, &self.config, shots)).unwrap_or_default()
    }

    fn resume(&mut self) -> Result<(), TrainError> {
        if self.settings.resume {
            self.optimizer = checkpoint::read(&self.checkpoint_path(), &self.vars, &self.fingerprint())?;
        }
        Ok(())
    }

    fn run(&mut self, report: &mut Report<'_>) -> Result<(), TrainError> {
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
                if report(&Progress::Steps { done, total, choice_loss, pose_loss, rate }).is_break() && done < total {
                    checkpoint::write(&self.checkpoint_path(), &self.vars, &self.optimizer, &self.fingerprint())?;
                    return Err(TrainError::Stopped { step: done });
                }
            }
            if done.is_multiple_of(self.settings.checkpoint_every.max(1)) || done == total {
                let _ = report(&self.checkpoint()?);
            }
        }
        Ok(())
    }

    fn rate(&self) -> f32 {
        rate(self.optimizer.steps, self.settings.warm_up, self.settings.steps, self.settings.peak_rate)
    }

    /// One step; the losses of choices and poses before it.
    fn step(&mut self) -> Result<[f64; 2], TrainError> {
        let step = self.optimizer.steps;
        let mut lessons = self.lessons(step)?;
        let batch = BatchSettings {
            threads: self.settings.threads,
            part_size: PART_SIZE,
            dropout: self.settings.dropout,
            seed: self.settings.seed ^ (step + 1).wrapping_mul(0x2545_f491_4f6c_dd1d),
        };
        let trainee = Trainee { network: &self.network, config: &self.config, vars: &self.vars };
        let result = trainee.gradients(&mut lessons, &batch)?;
        let rate = self.rate();
        let norm = self.optimizer.step(&self.vars, &result.gradients, rate, &AdamSettings::default())?;
        let found = result.choice_loss + result.pose_loss + f64::from(norm);
        if !found.is_finite() {
            return Err(TrainError::Diverged { step, found });
        }
        Ok([result.choice_loss, result.pose_loss])
    }

    /// The lessons of a step, drawn side by side.
    fn lessons(&self, step: u64) -> Result<Vec<Lesson>, TrainError> {
        let batch = self.settings.batch as u64;
        let threads = self.settings.threads.max(1) as u64;
        let draw = |thread: u64| -> Result<Vec<Lesson>, TrainError> {
            let share = (batch * thread / threads)..(batch * (thread + 1) / threads);
            share.map(|idx| self.school.lesson(self.settings.seed, step * batch + idx)).collect()
        };
        let parts = std::thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|thread| scope.spawn(move || draw(thread))).collect();
            let mut parts = vec![draw(0)];
            parts.extend(others.into_iter().map(|other| other.join().unwrap_or_else(|_| Ok(Vec::new()))));
            parts
        });
        let mut lessons = Vec::with_capacity(self.settings.batch);
        for part in parts {
            lessons.extend(part?);
        }
        Ok(lessons)
    }

    /// Writes checkpoint and model, and examines the model as it was written.
    fn checkpoint(&self) -> Result<Progress, TrainError> {
        checkpoint::write(&self.checkpoint_path(), &self.vars, &self.optimizer, &self.fingerprint())?;
        let files = self.files()?;
        let folder = &self.settings.out;
        write(&folder.join(WEIGHTS_FILE), &files.weights, Existing::Replace)?;
        write(&folder.join(TOKENIZER_FILE), &files.tokenizer, Existing::Replace)?;
        write(&folder.join(MANIFEST_FILE), &files.manifest, Existing::Replace)?;
        let director = Director::of(Model::load(&files)?);
        let count = self.settings.exam_prompts;
        let exam = if count == 0 { Marks::default() } else { examine(&director, Paper::Exam)? };
        Ok(Progress::Checkpoint {
            done: self.optimizer.steps,
            held_out_loss: self.held_out_loss()?,
            held_out: Box::new(examine(&director, Paper::HeldOut { count })?),
            exam: Box::new(exam),
        })
    }

    /// The model's files with the weights as they are now.
    fn files(&self) -> Result<ModelFiles<'static>, TrainError> {
        let mut tensors = BTreeMap::new();
        for (name, var) in &self.vars {
            tensors.insert(name.clone(), (var.dims().to_vec(), var.flatten_all()?.to_vec1::<f32>()?));
        }
        Ok(pack(&self.settings.name, &self.config, self.school.vocabulary, &tensors)?)
    }

    /// Losses a key on undamaged lessons and held-out shots.
    fn held_out_loss(&self) -> Result<[f64; 2], TrainError> {
        let shots_frac = if self.held_out.is_empty() { 0.0 } else { 0.5 };
        let school = School { shots: self.held_out, shots_frac, damage: Damage::NONE, ..self.school.clone() };
        let mut lessons =
            (0..64).map(|number| school.lesson(!self.settings.seed, number)).collect::<Result<Vec<_>, _>>()?;
        lessons.sort_by_key(|lesson| lesson.prompt.tokens.len());
        let num_keys: usize = lessons.iter().map(|lesson| lesson.keys.len()).sum();
        let num_posed: usize = lessons.iter().map(|lesson| lesson.poses.len()).sum();
        let trainee = Trainee { network: &self.network, config: &self.config, vars: &self.vars };
        let mut sums = [0.0; 2];
        for part in lessons.chunks(PART_SIZE) {
            let (choices, poses) = trainee.losses(&part.iter().collect::<Vec<_>>(), &Dropout::off())?;
            sums[0] += f64::from(choices.to_scalar::<f32>()?);
            sums[1] += poses.map_or(Ok(0.0), |poses| poses.to_scalar::<f32>().map(f64::from))?;
        }
        Ok([sums[0] / num_keys.max(1) as f64, sums[1] / num_posed.max(1) as f64])
    }

    fn summary(&self) -> Result<TrainSummary, TrainError> {
        Ok(TrainSummary {
            num_parameters: self.vars.values().map(|var| var.elem_count()).sum(),
            vocabulary: self.school.vocabulary.size(),
            num_shots: self.school.shots.len(),
            sha256: cinesplat_files::sha256_hex(&self.files()?.weights),
        })
    }
}
