use std::fmt::Write as _;
use std::time::Duration;

use super::{BenchRow, KnobKind};

/// The rows as CSV with a header. Times are in ms; `times_color` is empty except for outputs; `psnr_db` is against the
/// spec image, for free knobs against `standard`.
pub fn to_csv(rows: &[BenchRow]) -> String {
    let mut csv = String::from(
        "scene,camera,width,height,kind,variant,threads,median_ms,min_ms,max_ms,project_ms,sort_ms,bin_ms,blend_ms,\
         projected,splats,pairs,block_blends,psnr_db,ssim,worst,times_color\n",
    );
    rows.iter().for_each(|row| csv.push_str(&line(row)));
    csv
}

fn line(row: &BenchRow) -> String {
    let (times, counts, [low, high]) = (&row.timing.stats.times, &row.timing.stats.counts, row.timing.range);
    let times = [row.timing.median, low, high, times.project, times.sort, times.bin, times.blend];
    let times: Vec<String> = times.iter().map(|time| format!("{:.3}", ms(*time))).collect();
    // Unknown values are empty.
    let known = |value: f64, decimals: usize| {
        if value.is_nan() { String::new() } else { format!("{value:.decimals$}") }
    };
    format!(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
        row.scene,
        row.camera,
        row.size_px[0],
        row.size_px[1],
        row.kind.as_ref(),
        row.variant,
        row.num_threads,
        times.join(","),
        counts.num_projected,
        counts.num_splats,
        counts.num_pairs,
        counts.num_block_blends,
        known(row.difference.psnr_db, 2),
        known(row.difference.ssim, 6),
        known(row.difference.worst, 5),
        known(row.times_color.unwrap_or(f64::NAN), 3),
    )
}

/// Markdown: a table of the presets, one line per scene, size and preset, with the median time over the cameras and the
/// accuracy of the worst camera; dominated presets; a table of the outputs; and the number of free knobs with an equal
/// picture.
pub fn to_table(rows: &[BenchRow]) -> String {
    let of_kind = |kind: KnobKind| rows.iter().filter(|row| row.kind == kind).collect::<Vec<&BenchRow>>();
    let (presets, outputs, free) = (of_kind(KnobKind::Preset), of_kind(KnobKind::Output), of_kind(KnobKind::Free));
    let mut table = presets_table(&presets);
    let dominated = dominated(&presets);
    let found = if dominated.is_empty() { "none".to_owned() } else { dominated.join("; ") };
    let num_equal = free.iter().filter(|row| row.difference.psnr_db == f64::INFINITY).count();
    // Writing to a string cannot fail.
    let _ = writeln!(table, "\nPresets dominated in time and PSNR by another of the same scene and size: {found}.\n");
    table.push_str(&outputs_table(&outputs));
    let _ = writeln!(
        table,
        "\nFree knobs (depth order, threads, SIMD): {num_equal} of {} pictures equal those of `standard` bit by bit.",
        free.len()
    );
    table
}

fn presets_table(presets: &[&BenchRow]) -> String {
    let mut table = String::from(
        "Times are those of 8-bit pictures, as in films; PSNR, SSIM and worst pixel are those of the same pictures in \
         `f32`.\n\n\
         | scene | size | preset | ms per frame | PSNR, dB | SSIM | worst pixel |\n|---|---|---|---|---|---|---|\n",
    );
    for group in groups(presets) {
        let least = |value: fn(&BenchRow) -> f64| group.iter().map(|row| value(row)).fold(f64::INFINITY, f64::min);
        let worst = group.iter().map(|row| row.difference.worst).fold(0.0, f64::max);
        let _ = writeln!(
            table,
            "| {} | {:.1} | {:.1} | {:.4} | {worst:.3} |",
            cells(group[0]),
            median(group.iter().map(|row| ms(row.timing.median))),
            least(|row| row.difference.psnr_db),
            least(|row| row.difference.ssim),
        );
    }
    table
}

fn outputs_table(outputs: &[&BenchRow]) -> String {
    let mut table = String::from(
        "Outputs at `standard`; the factor is the ratio to the time of color in `f32`, measured alternately.\n\n\
         | scene | size | output | ms per frame | x color |\n|---|---|---|---|---|\n",
    );
    for group in groups(outputs) {
        let _ = writeln!(
            table,
            "| {} | {:.1} | {:.2} |",
            cells(group[0]),
            median(group.iter().map(|row| ms(row.timing.median))),
            median(group.iter().filter_map(|row| row.times_color)),
        );
    }
    table
}

/// Scene, size and variant as table cells.
fn cells(row: &BenchRow) -> String {
    format!("{} | {}x{} | {}", row.scene, row.size_px[0], row.size_px[1], row.variant)
}

/// Presets that another preset of the same scene and size dominates: it takes no longer and is at least as accurate.
fn dominated(presets: &[&BenchRow]) -> Vec<String> {
    let groups = groups(presets);
    let time = |group: &[&BenchRow]| median(group.iter().map(|row| ms(row.timing.median)));
    let psnr_db = |group: &[&BenchRow]| group.iter().map(|row| row.difference.psnr_db).fold(f64::INFINITY, f64::min);
    let beats = |a: &[&BenchRow], b: &[&BenchRow]| {
        let is_same = (&a[0].scene, a[0].size_px) == (&b[0].scene, b[0].size_px) && a[0].variant != b[0].variant;
        is_same && time(a) <= time(b) && psnr_db(a) >= psnr_db(b)
    };
    let pairs = groups.iter().flat_map(|b| groups.iter().filter(move |a| beats(a, b)).map(move |a| (a, b)));
    pairs
        .map(|(a, b)| {
            let [width, height] = b[0].size_px;
            format!("{} at {width}x{height}: {} by {}", b[0].scene, b[0].variant, a[0].variant)
        })
        .collect()
}

/// The median, the upper one of two middle values; 0 for no values.
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// Groups of rows with the same scene, size and variant, in order of first appearance. No group is empty.
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
