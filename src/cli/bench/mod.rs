mod films;
mod operator;
mod render;
mod scaling;
mod scenes;

use crate::cli::failure::Failure;

/// Measures what accuracy costs in time, and how cost grows with the work.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench render room.spz --cameras cameras.json -o bench
  cinesplat bench scaling room.spz -o bench
  cinesplat bench films room.spz --cameras cameras.json -o bench
  cinesplat bench operator moves")]
pub(super) struct Args {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Debug, clap::Subcommand)]
enum Benchmark {
    /// Scenes at every preset and every knob alone: time, PSNR, SSIM, worst pixel.
    Render(render::Args),
    /// Time and memory against Gaussians, pixels and layers.
    Scaling(scaling::Args),
    /// Films against their frames one by one, rendering and encoding alone, and forecasts.
    Films(films::Args),
    /// The operator: exactness of moves, films of cases, void, accuracy against time, stages.
    Operator(operator::Args),
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        match self.benchmark {
            Benchmark::Render(args) => args.run(),
            Benchmark::Scaling(args) => args.run(),
            Benchmark::Films(args) => args.run(),
            Benchmark::Operator(args) => args.run(),
        }
    }
}
