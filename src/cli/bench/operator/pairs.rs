use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use glam::DVec3;

use super::pair_trial::{PairResult, PairTrial};
use super::statistics::Summary;
use crate::cli::console;
use crate::cli::failure::Failure;
use cinesplat::objects::ObjectSet;
use cinesplat::operator::{ClearanceIndex, Route, World};
use cinesplat::pipeline;
use cinesplat::scene::{LoadOptions, Scene};

/// Measure paths between random places: clearance by brute force, and search time
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench operator pairs kitchen.spz synth:demo --pairs 100 > pairs.csv
One line per pair. Solver times are CPU time of one thread; the index of each scene is timed separately, also on one thread.")]
pub(crate) struct Args {
    /// Scenes; the pairs are divided among them
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    /// Number of pairs over all scenes
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    pairs: u16,
    /// Samples of every path that are compared with every Gaussian, without an index
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    samples: usize,
    /// Seed of the pairs
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        console::data(
            "scene,gaussians,index_ms,start_x,start_y,start_z,goal_x,goal_y,goal_z,outcome,keys,solve_ms,camera_radius,\
             proved_least,scanned_least,violations\n",
        )?;
        let single = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let single = single.map_err(|error| Failure::fault(&error.to_string()))?;
        let mut all = Vec::new();
        for (number, name) in self.scenes.iter().enumerate() {
            let scene = pipeline::open_scene(name, &LoadOptions::default())?.scene;
            let share = usize::from(self.pairs) * (number + 1) / self.scenes.len()
                - usize::from(self.pairs) * number / self.scenes.len();
            let trial = PairTrial { num_pairs: share, num_samples: self.samples, seed: self.seed };
            all.extend(single.install(|| on_scene(&scene, &trial))?);
        }
        console::note(&summary(&all));
        Ok(())
    }
}

fn on_scene(scene: &Scene, trial: &PairTrial) -> Result<Vec<PairResult>, Failure> {
    let begun = busy_time();
    let index = ClearanceIndex::new(&scene.gaussians);
    let index_ms = milliseconds(busy_time().saturating_sub(begun));
    let num_solid = index.len();
    drop(index);
    let world = World::new(&scene.gaussians, scene.up, &ObjectSet::default(), &[])?;
    let results = trial.run(&world, &scene.gaussians, busy_time);
    let name = scene.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    for result in &results {
        let head = format!("{name},{},{index_ms:.1}", scene.gaussians.len());
        console::data(&line(&head, result, world.camera_radius))?;
    }
    console::note(&format!(
        "{}: {} Gaussians, {num_solid} of them solid, index {index_ms:.0} ms; {}",
        scene.path.display(),
        scene.gaussians.len(),
        summary(&results)
    ));
    Ok(results)
}

fn line(head: &str, result: &PairResult, radius: f64) -> String {
    let coordinates: Vec<String> =
        [result.start, result.goal].iter().flat_map(DVec3::to_array).map(|v| format!("{v:.4}")).collect();
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.6}"));
    let (outcome, keys, proved) = match &result.route {
        Ok(route) => {
            let outcome = if route.is_straight() { "straight" } else { "around" };
            (outcome.to_owned(), route.states.len(), Some(route.proof.min_distance))
        }
        Err(why) => (format!("none: {why}"), 0, None),
    };
    let mut text = format!("{head},{},{outcome},{keys},", coordinates.join(","));
    let _ = writeln!(
        text,
        "{:.3},{radius:.6},{},{},{}",
        milliseconds(result.solve_time),
        number(proved),
        number(result.scanned_least),
        result.num_violations.map_or_else(String::new, |count| count.to_string())
    );
    text
}

fn summary(results: &[PairResult]) -> String {
    let times: Vec<f64> = results.iter().map(|result| milliseconds(result.solve_time)).collect();
    let Summary { median, largest: worst, .. } = Summary::of(&times);
    let straight = results.iter().filter(|r| r.route.as_ref().is_ok_and(Route::is_straight)).count();
    let found = results.iter().filter(|r| r.route.is_ok()).count();
    let violating = results.iter().filter(|r| r.num_violations.is_some_and(|count| count > 0)).count();
    // A scanned distance below the proved one refutes the proof, even where the camera has room. The scan measures
    // distances up to 1.5 radii.
    let refuted = results.iter().filter(|r| {
        let proved =
            r.route.as_ref().map_or(0.0, |route| route.proof.min_distance.min(1.5 * route.proof.camera_radius));
        r.scanned_least.is_some_and(|least| least < proved - 1e-9)
    });
    format!(
        "{} pairs: {straight} straight, {} around, {} without a route; {violating} with violations, {} proofs refuted; \
         solver median {median:.2} ms, worst {worst:.1} ms, all {:.0} ms",
        results.len(),
        found - straight,
        results.len() - found,
        refuted.count(),
        times.iter().sum::<f64>()
    )
}

/// CPU time of this thread, so that other programs do not count; wall time since the first call where the system does not
/// report it (elsewhere than Linux).
fn busy_time() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = stat.and_then(|stat| stat.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| START.elapsed(), Duration::from_nanos)
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
