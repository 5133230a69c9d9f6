mod calibration;
mod cases;
mod critic;
#[cfg(feature = "training")]
mod director;
mod encoder;
mod films;
mod lens;
mod objects;
mod operator;
mod promises;
mod readings;
mod render;
mod scaling;
mod scenes;
mod temporary_film;
mod up;

use crate::cli::failure::Failure;

/// Measure time, memory and accuracy
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench render room.spz --cameras cameras.json -o bench
  cinesplat bench scaling room.spz -o bench
  cinesplat bench films room.spz --cameras cameras.json -o bench
  cinesplat bench encoder room.spz --cameras cameras.json -o bench
  cinesplat bench promises room.spz synth:demo -o bench
  cinesplat bench lens room.spz --cameras cameras.json -o bench
  cinesplat bench objects synth:room:1:0.3 -o bench
  cinesplat bench up synth:room:1:0.1 palm.splat --rotations 20
  cinesplat bench operator moves
  cinesplat bench critic --cases public.jsonl -o critic
  cinesplat bench director -o bench")]
pub(super) struct Args {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Debug, clap::Subcommand)]
enum Benchmark {
    Render(render::Args),
    Scaling(scaling::Args),
    Films(films::Args),
    Encoder(encoder::Args),
    Promises(promises::Args),
    Lens(lens::Args),
    Objects(objects::Args),
    Up(up::Args),
    Operator(operator::Args),
    Critic(critic::Args),
    Readings(readings::Args),
    #[cfg(feature = "training")]
    Director(director::Args),
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        match self.benchmark {
            Benchmark::Render(args) => args.run(),
            Benchmark::Scaling(args) => args.run(),
            Benchmark::Films(args) => args.run(),
            Benchmark::Encoder(args) => args.run(),
            Benchmark::Promises(args) => args.run(),
            Benchmark::Lens(args) => args.run(),
            Benchmark::Objects(args) => args.run(),
            Benchmark::Up(args) => args.run(),
            Benchmark::Operator(args) => args.run(),
            Benchmark::Critic(args) => args.run(),
            Benchmark::Readings(args) => args.run(),
            #[cfg(feature = "training")]
            Benchmark::Director(args) => args.run(),
        }
    }
}
