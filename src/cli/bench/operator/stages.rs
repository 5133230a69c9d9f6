use std::path::PathBuf;
use std::time::Instant;

use strum::VariantArray;

use super::statistics::Summary;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scene_args::SceneArgs;
use cinesplat::language::program_from_notation;
use cinesplat::operator::{Program, SolveLevel, SolveSettings, World, realize};

/// Measure the time of each stage of planning
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Objects file [default: the scene's own objects, else a search]
    #[arg(long, value_name = "FILE")]
    objects: Option<PathBuf>,
    /// Program to solve, in the notation of programs [default: a push, an orbit and a pan]
    ///
    /// The default program is about the first two objects.
    #[arg(long, value_name = "PROGRAM", value_parser = program_from_notation)]
    program: Option<Program>,
    /// Runs of each stage after loading
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let (loaded, load_ms) = timed(|| self.scene.open_with_objects(self.objects.as_deref()));
        let (scene, objects) = loaded?;
        let id = |i: usize| objects.objects.get(i).or(objects.objects.first()).map_or(1, |object| object.id);
        let usual = format!("push-in end={0} / orbit-left start={0} / pan end={1}", id(0), id(1));
        let program = match self.program {
            Some(program) => program,
            None => program_from_notation(&usual).map_err(|error| Failure::fault(&error.to_string()))?,
        };
        let ids = program.object_ids();
        let mut world_ms = Vec::new();
        let mut solve_ms = vec![Vec::new(); SolveLevel::VARIANTS.len()];
        for seed in 0..u64::from(self.runs) {
            let (world, ms) = timed(|| World::new(&scene.gaussians, scene.up, &objects, &ids));
            let world = world?;
            world_ms.push(ms);
            for (times, &level) in solve_ms.iter_mut().zip(SolveLevel::VARIANTS) {
                let solve = SolveSettings { level, seed, ..SolveSettings::default() };
                times.push(timed(|| realize(&world, &program, "", &[], &solve)).1);
            }
        }
        let num_gaussians = scene.gaussians.len();
        console::data("stage,gaussians,ms_least,ms_median,ms_most\n")?;
        print_stage("load", num_gaussians, &[load_ms])?;
        print_stage("world", num_gaussians, &world_ms)?;
        SolveLevel::VARIANTS
            .iter()
            .zip(&solve_ms)
            .try_for_each(|(level, ms)| print_stage(&format!("solve {}", level.as_ref()), num_gaussians, ms))
    }
}

/// The result of `work` and its wall time in milliseconds.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64() * 1e3)
}

fn print_stage(name: &str, num_gaussians: usize, ms: &[f64]) -> Result<(), Failure> {
    let Summary { least, median, largest } = Summary::of(ms);
    console::data(&format!("{name},{num_gaussians},{least:.1},{median:.1},{largest:.1}\n"))
}
