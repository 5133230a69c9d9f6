//! `bench readings`: how many sentences are read as the moves, and about the things, that their writers mean.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::cli::console;
use crate::cli::failure::{Exit, Failure};
use crate::cli::model_args::ModelArgs;
use crate::cli::outputs;
use crate::cli::read::read_linked;
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::operator::Step;
use cinesplat::pipeline::{Interpreter, ProblemKind, Reading};
use cinesplat::trajectory::Move;

/// Measure how many sentences are read as the moves that their writers mean
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench readings prompts/outsiders/*.jsonl
  cinesplat bench readings prompts/outsiders/mixed.jsonl --misses
A line of a file is a sentence: {\"id\", \"things\": [names], \"prompt\", \"means\", \"steps\": [{\"moves\": [names], \"objs\": [numbers of
things, from 1], \"optional\"}]}. A sentence is read right where its steps are those, in order: each has one of the moves and is about all of
the things. A picture at rest more is no error. Amounts, sizes, angles and speeds are not compared.
The last two columns count the sentences, of those read right and of the others, that got a warning: part of them was not understood.")]
pub(super) struct Args {
    /// Files of sentences
    #[arg(value_name = "SENTENCES.JSONL", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    models: ModelArgs,
    /// Print every sentence that is read otherwise
    #[arg(long)]
    misses: bool,
}

/// A sentence with what it means.
#[derive(Debug, Deserialize)]
struct Sentence {
    id: String,
    things: Vec<String>,
    prompt: String,
    means: String,
    steps: Vec<WantedStep>,
}

/// A step that a sentence asks for.
#[derive(Debug, Deserialize)]
struct WantedStep {
    /// Moves, one of which it is.
    #[serde(deserialize_with = "moves")]
    moves: Vec<Move>,
    /// Ids of the things that it ends on, starts from, passes or looks at.
    #[serde(default)]
    objs: Vec<u32>,
    /// A reading may lack it.
    #[serde(default)]
    optional: bool,
}

fn moves<'de, D: Deserializer<'de>>(text: D) -> Result<Vec<Move>, D::Error> {
    let named = |name: &String| name.parse().map_err(|_| D::Error::custom(format!("there is no move {name:?}")));
    Vec::<String>::deserialize(text)?.iter().map(named).collect()
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let interpreter = self.models.interpreter()?;
        let mut table = "file,right,sentences,percent,right_with_warning,wrong_with_warning\n".to_owned();
        let mut all = Counts::default();
        for path in &self.files {
            let mut counts = Counts::default();
            for sentence in &sentences(path)? {
                let reading = read(&interpreter, sentence)?;
                let program = &reading.direction.program;
                let is_right = is_right(&sentence.steps, &program.steps);
                counts.add(is_right, &reading);
                if !is_right && self.misses {
                    let read = program_to_notation(program);
                    let Sentence { id, prompt, means, .. } = sentence;
                    console::note(&format!("{id}: {prompt:?}\n  means  {means}\n  read   {read}"));
                }
            }
            counts.write_row(&mut table, &path.display().to_string());
            all.add_all(&counts);
        }
        if self.files.len() > 1 {
            all.write_row(&mut table, "all");
        }
        console::data(&table)
    }
}

/// Numbers of sentences, of those read otherwise and of those read right: `[otherwise, right]`.
#[derive(Default)]
struct Counts {
    read: [usize; 2],
    with_warning: [usize; 2],
}

impl Counts {
    fn add(&mut self, is_right: bool, reading: &Reading) {
        let has_warning = reading.problems.iter().any(|problem| problem.kind == ProblemKind::NotUnderstood);
        self.read[usize::from(is_right)] += 1;
        self.with_warning[usize::from(is_right)] += usize::from(has_warning);
    }

    fn add_all(&mut self, other: &Self) {
        for idx in 0..2 {
            self.read[idx] += other.read[idx];
            self.with_warning[idx] += other.with_warning[idx];
        }
    }

    fn write_row(&self, table: &mut String, name: &str) {
        let Self { read: [otherwise, right], with_warning: [warned_otherwise, warned_right] } = self;
        let all = otherwise + right;
        let percent = 100.0 * *right as f64 / all.max(1) as f64;
        // Writing to a string cannot fail.
        let _ = writeln!(table, "{name},{right},{all},{percent:.1},{warned_right},{warned_otherwise}");
    }
}

fn sentences(path: &Path) -> Result<Vec<Sentence>, Failure> {
    let bad = |line: usize, error: &serde_json::Error| {
        let found = format!("{}: line {line}: {error}, expected a sentence", path.display());
        Failure::new("BAD-SENTENCE", found, "`cinesplat bench readings --help` explains the files", Exit::BadData)
    };
    let text = outputs::read_text(path)?;
    text.lines()
        .zip(1..)
        .map(|(line, number)| serde_json::from_str(line).map_err(|error| bad(number, &error)))
        .collect()
}

fn read(interpreter: &Interpreter, sentence: &Sentence) -> Result<Reading, Failure> {
    let named = (1..).zip(&sentence.things).map(|(id, label)| NamedObject { id, label: label.clone() });
    let names: Vec<NamedObject> = named.collect();
    let linked = interpreter.director.link(&sentence.prompt, &names)?;
    let (reading, _) = read_linked(interpreter, &sentence.prompt, linked, &names)?;
    Ok(reading)
}

/// Whether the steps are those wanted, in order.
fn is_right(wanted: &[WantedStep], steps: &[Step]) -> bool {
    match (wanted.split_first(), steps.split_first()) {
        (None, None) => true,
        (Some((first, rest)), Some((step, later))) => {
            (is_wanted(first, step) && is_right(rest, later))
                || (first.optional && is_right(rest, steps))
                || (is_rest(step) && is_right(wanted, later))
        }
        (Some((first, rest)), None) => first.optional && is_right(rest, steps),
        (None, Some((step, later))) => is_rest(step) && is_right(wanted, later),
    }
}

fn is_rest(step: &Step) -> bool {
    step.movement == Move::Static && step.with.is_empty()
}

fn is_wanted(wanted: &WantedStep, step: &Step) -> bool {
    let is_one = |movement: &Move| {
        wanted.moves.contains(movement)
            || step.either_way && movement.opposite().is_some_and(|other| wanted.moves.contains(&other))
    };
    let about = step.about();
    std::iter::once(&step.movement).chain(&step.with).any(is_one) && wanted.objs.iter().all(|id| about.contains(id))
}
