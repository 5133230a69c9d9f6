//! What a chart shows besides series: bars, boxes, level lines and lines colored by a value.

use super::drawing::Ink;

/// A bar from 0 to a height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Its left and right side, in units of the horizontal axis.
    pub sides: (f64, f64),
    /// Its height, in units of the vertical axis.
    pub height: f64,
    /// Its color.
    pub color: &'static str,
}

/// The distribution of values: a box over the middle half, a line at the median, whiskers to the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Its place on the horizontal axis.
    pub x: f64,
    /// Width of the box, in units of the horizontal axis.
    pub width: f64,
    /// Low end, first quartile, median, third quartile and high end, in units of the vertical axis.
    pub quartiles: [f64; 5],
    /// Its color.
    pub color: &'static str,
}

/// A dashed line at one value of the vertical axis, with its name at the right end.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// The value.
    pub y: f64,
    /// Text at its right end; may be empty.
    pub name: String,
    /// Whether the text is below the line, not above it.
    pub is_name_below: bool,
    /// Its color.
    pub color: &'static str,
}

/// A line through points whose color shows a value at each.
#[derive(Debug, Clone, PartialEq)]
pub struct ColoredLine {
    /// The points, in units of the axes.
    pub points: Vec<(f64, f64)>,
    /// The value at each point.
    pub values: Vec<f64>,
    /// Colors of the values.
    pub scale: ColorScale,
    /// Width, px.
    pub line_px: f64,
}

/// Colors of a range of values: dark at the low end, bright at the high end, so that they also differ in gray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorScale {
    /// Values of the darkest and the brightest color.
    pub range: (f64, f64),
}

impl ColorScale {
    /// The color of a value; values out of the range take that of the nearer end.
    pub fn ink(&self, value: f64) -> Ink {
        const STOPS: [[f64; 3]; 6] = [
            [32.0, 18.0, 77.0],
            [92.0, 24.0, 120.0],
            [164.0, 44.0, 102.0],
            [222.0, 84.0, 60.0],
            [248.0, 150.0, 32.0],
            [250.0, 222.0, 90.0],
        ];
        let (low, high) = self.range;
        let share = if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        let at = share * (STOPS.len() - 1) as f64;
        let stop = (at as usize).min(STOPS.len() - 2);
        let between = |channel: usize| {
            let (from, to) = (STOPS[stop][channel], STOPS[stop + 1][channel]);
            (from + (to - from) * (at - stop as f64)).round() as u8
        };
        Ink::new([between(0), between(1), between(2)])
    }
}
