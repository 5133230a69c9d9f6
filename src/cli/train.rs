use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use super::console;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::outputs::Overwrite;
use cinesplat::director::Director;
use cinesplat::language::program_to_notation;
use cinesplat::training::{
    EvaluationSplit, ProgramMetrics, Tally, TrainSettings, TrainingProgress, evaluate_director, train,
};

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
  cinesplat train --examine model")]
pub(super) struct Args {
    /// Folder for the model (three files) and its checkpoint
    #[arg(short, long, value_name = "DIR", required_unless_present = "examine")]
    output: Option<PathBuf>,
    /// Folder of training shots [default: learn from words only]
    ///
    /// `cinesplat dataset` writes it. Without it the network learns programs, not camera poses.
    #[arg(long, value_name = "DIR")]
    shots: Option<PathBuf>,
    /// Share of these shots among the examples
    #[arg(long, value_name = "FRAC", default_value_t = TrainSettings::default().shots_frac)]
    shots_frac: f64,
    /// Model to start from [default: random weights]
    #[arg(long, value_name = "MODEL")]
    from: Option<PathBuf>,
    /// Number of optimizer steps
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().steps)]
    steps: u64,
    /// Examples per step
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().batch)]
    batch: usize,
    /// Highest learning rate
    #[arg(long, value_name = "RATE", default_value_t = TrainSettings::default().peak_rate)]
    rate: f32,
    /// Steps of linear warm-up to that rate
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().warm_up)]
    warm_up: u64,
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
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(model) = &self.examine {
            return examine_model(model);
        }
        if std::env::var_os(THREADS_VARIABLE).is_none_or(|threads| threads != "1") {
            return restart();
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

    fn settings(self) -> TrainSettings {
        TrainSettings {
            seed: self.seed,
            steps: self.steps,
            batch: self.batch,
            peak_rate: self.rate,
            warm_up: self.warm_up,
            shots_frac: self.shots_frac.clamp(0.0, 1.0),
            vocabulary: self.vocabulary,
            name: self.name,
            shots: self.shots,
            from: self.from,
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

fn examine_model(model: &std::path::Path) -> Result<(), Failure> {
    let director = if model.as_os_str() == "built-in" { Director::embedded()? } else { Director::load(model)? };
    let splits = [
        ("people's sentences", EvaluationSplit::HandWritten),
        ("reserved wordings", EvaluationSplit::HeldOut { count: 500 }),
        ("wordings as in training", EvaluationSplit::Training { count: 300 }),
    ];
    for (title, split) in splits {
        let metrics = evaluate_director(&director, split)?;
        console::data(&format!("{}\n", metrics_line(title, &metrics)))?;
        for case in &metrics.error_cases {
            let (meant, understood) = (program_to_notation(&case.intended), program_to_notation(&case.understood));
            let mistakes: Vec<String> = case.mistakes.iter().map(ToString::to_string).collect();
            console::data(&format!(
                "  {}\n    meant      {meant}\n    understood {understood}\n    wrong: {}\n",
                case.prompt,
                mistakes.join(", ")
            ))?;
        }
    }
    Ok(())
}
