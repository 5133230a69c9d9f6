use std::fmt::Write as _;

use super::Axis;
use super::labels::Labels;
use super::text::escaped;

/// Margins of the frame, px: left and bottom hold the tick labels, top holds the title.
const MARGIN_LEFT: f64 = 58.0;
const MARGIN_BOTTOM: f64 = 40.0;
const MARGIN_TOP: f64 = 22.0;
const MARGIN_RIGHT: f64 = 8.0;
/// A line skips points nearer than this to the last one drawn, px, so that long recordings make small files.
const MIN_STEP_PX: f64 = 0.4;
/// Font size of the labels of markers, px.
const LABEL_PX: f64 = 11.0;

/// A marker at a point of a series.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Index of the point in the series.
    pub point_idx: usize,
    /// Radius, px.
    pub radius_px: f64,
    /// Whether it is drawn as a ring.
    pub is_hollow: bool,
    /// Whether it is drawn pale and behind the others.
    pub is_muted: bool,
    /// Text beside it; may be empty.
    pub label: String,
}

/// Points with one color, joined by a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Points in the units of the axes.
    pub points: Vec<(f64, f64)>,
    /// Color of line, markers and labels, as in SVG.
    pub color: &'static str,
    /// Width of the line through the points, px; 0 for no line.
    pub line_px: f64,
    /// Markers, in the order they are drawn.
    pub markers: Vec<Marker>,
}

/// A frame with axes, a title above it and series inside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Whether a unit has the same length on both axes.
    pub has_equal_units: bool,
    /// The series; later ones are drawn over earlier ones.
    pub series: Vec<Series>,
}

/// A chart with its frame on the figure and its axis ranges.
struct Layout<'a> {
    chart: &'a Chart,
    /// Left, top, right, bottom, px.
    frame: [f64; 4],
    /// Scaled values at the left and right side of the frame.
    x_range: (f64, f64),
    /// Scaled values at the bottom and top side of the frame.
    y_range: (f64, f64),
}

impl Marker {
    /// A filled dot without a label.
    pub fn dot(point_idx: usize, radius_px: f64) -> Self {
        Self { point_idx, radius_px, is_hollow: false, is_muted: false, label: String::new() }
    }
}

impl Chart {
    /// A chart without series.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.to_owned(), x, y, has_equal_units: false, series: Vec::new() }
    }

    /// Appends the chart as SVG, drawn into `[x, y, width, height]`, px.
    pub(super) fn draw(&self, svg: &mut String, area: [f64; 4]) {
        let layout = Layout::new(self, area);
        layout.draw_ticks(svg);
        layout.draw_names(svg);
        for series in &self.series {
            layout.draw_line(svg, series);
        }
        let markers =
            || self.series.iter().flat_map(|series| series.markers.iter().map(move |marker| (series, marker)));
        for is_muted in [true, false] {
            markers().filter(|(_, marker)| marker.is_muted == is_muted).for_each(|(series, marker)| {
                layout.draw_marker(svg, series, marker);
            });
        }
        let mut labels = Labels::inside(layout.frame);
        for (series, marker) in markers() {
            if let Some(point) = series.points.get(marker.point_idx).filter(|_| !marker.is_muted) {
                labels.block(layout.to_px(*point), marker.radius_px);
            }
        }
        for (series, marker) in markers().filter(|(_, marker)| !marker.label.is_empty()) {
            let Some(point) = series.points.get(marker.point_idx) else { continue };
            let (x, y) = labels.place(layout.to_px(*point), marker.radius_px, &marker.label, LABEL_PX);
            // Writing to a string cannot fail, here and below. The white outline separates the text from lines behind
            // it.
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{LABEL_PX}\" fill=\"{}\" stroke=\"white\" stroke-width=\"2.5\" \
                 paint-order=\"stroke\">{}</text>",
                series.color,
                escaped(&marker.label)
            );
        }
    }
}

impl<'a> Layout<'a> {
    fn new(chart: &'a Chart, [x, y, width, height]: [f64; 4]) -> Self {
        let frame = [x + MARGIN_LEFT, y + MARGIN_TOP, x + width - MARGIN_RIGHT, y + height - MARGIN_BOTTOM];
        let all = || chart.series.iter().flat_map(|series| series.points.iter());
        let mut x_range = chart.x.range(all().map(|point| point.0));
        let mut y_range = chart.y.range(all().map(|point| point.1));
        if chart.has_equal_units {
            let (across, up) = (frame[2] - frame[0], frame[3] - frame[1]);
            let units_per_px = ((x_range.1 - x_range.0) / across).max((y_range.1 - y_range.0) / up);
            let centered = |(low, high): (f64, f64), length: f64| {
                let middle = f64::midpoint(low, high);
                (middle - units_per_px * length / 2.0, middle + units_per_px * length / 2.0)
            };
            (x_range, y_range) = (centered(x_range, across), centered(y_range, up));
        }
        Self { chart, frame, x_range, y_range }
    }

    /// Position of a point on the figure, px.
    fn to_px(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let [left, top, right, bottom] = self.frame;
        let fraction = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let across = fraction(self.chart.x.scaled(x), self.x_range);
        let up = fraction(self.chart.y.scaled(y), self.y_range);
        (left + across * (right - left), bottom - up * (bottom - top))
    }

    fn draw_ticks(&self, svg: &mut String) {
        let [left, top, right, bottom] = self.frame;
        let ((x_low, x_high), (y_low, y_high)) = (self.x_range, self.y_range);
        for (tick, label) in self.chart.x.ticks(x_low, x_high, (right - left) / 50.0) {
            let (px, _) = self.to_px((tick, 1.0));
            let _ = writeln!(
                svg,
                "<path d=\"M{px:.1} {top:.1}V{bottom:.1}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{px:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\">{label}</text>",
                bottom + 15.0
            );
        }
        for (tick, label) in self.chart.y.ticks(y_low, y_high, (bottom - top) / 34.0) {
            let (_, py) = self.to_px((1.0, tick));
            let _ = writeln!(
                svg,
                "<path d=\"M{left:.1} {py:.1}H{right:.1}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"11\">{label}</text>",
                left - 6.0,
                py + 4.0
            );
        }
    }

    fn draw_names(&self, svg: &mut String) {
        let [left, top, right, bottom] = self.frame;
        let (middle_x, middle_y) = (f64::midpoint(left, right), f64::midpoint(top, bottom));
        let x = left - 45.0;
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\" fill=\"none\" stroke=\"#999999\"/>\
             <text x=\"{left:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>\
             <text x=\"{middle_x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555555\">{}</text>\
             <text x=\"{x:.1}\" y=\"{middle_y:.1}\" text-anchor=\"middle\" fill=\"#555555\" \
             transform=\"rotate(-90 {x:.1} {middle_y:.1})\">{}</text>",
            top - 7.0,
            escaped(&self.chart.title),
            bottom + 31.0,
            escaped(&self.chart.x.name),
            escaped(&self.chart.y.name)
        );
    }

    fn draw_line(&self, svg: &mut String, series: &Series) {
        if !(series.line_px > 0.0) {
            return;
        }
        let mut line = String::new();
        let mut drawn = (f64::INFINITY, f64::INFINITY);
        for (idx, point) in series.points.iter().enumerate() {
            let (x, y) = self.to_px(*point);
            if (x - drawn.0).hypot(y - drawn.1) >= MIN_STEP_PX || idx + 1 == series.points.len() {
                let _ = write!(line, "{x:.2},{y:.2} ");
                drawn = (x, y);
            }
        }
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
            line.trim_end(),
            series.color,
            series.line_px
        );
    }

    fn draw_marker(&self, svg: &mut String, series: &Series, marker: &Marker) {
        let Some(point) = series.points.get(marker.point_idx) else { return };
        let ((x, y), radius, color) = (self.to_px(*point), marker.radius_px, series.color);
        let paint = match (marker.is_hollow, marker.is_muted) {
            (true, _) => format!("fill=\"white\" stroke=\"{color}\" stroke-width=\"1.5\""),
            (false, true) => format!("fill=\"{color}\" fill-opacity=\"0.25\""),
            (false, false) => format!("fill=\"{color}\""),
        };
        let _ = writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" {paint}/>");
    }
}
