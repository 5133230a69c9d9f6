//! `bench operator`: what the operator promises, measured on finished shots by code that knows nothing of how they are made.

mod cases;
mod curve;
mod films;
mod moves;
mod pair_trial;
mod pairs;
mod path_facts;
mod scan;
mod stages;
mod statistics;
mod void;

use crate::cli::failure::Failure;

/// Measures the operator.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench operator moves
  cinesplat bench operator films --cases public.jsonl --intents intents.json --solve off -o paths
  cinesplat bench operator void --cases public.jsonl --only ps
  cinesplat bench operator curve --cases public.jsonl --intents intents.json --plot curve.svg
  cinesplat bench operator stages room.spz
  cinesplat bench operator pairs kitchen.spz synth:demo > pairs.csv
Cases are JSON lines with id, scene, objects and prompt, file names relative to the file; intents are one JSON object of
programs by id, such as {\"a1\": \"push-in end=2 / pan-left end=3\"}, and stand for the network's reading of the prompt.")]
pub(super) struct Args {
    #[command(subcommand)]
    benchmark: OperatorBenchmark,
}

#[derive(Debug, clap::Subcommand)]
enum OperatorBenchmark {
    /// Exactness of the moves: radius, speed, continuity, dolly zooms, backtracking.
    Moves,
    /// Writes the camera path and the shot of every case.
    Films(films::Args),
    /// Share of the picture that no Gaussian covers, per film.
    Void(void::Args),
    /// What was asked for and not found, against the time of the search.
    Curve(curve::Args),
    /// Time of every stage of planning.
    Stages(stages::Args),
    /// Ways between random places: clear of matter, by a plain scan of all Gaussians, and how long they take to find.
    Pairs(pairs::Args),
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        match self.benchmark {
            OperatorBenchmark::Moves => moves::run(),
            OperatorBenchmark::Films(args) => args.run(),
            OperatorBenchmark::Void(args) => args.run(),
            OperatorBenchmark::Curve(args) => args.run(),
            OperatorBenchmark::Stages(args) => args.run(),
            OperatorBenchmark::Pairs(args) => args.run(),
        }
    }
}
