//! Panels of points and lines over logarithmic or even axes, as SVG.

use std::fmt::Write as _;

/// Colors that people with any kind of color vision tell apart (Okabe and Ito).
pub(super) const COLORS: [&str; 7] = ["#222222", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const PANEL: [f64; 2] = [400.0, 270.0];
/// Left, top, right, bottom of the axes inside a panel.
const MARGIN: [f64; 4] = [58.0, 30.0, 14.0, 44.0];
const HEADER: f64 = 56.0;

/// How numbers are laid along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Spacing {
    /// Evenly.
    Even,
    /// By their logarithm.
    Logarithmic,
}

/// One axis of a panel.
#[derive(Debug, Clone)]
pub(super) struct Scale {
    pub(super) name: String,
    pub(super) spacing: Spacing,
}

/// Points that belong together.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// Index into the names of the figure.
    pub(super) name_idx: usize,
    /// Whether they are joined.
    pub(super) is_line: bool,
    pub(super) points: Vec<(f64, f64)>,
    /// A word beside each point; may be empty.
    pub(super) words: Vec<String>,
}

/// One panel.
#[derive(Debug, Clone)]
pub(super) struct Panel {
    pub(super) title: String,
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) series: Vec<Series>,
}

/// The panels in a grid under a title and a legend of the series' names.
pub(super) fn figure(title: &str, names: &[&str], panels: &[Panel], num_columns: usize) -> String {
    let num_rows = panels.len().div_ceil(num_columns);
    // Two panels wide at least: title and legend want that much.
    let (width, height) = (PANEL[0] * num_columns.max(2) as f64, HEADER + PANEL[1] * num_rows as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"11\" fill=\"#222222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"14\" y=\"22\" font-size=\"15\" font-weight=\"bold\">{}</text>\n",
        escaped(title)
    );
    let mut x = 14.0;
    for (name, color) in names.iter().zip(COLORS.iter().cycle()) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<circle cx=\"{}\" cy=\"42\" r=\"4\" fill=\"{color}\"/><text x=\"{}\" y=\"46\">{}</text>",
            x + 4.0,
            x + 12.0,
            escaped(name)
        );
        x += 30.0 + 6.6 * name.chars().count() as f64;
    }
    for (idx, panel) in panels.iter().enumerate() {
        let corner = [(idx % num_columns) as f64 * PANEL[0], HEADER + (idx / num_columns) as f64 * PANEL[1]];
        panel.draw(&mut svg, corner);
    }
    svg.push_str("</svg>\n");
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Spacing {
    /// Position along the axis before it is fitted to the panel.
    fn place(self, value: f64) -> f64 {
        match self {
            Self::Even => value,
            Self::Logarithmic => value.max(1e-12).log10(),
        }
    }

    /// Round values inside an interval of places.
    fn ticks(self, low: f64, high: f64) -> Vec<f64> {
        match self {
            Self::Even => {
                let rough = (high - low) / 5.0;
                let power = 10_f64.powf(rough.log10().floor());
                let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|step| *step >= rough);
                let step = step.unwrap_or(power * 10.0);
                ((low / step).ceil() as i64..=(high / step).floor() as i64).map(|idx| idx as f64 * step).collect()
            }
            Self::Logarithmic => {
                let steps: &[f64] = if high - low > 2.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
                let powers = low.floor() as i32..=high.ceil() as i32;
                let all = powers.flat_map(|power| steps.iter().map(move |m| m * 10_f64.powi(power)));
                all.filter(|value| (low..=high).contains(&value.log10())).collect()
            }
        }
    }
}

/// The places that an axis shows, with a little room at both ends.
fn interval(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low <= high { (low - 0.05 * (high - low).max(0.2), high + 0.08 * (high - low).max(0.2)) } else { (0.0, 1.0) }
}

/// A number in few characters.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 1e6 => format!("{}M", (value / 1e5).round() / 10.0),
        size if size >= 1e4 => format!("{}k", (value / 1e2).round() / 10.0),
        size if size < 0.01 && size > 0.0 => format!("{value:.0e}"),
        _ => format!("{}", (value * 1e4).round() / 1e4),
    }
}

impl Panel {
    fn draw(&self, svg: &mut String, [x, y]: [f64; 2]) {
        let (left, top) = (x + MARGIN[0], y + MARGIN[1]);
        let (right, bottom) = (x + PANEL[0] - MARGIN[2], y + PANEL[1] - MARGIN[3]);
        let points = || self.series.iter().flat_map(|series| series.points.iter().copied());
        let (x_low, x_high) = interval(points().map(|(x, _)| self.x.spacing.place(x)));
        let (y_low, y_high) = interval(points().map(|(_, y)| self.y.spacing.place(y)));
        let to_px = |(px, py): (f64, f64)| {
            let across = (self.x.spacing.place(px) - x_low) / (x_high - x_low);
            let up = (self.y.spacing.place(py) - y_low) / (y_high - y_low);
            (left + across * (right - left), bottom - up * (bottom - top))
        };
        for tick in self.x.spacing.ticks(x_low, x_high) {
            let (px, _) = to_px((tick, 1.0));
            let _ = writeln!(
                svg,
                "<path d=\"M{px:.1} {top:.1}V{bottom:.1}\" stroke=\"#e4e4e4\"/><text x=\"{px:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 14.0,
                short(tick)
            );
        }
        for tick in self.y.spacing.ticks(y_low, y_high) {
            let (_, py) = to_px((1.0, tick));
            let _ = writeln!(
                svg,
                "<path d=\"M{left:.1} {py:.1}H{right:.1}\" stroke=\"#e4e4e4\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 5.0,
                py + 4.0,
                short(tick)
            );
        }
        let (middle_x, middle_y) = (f64::midpoint(left, right), f64::midpoint(top, bottom));
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\" fill=\"none\" stroke=\"#999999\"/>\
             <text x=\"{left:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>\
             <text x=\"{middle_x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555555\">{}</text>\
             <text x=\"{:.1}\" y=\"{middle_y:.1}\" text-anchor=\"middle\" fill=\"#555555\" transform=\"rotate(-90 {:.1} {middle_y:.1})\">{}</text>",
            top - 8.0,
            escaped(&self.title),
            bottom + 30.0,
            escaped(&self.x.name),
            x + 13.0,
            x + 13.0,
            escaped(&self.y.name)
        );
        self.series.iter().for_each(|series| series.draw(svg, &to_px));
    }
}

impl Series {
    fn draw(&self, svg: &mut String, to_px: &impl Fn((f64, f64)) -> (f64, f64)) {
        let color = COLORS[self.name_idx % COLORS.len()];
        let places: Vec<(f64, f64)> = self.points.iter().map(|point| to_px(*point)).collect();
        if self.is_line {
            let line: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.3\"/>",
                line.join(" ")
            );
        }
        let radius = if self.is_line { 2.2 } else { 4.5 };
        for ((x, y), word) in places.iter().zip(self.words.iter().map(String::as_str).chain(std::iter::repeat(""))) {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{color}\"/>");
            if !word.is_empty() {
                let _ = writeln!(
                    svg,
                    "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"9\" fill=\"{color}\">{}</text>",
                    x + 5.0,
                    y - 4.0,
                    escaped(word)
                );
            }
        }
    }
}
