use std::fmt::Write as _;
use std::time::Duration;

use super::{BenchRow, Kind};

/// The rows as CSV with a header; times in ms, `psnr_db` against the spec image or, for free knobs, against `standard`.
pub fn to_csv(rows: &[BenchRow]) -> String {
    let mut csv = String::from(
        "scene,camera,width,height,kind,variant,threads,median_ms,min_ms,max_ms,project_ms,sort_ms,bin_ms,blend_ms,\
         projected,splats,pairs,block_blends,psnr_db,ssim,worst\n",
    );
    rows.iter().for_each(|row| csv.push_str(&line(row)));
    csv
}

fn line(row: &BenchRow) -> String {
    let (times, counts, [low, high]) = (&row.timed.stats.times, &row.timed.stats.counts, row.timed.range);
    let times = [row.timed.median, low, high, times.project, times.sort, times.bin, times.blend];
    let times: Vec<String> = times.iter().map(|time| format!("{:.3}", ms(*time))).collect();
    format!(
        "{},{},{},{},{},{},{},{},{},{},{},{},{:.2},{:.6},{:.5}\n",
        row.scene,
        row.camera,
        row.size_px[0],
        row.size_px[1],
        row.kind.name(),
        row.variant,
        row.num_threads,
        times.join(","),
        counts.num_projected,
        counts.num_splats,
        counts.num_pairs,
        counts.num_block_blends,
        row.difference.psnr_db,
        row.difference.ssim,
        row.difference.worst,
    )
}

/// A Markdown table of the presets, one line a scene and size: median time over the cameras and the worst camera's
/// figures; behind it what the free knobs lost.
pub fn to_table(rows: &[BenchRow]) -> String {
    let mut table = String::from(
        "| scene | size | preset | ms a frame | PSNR, dB | SSIM | worst pixel |\n|---|---|---|---|---|---|---|\n",
    );
    let presets: Vec<&BenchRow> = rows.iter().filter(|row| row.kind == Kind::Preset).collect();
    for group in groups(&presets) {
        let Some(first) = group.first() else { continue };
        let mut times: Vec<f64> = group.iter().map(|row| ms(row.timed.median)).collect();
        times.sort_by(f64::total_cmp);
        let least = |value: fn(&BenchRow) -> f64| group.iter().map(|row| value(row)).fold(f64::INFINITY, f64::min);
        let worst = group.iter().map(|row| row.difference.worst).fold(0.0, f64::max);
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "| {} | {}x{} | {} | {:.1} | {:.1} | {:.4} | {worst:.3} |",
            first.scene,
            first.size_px[0],
            first.size_px[1],
            first.variant,
            times[times.len() / 2],
            least(|row| row.difference.psnr_db),
            least(|row| row.difference.ssim),
        );
    }
    let free: Vec<&BenchRow> = rows.iter().filter(|row| row.kind == Kind::Free).collect();
    let num_equal = free.iter().filter(|row| row.difference.psnr_db == f64::INFINITY).count();
    let _ = writeln!(
        table,
        "\nFree knobs (threads, instruction sets): {num_equal} of {} pictures equal to those of `standard` to the bit.",
        free.len()
    );
    table
}

/// Rows of one scene, size and variant together, in the order of their first.
fn groups<'a>(rows: &[&'a BenchRow]) -> Vec<Vec<&'a BenchRow>> {
    let mut groups: Vec<Vec<&BenchRow>> = Vec::new();
    let key = |row: &BenchRow| (row.scene.clone(), row.size_px, row.variant.clone());
    for &row in rows {
        match groups.iter_mut().find(|group| key(group[0]) == key(row)) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    groups
}

/// Milliseconds.
pub(super) fn ms(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
