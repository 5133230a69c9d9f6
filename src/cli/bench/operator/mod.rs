//! `bench operator`: measures how exact and safe finished shots are, with code that is independent of the operator.

mod curve;
mod films;
mod flow_facts;
mod moves;
mod pair_trial;
mod pairs;
mod path_facts;
mod scan;
mod stages;
mod statistics;
mod void;

use crate::cli::failure::Failure;

/// Measure how exact and safe shots are, and how long planning takes
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench operator moves
  cinesplat bench operator films --cases public.jsonl --intents intents.json --solve off -o paths
  cinesplat bench operator films --cases public.jsonl --shots paths > flow.csv
  cinesplat bench operator void --cases public.jsonl --only ps
  cinesplat bench operator curve --cases public.jsonl --intents intents.json --plot curve.svg
  cinesplat bench operator stages room.spz
  cinesplat bench operator pairs kitchen.spz synth:demo > pairs.csv
Cases are JSON lines with id, scene, objects and prompt; file names are relative to the file. Intents are one JSON object
of programs by case id, such as {\"a1\": \"push-in end=2 / pan-left end=3\"}; they replace the network's programs.")]
pub(super) struct Args {
    #[command(subcommand)]
    benchmark: OperatorBenchmark,
}

#[derive(Debug, clap::Subcommand)]
enum OperatorBenchmark {
    /// Measure how exact the moves are: radius, speed, continuity, dolly zooms, reversals
    Moves,
    Films(films::Args),
    Void(void::Args),
    Curve(curve::Args),
    Stages(stages::Args),
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
