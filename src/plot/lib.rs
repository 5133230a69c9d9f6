//! Charts and drawings as SVG, PNG and PDF: lines and markers over linear or logarithmic axes, with labels placed to avoid
//! each other.
//!
//! Enters: [`Chart`]s of [`Series`], bars, distributions and lines colored by a value, in their own units. Leaves: one
//! [`Figure`] with a title, a legend and the charts, each in the area that the caller chooses, as a
//! [`Drawing`](drawing::Drawing). The one invariant: the same input gives the same bytes.

mod axis;
mod chart;
pub mod drawing;
mod error;
mod extras;
mod figure;
mod labels;
mod png;

pub use axis::{Axis, AxisScale};
pub use chart::{Chart, Marker, Series};
pub use error::PlotError;
pub use extras::{Bar, ColorScale, ColoredLine, Level, Spread};
pub use figure::{Figure, LegendEntry, LegendSymbol, grid, significant};

/// Colors that stay distinguishable with every kind of color vision (Okabe and Ito); the first is gray.
pub const COLORS: [&str; 8] = ["#888888", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222"];
