//! The command line: one file per subcommand, and the only place that prints.
//!
//! Enters: arguments. Leaves: data on stdout, everything else on stderr, files, an exit code. An error is one line
//! `error[CODE]: FILE: found, expected` and a second line `help: ` with the fix.

mod bench;
mod choice;
mod completions;
mod console;
#[cfg(feature = "training")]
mod dataset;
mod describe;
mod eval;
mod eval_folders;
mod eval_paths;
mod explain;
mod export;
mod failure;
mod farm;
mod faults;
mod figures;
mod film_report;
mod formats;
mod heading;
mod import;
mod info;
mod interrupt;
mod job_args;
mod map;
mod masks;
mod member;
mod memory;
mod model_args;
mod objects;
mod outputs;
mod plan;
mod plan_outputs;
mod progress;
mod prompts_file;
mod read;
mod render;
mod reproduce;
mod scene_args;
mod shot_args;
mod still;
mod takes;
#[cfg(feature = "training")]
mod train;
#[cfg(feature = "training")]
mod train_names;
mod usage;

use std::ffi::OsString;
use std::path::Path;

use clap::{CommandFactory, Parser, Subcommand};

use failure::Failure;

/// Turn a Gaussian-splat scene and a sentence into a camera move, and render it as a film.
#[derive(Debug, Parser)]
#[command(name = "cinesplat", version, max_term_width = 110, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print only data and errors: no notes, warnings or progress
    #[arg(short, long, global = true, display_order = 900)]
    quiet: bool,
    /// Memory that the program may take, such as 2G [default: what container and shell allow]
    ///
    /// A size takes the place of what the container has left and of the built-in caps, 4 GB for a picture and 32 GB for a
    /// scene. The memory of the machine and the container's limit bound it.
    #[arg(long, global = true, display_order = 901, hide_short_help = true, value_name = "SIZE", value_parser = memory::parse_size)]
    max_memory: Option<u64>,
}

const EXAMPLES: &str = "\
Examples:
  cinesplat info room.spz
  cinesplat objects room.spz -o objects.json --sheet objects.png
  cinesplat render room.spz -p \"push in on the lamp, then orbit it\" --objects objects.json -o lamp.mp4
  cinesplat render synth:demo -p \"slowly push in on the sofa\" -o sofa.mp4

SCENE is a file (.ply .spz .sog .splat .ksplat .glb .pcd), the folder of an unbundled SOG, or a generated scene:
synth:demo, synth:room:SEED or synth:tabletop:SEED.
Data goes to stdout, notes and progress go to stderr. No file is overwritten without --overwrite.
Exit codes: 0 done, 2 wrong arguments, 65 bad data, 66 no such input, 69 codec missing, 70 fault of
cinesplat, 71 over a cap, 73 cannot create the output, 74 I/O error, 75 stopped early, 77 permission
denied, 130 interrupted twice.";

/// The commands. The documentation of each `Args` is its help.
#[derive(Debug, Subcommand)]
enum Command {
    Info(info::Args),
    Objects(objects::Args),
    Read(read::Args),
    Plan(plan::Args),
    Render(render::Args),
    Map(map::Args),
    Farm(farm::Args),
    Still(still::Args),
    Export(export::Args),
    Import(import::Args),
    Describe(describe::Args),
    Eval(eval::Args),
    #[cfg(feature = "training")]
    Train(train::Args),
    #[cfg(feature = "training")]
    Dataset(dataset::Args),
    Bench(bench::Args),
    Completions(completions::CompletionsArgs),
    Man(completions::ManArgs),
}

impl Command {
    /// The film that the command makes, if it makes one.
    fn film(&self) -> Option<&Path> {
        match self {
            Self::Render(args) => Some(args.output()),
            Self::Farm(args) => Some(args.output()),
            _ => None,
        }
    }

    fn run(self) -> Result<(), Failure> {
        match self {
            Self::Info(args) => args.run(),
            Self::Objects(args) => args.run(),
            Self::Read(args) => args.run(),
            Self::Plan(args) => args.run(),
            Self::Render(args) => args.run(),
            Self::Map(args) => args.run(),
            Self::Farm(args) => args.run(),
            Self::Still(args) => args.run(),
            Self::Export(args) => args.run(),
            Self::Import(args) => args.run(),
            Self::Describe(args) => args.run(),
            Self::Eval(args) => args.run(),
            #[cfg(feature = "training")]
            Self::Train(args) => args.run(),
            #[cfg(feature = "training")]
            Self::Dataset(args) => args.run(),
            Self::Bench(args) => args.run(),
            Self::Completions(args) => args.run(&mut Cli::command()),
            Self::Man(args) => args.run(Cli::command()),
        }
    }
}

/// Runs the program with its arguments, the program's name first; returns the exit code.
pub(super) fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    interrupt::survive_file_limit();
    let ended = match Cli::try_parse_from(arguments) {
        Ok(cli) => {
            console::set_quiet(cli.quiet);
            cli.max_memory.into_iter().for_each(memory::set_max);
            let output = cli.command.film().map(Path::to_owned);
            faults::catch(|| check_threads().and_then(|()| cli.command.run()), output.as_deref())
        }
        Err(refused) => usage::answer(&refused),
    };
    match ended {
        Ok(()) => 0,
        Err(failure) => {
            member::report(&failure);
            failure.exit_code()
        }
    }
}

/// Refuses a number of threads from the environment that no flag takes: starting them would take minutes and gigabytes.
fn check_threads() -> Result<(), Failure> {
    let wanted = std::env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.parse::<usize>().ok());
    match wanted.filter(|found| *found > MAX_THREADS) {
        Some(found) => {
            let message = format!("RAYON_NUM_THREADS is {found}, expected at most {MAX_THREADS}");
            Err(Failure::usage(message, "unset it for one thread per core"))
        }
        None => Ok(()),
    }
}

/// Most threads of the program.
const MAX_THREADS: usize = 1024;
