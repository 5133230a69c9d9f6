use std::fmt::Write as _;

use super::measure::{EncoderRow, Step};
use cinesplat::plot::{Axis, COLORS, Chart, LegendEntry, LegendSymbol, Marker, Series, grid};
use cinesplat::video::X264Preset;

/// Header line of the CSV.
pub(super) const CSV_HEADER: &str = "scene,width,height,frames,step,crf,fps,busy_ms_a_frame,kbps,ssim\n";

/// The setting whose SSIM all presets are compared at.
const BASELINE: (X264Preset, u8) = (X264Preset::Medium, 18);
const PANEL_PX: [f64; 2] = [410.0, 300.0];

/// The rows as CSV with a header.
pub(super) fn to_csv(rows: &[EncoderRow]) -> String {
    rows.iter().fold(CSV_HEADER.to_owned(), |csv, row| csv + &csv_line(row))
}

/// One row as a line of the CSV; cells without a meaning are empty.
pub(super) fn csv_line(row: &EncoderRow) -> String {
    let (name, figures) = match row.step {
        Step::Render => ("render", ["", "", ""].map(str::to_owned)),
        Step::Convert => ("convert", ["", "", ""].map(str::to_owned)),
        Step::Encode { preset, crf, rate_kbps, ssim } => {
            (preset.into(), [crf.to_string(), format!("{rate_kbps:.0}"), format!("{ssim:.5}")])
        }
    };
    let [crf, rate, ssim] = figures;
    let ([width, height], num_frames) = (row.size_px, row.num_frames);
    let rate_fps = num_frames as f64 / row.spent.wall_secs.max(1e-9);
    let busy_ms = busy_ms(row);
    format!("{},{width},{height},{num_frames},{name},{crf},{rate_fps:.1},{busy_ms:.2},{rate},{ssim}\n", row.scene)
}

/// One line per film and preset: its cost, and its bit rate for the SSIM of the baseline.
pub(super) fn to_table(rows: &[EncoderRow]) -> String {
    let mut table = String::from(
        "| film | step | ms of one core per frame | kbps for the SSIM of medium at 18 | kbps, of medium's |\n|---|---|---|---|---|\n",
    );
    for film in films(rows) {
        // Writing to a string cannot fail.
        for row in film.rows.iter().filter(|row| !matches!(row.step, Step::Encode { .. })) {
            let name = if row.step == Step::Render { "render" } else { "convert" };
            let _ = writeln!(table, "| {} | {name} | {:.1} | | |", film.name, busy_ms(row));
        }
        // Cells without a meaning are empty.
        let shown = |value: f64, text: String| if value.is_finite() { text } else { String::new() };
        let of_baseline = film.rate_of(BASELINE.0).unwrap_or(f64::NAN);
        for preset in film.presets() {
            let rate = film.rate_of(preset).unwrap_or(f64::NAN);
            let busy_ms = film.busy_ms_of(preset);
            let percent = rate / of_baseline * 100.0;
            let _ = writeln!(
                table,
                "| {} | {preset} | {} | {} | {} |",
                film.name,
                shown(busy_ms, format!("{busy_ms:.1}")),
                shown(rate, format!("{rate:.0}")),
                shown(percent, format!("{percent:.0} %"))
            );
        }
    }
    table
}

/// Two panels per film: SSIM against bit rate, and the bit rate for one SSIM against time.
pub(super) fn to_svg(rows: &[EncoderRow]) -> String {
    let films = films(rows);
    let charts: Vec<Chart> = films.iter().map(Film::quality_chart).chain(films.iter().map(Film::time_chart)).collect();
    let presets = films.first().map(Film::presets).unwrap_or_default();
    let entry = |preset: &X264Preset| LegendEntry {
        name: preset.to_string(),
        color: color(*preset),
        symbol: LegendSymbol::Dot,
    };
    let legend: Vec<LegendEntry> = presets.iter().map(entry).collect();
    let title = "H.264: loss against bit rate, and bit rate for one loss against time";
    grid(title, &legend, &charts, films.len().max(1), PANEL_PX)
}

/// The rows of one film.
struct Film<'a> {
    name: String,
    rows: Vec<&'a EncoderRow>,
}

fn films(rows: &[EncoderRow]) -> Vec<Film<'_>> {
    let mut films: Vec<Film> = Vec::new();
    for row in rows {
        let name = format!("{} {}x{}", row.scene, row.size_px[0], row.size_px[1]);
        match films.iter_mut().find(|film| film.name == name) {
            Some(film) => film.rows.push(row),
            None => films.push(Film { name, rows: vec![row] }),
        }
    }
    films
}

impl Film<'_> {
    /// Its presets in the order of their effort.
    fn presets(&self) -> Vec<X264Preset> {
        use strum::VariantArray as _;
        let is_measured = |preset: &X264Preset| !self.points(*preset).is_empty();
        X264Preset::VARIANTS.iter().copied().filter(is_measured).collect()
    }

    /// Rate factor, bit rate and loss (1 - SSIM) of a preset, in the order of the bit rate.
    fn points(&self, wanted: X264Preset) -> Vec<(u8, f64, f64)> {
        let point = |row: &&EncoderRow| match row.step {
            Step::Encode { preset, crf, rate_kbps, ssim } if preset == wanted => {
                Some((crf, rate_kbps, (1.0 - ssim).max(1e-9)))
            }
            _ => None,
        };
        let mut points: Vec<_> = self.rows.iter().filter_map(point).collect();
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        points
    }

    /// The bit rate at which a preset has the loss of the baseline, along lines between its logarithms; the outer lines
    /// are continued.
    fn rate_of(&self, preset: X264Preset) -> Option<f64> {
        let wanted = self.points(BASELINE.0).iter().find(|(crf, ..)| *crf == BASELINE.1)?.2.ln();
        let points: Vec<(f64, f64)> =
            self.points(preset).iter().map(|(_, rate, loss)| (loss.ln(), rate.ln())).collect();
        let inside = points.windows(2).find(|pair| (pair[1].0..=pair[0].0).contains(&wanted));
        let nearest = if points.first()?.0 < wanted { points.windows(2).next() } else { points.windows(2).last() };
        let &[(x0, y0), (x1, y1)] = inside.or(nearest)? else { return None };
        Some((y0 + (y1 - y0) * (wanted - x0) / (x1 - x0)).exp())
    }

    /// CPU time per frame at the rate factor of the baseline.
    fn busy_ms_of(&self, wanted: X264Preset) -> f64 {
        let is_wanted = |row: &&&EncoderRow| matches!(row.step, Step::Encode { preset, crf, .. } if preset == wanted && crf == BASELINE.1);
        self.rows.iter().find(is_wanted).map_or(f64::NAN, |row| busy_ms(row))
    }

    fn quality_chart(&self) -> Chart {
        let mut chart = Chart::new(&self.name, Axis::logarithmic("kbps"), Axis::logarithmic("1 - SSIM"));
        for preset in self.presets() {
            let points = self.points(preset);
            chart.series.push(Series {
                points: points.iter().map(|(_, rate, loss)| (*rate, *loss)).collect(),
                color: color(preset),
                line_px: 1.0,
                markers: (0..points.len()).map(|idx| Marker::dot(idx, 3.0)).collect(),
            });
        }
        chart
    }

    fn time_chart(&self) -> Chart {
        let (x, y) = (Axis::logarithmic("ms of one core per frame"), Axis::linear("kbps for the SSIM of medium at 18"));
        let mut chart = Chart::new(&self.name, x, y);
        for preset in self.presets() {
            chart.series.push(Series {
                points: vec![(self.busy_ms_of(preset), self.rate_of(preset).unwrap_or(f64::NAN))],
                color: color(preset),
                line_px: 0.0,
                markers: vec![Marker { label: preset.to_string(), ..Marker::dot(0, 4.0) }],
            });
        }
        chart
    }
}

fn busy_ms(row: &EncoderRow) -> f64 {
    row.spent.cpu_secs * 1e3 / row.num_frames.max(1) as f64
}

fn color(preset: X264Preset) -> &'static str {
    COLORS[preset as usize % COLORS.len()]
}
