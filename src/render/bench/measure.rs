use std::time::{Duration, Instant};

use super::super::{Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer};
use super::{Difference, Kind, Variant, difference};
use crate::geometry::Camera;

/// What is measured and how often.
#[derive(Debug, Clone)]
pub struct BenchSettings {
    /// Name of the scene in the rows.
    pub scene: String,
    /// What is measured.
    pub variants: Vec<Variant>,
    /// Timed pictures a row, after one that warms up.
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
    pub kind: Kind,
    /// How far.
    pub variant: String,
    /// Threads it ran on.
    pub num_threads: usize,
    /// How long it took.
    pub timed: Timed,
    /// Against the spec image; a free knob against the picture of `standard`.
    pub difference: Difference,
}

/// Times of the same picture, several times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// Median wall time.
    pub median: Duration,
    /// Shortest and longest wall time.
    pub range: [Duration; 2],
    /// Stages and counts of the picture with the median time.
    pub stats: RenderStats,
}

/// Measures every variant on every camera; `tell` hears of every row.
///
/// # Errors
/// [`RenderError`] of the first picture that cannot be rendered.
pub fn measure(
    renderer: &Renderer<'_>,
    cameras: &[(String, Camera)],
    settings: &BenchSettings,
    tell: &mut dyn FnMut(&BenchRow),
) -> Result<Vec<BenchRow>, RenderError> {
    let mut rows = Vec::new();
    let mut frame = Frame::default();
    for (name, camera) in cameras {
        let as_preset = |quality| {
            let first = settings.variants.first().map_or_else(RenderSettings::default, |variant| variant.settings);
            renderer.render(camera, &RenderSettings { quality, accuracy: None, ..first })
        };
        let (spec, standard) = (as_preset(Quality::Reference)?, as_preset(Quality::Standard)?);
        for variant in &settings.variants {
            let mut work = || time(renderer, camera, (&variant.settings, settings.num_repeats), &mut frame);
            let (timed, num_threads) = match variant.num_threads.and_then(pool_of) {
                Some(pool) => (pool.install(work)?, pool.current_num_threads()),
                None => (work()?, rayon::current_num_threads()),
            };
            let against = if variant.kind == Kind::Free { &standard } else { &spec };
            let row = BenchRow {
                scene: settings.scene.clone(),
                camera: name.clone(),
                size_px: [frame.width, frame.height],
                kind: variant.kind,
                variant: variant.name.clone(),
                num_threads,
                timed,
                difference: difference(&frame, against),
            };
            tell(&row);
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Threads of their own; `None` where the machine gives none, and the current ones do.
fn pool_of(num_threads: usize) -> Option<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().num_threads(num_threads).build().ok()
}

/// Renders once to warm up and then `num_repeats` times, at least once.
///
/// # Errors
/// As [`Renderer::render`].
pub fn time(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (settings, num_repeats): (&RenderSettings, usize),
    frame: &mut Frame,
) -> Result<Timed, RenderError> {
    renderer.render_into(camera, settings, frame)?;
    let mut timed = Vec::new();
    for _ in 0..num_repeats.max(1) {
        let start = Instant::now();
        renderer.render_into(camera, settings, frame)?;
        timed.push((start.elapsed(), frame.stats));
    }
    timed.sort_by_key(|(elapsed, _)| *elapsed);
    let (median, stats) = timed[timed.len() / 2];
    Ok(Timed { median, range: [timed[0].0, timed[timed.len() - 1].0], stats })
}
