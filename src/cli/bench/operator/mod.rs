//! `bench operator`: what the operator promises, measured on finished shots by code that knows nothing of how they are made.

mod cases;
mod curve;
mod films;
mod moves;
mod pairs;
mod path_facts;
mod stages;
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
    part: Part,
}

#[derive(Debug, clap::Subcommand)]
enum Part {
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
        match self.part {
            Part::Moves => moves::run(),
            Part::Films(args) => args.run(),
            Part::Void(args) => args.run(),
            Part::Curve(args) => args.run(),
            Part::Stages(args) => args.run(),
            Part::Pairs(args) => args.run(),
        }
    }
}

/// Median (of an even number the upper one) and largest of values; 0 of none.
fn median_and_most(values: &[f64]) -> (f64, f64) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    (sorted.get(sorted.len() / 2).copied().unwrap_or(0.0), sorted.last().copied().unwrap_or(0.0))
}
