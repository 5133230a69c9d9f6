use glam::DVec2;

use super::Chart;
use super::chart::{TEXT, text};
use super::drawing::{Anchor, Drawing, Ink, Mark, Stroke, TextStyle, text_width_px};
use super::extras::ColorScale;

/// Margin of title and legend, px.
const MARGIN: f64 = 16.0;
/// Height of title and legend above the charts of a [`grid`], px.
const HEADER: f64 = 58.0;
/// Font size of the title and of the legend, px.
const TITLE_PX: f64 = 16.0;
const LEGEND_PX: f64 = 12.0;
/// Steps of a color bar.
const NUM_STEPS: usize = 64;

/// The symbol of a legend entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegendSymbol {
    /// A filled dot.
    Dot,
    /// A line.
    Line,
    /// A ring.
    Ring,
}

/// An entry of the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// Text.
    pub name: String,
    /// Color of the symbol, as in SVG.
    pub color: &'static str,
    /// Symbol before the text.
    pub symbol: LegendSymbol,
}

/// A drawing with a title, to which a legend and charts are added.
#[derive(Debug)]
pub struct Figure {
    drawing: Drawing,
}

impl Figure {
    /// A figure of a width and height in px, without charts.
    pub fn new(size_px: [f64; 2], title: &str) -> Self {
        let style = TextStyle { size_px: TITLE_PX, ink: TEXT, anchor: Anchor::Start, is_bold: true };
        let heading = Mark::Text { at_px: DVec2::new(MARGIN, 26.0), style, halo_px: 0.0, text: title.to_owned() };
        let drawing = Drawing { size_px: DVec2::from_array(size_px), title: title.to_owned(), marks: vec![heading] };
        Self { drawing }
    }

    /// Adds the legend, one line below the title.
    pub fn legend(&mut self, entries: &[LegendEntry]) {
        let mut x = MARGIN;
        for entry in entries {
            let ink = Ink::of_code(entry.color);
            let circle = |fill: Ink, border: Option<Stroke>| Mark::Circle {
                center_px: DVec2::new(x + 4.0, 46.0),
                radius_px: 4.0,
                fill: Some(fill),
                border,
            };
            let (mark, width) = match entry.symbol {
                LegendSymbol::Dot => (circle(ink, None), 8.0),
                LegendSymbol::Ring => (circle(Ink::new([255; 3]), Some(Stroke::solid(ink, 1.5))), 8.0),
                LegendSymbol::Line => {
                    let points_px = vec![DVec2::new(x, 46.0), DVec2::new(x + 26.0, 46.0)];
                    (Mark::Line { points_px, stroke: Stroke::solid(ink, 3.0) }, 26.0)
                }
            };
            x += width + 6.0;
            let style = TextStyle { size_px: LEGEND_PX, ink: TEXT, anchor: Anchor::Start, is_bold: false };
            let at_px = DVec2::new(x, 50.0);
            self.drawing.marks.extend([mark, Mark::Text { at_px, style, halo_px: 0.0, text: entry.name.clone() }]);
            x += text_width_px(&entry.name, LEGEND_PX) + 20.0;
        }
    }

    /// Adds a chart in the area `[x, y, width, height]`, px from the upper left corner.
    pub fn chart(&mut self, area: [f64; 4], chart: &Chart) {
        chart.draw(&mut self.drawing, area);
    }

    /// Adds an upright color bar in the area `[x, y, width, height]`, px: the colors of a scale, with the values at both
    /// ends and in the middle, and the name above.
    pub fn color_bar(&mut self, [x, y, width, height]: [f64; 4], name: &str, scale: &ColorScale) {
        let (low, high) = scale.range;
        let marks = &mut self.drawing.marks;
        let row = height / NUM_STEPS as f64;
        for step in 0..NUM_STEPS {
            let share = (step as f64 + 0.5) / NUM_STEPS as f64;
            let bottom = y + height - row * step as f64;
            let corners = [(x, bottom - row - 0.3), (x + width, bottom - row - 0.3), (x + width, bottom), (x, bottom)];
            let outline_px = corners.map(|(x, y)| DVec2::new(x, y)).to_vec();
            marks.push(Mark::Area { outline_px, fill: Some(scale.ink(low + share * (high - low))), border: None });
        }
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let at = DVec2::new(x + width + 5.0, y + height * (1.0 - share) + 4.0);
            marks.push(text(at, &significant(low + share * (high - low), 3), Anchor::Start, TEXT, false));
        }
        marks.push(text(DVec2::new(x, y - 9.0), name, Anchor::Start, TEXT, false));
    }

    /// The figure as a drawing.
    pub fn into_drawing(self) -> Drawing {
        self.drawing
    }
}

/// A number with this many significant digits, without trailing zeros behind the point.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { value.to_string() };
    }
    let power = value.abs().log10().floor() as i32;
    if !(-4..7).contains(&power) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let decimals = (digits as i32 - 1 - power).max(0) as usize;
    let fixed = format!("{value:.decimals$}");
    if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.').to_owned() } else { fixed }
}

/// A figure as SVG text: charts of size `chart_px` in rows of `num_columns`, below a title and a legend.
pub fn grid(title: &str, entries: &[LegendEntry], charts: &[Chart], num_columns: usize, chart_px: [f64; 2]) -> String {
    let num_rows = charts.len().div_ceil(num_columns.max(1));
    let names = entries.iter().map(|entry| text_width_px(&entry.name, LEGEND_PX) + 52.0).sum::<f64>();
    let wanted = names.max(text_width_px(title, TITLE_PX)) + 2.0 * MARGIN;
    let width = (chart_px[0] * num_columns as f64 + MARGIN).max(wanted).ceil();
    let mut figure = Figure::new([width, HEADER + chart_px[1] * num_rows as f64], title);
    figure.legend(entries);
    for (idx, chart) in charts.iter().enumerate() {
        let (column, row) = ((idx % num_columns) as f64, (idx / num_columns) as f64);
        let corner = [MARGIN / 2.0 + column * chart_px[0], HEADER + row * chart_px[1]];
        figure.chart([corner[0], corner[1], chart_px[0], chart_px[1]], chart);
    }
    figure.into_drawing().to_svg()
}
