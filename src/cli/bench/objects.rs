//! `bench objects`: how well objects are found, and how well few points show their silhouettes.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::scenes::scene_name;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::BenchFolder;
use crate::cli::scene_args::SceneOptions;
use cinesplat::objects::radius_search::RadiusOptimizer;
use cinesplat::objects::{self, CloudSettings, FindSettings, ObjectSet, PointSampler};
use cinesplat::plot::{Axis, COLORS, Chart, LegendEntry, LegendSymbol, Marker, Series, grid};
use cinesplat::scene::Scene;

/// Numbers of points at which clouds are compared.
const BUDGETS: [usize; 4] = [32, 64, 128, 512];

/// Measure how well objects are found and how well few points show them
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench objects synth:room:1:0.3 synth:room:2:0.3 -o bench
  cinesplat bench objects kitchen_plus_dev.spz --labels kitchen_plus_dev_labels.npy -o bench
The true objects are those of a generated scene or of --labels. Prints one CSV line per true object: the overlap with the
found object that overlaps it most. -o also compares samplers and optimizers of clouds: clouds.csv and clouds.svg.")]
pub(super) struct Args {
    /// Scenes, named as for the other commands
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
    /// True labels of the scenes, in their order: one id per Gaussian
    #[arg(long, value_name = "LABELS.NPY")]
    labels: Vec<PathBuf>,
    #[command(flatten)]
    folder: BenchFolder,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.folder.prepare(&["objects.csv", "clouds.csv", "clouds.svg"])?;
        let mut found = "scene,id,label,size_frac,iou,found_id,found_label,find_secs\n".to_owned();
        console::data(&found)?;
        let mut clouds = Vec::new();
        for (idx, path) in self.scenes.iter().enumerate() {
            let (scene, truth) = self.open(path, self.labels.get(idx).map(PathBuf::as_path))?;
            let lines = found_lines(&scene_name(path), &scene, &truth);
            console::data(&lines)?;
            found.push_str(&lines);
            if self.folder.is_given() {
                clouds.extend(cloud_rows(&scene_name(path), &scene, &truth)?);
            }
        }
        self.folder.write("objects.csv", &found)?;
        self.folder.write("clouds.csv", &clouds_csv(&clouds))?;
        self.folder.write("clouds.svg", &clouds_svg(&clouds))
    }

    /// A scene with its true objects.
    fn open(&self, path: &Path, labels: Option<&Path>) -> Result<(Scene, ObjectSet), Failure> {
        let opened = self.options.open(path)?;
        match labels {
            Some(labels) => {
                let ids = objects::read_labels(labels, &opened.scene)?;
                let set = objects::from_labels(&opened.scene, ids);
                Ok((opened.scene, set))
            }
            None => Ok(opened.with_objects(None)?),
        }
    }
}

/// One line per true object.
fn found_lines(name: &str, scene: &Scene, truth: &ObjectSet) -> String {
    let start = Instant::now();
    let found = objects::find(scene, &FindSettings::default());
    let secs = start.elapsed().as_secs_f64();
    let size = scene.bounds().size();
    let mut lines = String::new();
    for agreement in objects::agreements(&scene.gaussians, &found, &truth.labels) {
        let Some(object) = truth.get(agreement.true_id) else { continue };
        let best = agreement.found_id.and_then(|id| found.get(id));
        let label = best.map_or("", |object| object.label.as_str());
        let id = best.map_or(0, |object| object.id);
        let size_frac = 2.0 * object.radius() / size;
        // Writing to a string cannot fail.
        let _ = writeln!(
            lines,
            "{name},{},{},{size_frac:.4},{:.4},{id},{label},{secs:.3}",
            object.id, object.label, agreement.iou
        );
    }
    lines
}

/// The clouds of all true objects of a scene with one sampler, optimizer and budget.
struct CloudRow {
    scene: String,
    sampler: &'static str,
    optimizer: &'static str,
    budget: usize,
    /// Means over the objects.
    num_points: f64,
    mask_iou: f64,
    /// Largest distance of a Gaussian's mean from the nearest point, over the object's diagonal.
    hausdorff_frac: f64,
    secs: f64,
}

fn cloud_rows(name: &str, scene: &Scene, truth: &ObjectSet) -> Result<Vec<CloudRow>, Failure> {
    let exact = ("exact sweep", RadiusOptimizer::ExactSweep);
    let zeroth = ("zeroth order", RadiusOptimizer::ZEROTH_ORDER);
    let mut cases: Vec<_> = PointSampler::ALL.into_iter().map(|sampler| (sampler, exact)).collect();
    cases.push((PointSampler::ALL[0], zeroth));
    let mut rows = Vec::new();
    for budget in BUDGETS {
        for ((sampler, sampler_name), (optimizer_name, optimizer)) in cases.iter().copied() {
            let settings =
                CloudSettings { points: budget, tolerance: 0.0, optimizer, sampler, ..CloudSettings::default() };
            let mut set = truth.clone();
            let start = Instant::now();
            objects::fill_clouds(scene, &mut set, &settings)?;
            let secs = start.elapsed().as_secs_f64();
            let count = set.objects.len().max(1) as f64;
            rows.push(CloudRow {
                scene: name.to_owned(),
                sampler: sampler_name,
                optimizer: optimizer_name,
                budget,
                num_points: set.objects.iter().map(|object| object.points.len() as f64).sum::<f64>() / count,
                mask_iou: set.objects.iter().map(|object| object.mask_iou).sum::<f64>() / count,
                hausdorff_frac: hausdorff_frac(scene, &set),
                secs,
            });
        }
    }
    Ok(rows)
}

/// Mean over the objects of the largest distance from a mean to the nearest kept point, over the box's diagonal. Every
/// n-th Gaussian of at most a thousand is measured.
fn hausdorff_frac(scene: &Scene, set: &ObjectSet) -> f64 {
    let mut sum = 0.0;
    for object in &set.objects {
        let of_object = |i: &usize| u32::from(set.labels[*i]) == object.id;
        let members: Vec<usize> = (0..set.labels.len()).filter(of_object).collect();
        let inside =
            members.iter().step_by(members.len().div_ceil(1000).max(1)).map(|&i| scene.gaussians.mean_world(i));
        let gap = |mean: glam::DVec3| {
            object.points.iter().map(|point| point.distance_squared(mean)).fold(f64::INFINITY, f64::min).sqrt()
        };
        let inside = inside.filter(|mean| object.contains(*mean, 0.0));
        sum += inside.map(gap).fold(0.0, f64::max) / (2.0 * object.radius()).max(f64::MIN_POSITIVE);
    }
    sum / set.objects.len().max(1) as f64
}

fn clouds_csv(rows: &[CloudRow]) -> String {
    let mut csv = "scene,sampler,optimizer,budget,mean_points,mean_mask_iou,mean_hausdorff_frac,secs\n".to_owned();
    for row in rows {
        let CloudRow { scene, sampler, optimizer, budget, num_points, mask_iou, hausdorff_frac, secs } = row;
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{scene},{sampler},{optimizer},{budget},{num_points:.1},{mask_iou:.4},{hausdorff_frac:.4},{secs:.3}"
        );
    }
    csv
}

/// One chart per scene: overlap with the masks against the number of points, one line per sampler.
fn clouds_svg(rows: &[CloudRow]) -> String {
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene.as_str()).collect();
    scenes.dedup();
    let color = |idx: usize| COLORS[idx % COLORS.len()];
    let chart = |scene: &&str| {
        let mut chart = Chart::new(scene, Axis::logarithmic("points"), Axis::linear("overlap with the masks"));
        for (idx, (_, sampler)) in PointSampler::ALL.into_iter().enumerate() {
            let is_line =
                |row: &&CloudRow| row.scene == **scene && row.sampler == sampler && row.optimizer == "exact sweep";
            let points: Vec<(f64, f64)> =
                rows.iter().filter(is_line).map(|row| (row.num_points, row.mask_iou)).collect();
            let markers = (0..points.len()).map(|point| Marker::dot(point, 3.0)).collect();
            chart.series.push(Series { points, color: color(idx), line_px: 1.5, markers });
        }
        chart
    };
    let charts: Vec<Chart> = scenes.iter().map(chart).collect();
    let entry = |(idx, (_, name)): (usize, (PointSampler, &str))| LegendEntry {
        name: name.to_owned(),
        color: color(idx),
        symbol: LegendSymbol::Dot,
    };
    let legend: Vec<LegendEntry> = PointSampler::ALL.into_iter().enumerate().map(entry).collect();
    grid("Kept points and how well their alpha shapes cover the masks", &legend, &charts, 2, [410.0, 300.0])
}
