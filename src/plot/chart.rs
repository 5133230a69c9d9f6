use std::fmt::Write as _;

use super::Axis;
use super::labels::Labels;
use super::text::escaped;

/// Room for tick labels left of and under the frame, and for the title above it, px.
const LEFT: f64 = 58.0;
const UNDER: f64 = 40.0;
const ABOVE: f64 = 22.0;
/// Room right of the frame, px.
const BESIDE: f64 = 8.0;
/// Points closer to the one drawn before are left out of lines, px: long recordings stay small files.
const LEAST_STEP: f64 = 0.4;
const WORD_PX: f64 = 11.0;

/// A dot at a point of a series.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The point.
    pub point_idx: usize,
    /// Radius, px.
    pub radius_px: f64,
    /// Whether it is a ring.
    pub is_hollow: bool,
    /// Whether it stands back behind the others.
    pub is_muted: bool,
    /// A word beside it; may be empty.
    pub word: String,
}

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Points in the units of the axes.
    pub points: Vec<(f64, f64)>,
    /// Color of line, dots and words.
    pub color: &'static str,
    /// Width of the line through the points, px; 0 for none.
    pub line_px: f64,
    /// Dots.
    pub marks: Vec<Mark>,
}

/// A frame with axes, series in it, a title above.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// The axis along the lower side.
    pub x: Axis,
    /// The axis along the left side.
    pub y: Axis,
    /// Whether a unit is as long in both directions.
    pub has_equal_units: bool,
    /// What is drawn, the first under the others.
    pub series: Vec<Series>,
}

/// A chart's frame on the figure and the places that it shows.
struct Layout<'a> {
    chart: &'a Chart,
    /// Left, top, right, bottom, px.
    frame: [f64; 4],
    x_places: (f64, f64),
    y_places: (f64, f64),
}

impl Mark {
    /// A plain dot.
    pub fn dot(point_idx: usize, radius_px: f64) -> Self {
        Self { point_idx, radius_px, is_hollow: false, is_muted: false, word: String::new() }
    }
}

impl Chart {
    /// A chart without series.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self { title: title.to_owned(), x, y, has_equal_units: false, series: Vec::new() }
    }

    pub(super) fn draw(&self, svg: &mut String, area: [f64; 4]) {
        let layout = Layout::new(self, area);
        layout.draw_ticks(svg);
        layout.draw_names(svg);
        for series in &self.series {
            layout.draw_line(svg, series);
        }
        let marks = || self.series.iter().flat_map(|series| series.marks.iter().map(move |mark| (series, mark)));
        for is_muted in [true, false] {
            marks().filter(|(_, mark)| mark.is_muted == is_muted).for_each(|(series, mark)| {
                layout.draw_mark(svg, series, mark);
            });
        }
        let mut labels = Labels::inside(layout.frame);
        for (series, mark) in marks() {
            if let Some(point) = series.points.get(mark.point_idx).filter(|_| !mark.is_muted) {
                labels.block(layout.to_px(*point), mark.radius_px);
            }
        }
        for (series, mark) in marks().filter(|(_, mark)| !mark.word.is_empty()) {
            let Some(point) = series.points.get(mark.point_idx) else { continue };
            let (x, y) = labels.place(layout.to_px(*point), mark.radius_px, &mark.word, WORD_PX);
            // Writing to a string cannot fail, here and below. The white edge keeps lines off the letters.
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{WORD_PX}\" fill=\"{}\" stroke=\"white\" stroke-width=\"2.5\" \
                 paint-order=\"stroke\">{}</text>",
                series.color,
                escaped(&mark.word)
            );
        }
    }
}

impl<'a> Layout<'a> {
    fn new(chart: &'a Chart, [x, y, width, height]: [f64; 4]) -> Self {
        let frame = [x + LEFT, y + ABOVE, x + width - BESIDE, y + height - UNDER];
        let all = || chart.series.iter().flat_map(|series| series.points.iter());
        let mut x_places = chart.x.interval(all().map(|point| point.0));
        let mut y_places = chart.y.interval(all().map(|point| point.1));
        if chart.has_equal_units {
            let (across, up) = (frame[2] - frame[0], frame[3] - frame[1]);
            let units_a_px = ((x_places.1 - x_places.0) / across).max((y_places.1 - y_places.0) / up);
            let about = |(low, high): (f64, f64), length: f64| {
                let middle = f64::midpoint(low, high);
                (middle - units_a_px * length / 2.0, middle + units_a_px * length / 2.0)
            };
            (x_places, y_places) = (about(x_places, across), about(y_places, up));
        }
        Self { chart, frame, x_places, y_places }
    }

    /// A point on the figure, px.
    fn to_px(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let [left, top, right, bottom] = self.frame;
        let part = |place: f64, (low, high): (f64, f64)| (place - low) / (high - low);
        let across = part(self.chart.x.place(x), self.x_places);
        let up = part(self.chart.y.place(y), self.y_places);
        (left + across * (right - left), bottom - up * (bottom - top))
    }

    fn draw_ticks(&self, svg: &mut String) {
        let [left, top, right, bottom] = self.frame;
        let ((x_low, x_high), (y_low, y_high)) = (self.x_places, self.y_places);
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
            if (x - drawn.0).hypot(y - drawn.1) >= LEAST_STEP || idx + 1 == series.points.len() {
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

    fn draw_mark(&self, svg: &mut String, series: &Series, mark: &Mark) {
        let Some(point) = series.points.get(mark.point_idx) else { return };
        let ((x, y), radius, color) = (self.to_px(*point), mark.radius_px, series.color);
        let paint = match (mark.is_hollow, mark.is_muted) {
            (true, _) => format!("fill=\"white\" stroke=\"{color}\" stroke-width=\"1.5\""),
            (false, true) => format!("fill=\"{color}\" fill-opacity=\"0.25\""),
            (false, false) => format!("fill=\"{color}\""),
        };
        let _ = writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" {paint}/>");
    }
}
