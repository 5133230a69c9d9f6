//! Accuracy against time: the same cameras at several settings, each timed and held against the spec image.

use std::fmt::Write as _;
use std::time::Duration;

use super::{Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer};
use crate::geometry::Camera;

/// What is measured and how often.
#[derive(Debug, Clone)]
pub struct BenchSettings {
    /// Name and settings of each variant; the first part of a row's name.
    pub variants: Vec<(String, RenderSettings)>,
    /// Timed pictures a row, after one that warms up.
    pub num_repeats: usize,
    /// Whether every row is also held against the spec image, which takes far longer than the rest.
    pub measures_accuracy: bool,
}

/// One camera at one variant.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchRow {
    /// The variant.
    pub variant: String,
    /// The camera.
    pub camera: String,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Threads of the pool it ran on.
    pub num_threads: usize,
    /// Median wall time of a picture.
    pub median: Duration,
    /// Shortest and longest wall time.
    pub range: [Duration; 2],
    /// Stages and counts of the picture with the median time.
    pub stats: RenderStats,
    /// Against the spec image: PSNR in dB (both clamped to 0..=1) and largest difference of a channel.
    pub accuracy: Option<(f64, f64)>,
}

/// Measures every variant on every camera, on the current rayon pool.
///
/// # Errors
/// [`RenderError`] of the first picture that cannot be rendered.
pub fn measure(
    renderer: &Renderer<'_>,
    cameras: &[(String, Camera)],
    settings: &BenchSettings,
) -> Result<Vec<BenchRow>, RenderError> {
    let mut rows = Vec::new();
    let mut frame = Frame::default();
    for (name, camera) in cameras {
        let first = settings.variants.first().filter(|_| settings.measures_accuracy);
        let spec = first.map(|(_, variant)| {
            renderer.render(camera, &RenderSettings { quality: Quality::Reference, accuracy: None, ..*variant })
        });
        let spec = spec.transpose()?;
        for (variant, render_settings) in &settings.variants {
            let timed = time(renderer, camera, (render_settings, settings.num_repeats), &mut frame)?;
            rows.push(BenchRow {
                variant: variant.clone(),
                camera: name.clone(),
                size_px: [frame.width, frame.height],
                num_threads: rayon::current_num_threads(),
                median: timed[timed.len() / 2].0,
                range: [timed[0].0, timed[timed.len() - 1].0],
                stats: timed[timed.len() / 2].1,
                accuracy: spec.as_ref().map(|spec| (frame.psnr_db(spec), largest_difference(&frame, spec))),
            });
        }
    }
    Ok(rows)
}

/// Times of pictures, shortest first, after one that warms up; at least one.
fn time(
    renderer: &Renderer<'_>,
    camera: &Camera,
    (settings, num_repeats): (&RenderSettings, usize),
    frame: &mut Frame,
) -> Result<Vec<(Duration, RenderStats)>, RenderError> {
    renderer.render_into(camera, settings, frame)?;
    let mut timed = Vec::new();
    for _ in 0..num_repeats.max(1) {
        let start = std::time::Instant::now();
        renderer.render_into(camera, settings, frame)?;
        timed.push((start.elapsed(), frame.stats));
    }
    timed.sort_by_key(|(elapsed, _)| *elapsed);
    Ok(timed)
}

fn largest_difference(a: &Frame, b: &Frame) -> f64 {
    let differences = a.rgb.iter().zip(&b.rgb).map(|(a, b)| (a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).abs());
    f64::from(differences.fold(0.0, f32::max))
}

/// The rows as CSV with a header; times in ms.
pub fn to_csv(rows: &[BenchRow]) -> String {
    let mut csv = String::from(
        "variant,camera,width,height,threads,median_ms,min_ms,max_ms,project_ms,sort_ms,bin_ms,blend_ms,\
         projected,splats,pairs,block_blends,psnr_db,max_difference\n",
    );
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    for row in rows {
        let (times, counts, [low, high]) = (&row.stats.times, &row.stats.counts, row.range);
        let accuracy = row.accuracy.map_or_else(|| ",".into(), |(db, largest)| format!("{db:.2},{largest:.5}"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{},{},{},{},{},{:.3},{:.3},{:.3},{:.3},{:.3},{:.3},{:.3},{},{},{},{},{accuracy}",
            row.variant,
            row.camera,
            row.size_px[0],
            row.size_px[1],
            row.num_threads,
            ms(row.median),
            ms(low),
            ms(high),
            ms(times.project),
            ms(times.sort),
            ms(times.bin),
            ms(times.blend),
            counts.num_projected,
            counts.num_splats,
            counts.num_pairs,
            counts.num_block_blends,
        );
    }
    csv
}
