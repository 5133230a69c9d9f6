//! One chart: a frame with ticks, lines in it, a title above.

use std::fmt::Write as _;

use super::ticks::{padded, ticks};

/// Room for tick labels left of and under the frame, and for the title above it, px.
const LEFT: f64 = 58.0;
const UNDER: f64 = 36.0;
const ABOVE: f64 = 20.0;
/// Points closer to the one drawn before are left out, px: long recordings stay small files.
const LEAST_STEP: f64 = 0.4;

/// A line in a chart.
pub(super) struct Series {
    /// Points in the units of the axes.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) color: &'static str,
    /// Indices of points marked as keys.
    pub(super) keys: Vec<usize>,
    /// Whether the first point has a ring.
    pub(super) marks_start: bool,
}

/// A chart in an area `[x, y, width, height]` of the figure, px.
pub(super) struct Chart {
    pub(super) series: Vec<Series>,
    pub(super) x_name: String,
    pub(super) y_name: String,
    /// Whether a unit is as long in both directions.
    pub(super) equal_axes: bool,
    title: String,
    frame: [f64; 4],
}

impl Chart {
    pub(super) fn new([x, y, width, height]: [f64; 4], title: &str) -> Self {
        let frame = [x + LEFT, y + ABOVE, width - LEFT - 6.0, height - ABOVE - UNDER];
        let title = title.to_owned();
        Self { series: Vec::new(), x_name: String::new(), y_name: String::new(), equal_axes: false, title, frame }
    }

    /// Bounds of both axes: `[x low, x high, y low, y high]`.
    fn bounds(&self) -> [f64; 4] {
        let all = || self.series.iter().flat_map(|series| series.points.iter().copied());
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (x, y) = (range(&mut all().map(|p| p.0)), range(&mut all().map(|p| p.1)));
        let [_, _, width, height] = self.frame;
        if !self.equal_axes {
            // A flat line is not blown up until its rounding shows.
            let least = 1e-3 * y.0.abs().max(y.1.abs()).max(1.0);
            let (y_low, y_high) = padded(y.0, y.1, least);
            let (x_low, x_high) = if x.1 > x.0 { x } else { padded(x.0, x.1, 1.0) };
            return [x_low, x_high, y_low, y_high];
        }
        let ((x_low, x_high), (y_low, y_high)) = (padded(x.0, x.1, 1e-3), padded(y.0, y.1, 1e-3));
        let units_a_px = ((x_high - x_low) / width).max((y_high - y_low) / height);
        let (x_mid, y_mid) = (f64::midpoint(x_low, x_high), f64::midpoint(y_low, y_high));
        let (dx, dy) = (units_a_px * width / 2.0, units_a_px * height / 2.0);
        [x_mid - dx, x_mid + dx, y_mid - dy, y_mid + dy]
    }

    pub(super) fn draw(&self, svg: &mut String) {
        let [left, top, width, height] = self.frame;
        let [x_low, x_high, y_low, y_high] = self.bounds();
        let to_px = |(x, y): (f64, f64)| {
            (left + (x - x_low) / (x_high - x_low) * width, top + (y_high - y) / (y_high - y_low) * height)
        };
        let bottom = top + height;
        for (x, label) in labels(x_low, x_high, width / 90.0) {
            let (px, _) = to_px((x, y_low));
            let _ = writeln!(
                svg,
                "<line x1=\"{px:.1}\" y1=\"{top:.1}\" x2=\"{px:.1}\" y2=\"{bottom:.1}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{px:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\">{label}</text>",
                bottom + 14.0
            );
        }
        for (y, label) in labels(y_low, y_high, height / 45.0) {
            let (_, py) = to_px((x_low, y));
            let _ = writeln!(
                svg,
                "<line x1=\"{left:.1}\" y1=\"{py:.1}\" x2=\"{:.1}\" y2=\"{py:.1}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"11\">{label}</text>",
                left + width,
                left - 6.0,
                py + 4.0
            );
        }
        let _ = writeln!(
            svg,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#999999\"/>"
        );
        self.write_names(svg);
        for (idx, series) in self.series.iter().enumerate() {
            // The reference is broader, so that it shows under an estimate that covers it.
            draw_series(svg, series, if idx == 0 { 3.0 } else { 1.5 }, to_px);
        }
    }

    fn write_names(&self, svg: &mut String) {
        let [left, top, width, height] = self.frame;
        let _ = writeln!(
            svg,
            "<text x=\"{left:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555555\">{}</text>",
            top - 7.0,
            self.title,
            left + width / 2.0,
            top + height + 30.0,
            self.x_name
        );
        let (x, y) = (left - 44.0, top + height / 2.0);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"#555555\" transform=\"rotate(-90 {x:.1} {y:.1})\">{}</text>",
            self.y_name
        );
    }
}

/// Ticks with their text, none with a minus before zero.
fn labels(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    let (values, decimals) = ticks(low, high, count);
    values.into_iter().map(|value| (value, format!("{:.decimals$}", value + 0.0))).collect()
}

fn draw_series(svg: &mut String, series: &Series, width: f64, to_px: impl Fn((f64, f64)) -> (f64, f64)) {
    let points: Vec<(f64, f64)> = series.points.iter().map(|point| to_px(*point)).collect();
    let mut line = String::new();
    let mut drawn = (f64::INFINITY, f64::INFINITY);
    for (idx, (x, y)) in points.iter().copied().enumerate() {
        if (x - drawn.0).hypot(y - drawn.1) >= LEAST_STEP || idx + 1 == points.len() {
            let _ = write!(line, "{x:.2},{y:.2} ");
            drawn = (x, y);
        }
    }
    let color = series.color;
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"/>",
        line.trim_end()
    );
    for (x, y) in series.keys.iter().filter_map(|idx| points.get(*idx)) {
        let _ = writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.2\" fill=\"{color}\"/>");
    }
    if let Some((x, y)) = points.first().filter(|_| series.marks_start) {
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4.5\" fill=\"white\" stroke=\"{color}\" stroke-width=\"1.5\"/>"
        );
    }
}
