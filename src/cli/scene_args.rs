use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;

use super::choice::choice;
use super::failure::Failure;
use super::{console, heading, memory};
use cinesplat::export::cameras_json::FilterChoice;
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline::{self, OpenedScene};
use cinesplat::render::{ColorClamp, Quality, RenderSettings, SortMode};
use cinesplat::scene::{Limits, LoadOptions, SURE_PERCENT, Scene, SplatFilter, UpSource, up_flag};

/// A scene and the options for reading it.
#[derive(Debug, Clone, Args)]
pub(super) struct SceneArgs {
    /// Scene file (.ply .spz .sog .splat .ksplat .glb .pcd), SOG folder, or synth:demo
    ///
    /// Generated scenes are synth:demo, synth:room:SEED and synth:tabletop:SEED, with an optional share of the full
    /// number of Gaussians, such as synth:room:7:0.2.
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
    #[command(flatten)]
    options: SceneOptions,
}

/// Options for reading scenes.
#[derive(Debug, Clone, Args)]
pub(super) struct SceneOptions {
    /// World up axis [default: from the file, else estimated]
    ///
    /// Three numbers, such as 0,-1,0.
    #[arg(long, value_name = "X,Y,Z", help_heading = heading::SCENE, value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Largest number of Gaussians to read
    #[arg(long, value_name = "N", help_heading = heading::SCENE, hide_short_help = true, default_value_t = Limits::DEFAULT.gaussians)]
    max_gaussians: usize,
    /// Largest file to read in bytes, packed or unpacked
    #[arg(long, value_name = "N", help_heading = heading::SCENE, hide_short_help = true, default_value_t = Limits::DEFAULT.scene_bytes)]
    max_file_bytes: u64,
}

impl SceneOptions {
    /// Opens a scene and prints its notes, such as the number of dropped Gaussians.
    pub(super) fn open(&self, scene: &Path) -> Result<OpenedScene, Failure> {
        let limits = Limits { scene_bytes: self.max_file_bytes, gaussians: self.max_gaussians, ..Limits::DEFAULT };
        let options = LoadOptions { up: self.up, limits: memory::reading(limits) };
        let source = pipeline::open_scene(scene, &options)?;
        for note in &source.scene.notes {
            console::note(&format!("scene: {note}"));
        }
        Ok(source)
    }
}

impl SceneArgs {
    /// Opens the scene and prints notes.
    pub(super) fn open(&self) -> Result<OpenedScene, Failure> {
        self.options.open(&self.scene)
    }

    /// Opens the scene with its objects: those of `file`, else those of the scene itself, else those that a search
    /// finds. The up axis is that of `--up`, else of `file`, else of the scene.
    pub(super) fn open_with_objects(&self, file: Option<&Path>) -> Result<(Scene, ObjectSet), Failure> {
        let opened = self.open()?;
        let is_searched = file.is_none() && opened.needs_search();
        let num_printed = opened.scene.notes.len();
        let (scene, set) = opened.with_objects(file)?;
        console::warnings(scene.notes.iter().skip(num_printed));
        if is_searched {
            console::note(&format!("objects: found {} (no file of objects is given)", set.objects.len()));
        }
        print_up(&scene);
        Ok((scene, set))
    }
}

/// Prints the up axis and its source.
pub(super) fn print_up(scene: &Scene) {
    print_up_of(scene.up, &scene.up_source.to_string());
    if let UpSource::Estimated(percent) = scene.up_source
        && percent < SURE_PERCENT
    {
        let others =
            scene.up_candidates().into_iter().filter(|c| c.confidence_percent > 0 && c.up.dot(scene.up) < SAME_UP_COS);
        let others = others.take(NUM_OTHERS);
        let others: Vec<String> = others.map(|c| format!("{} ({} %)", up_flag(c.up), c.confidence_percent)).collect();
        let turn = if others.is_empty() { String::new() } else { format!(", or type {}", others.join(" or ")) };
        let chosen = up_flag(scene.up);
        console::note(&format!("up is a guess: keep it with {chosen}{turn}; `cinesplat objects --sheet` shows them"));
    }
}

/// Cosine of 15 degrees: closer directions are one.
const SAME_UP_COS: f64 = 0.965_925_826;

/// Number of other directions that the program names if up is a guess.
const NUM_OTHERS: usize = 3;

/// As [`print_up`], for a direction from elsewhere.
pub(super) fn print_up_of(up: DVec3, source: &str) {
    let [x, y, z] = up.to_array();
    console::note(&format!("up: {x:.3} {y:.3} {z:.3} ({source})"));
}

/// How pictures are rendered.
#[derive(Debug, Clone, Args)]
pub(super) struct PictureArgs {
    /// Accuracy [default: standard; final for stills]
    ///
    /// `reference` renders the exact picture in double precision, `final` the same in single precision. `standard` and
    /// `draft` are faster; the program prints how accurate they are.
    #[arg(long, value_name = "QUALITY", help_heading = heading::PICTURE, value_parser = choice::<Quality>())]
    quality: Option<Quality>,
    /// Splat filter [default: auto]
    ///
    /// `auto` takes the filter that the scene's file names, else `classic`. `mip` lowers the opacity of splats
    /// that the dilation enlarges.
    #[arg(long, value_name = "FILTER", help_heading = heading::PICTURE, hide_short_help = true, value_parser = choice::<FilterChoice>())]
    filter: Option<FilterChoice>,
    /// Order of blending [default: z]
    ///
    /// `z` sorts by depth, as scenes are trained. `ray` sorts by distance: no splat pops while the camera turns.
    #[arg(long, value_name = "ORDER", help_heading = heading::PICTURE, hide_short_help = true, value_parser = choice::<SortMode>())]
    sort: Option<SortMode>,
    /// Where colors are clamped to their range [default: trained]
    ///
    /// `trained` clamps once, in the finished picture. `khr` clamps every Gaussian, as the glTF extension for splats
    /// defines it.
    #[arg(long, value_name = "MODE", help_heading = heading::PICTURE, hide_short_help = true, value_parser = choice::<ColorClamp>())]
    color_clamp: Option<ColorClamp>,
    /// Near plane in scene units [default: 0.01 of the scene size, at most 0.2]
    #[arg(long, value_name = "DISTANCE", help_heading = heading::PICTURE, hide_short_help = true, value_parser = parse_distance)]
    near: Option<f64>,
    /// Threads to render with [default: one per core]
    #[arg(long, value_name = "N", help_heading = heading::PICTURE, hide_short_help = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl PictureArgs {
    /// Bounds the number of threads of everything that follows; call it before any work.
    pub(super) fn bound_threads(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|_| Failure::no_threads())
    }

    /// The flags that are given, for a table: `quality Final near 0.1`.
    pub(super) fn given(&self) -> String {
        let Self { quality, filter, sort, color_clamp, near, threads } = self;
        let flags = [
            quality.map(|quality| format!("quality {quality:?}")),
            filter.map(|filter| format!("filter {filter:?}")),
            sort.map(|sort| format!("sort {sort:?}")),
            color_clamp.map(|clamp| format!("clamp {clamp:?}")),
            near.map(|near| format!("near {near}")),
            threads.map(|threads| format!("threads {threads}")),
        ];
        flags.into_iter().flatten().collect::<Vec<_>>().join(" ")
    }

    /// Settings for a scene. `filter` and `near` come from a cameras file; a flag takes precedence over them.
    pub(super) fn settings(
        &self,
        scene: &Scene,
        default: Quality,
        filter: Option<FilterChoice>,
        near: Option<f64>,
    ) -> RenderSettings {
        let defaults = RenderSettings::for_scene(scene);
        let filter = match self.filter.or(filter).unwrap_or_default() {
            FilterChoice::Auto => defaults.filter,
            FilterChoice::Classic => SplatFilter::Classic,
            FilterChoice::Mip if defaults.filter == SplatFilter::MipSmall => SplatFilter::MipSmall,
            FilterChoice::Mip => SplatFilter::Mip,
        };
        let near = self.near.or(near).unwrap_or(defaults.near);
        let (quality, sort) = (self.quality.unwrap_or(default), self.sort.unwrap_or(defaults.sort));
        let color_clamp = self.color_clamp.unwrap_or(defaults.color_clamp);
        let limits = memory::rendering(defaults.limits);
        RenderSettings { quality, filter, near, sort, color_clamp, limits, ..defaults }
    }
}

fn parse_distance(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|near: &f64| *near >= 0.0 && near.is_finite())
        .ok_or("expected a distance, 0 or more".to_owned())
}

pub(super) fn parse_vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let vector = numbers.ok().and_then(|numbers| <[f64; 3]>::try_from(numbers).ok()).map(DVec3::from_array);
    let usable = vector.filter(|vector| vector.is_finite() && vector.length() > 0.0);
    usable.ok_or_else(|| "expected three numbers separated by commas, not all 0, such as 0,-1,0".to_owned())
}
