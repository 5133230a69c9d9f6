use std::fmt::Write as _;

use super::chart::{Chart, Series};
use super::{COLORS, escaped};

const SIZE: (f64, f64) = (760.0, 460.0);
const MARGIN: f64 = 24.0;

/// One curve through points, each marked, as SVG text.
pub fn curve_svg(title: &str, x_name: &str, y_name: &str, points: &[(f64, f64)]) -> String {
    let (width, height) = SIZE;
    let mut svg = String::new();
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
    );
    let area = [MARGIN, MARGIN, width - 2.0 * MARGIN, height - 2.0 * MARGIN];
    let mut chart = Chart::new(area, &escaped(title));
    chart.x_name = escaped(x_name);
    chart.y_name = escaped(y_name);
    let keys = (0..points.len()).collect();
    chart.series.push(Series { points: points.to_vec(), color: COLORS[2], keys, marks_start: false });
    chart.draw(&mut svg);
    svg + "</svg>\n"
}
