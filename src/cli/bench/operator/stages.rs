use std::path::PathBuf;

use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scene_args::SceneArgs;
use cinesplat::language::program_from_notation;
use cinesplat::operator::{Program, SolveLevel, SolveSettings, World, realize};
use cinesplat::pipeline::StageTimes;

/// Which scene, which program.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Objects file; without it objects are found
    #[arg(long, value_name = "FILE")]
    objects: Option<PathBuf>,
    /// Program to solve, in the notation of programs; without it a push, an orbit and a pan about the first objects
    #[arg(long, value_name = "PROGRAM", value_parser = program_from_notation)]
    program: Option<Program>,
    /// Runs of every stage after loading
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let mut loading = StageTimes::default();
        let (scene, objects) = loading.measure("load", || self.scene.open_with_objects(self.objects.as_deref()))?;
        let id = |i: usize| objects.objects.get(i).or(objects.objects.first()).map_or(1, |object| object.id);
        let usual = format!("push-in end={0} / orbit-left start={0} / pan end={1}", id(0), id(1));
        let program = match self.program {
            Some(program) => program,
            None => program_from_notation(&usual).map_err(|error| Failure::fault(&error))?,
        };
        let mut runs = Vec::new();
        for seed in 0..u64::from(self.runs) {
            let mut times = StageTimes::default();
            let ids = program.object_ids();
            let world = times.measure("world", || World::new(&scene.gaussians, scene.up, &objects, &ids))?;
            for level in [SolveLevel::Off, SolveLevel::Fast, SolveLevel::Full] {
                let solve = SolveSettings { level, seed, ..SolveSettings::default() };
                times.measure(stage_name(level), || realize(&world, &program, "", &[], &solve));
            }
            runs.push(times);
        }
        console::data("stage,gaussians,ms_least,ms_median,ms_most\n")?;
        print_stage("load", scene.gaussians.len(), &[loading])?;
        for name in ["world", "solve off", "solve fast", "solve full"] {
            print_stage(name, scene.gaussians.len(), &runs)?;
        }
        Ok(())
    }
}

fn stage_name(level: SolveLevel) -> &'static str {
    match level {
        SolveLevel::Off => "solve off",
        SolveLevel::Fast => "solve fast",
        SolveLevel::Full => "solve full",
    }
}

fn print_stage(name: &str, num_gaussians: usize, runs: &[StageTimes]) -> Result<(), Failure> {
    let of_run = |times: &StageTimes| times.iter().find(|(stage, _)| *stage == name).map(|(_, time)| time);
    let mut ms: Vec<f64> = runs.iter().filter_map(of_run).map(|time| time.as_secs_f64() * 1e3).collect();
    ms.sort_by(f64::total_cmp);
    let (Some(least), Some(most)) = (ms.first(), ms.last()) else { return Ok(()) };
    console::data(&format!("{name},{num_gaussians},{least:.1},{:.1},{most:.1}\n", ms[ms.len() / 2]))
}
