use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec2;

use super::failure::Failure;
use super::scene_args::{PictureArgs, SceneOptions};
use super::{console, outputs};
use crate::cli::progress::FrameProgress;
use crate::export::cameras_json::{self, StillCameras};
use crate::geometry::{Camera, Intrinsics, LevelFrame, Pose};
use crate::render::bench::{self, Axis, BenchRow, BenchSettings};
use crate::render::{Quality, RenderSettings, Renderer};
use crate::scene::Scene;

/// Measures scenes at every preset, every knob alone and every output.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench render room.spz skull.sog --cameras room.cameras.json --cameras auto -o bench
One line of CSV a scene, camera, size and variant on stdout: median and range of the runs and times of the stages in ms,
work counts, PSNR, SSIM and worst pixel against `reference` (free knobs: against `standard`). -o keeps it with tables and
plots. Times are those of pictures in eight bits, as films take them; PSNR and the like are those of the same pictures as
numbers. Outputs (depth, ids, features, weights, lift) are timed at `standard` in turn with color as numbers; times_color
is the median ratio of the two. Knobs are measured at the first size alone, `scalar` there once on one camera.")]
pub(in super::super) struct Args {
    /// Scenes, as for the other commands
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
    /// Cameras of the scene at the same place in the line, the last for all further ones; auto: from the middle of the
    /// scene and from two sides
    #[arg(long, value_name = "CAMERAS.JSON", default_value = "auto")]
    cameras: Vec<PathBuf>,
    /// Sizes of the pictures, or `given` for those of the cameras file; all variants at the first, presets alone at the
    /// others
    #[arg(long, value_name = "WxH,..", default_value = "1280x720", value_delimiter = ',', value_parser = parse_size)]
    sizes: Vec<Option<[u32; 2]>>,
    /// Most cameras of a scene
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    max_cameras: u16,
    /// Runs of every picture, after one that is not counted
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    /// Folder for render.csv, render.md and render.psnr.svg, .ssim.svg, .worst.svg
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    picture: PictureArgs,
}

impl Args {
    pub(in super::super) fn run(self) -> Result<(), Failure> {
        let files: Vec<Option<StillCameras>> =
            self.cameras.iter().map(|path| read_cameras(path)).collect::<Result<_, _>>()?;
        if let Some(folder) = &self.output {
            fs::create_dir_all(folder).map_err(|error| Failure::io(&folder.display().to_string(), &error))?;
        }
        self.picture.bound_threads()?;
        console::data(&bench::to_csv(&[]))?;
        let cameras_of = |idx: usize| files.get(idx.min(files.len() - 1)).and_then(Option::as_ref);
        let num_rows: usize = (0..self.scenes.len()).map(|idx| self.num_rows(cameras_of(idx))).sum();
        let mut log = RowLog { rows: Vec::new(), num_rows, progress: FrameProgress::of_rows() };
        for (idx, path) in self.scenes.iter().enumerate() {
            self.bench_scene(path, cameras_of(idx), &mut log)?;
        }
        log.progress.finish();
        self.output.as_ref().map_or(Ok(()), |folder| write_all(folder, &log.rows))
    }

    /// All cameras and sizes of one scene.
    fn bench_scene(&self, path: &Path, file: Option<&StillCameras>, log: &mut RowLog) -> Result<(), Failure> {
        let scene = self.options.open(path)?.scene;
        let (filter, near) = file.map_or((None, None), |file| (file.filter.as_deref(), file.near));
        let base = self.picture.settings(&scene, Quality::Final, filter, near);
        let mut cameras = match file {
            Some(file) => file.cameras.iter().map(|named| (named.name.clone(), named.camera)).collect(),
            None => own_views(&scene)?,
        };
        cameras.truncate(usize::from(self.max_cameras));
        let renderer = Renderer::new(&scene.gaussians);
        for (size_idx, size) in self.sizes.iter().enumerate() {
            let settings = self.bench_settings(scene_name(path), size_idx, &base);
            let resized: Vec<_> = cameras.iter().map(|(name, camera)| (name.clone(), resized(camera, *size))).collect();
            bench::measure(&renderer, &resized, &settings, &mut |row| log.add(row))?;
        }
        Ok(())
    }

    /// What is measured at one of the sizes.
    fn bench_settings(&self, scene: String, size_idx: usize, base: &RenderSettings) -> BenchSettings {
        let variants = if size_idx == 0 { bench::variants(base) } else { bench::presets(base) };
        BenchSettings { scene, variants, num_repeats: usize::from(self.runs) }
    }

    /// Rows of a scene with these cameras.
    fn num_rows(&self, file: Option<&StillCameras>) -> usize {
        let num_cameras = file.map_or(NUM_OWN_VIEWS, |file| file.cameras.len()).min(usize::from(self.max_cameras));
        let at = |size_idx| self.bench_settings(String::new(), size_idx, &RenderSettings::default());
        (0..self.sizes.len()).map(|size_idx| at(size_idx).num_rows(num_cameras)).sum()
    }
}

/// The rows so far; each is written as it comes.
struct RowLog {
    rows: Vec<BenchRow>,
    num_rows: usize,
    progress: FrameProgress,
}

impl RowLog {
    fn add(&mut self, row: &BenchRow) {
        let line = bench::to_csv(std::slice::from_ref(row));
        // A reader that has gone is told of at the end.
        let _ = console::data(line.split_inclusive('\n').nth(1).unwrap_or_default());
        self.rows.push(row.clone());
        self.progress.show(self.rows.len(), self.num_rows);
    }
}

pub(super) fn read_cameras(path: &Path) -> Result<Option<StillCameras>, Failure> {
    if path == Path::new("auto") {
        return Ok(None);
    }
    let text = outputs::read_text(path)?;
    let read = cameras_json::read(&text).map_err(|error| Failure::from(error).in_file(path))?;
    Ok(Some(read))
}

/// The scene's file name without its last extension; of `scene.spz` and `meta.json` the folder's, with the number of
/// its level where it is only that.
pub(super) fn scene_name(path: &Path) -> String {
    let stem = |path: &Path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let parent = || path.parent().map(stem).filter(|name| !name.is_empty());
    let name = stem(path);
    let is_number = !name.is_empty() && name.chars().all(|c| c.is_ascii_digit() || c == '_');
    match parent() {
        Some(folder) if name == "scene" || name == "meta" => folder,
        Some(folder) if is_number => format!("{folder} {name}"),
        _ => name.replace(',', " "),
    }
}

/// The picture of a camera at another size: its height decides the scale, the width is cut or widened evenly.
pub(super) fn resized(camera: &Camera, size: Option<[u32; 2]>) -> Camera {
    let Some([width, height]) = size else { return *camera };
    let given = camera.intrinsics;
    let scale = f64::from(height) / f64::from(given.height);
    let intrinsics = Intrinsics {
        width,
        height,
        fx_px: given.fx_px * scale,
        fy_px: given.fy_px * scale,
        cx_px: (given.cx_px - f64::from(given.width) / 2.0) * scale + f64::from(width) / 2.0,
        cy_px: given.cy_px * scale,
    };
    Camera { pose: camera.pose, intrinsics }
}

/// Cameras that [`own_views`] makes.
const NUM_OWN_VIEWS: usize = 3;

/// One level view from the middle of the scene and two from outside, a quarter turn apart, 16:9 with 60 degrees.
pub(super) fn own_views(scene: &Scene) -> Result<Vec<(String, Camera)>, Failure> {
    let level = LevelFrame::new(scene.up)?;
    let intrinsics = Intrinsics::from_fov_y(1280, 720, 60_f64.to_radians());
    let bounds = scene.bounds();
    let axis = level.up.any_orthonormal_vector();
    let view = |name: &str, heading: DVec2, distance: f64, rise: f64| {
        let outward = axis * heading.x + level.up.cross(axis) * heading.y;
        let eye = bounds.center() + (outward + level.up * rise) * distance * bounds.size();
        let forward = if distance > 0.0 { bounds.center() - eye } else { outward };
        (name.to_owned(), Camera { pose: Pose::facing(eye, forward, level.up, None), intrinsics })
    };
    Ok(vec![view("front", DVec2::X, 0.7, 0.2), view("side", DVec2::Y, 0.9, 0.4), view("middle", DVec2::X, 0.0, 0.0)])
}

fn write_all(folder: &Path, rows: &[BenchRow]) -> Result<(), Failure> {
    outputs::write(&folder.join("render.csv"), bench::to_csv(rows).as_bytes())?;
    outputs::write(&folder.join("render.md"), bench::to_table(rows).as_bytes())?;
    let Some(size_px) = rows.first().map(|row| row.size_px) else { return Ok(()) };
    for axis in Axis::ALL {
        let svg = bench::pareto_svg(rows, size_px, axis);
        outputs::write(&folder.join(format!("render.{}.svg", axis.name())), svg.as_bytes())?;
    }
    console::note(&format!("{}: render.csv, render.md and plots of {} rows", folder.display(), rows.len()));
    Ok(())
}

pub(super) fn parse_size(text: &str) -> Result<Option<[u32; 2]>, String> {
    if text == "given" {
        return Ok(None);
    }
    let number = |digits: &str| digits.parse::<u32>().ok().filter(|n| (16..=16384).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| Some([number(width)?, number(height)?]));
    size.map(Some).ok_or_else(|| "expected WIDTHxHEIGHT in pixels such as 1280x720, or given".to_owned())
}
