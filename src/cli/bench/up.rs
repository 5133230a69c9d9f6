//! `bench up`: how well the up axis is estimated from the shape of a scene alone.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use glam::{DQuat, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::calibration::calibration_error;
use super::scenes::scene_name;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::BenchFolder;
use crate::cli::scene_args::{SceneOptions, parse_vector};

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::scene::{Gaussians, UpPrior, up_estimates};
use cinesplat_bench::median;

/// Largest angle between an estimate that is right and the true direction, degrees.
const RIGHT_DEG: f64 = 10.0;

/// Measure how well the up axis is estimated from the shape of a scene alone
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench up synth:room:1:0.1 synth:tabletop:1:0.1 --rotations 20
  cinesplat bench up palm.splat guitar.ply --truth 0,-1,0 --truth 0,-1,0 -o bench
  cinesplat bench up synth:room:1:0.3 --things 8
Every scene is estimated in its own pose and in random rotations, without what its kind of file suggests. Prints one CSV
line per scene, and one for all. An estimate within 10 degrees is right.")]
pub(super) struct Args {
    /// Scenes, named as for the other commands
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
    /// True up of the scenes, in their order [default: what file or name states, else the estimate in the file's own
    /// pose]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    truth: Vec<DVec3>,
    /// Random rotations per scene
    #[arg(long, value_name = "N", default_value_t = 20)]
    rotations: usize,
    /// Seed of the rotations
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Largest true objects of every scene that are estimated alone as well
    #[arg(long, value_name = "N", default_value_t = 0)]
    things: usize,
    #[command(flatten)]
    folder: BenchFolder,
}

/// One estimate.
struct Trial {
    error_deg: f64,
    /// Probability that the estimate states, 0..=1.
    confidence: f64,
    secs: f64,
}

impl Trial {
    fn is_right(&self) -> bool {
        self.error_deg <= RIGHT_DEG
    }
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.folder.prepare(&["up.csv"])?;
        let mut table =
            "scene,num_gaussians,trials,right_frac,median_error_deg,mean_confidence,calibration_error,median_secs\n"
                .to_owned();
        console::data(&table)?;
        let mut all = Vec::new();
        for (idx, path) in self.scenes.iter().enumerate() {
            for subject in self.subjects(path, self.truth.get(idx).copied())? {
                let trials = self.trials(&subject.gaussians, subject.truth);
                let line = line(&subject.name, subject.gaussians.len(), &trials);
                console::data(&line)?;
                table.push_str(&line);
                all.extend(trials);
            }
        }
        let line = line("all", 0, &all);
        console::data(&line)?;
        table.push_str(&line);
        self.folder.write("up.csv", &table)
    }

    /// A scene, and its largest things alone.
    fn subjects(&self, path: &Path, truth: Option<DVec3>) -> Result<Vec<Subject>, Failure> {
        let (scene, objects) = match self.things {
            0 => (self.options.open(path)?.scene, ObjectSet::default()),
            _ => self.options.open(path)?.with_objects(None)?,
        };
        let truth = truth.unwrap_or(scene.up).normalize();
        let mut things: Vec<&Object> = objects.objects.iter().filter(|object| object.parent.is_none()).collect();
        things.sort_by(|a, b| b.radius().total_cmp(&a.radius()).then(a.id.cmp(&b.id)));
        let alone = |thing: &&Object| {
            let labels = objects.labels_of(thing.id);
            let owns = thing.owns(&labels, 0.0);
            let is_own = |idx: &usize| owns(*idx, scene.gaussians.mean_world(*idx));
            let own: Vec<usize> = (0..scene.gaussians.len()).filter(is_own).collect();
            let name = format!("{}:{}", scene_name(path), thing.label);
            Subject { name, gaussians: scene.gaussians.subset(&own), truth }
        };
        let is_upright = |thing: &&&Object| has_up(thing, truth);
        let alone: Vec<Subject> = things.iter().filter(is_upright).take(self.things).map(alone).collect();
        let whole = Subject { name: scene_name(path), gaussians: scene.gaussians, truth };
        Ok(std::iter::once(whole).chain(alone).collect())
    }

    /// The pose of the file and random ones.
    fn turns(&self) -> impl Iterator<Item = DQuat> {
        let mut random = Pcg64Mcg::seed_from_u64(self.seed);
        let turns: Vec<DQuat> = (0..self.rotations).map(|_| random_rotation(&mut random)).collect();
        std::iter::once(DQuat::IDENTITY).chain(turns)
    }

    fn trials(&self, gaussians: &Gaussians, truth: DVec3) -> Vec<Trial> {
        self.turns().map(|turn| trial(&rotated(gaussians, turn), turn * truth)).collect()
    }
}

/// What is estimated.
struct Subject {
    name: String,
    gaussians: Gaussians,
    truth: DVec3,
}

/// Height and depth over the longest side from which a thing shows which way is up: a rug and a door do not.
const MIN_HEIGHT: f64 = 0.25;
const MIN_DEPTH: f64 = 0.15;

fn has_up(thing: &Object, up: DVec3) -> bool {
    let [low, high] = thing.span_along(up);
    let longest = thing.half_extents.max_element();
    high - low >= MIN_HEIGHT * 2.0 * longest && thing.half_extents.min_element() >= MIN_DEPTH * longest
}

fn trial(gaussians: &Gaussians, truth: DVec3) -> Trial {
    let start = Instant::now();
    let best = up_estimates(gaussians, UpPrior::Any).into_iter().next();
    let secs = start.elapsed().as_secs_f64();
    let (error_deg, confidence) = best.map_or((180.0, 0.0), |best| {
        (best.up.angle_between(truth).to_degrees(), f64::from(best.confidence_percent) / 100.0)
    });
    Trial { error_deg, confidence, secs }
}

/// A rotation that is uniformly distributed: Shoemake, "Uniform random rotations", Graphics Gems III.
fn random_rotation(random: &mut Pcg64Mcg) -> DQuat {
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let (share, first, second) = (unit(), std::f64::consts::TAU * unit(), std::f64::consts::TAU * unit());
    let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
    DQuat::from_xyzw(a * first.sin(), a * first.cos(), b * second.sin(), b * second.cos())
}

fn rotated(gaussians: &Gaussians, turn: DQuat) -> Gaussians {
    let mut out = gaussians.clone();
    out.origin = turn * out.origin;
    out.means.iter_mut().for_each(|mean| *mean = (turn * mean.as_dvec3()).as_vec3());
    out.rotations.iter_mut().for_each(|rotation| *rotation = (turn * rotation.as_dquat()).as_quat());
    out
}

fn line(name: &str, num_gaussians: usize, trials: &[Trial]) -> String {
    let count = trials.len().max(1) as f64;
    let right = trials.iter().filter(|trial| trial.is_right()).count() as f64 / count;
    let confidence = trials.iter().map(|trial| trial.confidence).sum::<f64>() / count;
    let certainty: Vec<(f64, bool)> = trials.iter().map(|trial| (trial.confidence, trial.is_right())).collect();
    let mut text = format!("{name},{num_gaussians},{},{right:.4},", trials.len());
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{:.2},{confidence:.4},{:.4},{:.4}",
        median(trials.iter().map(|trial| trial.error_deg)),
        calibration_error(&certainty),
        median(trials.iter().map(|trial| trial.secs)),
    );
    text
}
