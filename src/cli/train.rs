use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use super::console;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::outputs::Overwrite;
use super::train_names;
use cinesplat::director::{Calibration, Director, ModelFiles};
use cinesplat::files::Existing;
use cinesplat::language::program_to_notation;
use cinesplat::training::corpus::{self, SentenceKind, Split, Writer};
use cinesplat::training::{
    EvaluationSplit, Mentions, NameSettings, ProgramMetrics, Tally, TrainSettings, TrainingProgress, drawn_sentences,
    evaluate_director, examine, train,
};
use strum::VariantArray;

/// candle's matrix products run on rayon's pool, whose threads spin. Worker threads with one rayon thread each are faster.
const THREADS_VARIABLE: &str = "RAYON_NUM_THREADS";
/// Keeps freed memory in the process; page faults cost up to a second per step otherwise.
const PURGE_VARIABLE: &str = "MIMALLOC_PURGE_DELAY";

/// Train the director's network, which understands sentences
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat dataset -o shots --scenes 400
  cinesplat train -o model --shots shots --steps 12000
  cinesplat train -o model --shots shots --steps 12000 --resume
  cinesplat train -o names --names --sentences prompts/corpus
  cinesplat train --examine model
  cinesplat train --examine names --names --sentences prompts/corpus")]
pub(super) struct Args {
    /// Folder for the model (three files) and its checkpoint
    #[arg(short, long, value_name = "DIR", required_unless_present_any = ["examine", "calibrate", "draw"])]
    output: Option<PathBuf>,
    /// Train the network of names instead: which words name which objects
    ///
    /// It learns from the training writers of --sentences. The folder receives two files.
    #[arg(long, requires = "sentences", conflicts_with_all = ["shots", "resume"])]
    names: bool,
    /// Folder of training shots [default: learn from words only]
    ///
    /// `cinesplat dataset` writes it. Without it the network learns programs, not camera poses.
    #[arg(long, value_name = "DIR")]
    shots: Option<PathBuf>,
    /// Share of these shots among the examples
    #[arg(long, value_name = "FRAC", default_value_t = TrainSettings::default().shots_frac)]
    shots_frac: f64,
    /// Folder of sentences with their programs, such as prompts/corpus [default: sampled sentences only]
    #[arg(long, value_name = "DIR")]
    sentences: Option<PathBuf>,
    /// Share of these sentences among the examples
    #[arg(long, value_name = "FRAC", default_value_t = TrainSettings::default().sentences_frac)]
    sentences_frac: f64,
    /// Number of these sentences to learn from, drawn at random [default: all]
    #[arg(long, value_name = "N", requires = "sentences", hide_short_help = true)]
    max_sentences: Option<usize>,
    /// Model to start from [default: random weights]
    #[arg(long, value_name = "MODEL")]
    from: Option<PathBuf>,
    /// Text encoder that was trained beforehand: a folder with config.json, model.safetensors and vocab.txt of a BERT
    ///
    /// As `transformers` stores it. Its word pieces become the vocabulary.
    #[arg(long, value_name = "DIR", hide_short_help = true, conflicts_with_all = ["names", "new_vocabulary"])]
    base: Option<PathBuf>,
    /// Highest learning rate of that encoder, as a share of --rate
    #[arg(long, value_name = "FRAC", default_value_t = TrainSettings::default().base_rate_frac, hide_short_help = true)]
    base_rate_frac: f32,
    /// Learn the vocabulary anew although there is a model to start from
    #[arg(long, requires = "from")]
    new_vocabulary: bool,
    /// Number of optimizer steps
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().steps)]
    #[arg(default_value_if("names", "true", "6000"))]
    steps: u64,
    /// Examples per step
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().batch)]
    #[arg(default_value_if("names", "true", "32"))]
    batch: usize,
    /// Highest learning rate
    #[arg(long, value_name = "RATE", default_value_t = TrainSettings::default().peak_rate)]
    #[arg(default_value_if("names", "true", "0.002"))]
    rate: f32,
    /// Steps of linear warm-up to that rate
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().warm_up)]
    warm_up: u64,
    /// Share of the values that dropout sets to zero
    #[arg(long, value_name = "FRAC", default_value_t = TrainSettings::default().dropout)]
    #[arg(default_value_if("names", "true", "0.15"))]
    dropout: f32,
    /// Size of the vocabulary in tokens
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().vocabulary)]
    vocabulary: usize,
    /// Name of the model, written into every shot
    #[arg(long, value_name = "NAME", default_value_t = TrainSettings::default().name)]
    name: String,
    /// Seed of weights, examples and dropout
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().seed)]
    seed: u64,
    /// Threads that share a batch
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().threads)]
    threads: usize,
    /// Steps between checkpoints
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().checkpoint_every)]
    checkpoint_every: u64,
    /// Resume from the checkpoint in the output folder
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Evaluate a model instead: a folder, or `built-in`
    ///
    /// Prints accuracy on each evaluation split and every prompt that the model misunderstands.
    #[arg(long, value_name = "MODEL", conflicts_with_all = ["output", "shots", "from", "resume"])]
    examine: Option<PathBuf>,
    /// Fit the certainty of a model to the development writers of --sentences instead: a folder, which is rewritten
    ///
    /// Also gives the model the name of --name.
    #[arg(long, value_name = "MODEL", requires = "sentences", conflicts_with_all = ["output", "shots", "from", "resume", "examine"])]
    calibrate: Option<PathBuf>,
    /// Write the mean of several models of one network instead
    ///
    /// The models must share their vocabulary, as a model and one trained --from it do. The mean is not calibrated.
    #[arg(long, value_name = "MODEL", hide_short_help = true, num_args = 2.., requires = "output", conflicts_with_all = ["shots", "from", "resume", "examine", "calibrate", "names"])]
    average: Vec<PathBuf>,
    /// Write a model in about half the bytes instead: matrices in 8.5 bits a number; those of BERT in 4.5, and those above it in 6.6
    #[arg(long, value_name = "MODEL", hide_short_help = true, requires = "output", conflicts_with_all = ["shots", "from", "resume", "examine", "calibrate", "names", "average"])]
    compact: Option<PathBuf>,
    /// Print that many sentences as training draws them from --sentences, with their programs, instead
    #[arg(long, value_name = "N", requires = "sentences", conflicts_with_all = ["output", "shots", "from", "resume", "examine"])]
    draw: Option<usize>,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let sentences = self.sentences.clone().unwrap_or_default();
        if let Some(model) = self.examine.as_ref().filter(|_| self.names) {
            return train_names::examine_model(model, &sentences);
        }
        if let Some(model) = &self.examine {
            return examine_model(model, self.sentences.as_deref());
        }
        if let (Some(model), Some(sentences)) = (&self.calibrate, &self.sentences) {
            return calibrate_model(model, &self.name, sentences);
        }
        if !self.average.is_empty() {
            return average_models(
                &self.average,
                &self.name,
                &self.output.unwrap_or_default(),
                self.overwrite.existing(),
            );
        }
        if let Some(model) = &self.compact {
            return compact_model(model, &self.output.unwrap_or_default(), self.overwrite.existing());
        }
        if let Some(count) = self.draw {
            for (linked, program) in drawn_sentences(&corpus::read_folder(&sentences)?, count, self.seed) {
                console::data(&format!("{}\n  {}\n", linked.tokens_text, program_to_notation(&program)))?;
            }
            return Ok(());
        }
        if std::env::var_os(THREADS_VARIABLE).is_none_or(|threads| threads != "1") {
            return restart();
        }
        if self.names {
            let out = self.output.clone().unwrap_or_default();
            return train_names::train(&self.name_settings(), &sentences, &out);
        }
        let interrupt = Interrupt::listen()?;
        let out = self.output.clone().unwrap_or_default();
        let settings = self.settings();
        let mut lines = Lines::new(settings.steps);
        let summary = train(&settings, &out, &mut |progress| {
            lines.show(progress);
            if interrupt.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        console::note(&format!(
            "{} parameters, {} tokens, {} realized shots, weights {}",
            summary.num_parameters, summary.vocabulary, summary.num_shots, summary.sha256
        ));
        Ok(())
    }

    fn name_settings(&self) -> NameSettings {
        NameSettings {
            seed: self.seed,
            steps: self.steps,
            batch: self.batch,
            peak_rate: self.rate,
            dropout: self.dropout.clamp(0.0, 0.9),
            from: self.from.clone(),
            existing: self.overwrite.existing(),
        }
    }

    fn settings(self) -> TrainSettings {
        TrainSettings {
            seed: self.seed,
            steps: self.steps,
            batch: self.batch,
            peak_rate: self.rate,
            warm_up: self.warm_up,
            dropout: self.dropout.clamp(0.0, 0.9),
            shots_frac: self.shots_frac.clamp(0.0, 1.0),
            sentences: self.sentences,
            sentences_frac: self.sentences_frac.clamp(0.0, 1.0),
            max_sentences: self.max_sentences,
            vocabulary: self.vocabulary,
            name: self.name,
            shots: self.shots,
            base_rate_frac: self.base_rate_frac,
            base: self.base,
            from: self.from,
            new_vocabulary: self.new_vocabulary,
            threads: self.threads,
            checkpoint_every: self.checkpoint_every,
            resume: self.resume,
            existing: self.overwrite.existing(),
            ..TrainSettings::default()
        }
    }
}

/// Runs this program again with the environment that training needs, and exits with its exit code.
fn restart() -> Result<(), Failure> {
    let failed = |error: std::io::Error| Failure::io("the program itself", &error);
    let program = std::env::current_exe().map_err(failed)?;
    let mut command = Command::new(program);
    command.args(std::env::args_os().skip(1)).env(THREADS_VARIABLE, "1").env(PURGE_VARIABLE, "-1");
    let status = command.status().map_err(failed)?;
    match status.code() {
        Some(0) => Ok(()),
        Some(code) => std::process::exit(code),
        None => Err(Failure::fault("a signal ended the training")),
    }
}

/// Progress lines of a training with the time left.
struct Lines {
    start: Instant,
    first: Option<u64>,
    total: u64,
}

impl Lines {
    fn new(total: u64) -> Self {
        Self { start: Instant::now(), first: None, total }
    }

    fn show(&mut self, progress: &TrainingProgress) {
        match progress {
            TrainingProgress::Steps { done, choice_loss, pose_loss, rate, .. } => {
                let first = *self.first.get_or_insert(done.saturating_sub(10));
                let step_secs = self.start.elapsed().as_secs_f64() / (done - first).max(1) as f64;
                let left_mins = step_secs * self.total.saturating_sub(*done) as f64 / 60.0;
                console::note(&format!(
                    "step {done}/{}: choices {choice_loss:.4}, poses {pose_loss:.4}, rate {rate:.2e}, {step_secs:.2} s per step, {left_mins:.0} min left",
                    self.total
                ));
            }
            TrainingProgress::Checkpoint { done, held_out_loss: [choices, poses], held_out, hand_written } => {
                console::note(&format!("checkpoint {done}: held-out loss: choices {choices:.4}, poses {poses:.4}"));
                console::note(&metrics_line("  reserved wordings", held_out));
                console::note(&metrics_line("  people's sentences", hand_written));
            }
        }
    }
}

fn metrics_line(title: &str, metrics: &ProgramMetrics) -> String {
    let percent = |tally: Tally| 100.0 * tally.correct as f64 / tally.total.max(1) as f64;
    let mut line = format!(
        "{title}: {:.1} % of {} prompts, {:.1} % of {} steps;",
        percent(metrics.programs),
        metrics.programs.total,
        percent(metrics.steps),
        metrics.steps.total
    );
    for (name, tally) in &metrics.fields {
        // Writing to a string cannot fail.
        let _ = write!(line, " {name} {:.0}", percent(*tally));
    }
    line
}

fn examine_model(model: &Path, sentences: Option<&Path>) -> Result<(), Failure> {
    let director = if model.as_os_str() == "built-in" { Director::embedded()? } else { Director::load(model)? };
    let splits = [
        ("people's sentences", EvaluationSplit::HandWritten),
        ("reserved wordings", EvaluationSplit::HeldOut { count: 500 }),
        ("wordings as in training", EvaluationSplit::Training { count: 300 }),
    ];
    for (title, split) in splits {
        print_metrics(title, &evaluate_director(&director, split)?)?;
    }
    let Some(sentences) = sentences else { return Ok(()) };
    let writers = corpus::read_folder(sentences)?;
    // The exam belongs to `bench director`: nobody should look at its sentences.
    for split in [Split::Development] {
        let writers: Vec<&Writer> = writers.iter().filter(|writer| writer.split == split).collect();
        for kind in SentenceKind::VARIANTS {
            for mentions in Mentions::VARIANTS {
                let examined = examine(&director, &writers, Some(*kind), *mentions)?;
                print_metrics(&format!("{split}, {kind}, mentions {mentions}"), &examined.metrics)?;
            }
        }
    }
    Ok(())
}

/// Prints metrics and every prompt that was misunderstood.
fn print_metrics(title: &str, metrics: &ProgramMetrics) -> Result<(), Failure> {
    console::data(&format!("{}\n", metrics_line(title, metrics)))?;
    for case in &metrics.error_cases {
        let (meant, understood) = (program_to_notation(&case.intended), program_to_notation(&case.understood));
        let mistakes: Vec<String> = case.mistakes.iter().map(ToString::to_string).collect();
        console::data(&format!(
            "  {}\n    meant      {meant}\n    understood {understood}\n    wrong: {}\n",
            case.prompt,
            mistakes.join(", ")
        ))?;
    }
    Ok(())
}

/// Writes the mean of some models into a folder.
fn average_models(models: &[PathBuf], name: &str, out: &Path, existing: Existing) -> Result<(), Failure> {
    let models = models.iter().map(|model| ModelFiles::read(model)).collect::<Result<Vec<_>, _>>()?;
    let mean = ModelFiles::mean(&models, name)?;
    write_model(&mean, out, existing)?;
    console::note(&format!("mean of {} models, weights {}", models.len(), mean.weights_sha256()));
    Ok(())
}

/// Writes a model in about half the bytes into a folder.
fn compact_model(model: &Path, out: &Path, existing: Existing) -> Result<(), Failure> {
    let compact = ModelFiles::read(model)?.compact()?;
    write_model(&compact, out, existing)?;
    let bytes: usize = compact.named().iter().map(|(_, bytes)| bytes.len()).sum();
    console::note(&format!("{bytes} bytes, weights {}", compact.weights_sha256()));
    Ok(())
}

fn write_model(model: &ModelFiles, out: &Path, existing: Existing) -> Result<(), Failure> {
    cinesplat::files::create_folder(out)?;
    ModelFiles::NAMES.iter().try_for_each(|name| cinesplat::files::check_free(&out.join(name), existing))?;
    for (name, bytes) in model.named() {
        cinesplat::files::write(&out.join(name), bytes, existing)?;
    }
    Ok(())
}

/// Fits the certainty of a model to the development writers, and writes it into the model's description.
fn calibrate_model(folder: &Path, name: &str, sentences: &Path) -> Result<(), Failure> {
    let files = ModelFiles::read(folder)?.described(name, Calibration::default())?;
    let director = Director::from_files(&files)?;
    let writers = corpus::read_folder(sentences)?;
    let writers: Vec<&Writer> = writers.iter().filter(|writer| writer.split == Split::Development).collect();
    let examined = examine(&director, &writers, None, Mentions::Found)?;
    let calibration = Calibration::fit(&examined.certainty);
    let calibrated = files.described(name, calibration)?;
    for (name, bytes) in calibrated.named() {
        cinesplat::files::write(&folder.join(name), bytes, Existing::Replace)?;
    }
    let Calibration { slope, offset } = calibration;
    console::note(&format!("calibrated on {} steps: slope {slope:.3}, offset {offset:.3}", examined.certainty.len()));
    Ok(())
}
