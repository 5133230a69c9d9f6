use crate::cli::outputs::BenchFolder;
use std::path::Path;
use strum::VariantArray;

use super::scenes::{NUM_OWN_VIEWS, ScenesArgs, parse_size, resized, scene_name, settings, views};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::progress::FrameProgress;
use crate::cli::scene_args::PictureArgs;
use cinesplat::export::cameras_json::StillCameras;
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat_bench::{AccuracyAxis, BenchPlan, BenchRow};

/// Measure every preset, knob and output of the renderer: time, PSNR, SSIM, worst pixel
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench render room.spz skull.sog --cameras room.cameras.json --cameras auto -o bench
Prints one CSV line per scene, camera, size and variant: median and range of the runs and times of the stages in ms,
work counts, PSNR, SSIM and worst pixel against `reference` (knobs that change no bit: `standard`). -o keeps the CSV, tables
and plots. Times are those of 8-bit pictures, as in films; PSNR, SSIM and worst pixel are those of the same
pictures as f32. Outputs (depth, ids, features, weights, lift) are timed at `standard`, alternating with f32 color;
times_color is the median ratio of the two. Knobs are measured at the first size only, `scalar` once on one camera.")]
pub(crate) struct Args {
    #[command(flatten)]
    scenes: ScenesArgs,
    /// Sizes of the pictures; `given` takes those of the cameras file
    ///
    /// All variants are measured at the first size, presets only at the others.
    #[arg(long, value_name = "WxH,..", default_value = "1280x720", value_delimiter = ',', value_parser = parse_size)]
    sizes: Vec<Option<[u32; 2]>>,
    /// Largest number of cameras per scene
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    max_cameras: u16,
    /// Timed runs per picture, after one warm-up run
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    #[command(flatten)]
    folder: BenchFolder,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let plots: Vec<String> = AccuracyAxis::VARIANTS.iter().map(|axis| plot_name(*axis)).collect();
        let names: Vec<&str> =
            ["render.csv", "render.md"].into_iter().chain(plots.iter().map(String::as_str)).collect();
        let scenes = self.scenes.begin((&self.folder, &names), &self.picture, &cinesplat_bench::to_csv(&[]))?;
        let num_rows: usize = scenes.iter().map(|(_, file)| self.num_rows(file.as_ref())).sum();
        let mut log = RowLog { rows: Vec::new(), num_rows, progress: FrameProgress::of_rows() };
        for (path, file) in &scenes {
            self.bench_scene(path, file.as_ref(), &mut log)?;
        }
        log.progress.finish();
        write_all(&self.folder, &log.rows)
    }

    /// Measures all cameras and sizes of one scene.
    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>, log: &mut RowLog) -> Result<(), Failure> {
        let scene = self.scenes.options.open(path)?.scene;
        let base = settings(&self.picture, &scene, Quality::Final, file);
        let mut cameras = views(&scene, file)?;
        cameras.truncate(usize::from(self.max_cameras));
        let renderer = Renderer::new(&scene.gaussians);
        for (size_idx, size) in self.sizes.iter().enumerate() {
            let plan = self.plan(scene_name(path), size_idx, &base);
            let resized: Vec<_> = cameras.iter().map(|(name, camera)| (name.clone(), resized(camera, *size))).collect();
            cinesplat_bench::measure(&renderer, &resized, &plan, &mut |row| log.add(row))?;
        }
        Ok(())
    }

    /// Settings for one of the sizes.
    fn plan(&self, scene: String, size_idx: usize, base: &RenderSettings) -> BenchPlan {
        let variants = if size_idx == 0 { cinesplat_bench::variants(base) } else { cinesplat_bench::presets(base) };
        BenchPlan { scene, variants, num_repeats: usize::from(self.runs) }
    }

    /// Number of rows of a scene with these cameras.
    fn num_rows(&self, file: Option<&StillCameras>) -> usize {
        let num_cameras = file.map_or(NUM_OWN_VIEWS, |file| file.cameras.len()).min(usize::from(self.max_cameras));
        let at = |size_idx| self.plan(String::new(), size_idx, &RenderSettings::default());
        (0..self.sizes.len()).map(|size_idx| at(size_idx).num_rows(num_cameras)).sum()
    }
}

/// The rows so far; each is printed when it is complete.
struct RowLog {
    rows: Vec<BenchRow>,
    num_rows: usize,
    progress: FrameProgress,
}

impl RowLog {
    fn add(&mut self, row: &BenchRow) {
        let line = cinesplat_bench::to_csv(std::slice::from_ref(row));
        // A closed stdout is reported at the end.
        let _ = console::data(line.split_inclusive('\n').nth(1).unwrap_or_default());
        self.rows.push(row.clone());
        self.progress.show(self.rows.len(), self.num_rows);
    }
}

fn write_all(folder: &BenchFolder, rows: &[BenchRow]) -> Result<(), Failure> {
    folder.write("render.csv", &cinesplat_bench::to_csv(rows))?;
    folder.write("render.md", &cinesplat_bench::to_table(rows))?;
    let Some(size_px) = rows.first().map(|row| row.size_px) else { return Ok(()) };
    for &axis in AccuracyAxis::VARIANTS {
        folder.write(&plot_name(axis), &cinesplat_bench::pareto_svg(rows, size_px, axis))?;
    }
    console::note(&format!("render.csv, render.md and plots: {} rows", rows.len()));
    Ok(())
}

fn plot_name(axis: AccuracyAxis) -> String {
    format!("render.{axis}.svg")
}
