use std::time::Duration;

use super::output::{OutputBuffers, RenderOutput};
use super::{Difference, KnobKind, Variant};
use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer};

/// What is measured and how often.
#[derive(Debug, Clone)]
pub struct BenchPlan {
    /// Name of the scene in the rows.
    pub scene: String,
    /// What is measured.
    pub variants: Vec<Variant>,
    /// Timing pictures a row, after one that warms up.
    pub num_repeats: usize,
}

/// One camera at one variant.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchRow {
    /// The scene.
    pub scene: String,
    /// The camera.
    pub camera: String,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// What the variant turns.
    pub kind: KnobKind,
    /// How far.
    pub variant: String,
    /// Threads it ran on.
    pub num_threads: usize,
    /// How long it took.
    pub timed: Timing,
    /// Of an output: its time over that of color as numbers, the two in turn; the median of the pairs.
    pub times_color: Option<f64>,
    /// Of the picture as numbers against the spec image, of a free knob against the picture of `standard`; all NaN for
    /// an output.
    pub difference: Difference,
}

/// Times of the same picture, several times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median wall time.
    pub median: Duration,
    /// Shortest and longest wall time.
    pub range: [Duration; 2],
    /// Stages and counts of the picture with the median time; zeros for outputs that do not tell.
    pub stats: RenderStats,
}

impl BenchPlan {
    /// Rows that [`measure`] leaves.
    pub fn num_rows(&self, num_cameras: usize) -> usize {
        let rows = |variant: &Variant| if variant.is_slow { num_cameras.min(1) } else { num_cameras };
        self.variants.iter().map(rows).sum()
    }
}

/// The pictures of one camera that others are held against.
struct Against {
    spec: Frame,
    standard: Frame,
}

/// Measures every variant on every camera, slow ones once on the first; `tell` hears of every row.
///
/// # Errors
/// [`RenderError`] of the first picture that cannot be rendered.
pub fn measure(
    renderer: &Renderer<'_>,
    cameras: &[(String, Camera)],
    plan: &BenchPlan,
    tell: &mut dyn FnMut(&BenchRow),
) -> Result<Vec<BenchRow>, RenderError> {
    let mut rows = Vec::new();
    let mut outputs = OutputBuffers::new(renderer.num_gaussians());
    for (camera_idx, (name, camera)) in cameras.iter().enumerate() {
        let as_preset = |quality| {
            let first = plan.variants.first().map_or_else(RenderSettings::default, |variant| variant.settings);
            renderer.render(camera, &RenderSettings { quality, accuracy: None, ..first })
        };
        let against = Against { spec: as_preset(Quality::Reference)?, standard: as_preset(Quality::Standard)? };
        for variant in plan.variants.iter().filter(|variant| camera_idx == 0 || !variant.is_slow) {
            let num_repeats = if variant.is_slow { 1 } else { plan.num_repeats };
            let mut work = || row(renderer, camera, (variant, num_repeats), &against, &mut outputs);
            let (mut row, num_threads) = match variant.num_threads.and_then(pool_of) {
                Some(pool) => (pool.install(work)?, pool.current_num_threads()),
                None => (work()?, rayon::current_num_threads()),
            };
            (row.scene, row.camera, row.num_threads) = (plan.scene.clone(), name.clone(), num_threads);
            tell(&row);
            rows.push(row);
        }
    }
    Ok(rows)
}

/// The row of one variant, yet without names.
fn row(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (variant, num_repeats): (&Variant, usize),
    against: &Against,
    outputs: &mut OutputBuffers,
) -> Result<BenchRow, RenderError> {
    let settings = &variant.settings;
    let mut difference = Difference::UNKNOWN;
    if variant.kind != KnobKind::Output {
        outputs.time(renderer, camera, settings, RenderOutput::Color)?;
        let other = if variant.kind == KnobKind::Free { &against.standard } else { &against.spec };
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
        timed,
        times_color,
        difference,
    })
}

/// Threads of their own; `None` where the machine gives none, and the current ones do.
fn pool_of(num_threads: usize) -> Option<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().ok()
}

/// Times an output and color as numbers in turn, so that whatever else the machine does meets both; also the median of
/// the ratios of neighbors.
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
    // The first pair warmed up.
    ratios.remove(0);
    ratios.sort_by(f64::total_cmp);
    Ok((timed, ratios[ratios.len() / 2]))
}

/// Renders once to warm up and then `num_repeats` times, at least once, color as numbers.
///
/// # Errors
/// As [`Renderer::render`].
pub fn time(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (settings, num_repeats): (&RenderSettings, usize),
) -> Result<Timing, RenderError> {
    let mut outputs = OutputBuffers::new(0);
    time_runs(num_repeats, &mut || outputs.time(renderer, camera, settings, RenderOutput::Color))
}

/// Runs work once to warm up and then `num_repeats` times, at least once; it says how many seconds it took.
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
