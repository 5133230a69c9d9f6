//! A drawing as a list of marks, written as SVG or as pixels.
//!
//! Enters: marks in px, y downward; later marks cover earlier ones. Leaves: SVG text, a PNG or a PDF with the same marks at
//! the same places. The one invariant: the same marks give the same bytes.

mod glyphs;
mod letters;
mod pdf;
mod pixels;
mod simplify;
mod svg;

use glam::DVec2;

pub use letters::text_width_px;

use crate::error::PlotError;
use crate::png;

/// A color with its opacity, 0..=1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Red, green, blue.
    pub rgb: [u8; 3],
    /// Opacity.
    pub opacity: f64,
}

impl Ink {
    /// An opaque color.
    pub const fn new(rgb: [u8; 3]) -> Self {
        Self { rgb, opacity: 1.0 }
    }

    /// The color of a code such as `#d55e00`; black for anything else.
    pub fn of_code(code: &str) -> Self {
        let number = code.strip_prefix('#').and_then(|digits| u32::from_str_radix(digits, 16).ok()).unwrap_or(0);
        let [_, red, green, blue] = number.to_be_bytes();
        Self::new([red, green, blue])
    }

    /// The same color with this opacity.
    #[must_use]
    pub const fn with_opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// How a line is drawn. Ends and corners are round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Color.
    pub ink: Ink,
    /// Width, px.
    pub width_px: f64,
    /// Lengths of dash and gap, px; `None` for a solid line.
    pub dash_px: Option<[f64; 2]>,
}

impl Stroke {
    /// A solid line.
    pub const fn solid(ink: Ink, width_px: f64) -> Self {
        Self { ink, width_px, dash_px: None }
    }

    /// A dashed line.
    pub const fn dashed(ink: Ink, width_px: f64, dash_px: [f64; 2]) -> Self {
        Self { ink, width_px, dash_px: Some(dash_px) }
    }
}

/// Which part of a text lies at its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// How a text is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// Font size, px.
    pub size_px: f64,
    /// Color.
    pub ink: Ink,
    /// Which part of the text lies at its position.
    pub anchor: Anchor,
    /// Whether it is bold.
    pub is_bold: bool,
}

/// A picture in 8-bit color.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row.
    pub rgb8: Vec<u8>,
    /// The same as a PNG file.
    png: Vec<u8>,
}

impl Picture {
    /// A picture of a width and height in pixels.
    ///
    /// # Errors
    /// [`PlotError::Picture`] unless `rgb8` holds three bytes per pixel.
    pub fn new(size: [u32; 2], rgb8: Vec<u8>) -> Result<Self, PlotError> {
        Ok(Self { size, png: png::encode(size, &rgb8)?, rgb8 })
    }
}

/// One mark of a drawing. Positions are in px from the upper left corner, y downward.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A polygon.
    Area {
        /// Its corners.
        outline_px: Vec<DVec2>,
        /// Color of its inside.
        fill: Option<Ink>,
        /// Its border.
        border: Option<Stroke>,
    },
    /// A circle.
    Circle {
        /// Its center.
        center_px: DVec2,
        /// Its radius.
        radius_px: f64,
        /// Color of its inside.
        fill: Option<Ink>,
        /// Its border.
        border: Option<Stroke>,
    },
    /// A line through points.
    Line {
        /// Its points.
        points_px: Vec<DVec2>,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// One line of text.
    Text {
        /// Position on the base line.
        at_px: DVec2,
        /// How it is drawn.
        style: TextStyle,
        /// White border, px, that separates it from what is behind it; 0 for none.
        halo_px: f64,
        /// The text.
        text: String,
    },
    /// A picture, scaled to a rectangle.
    Picture {
        /// Upper left corner.
        corner_px: DVec2,
        /// Width and height of the rectangle.
        size_px: DVec2,
        /// The picture.
        picture: Picture,
    },
}

/// Marks on a white page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Width and height, px.
    pub size_px: DVec2,
    /// What it shows, for readers that cannot see it.
    pub title: String,
    /// The marks, from the back to the front.
    pub marks: Vec<Mark>,
}
