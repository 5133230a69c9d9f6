use super::report::ms;
use super::{BenchRow, KnobKind};
use cinesplat_plot::{Axis, COLORS, Chart, LegendEntry, LegendSymbol, Marker, Series, grid};
use strum::VariantArray;

/// PSNR at which plots clip (equal or nearly equal pictures).
const MAX_DB: f64 = 120.0;
const PANEL_PX: [f64; 2] = [410.0, 300.0];

/// Accuracy metric of a Pareto plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum AccuracyAxis {
    /// PSNR in dB.
    Psnr,
    /// 1 - SSIM.
    Ssim,
    /// Largest difference of a channel of a pixel.
    Worst,
}

/// A variant on one scene, averaged over its cameras.
#[derive(Debug, Clone, PartialEq)]
struct Point {
    kind: KnobKind,
    variant: String,
    /// Geometric mean of the times, ms.
    ms: f64,
    value: f64,
    /// Whether another point is at least as good in both time and accuracy, and better in one.
    is_dominated: bool,
}

impl AccuracyAxis {
    fn of_plot(self) -> Axis {
        match self {
            Self::Psnr => Axis::linear("PSNR, dB"),
            Self::Ssim => Axis::logarithmic("1 - SSIM"),
            Self::Worst => Axis::logarithmic("worst pixel"),
        }
    }

    fn of(self, row: &BenchRow) -> f64 {
        match self {
            Self::Psnr => row.difference.psnr_db.min(MAX_DB),
            Self::Ssim => (1.0 - row.difference.ssim).max(1e-8),
            Self::Worst => row.difference.worst.max(1e-6),
        }
    }

    /// A value as a loss: larger is worse.
    fn loss(self, value: f64) -> f64 {
        if self == Self::Psnr { -value } else { value }
    }
}

/// Pareto plots as SVG, one panel per scene, for the pictures of one size: accuracy against time of the presets, with
/// their names, and of each knob alone. Dominated settings are faint. Levels of detail of one scene (named `NAME
/// LEVEL`) share a panel with one line of presets per level.
pub fn pareto_svg(rows: &[BenchRow], size_px: [u32; 2], axis: AccuracyAxis) -> String {
    let shown: Vec<&BenchRow> = rows.iter().filter(|row| row.size_px == size_px && row.kind.costs_accuracy()).collect();
    let mut panels: Vec<(&str, Vec<&str>)> = Vec::new();
    for row in &shown {
        let (name, scene) = (panel_of(&row.scene), row.scene.as_str());
        match panels.iter_mut().find(|(known, _)| *known == name) {
            Some((_, scenes)) if scenes.contains(&scene) => {}
            Some((_, scenes)) => scenes.push(scene),
            None => panels.push((name, vec![scene])),
        }
    }
    let chart = |(name, scenes): &(&str, Vec<&str>)| match scenes.as_slice() {
        [scene] => knobs_chart(scene, &points(&shown, scene, axis), axis),
        _ => levels_chart(name, scenes, &shown, axis),
    };
    let charts: Vec<Chart> = panels.iter().map(chart).collect();
    let title = format!("Accuracy against time, {} x {} pixels, against the spec image", size_px[0], size_px[1]);
    grid(&title, &legend(), &charts, 3.min(charts.len().max(1)), PANEL_PX)
}

/// The panel of a scene: the name without its level of detail.
fn panel_of(scene: &str) -> &str {
    match scene.rsplit_once(' ') {
        Some((name, level)) if level.starts_with(|c: char| c.is_ascii_digit()) => name,
        _ => scene,
    }
}

fn color(kind: KnobKind) -> &'static str {
    match kind {
        KnobKind::Preset => COLORS[7],
        KnobKind::AlphaCut => COLORS[1],
        KnobKind::TransmittanceStop => COLORS[2],
        KnobKind::Resolution => COLORS[3],
        _ => COLORS[4],
    }
}

fn legend() -> Vec<LegendEntry> {
    let entry = |kind: KnobKind| LegendEntry {
        name: if kind == KnobKind::Preset { "preset".to_owned() } else { format!("{} alone", kind.as_ref()) },
        color: color(kind),
        symbol: LegendSymbol::Dot,
    };
    let mut entries: Vec<LegendEntry> =
        KnobKind::VARIANTS.iter().copied().filter(|kind| kind.costs_accuracy()).map(entry).collect();
    entries.push(LegendEntry { name: "faint: dominated".to_owned(), color: "#dddddd", symbol: LegendSymbol::Dot });
    entries
}

/// The variants of a scene, in the order of their rows.
fn points(rows: &[&BenchRow], scene: &str, axis: AccuracyAxis) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for row in rows.iter().filter(|row| row.scene == scene) {
        if points.iter().any(|point| point.kind == row.kind && point.variant == row.variant) {
            continue;
        }
        let of_variant =
            |other: &&&BenchRow| other.scene == scene && other.kind == row.kind && other.variant == row.variant;
        let cameras: Vec<&&BenchRow> = rows.iter().filter(of_variant).collect();
        let mean =
            |value: &dyn Fn(&BenchRow) -> f64| cameras.iter().map(|row| value(row)).sum::<f64>() / cameras.len() as f64;
        let (ms, value) = (mean(&|row| ms(row.timing.median).ln()).exp(), mean(&|row| axis.of(row)));
        points.push(Point { kind: row.kind, variant: row.variant.clone(), ms, value, is_dominated: false });
    }
    let beats = |a: &Point, b: &Point| {
        let (a_loss, b_loss) = (axis.loss(a.value), axis.loss(b.value));
        a.ms <= b.ms && a_loss <= b_loss && (a.ms < b.ms || a_loss < b_loss)
    };
    let dominated: Vec<bool> = points.iter().map(|point| points.iter().any(|other| beats(other, point))).collect();
    points.iter_mut().zip(dominated).for_each(|(point, is_dominated)| point.is_dominated = is_dominated);
    points
}

/// The chart of one scene: presets and knobs.
fn knobs_chart(title: &str, points: &[Point], axis: AccuracyAxis) -> Chart {
    let mut chart = Chart::new(title, Axis::logarithmic("ms per frame"), axis.of_plot());
    for &kind in KnobKind::VARIANTS.iter().rev() {
        let of_kind: Vec<&Point> = points.iter().filter(|point| point.kind == kind).collect();
        let mark = |(idx, point): (usize, &&Point)| match kind {
            KnobKind::Preset => Marker { label: point.variant.clone(), ..Marker::dot(idx, 5.0) },
            _ => Marker { is_muted: point.is_dominated, ..Marker::dot(idx, 3.0) },
        };
        if !of_kind.is_empty() {
            chart.series.push(Series {
                points: of_kind.iter().map(|point| (point.ms, point.value)).collect(),
                color: color(kind),
                line_px: if kind == KnobKind::Preset { 1.0 } else { 0.0 },
                markers: of_kind.iter().enumerate().map(mark).collect(),
            });
        }
    }
    chart
}

/// The chart of a scene with levels of detail: one line through the presets of each level. The presets of the first
/// level and all levels are labeled.
fn levels_chart(name: &str, scenes: &[&str], rows: &[&BenchRow], axis: AccuracyAxis) -> Chart {
    let title = format!("{name}, {} levels of detail", scenes.len());
    let mut chart = Chart::new(&title, Axis::logarithmic("ms per frame"), axis.of_plot());
    for (level_idx, scene) in scenes.iter().enumerate() {
        let presets: Vec<Point> =
            points(rows, scene, axis).into_iter().filter(|point| point.kind == KnobKind::Preset).collect();
        let level = scene[panel_of(scene).len()..].trim();
        let mark = |(idx, point): (usize, &Point)| {
            let is_last = idx + 1 == presets.len();
            let word = match (level_idx == 0, is_last) {
                (true, true) => format!("{level} {}", point.variant),
                (true, false) => point.variant.clone(),
                (false, true) => level.to_owned(),
                (false, false) => String::new(),
            };
            Marker { label: word, ..Marker::dot(idx, 4.0) }
        };
        chart.series.push(Series {
            points: presets.iter().map(|point| (point.ms, point.value)).collect(),
            color: COLORS[(level_idx + 7) % COLORS.len()],
            line_px: 1.0,
            markers: presets.iter().enumerate().map(mark).collect(),
        });
    }
    chart
}
