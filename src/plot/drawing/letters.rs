//! A font of strokes, for pictures without a font file.
//!
//! Letters lie on a grid of half units: x grows to the right, y downward. Capitals reach from row 0 to the base line in
//! row 16, small letters from row 6, descenders to row 21.

use glam::DVec2;

use super::glyphs::{glyph, plain};

/// Height of capitals over the font size.
const CAPITAL_FRAC: f64 = 0.72;
/// Rows of the grid from the top of capitals to the base line.
const BASE_ROW: f64 = 16.0;
/// Space after a letter, columns.
const SPACING: f64 = 3.6;
/// Advance of a space, columns.
const SPACE: f64 = 5.5;
/// Rounds of corner cutting for curves.
const NUM_CUTS: usize = 3;

/// Strokes of a letter on the grid, and the column where the next letter starts.
fn strokes(letter: char) -> (Vec<Vec<DVec2>>, f64) {
    if letter.is_whitespace() {
        return (Vec::new(), SPACE);
    }
    let drawn: Vec<Vec<DVec2>> = glyph(plain(letter)).split(' ').map(stroke).collect();
    let width = drawn.iter().flatten().map(|point| point.x).fold(0.0, f64::max);
    // Figures are equally wide, so that numbers below each other line up.
    let width = if letter.is_ascii_digit() { 8.0 } else { width };
    (drawn, width + SPACING)
}

fn stroke(code: &str) -> Vec<DVec2> {
    let (is_curve, digits) = code.strip_prefix('~').map_or((false, code), |rest| (true, rest));
    let values: Vec<f64> = digits.chars().filter_map(|digit| digit.to_digit(36)).map(f64::from).collect();
    let points: Vec<DVec2> = values.chunks_exact(2).map(|pair| DVec2::new(pair[0], pair[1])).collect();
    if is_curve { (0..NUM_CUTS).fold(points, |points, _| cut(&points)) } else { points }
}

/// One round of corner cutting that keeps both ends (Chaikin 1974); its limit is the quadratic B-spline.
fn cut(points: &[DVec2]) -> Vec<DVec2> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let inner = points.windows(2).flat_map(|pair| [pair[0].lerp(pair[1], 0.25), pair[0].lerp(pair[1], 0.75)]);
    std::iter::once(*first).chain(inner).chain([*last]).collect()
}

/// Width of a text at a font size, px. It holds in every output, whatever its font.
pub fn text_width_px(text: &str, size_px: f64) -> f64 {
    let columns: f64 = text.chars().map(|letter| strokes(letter).1).sum();
    (columns - SPACING).max(0.0) * CAPITAL_FRAC * size_px / BASE_ROW
}

/// Strokes of a text whose base line starts at a point, px.
pub(super) fn text_strokes(text: &str, start_px: DVec2, size_px: f64) -> Vec<Vec<DVec2>> {
    let px_per_row = CAPITAL_FRAC * size_px / BASE_ROW;
    let mut column = 0.0;
    let mut all = Vec::new();
    for letter in text.chars() {
        let (drawn, advance) = strokes(letter);
        let place = |point: DVec2| start_px + DVec2::new(point.x + column, point.y - BASE_ROW) * px_per_row;
        all.extend(drawn.into_iter().map(|stroke| stroke.into_iter().map(place).collect()));
        column += advance;
    }
    all
}
