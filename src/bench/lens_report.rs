use super::lens::{LENS_CASES, LensCase, LensMethod, LensRow};
use cinesplat_plot::{Axis, COLORS, Chart, LegendEntry, LegendSymbol, Marker, Series, grid};
use cinesplat_render::Quality;

/// PSNR at which plots clip.
const MAX_DB: f64 = 90.0;
const PANEL_PX: [f64; 2] = [340.0, 280.0];
/// The header of [`lens_csv_line`].
pub const LENS_CSV_HEADER: &str =
    "scene,camera,source,blur_px,quality,method,samples,psnr_db,times_plain,plain_ms,blends_ratio\n";

/// One row as a CSV line.
pub fn lens_csv_line(row: &LensRow) -> String {
    format!(
        "{},{},{},{},{},{},{},{:.2},{:.3},{:.3},{:.3}\n",
        row.scene,
        row.camera,
        row.case.source,
        row.case.blur_px,
        row.quality,
        row.method,
        row.num_samples,
        row.psnr_db,
        row.times_plain,
        row.plain_ms,
        row.blends_ratio,
    )
}

/// The row of a line that [`lens_csv_line`] wrote; `None` for any other line.
pub fn lens_row_of(line: &str) -> Option<LensRow> {
    let fields: Vec<&str> = line.trim_end().split(',').collect();
    let [scene, camera, source, blur_px, quality, method, samples, psnr_db, times_plain, plain_ms, blends_ratio] =
        fields[..]
    else {
        return None;
    };
    Some(LensRow {
        scene: scene.to_owned(),
        camera: camera.to_owned(),
        case: LensCase { source: source.parse().ok()?, blur_px: blur_px.parse().ok()? },
        quality: quality.parse().ok()?,
        method: method.parse().ok()?,
        num_samples: samples.parse().ok()?,
        psnr_db: psnr_db.parse().ok()?,
        times_plain: times_plain.parse().ok()?,
        plain_ms: plain_ms.parse().ok()?,
        blends_ratio: blends_ratio.parse().ok()?,
    })
}

/// One panel per case: PSNR against time, with one line per method and the presets as labeled dots. Means over scenes
/// and cameras.
pub fn lens_svg(rows: &[LensRow]) -> String {
    let cases = LENS_CASES.iter().filter(|case| rows.iter().any(|row| row.case == **case));
    let charts: Vec<Chart> = cases.map(|case| chart(rows, *case)).collect();
    let entry = |(method, color): (LensMethod, &'static str)| LegendEntry {
        name: name(method).to_owned(),
        color,
        symbol: LegendSymbol::Dot,
    };
    let title = "Blur of lens and shutter: accuracy against time";
    grid(title, &methods().map(entry), &charts, 4.min(charts.len().max(1)), PANEL_PX)
}

fn methods() -> [(LensMethod, &'static str); 5] {
    [
        (LensMethod::Plain, COLORS[0]),
        (LensMethod::Sharp, COLORS[1]),
        (LensMethod::Shared, COLORS[3]),
        (LensMethod::Blurred, COLORS[2]),
        (LensMethod::Preset, COLORS[7]),
    ]
}

fn name(method: LensMethod) -> &'static str {
    match method {
        LensMethod::Plain => "no blur",
        LensMethod::Sharp => "sharp samples",
        LensMethod::Shared => "sharp samples of one projection",
        LensMethod::Blurred => "samples with blurred splats",
        LensMethod::Preset => "preset",
    }
}

fn chart(rows: &[LensRow], case: LensCase) -> Chart {
    let title = format!("{} of {} px", case.source, case.blur_px);
    let mut chart = Chart::new(&title, Axis::logarithmic("time, plain picture = 1"), Axis::linear("PSNR, dB"));
    for (method, color) in methods() {
        let points = means(rows.iter().filter(|row| row.case == case && row.method == method));
        let label = |(samples, quality): (usize, Quality)| match method {
            LensMethod::Preset => quality.to_string(),
            LensMethod::Plain => String::new(),
            LensMethod::Sharp | LensMethod::Shared | LensMethod::Blurred => samples.to_string(),
        };
        let mark = |(idx, point): (usize, &Mean)| Marker { label: label(point.key), ..Marker::dot(idx, 3.5) };
        let has_line = matches!(method, LensMethod::Sharp | LensMethod::Shared | LensMethod::Blurred);
        chart.series.push(Series {
            points: points.iter().map(|point| (point.times, point.psnr_db)).collect(),
            color,
            line_px: if has_line { 1.0 } else { 0.0 },
            markers: points.iter().enumerate().map(mark).collect(),
        });
    }
    chart
}

/// Rows with the same samples and quality.
struct Mean {
    key: (usize, Quality),
    times: f64,
    psnr_db: f64,
}

fn means<'a>(rows: impl Iterator<Item = &'a LensRow>) -> Vec<Mean> {
    let mut groups: Vec<((usize, Quality), Vec<&LensRow>)> = Vec::new();
    for row in rows {
        // The samples of a preset differ between scenes.
        let samples = if row.method == LensMethod::Preset { 0 } else { row.num_samples };
        let key = (samples, row.quality);
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, group)) => group.push(row),
            None => groups.push((key, vec![row])),
        }
    }
    let mean = |(key, rows): &((usize, Quality), Vec<&LensRow>)| {
        let of = |value: &dyn Fn(&LensRow) -> f64| rows.iter().map(|row| value(row)).sum::<f64>() / rows.len() as f64;
        Mean { key: *key, times: of(&|row| row.times_plain.ln()).exp(), psnr_db: of(&|row| row.psnr_db.min(MAX_DB)) }
    };
    groups.iter().map(mean).collect()
}
