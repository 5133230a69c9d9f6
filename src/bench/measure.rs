use std::time::Duration;

use super::output::{OutputBuffers, RenderOutput};
use super::{Difference, KnobKind, Variant};
use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer};

/// The variants to measure, and the number of runs.
#[derive(Debug, Clone)]
pub struct BenchPlan {
    /// Name of the scene, for the rows.
    pub scene: String,
    /// The variants to measure.
    pub variants: Vec<Variant>,
    /// Timed runs per row, after one warm-up run.
    pub num_repeats: usize,
}

/// The measurement of one variant with one camera.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchRow {
    /// The scene.
    pub scene: String,
    /// The camera.
    pub camera: String,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The knob of the variant.
    pub kind: KnobKind,
    /// Name of the variant: the value of the knob.
    pub variant: String,
    /// Number of threads.
    pub num_threads: usize,
    /// Times of the runs.
    pub timing: Timing,
    /// For [`KnobKind::Output`]: ratio to the time of color in `f32`, measured alternately; median over the runs.
    pub times_color: Option<f64>,
    /// Difference of the picture in `f32` from the spec image, for [`KnobKind::Free`] from the picture of `standard`; all
    /// NaN for [`KnobKind::Output`].
    pub difference: Difference,
}

/// Times of repeated runs of the same picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median wall time.
    pub median: Duration,
    /// Shortest and longest wall time.
    pub range: [Duration; 2],
    /// Stage times and counters of the run with the median time; zeros for outputs that do not report them.
    pub stats: RenderStats,
}

impl BenchPlan {
    /// Number of rows that [`measure`] returns.
    pub fn num_rows(&self, num_cameras: usize) -> usize {
        let rows = |variant: &Variant| if variant.is_slow { num_cameras.min(1) } else { num_cameras };
        self.variants.iter().map(rows).sum()
    }
}

/// The pictures of one camera that variants are compared with.
struct Baselines {
    spec: Frame,
    standard: Frame,
}

/// Measures every variant with every camera; slow variants once, with the first camera. Calls `on_row` with every row.
///
/// # Errors
/// [`RenderError`] of the first picture that cannot be rendered.
pub fn measure(
    renderer: &Renderer<'_>,
    cameras: &[(String, Camera)],
    plan: &BenchPlan,
    on_row: &mut dyn FnMut(&BenchRow),
) -> Result<Vec<BenchRow>, RenderError> {
    let mut rows = Vec::new();
    let mut outputs = OutputBuffers::new(renderer.num_gaussians());
    for (camera_idx, (name, camera)) in cameras.iter().enumerate() {
        let as_preset = |quality| {
            let first = plan.variants.first().map_or_else(RenderSettings::default, |variant| variant.settings);
            renderer.render(camera, &RenderSettings { quality, accuracy: None, ..first })
        };
        let baselines = Baselines { spec: as_preset(Quality::Reference)?, standard: as_preset(Quality::Standard)? };
        for variant in plan.variants.iter().filter(|variant| camera_idx == 0 || !variant.is_slow) {
            let num_repeats = if variant.is_slow { 1 } else { plan.num_repeats };
            let mut work = || row(renderer, camera, (variant, num_repeats), &baselines, &mut outputs);
            let (mut row, num_threads) = match variant.num_threads.and_then(pool_of) {
                Some(pool) => (pool.install(work)?, pool.current_num_threads()),
                None => (work()?, rayon::current_num_threads()),
            };
            (row.scene, row.camera, row.num_threads) = (plan.scene.clone(), name.clone(), num_threads);
            on_row(&row);
            rows.push(row);
        }
    }
    Ok(rows)
}

/// The row of one variant, without the names of scene and camera.
fn row(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (variant, num_repeats): (&Variant, usize),
    baselines: &Baselines,
    outputs: &mut OutputBuffers,
) -> Result<BenchRow, RenderError> {
    let settings = &variant.settings;
    let mut difference = Difference::UNKNOWN;
    if variant.kind != KnobKind::Output {
        outputs.time(renderer, camera, settings, RenderOutput::Color)?;
        let other = if variant.kind == KnobKind::Free { &baselines.standard } else { &baselines.spec };
        difference = super::difference(&outputs.frame, other);
    }
    let (timed, times_color) = if variant.kind == KnobKind::Output {
        let (timed, times_color) = time_beside_color(renderer, camera, (variant, num_repeats), outputs)?;
        (timed, Some(times_color))
    } else {
        let mut work = || outputs.time(renderer, camera, settings, variant.output);
        (time_runs(num_repeats, &mut work)?, None)
    };
    Ok(BenchRow {
        scene: String::new(),
        camera: String::new(),
        size_px: [camera.intrinsics.width, camera.intrinsics.height],
        kind: variant.kind,
        variant: variant.name.clone(),
        num_threads: 0,
        timing: timed,
        times_color,
        difference,
    })
}

/// A new thread pool; `None`, and the current pool is used, if the system cannot start the threads.
fn pool_of(num_threads: usize) -> Option<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().ok()
}

/// Times an output and color in `f32` alternately, so that other load on the machine affects both. Also returns the
/// median ratio of neighboring times.
fn time_beside_color(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (variant, num_repeats): (&Variant, usize),
    outputs: &mut OutputBuffers,
) -> Result<(Timing, f64), RenderError> {
    let mut ratios = Vec::new();
    let mut work = || {
        let (color_secs, _) = outputs.time(renderer, camera, &variant.settings, RenderOutput::Color)?;
        let (secs, stats) = outputs.time(renderer, camera, &variant.settings, variant.output)?;
        ratios.push(secs / color_secs);
        Ok((secs, stats))
    };
    let timed = time_runs(num_repeats, &mut work)?;
    // The first pair is the warm-up.
    ratios.remove(0);
    ratios.sort_by(f64::total_cmp);
    Ok((timed, ratios[ratios.len() / 2]))
}

/// Times color in `f32`: one warm-up run and then `num_repeats` runs, at least one.
///
/// # Errors
/// Those of [`Renderer::render`].
pub(super) fn time(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (settings, num_repeats): (&RenderSettings, usize),
) -> Result<Timing, RenderError> {
    let mut outputs = OutputBuffers::new(0);
    time_runs(num_repeats, &mut || outputs.time(renderer, camera, settings, RenderOutput::Color))
}

/// Runs `work` once to warm up and then `num_repeats` times, at least once. `work` returns the seconds that it took.
fn time_runs(
    num_repeats: usize,
    work: &mut dyn FnMut() -> Result<(f64, RenderStats), RenderError>,
) -> Result<Timing, RenderError> {
    work()?;
    let mut timed = Vec::new();
    for _ in 0..num_repeats.max(1) {
        let (secs, stats) = work()?;
        timed.push((Duration::from_secs_f64(secs), stats));
    }
    timed.sort_by_key(|(elapsed, _)| *elapsed);
    let (median, stats) = timed[timed.len() / 2];
    Ok(Timing { median, range: [timed[0].0, timed[timed.len() - 1].0], stats })
}
