use std::fmt::Write as _;

use super::Chart;
use super::text::{escaped, text_width};

/// Margin of title and legend, px.
const MARGIN: f64 = 16.0;
/// Height of title and legend above the charts of a [`grid`], px.
const HEADER: f64 = 58.0;

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
    svg: String,
}

impl Figure {
    /// A figure of a width and height in px, without charts.
    pub fn new([width, height]: [f64; 2], title: &str) -> Self {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{MARGIN}\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{}</text>\n",
            escaped(title)
        );
        Self { svg }
    }

    /// Adds the legend, one line below the title.
    pub fn legend(&mut self, entries: &[LegendEntry]) {
        let mut x = MARGIN;
        for entry in entries {
            let (color, name) = (entry.color, escaped(&entry.name));
            let (mark, width) = match entry.symbol {
                LegendSymbol::Dot => (format!("<circle cx=\"{}\" cy=\"46\" r=\"4\" fill=\"{color}\"/>", x + 4.0), 8.0),
                LegendSymbol::Line => (format!("<path d=\"M{x} 46h26\" stroke=\"{color}\" stroke-width=\"3\"/>"), 26.0),
                LegendSymbol::Ring => (
                    format!(
                        "<circle cx=\"{}\" cy=\"46\" r=\"4\" fill=\"white\" stroke=\"{color}\" stroke-width=\"1.5\"/>",
                        x + 4.0
                    ),
                    8.0,
                ),
            };
            x += width + 6.0;
            // Writing to a string cannot fail.
            let _ = writeln!(self.svg, "{mark}<text x=\"{x:.0}\" y=\"50\">{name}</text>");
            x += text_width(&entry.name, 12.0) + 20.0;
        }
    }

    /// Adds a chart in the area `[x, y, width, height]`, px from the upper left corner.
    pub fn chart(&mut self, area: [f64; 4], chart: &Chart) {
        chart.draw(&mut self.svg, area);
    }

    /// The figure as SVG text.
    pub fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }
}

/// A figure as SVG text: charts of size `chart_px` in rows of `num_columns`, below a title and a legend.
pub fn grid(title: &str, entries: &[LegendEntry], charts: &[Chart], num_columns: usize, chart_px: [f64; 2]) -> String {
    let num_rows = charts.len().div_ceil(num_columns.max(1));
    let names = entries.iter().map(|entry| text_width(&entry.name, 12.0) + 52.0).sum::<f64>();
    let wanted = names.max(text_width(title, 17.0)) + 2.0 * MARGIN;
    let width = (chart_px[0] * num_columns as f64 + MARGIN).max(wanted).ceil();
    let mut figure = Figure::new([width, HEADER + chart_px[1] * num_rows as f64], title);
    figure.legend(entries);
    for (idx, chart) in charts.iter().enumerate() {
        let (column, row) = ((idx % num_columns) as f64, (idx / num_columns) as f64);
        let corner = [MARGIN / 2.0 + column * chart_px[0], HEADER + row * chart_px[1]];
        figure.chart([corner[0], corner[1], chart_px[0], chart_px[1]], chart);
    }
    figure.finish()
}
