use glam::DVec2;

use super::Axis;
use super::drawing::{Anchor, Drawing, Ink, Mark, Stroke, TextStyle, text_width_px};
use super::extras::{Bar, ColoredLine, Level, Spread};
use super::labels::Labels;

/// Margins of the frame, px: left and bottom hold the tick labels, top holds the title.
const MARGIN_LEFT: f64 = 58.0;
const MARGIN_BOTTOM: f64 = 40.0;
const MARGIN_TOP: f64 = 24.0;
const MARGIN_RIGHT: f64 = 8.0;
/// A line skips points nearer than this to the last one drawn, px, so that long recordings make small files.
const MIN_STEP_PX: f64 = 0.4;
/// A colored line skips points nearer than this, px: it is one mark per step.
const MIN_COLOR_STEP_PX: f64 = 1.5;
/// Font size of ticks and of the labels of markers, px.
const LABEL_PX: f64 = 11.0;
/// Font size of titles, px.
const TITLE_PX: f64 = 12.0;
const GRID: Ink = Ink::new([228; 3]);
const FRAME: Ink = Ink::new([153; 3]);
pub(super) const TEXT: Ink = Ink::new([34; 3]);
const FAINT_TEXT: Ink = Ink::new([85; 3]);
const WHITE: Ink = Ink::new([255; 3]);

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
    /// The vertical axis. Its name is written after the title.
    pub y: Axis,
    /// Whether a unit has the same length on both axes.
    pub has_equal_units: bool,
    /// Bars, behind everything else.
    pub bars: Vec<Bar>,
    /// Dashed level lines.
    pub levels: Vec<Level>,
    /// Distributions.
    pub spreads: Vec<Spread>,
    /// The series; later ones are drawn over earlier ones.
    pub series: Vec<Series>,
    /// Lines colored by a value, over the series.
    pub colored: Vec<ColoredLine>,
    /// Lines of text in the upper left corner of the frame.
    pub notes: Vec<String>,
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
    /// A chart without content.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self {
            title: title.to_owned(),
            x,
            y,
            has_equal_units: false,
            bars: Vec::new(),
            levels: Vec::new(),
            spreads: Vec::new(),
            series: Vec::new(),
            colored: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds the chart to a drawing, in the area `[x, y, width, height]`, px.
    pub(super) fn draw(&self, drawing: &mut Drawing, area: [f64; 4]) {
        let layout = Layout::new(self, area);
        let marks = &mut drawing.marks;
        layout.draw_ticks(marks);
        self.bars.iter().for_each(|bar| marks.push(layout.bar(bar)));
        layout.draw_names(marks);
        self.spreads.iter().for_each(|spread| marks.extend(layout.spread(spread)));
        self.series.iter().for_each(|series| marks.extend(layout.line(series)));
        self.colored.iter().for_each(|line| marks.extend(layout.colored(line)));
        self.levels.iter().for_each(|level| marks.extend(layout.level(level)));
        let markers =
            || self.series.iter().flat_map(|series| series.markers.iter().map(move |marker| (series, marker)));
        for is_muted in [true, false] {
            let group = markers().filter(|(_, marker)| marker.is_muted == is_muted);
            marks.extend(group.filter_map(|(series, marker)| layout.marker(series, marker)));
        }
        layout.draw_labels(marks, markers().collect());
        for (idx, note) in self.notes.iter().enumerate() {
            let at = DVec2::new(layout.frame[0] + 8.0, layout.frame[1] + 16.0 + 14.0 * idx as f64);
            marks.push(text(at, note, Anchor::Start, TEXT, true));
        }
    }
}

/// A text in the size of labels.
pub(super) fn text(at_px: DVec2, text: &str, anchor: Anchor, ink: Ink, has_halo: bool) -> Mark {
    let style = TextStyle { size_px: LABEL_PX, ink, anchor, is_bold: false };
    Mark::Text { at_px, style, halo_px: if has_halo { 1.5 } else { 0.0 }, text: text.to_owned() }
}

fn px((x, y): (f64, f64)) -> DVec2 {
    DVec2::new(x, y)
}

impl<'a> Layout<'a> {
    fn new(chart: &'a Chart, [x, y, width, height]: [f64; 4]) -> Self {
        let frame = [x + MARGIN_LEFT, y + MARGIN_TOP, x + width - MARGIN_RIGHT, y + height - MARGIN_BOTTOM];
        let all = || {
            let bars = chart.bars.iter().flat_map(|bar| [(bar.sides.0, 0.0), (bar.sides.1, bar.height)]);
            let spreads =
                chart.spreads.iter().flat_map(|s| [(s.x - s.width, s.quartiles[0]), (s.x + s.width, s.quartiles[4])]);
            let series = chart.series.iter().flat_map(|series| series.points.iter().copied());
            let colored = chart.colored.iter().flat_map(|line| line.points.iter().copied());
            bars.chain(spreads).chain(series).chain(colored)
        };
        let levels = chart.levels.iter().map(|level| level.y);
        let mut x_range = chart.x.range(all().map(|point| point.0));
        let mut y_range = chart.y.range(all().map(|point| point.1).chain(levels));
        // Room for the notes above the content.
        let note_frac = 15.0 * chart.notes.len() as f64 / (frame[3] - frame[1]);
        y_range.1 += (y_range.1 - y_range.0) * note_frac.min(0.5);
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

    fn draw_ticks(&self, marks: &mut Vec<Mark>) {
        let [left, top, right, bottom] = self.frame;
        let ((x_low, x_high), (y_low, y_high)) = (self.x_range, self.y_range);
        let rule = |from: (f64, f64), to: (f64, f64)| Mark::Line {
            points_px: vec![px(from), px(to)],
            stroke: Stroke::solid(GRID, 1.0),
        };
        for (tick, label) in self.chart.x.ticks(x_low, x_high, (right - left) / 50.0) {
            let (x, _) = self.to_px((tick, 1.0));
            marks.push(rule((x, top), (x, bottom)));
            marks.push(text(DVec2::new(x, bottom + 15.0), &label, Anchor::Middle, TEXT, false));
        }
        for (tick, label) in self.chart.y.ticks(y_low, y_high, (bottom - top) / 34.0) {
            let (_, y) = self.to_px((1.0, tick));
            marks.push(rule((left, y), (right, y)));
            marks.push(text(DVec2::new(left - 6.0, y + 4.0), &label, Anchor::End, TEXT, false));
        }
    }

    /// The frame, and the names of chart and axes.
    fn draw_names(&self, marks: &mut Vec<Mark>) {
        let [left, top, right, bottom] = self.frame;
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        marks.push(Mark::Area {
            outline_px: corners.map(px).to_vec(),
            fill: None,
            border: Some(Stroke::solid(FRAME, 1.0)),
        });
        let style = TextStyle { size_px: TITLE_PX, ink: TEXT, anchor: Anchor::Start, is_bold: true };
        let at_px = DVec2::new(left, top - 8.0);
        marks.push(Mark::Text { at_px, style, halo_px: 0.0, text: self.chart.title.clone() });
        let after = if self.chart.title.is_empty() { 0.0 } else { text_width_px(&self.chart.title, TITLE_PX) + 10.0 };
        marks.push(text(at_px + DVec2::new(after, 0.0), &self.chart.y.name, Anchor::Start, FAINT_TEXT, false));
        let below = DVec2::new(f64::midpoint(left, right), bottom + 31.0);
        marks.push(text(below, &self.chart.x.name, Anchor::Middle, FAINT_TEXT, false));
    }

    fn bar(&self, bar: &Bar) -> Mark {
        let (left, top) = self.to_px((bar.sides.0, bar.height));
        let (right, bottom) = self.to_px((bar.sides.1, 0.0));
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        let ink = Ink::of_code(bar.color);
        let border = Some(Stroke::solid(ink, 0.6));
        Mark::Area { outline_px: corners.map(px).to_vec(), fill: Some(ink.with_opacity(0.45)), border }
    }

    fn spread(&self, spread: &Spread) -> Vec<Mark> {
        let [low, first, median, third, high] = spread.quartiles;
        let (left, right) = (spread.x - spread.width / 2.0, spread.x + spread.width / 2.0);
        let ink = Ink::of_code(spread.color);
        let at = |x: f64, y: f64| px(self.to_px((x, y)));
        let line = |from: DVec2, to: DVec2, width_px: f64| Mark::Line {
            points_px: vec![from, to],
            stroke: Stroke::solid(ink, width_px),
        };
        let cap = |y: f64| line(at(spread.x - spread.width / 5.0, y), at(spread.x + spread.width / 5.0, y), 1.2);
        vec![
            line(at(spread.x, low), at(spread.x, first), 1.2),
            line(at(spread.x, third), at(spread.x, high), 1.2),
            cap(low),
            cap(high),
            Mark::Area {
                outline_px: vec![at(left, third), at(right, third), at(right, first), at(left, first)],
                fill: Some(ink.with_opacity(0.35)),
                border: Some(Stroke::solid(ink, 1.2)),
            },
            line(at(left, median), at(right, median), 2.4),
        ]
    }

    fn level(&self, level: &Level) -> Vec<Mark> {
        let [left, _, right, _] = self.frame;
        let (_, y) = self.to_px((1.0, level.y));
        let ink = Ink::of_code(level.color);
        vec![
            Mark::Line {
                points_px: vec![DVec2::new(left, y), DVec2::new(right, y)],
                stroke: Stroke::dashed(ink, 1.2, [6.0, 4.0]),
            },
            text(
                DVec2::new(right - 5.0, if level.is_name_below { y + 12.0 } else { y - 4.0 }),
                &level.name,
                Anchor::End,
                ink,
                true,
            ),
        ]
    }

    /// The points of a line, px, without those nearer than a step to the last one.
    fn thinned(&self, points: &[(f64, f64)], min_step_px: f64) -> Vec<(usize, DVec2)> {
        let mut kept: Vec<(usize, DVec2)> = Vec::new();
        for (idx, point) in points.iter().enumerate() {
            let at = px(self.to_px(*point));
            let is_far = kept.last().is_none_or(|(_, last)| last.distance(at) >= min_step_px);
            if is_far || idx + 1 == points.len() {
                kept.push((idx, at));
            }
        }
        kept
    }

    fn line(&self, series: &Series) -> Option<Mark> {
        let points_px: Vec<DVec2> = self.thinned(&series.points, MIN_STEP_PX).into_iter().map(|(_, at)| at).collect();
        let stroke = Stroke::solid(Ink::of_code(series.color), series.line_px);
        (series.line_px > 0.0 && !points_px.is_empty()).then_some(Mark::Line { points_px, stroke })
    }

    fn colored(&self, line: &ColoredLine) -> Vec<Mark> {
        let kept = self.thinned(&line.points, MIN_COLOR_STEP_PX);
        let piece = |pair: &[(usize, DVec2)]| {
            let values = line.values.get(pair[0].0..=pair[1].0)?;
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let stroke = Stroke::solid(line.scale.ink(mean), line.line_px);
            Some(Mark::Line { points_px: vec![pair[0].1, pair[1].1], stroke })
        };
        kept.windows(2).filter_map(piece).collect()
    }

    fn marker(&self, series: &Series, marker: &Marker) -> Option<Mark> {
        let center_px = px(self.to_px(*series.points.get(marker.point_idx)?));
        let ink = Ink::of_code(series.color);
        let (fill, border) = match (marker.is_hollow, marker.is_muted) {
            (true, _) => (WHITE, Some(Stroke::solid(ink, 1.5))),
            (false, true) => (ink.with_opacity(0.25), None),
            (false, false) => (ink, None),
        };
        Some(Mark::Circle { center_px, radius_px: marker.radius_px, fill: Some(fill), border })
    }

    fn draw_labels(&self, marks: &mut Vec<Mark>, markers: Vec<(&Series, &Marker)>) {
        let mut labels = Labels::inside(self.frame);
        for (series, marker) in &markers {
            if let Some(point) = series.points.get(marker.point_idx).filter(|_| !marker.is_muted) {
                labels.block(self.to_px(*point), marker.radius_px);
            }
        }
        for (series, marker) in markers.into_iter().filter(|(_, marker)| !marker.label.is_empty()) {
            let Some(point) = series.points.get(marker.point_idx) else { continue };
            let at = labels.place(self.to_px(*point), marker.radius_px, &marker.label, LABEL_PX);
            marks.push(text(px(at), &marker.label, Anchor::Start, Ink::of_code(series.color), true));
        }
    }
}
