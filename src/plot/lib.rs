//! Charts as SVG text: lines and marks over even or logarithmic axes, words that do not cover each other.
//!
//! Enters: [`Chart`]s of [`Series`] in their own units. Leaves: one [`Figure`] with a title, a legend and the charts
//! where the caller puts them, px from the upper left corner. The one invariant: the same input gives the same bytes.

mod axis;
mod chart;
mod figure;
mod labels;
mod text;

pub use axis::{Axis, Spacing};
pub use chart::{Chart, Mark, Series};
pub use figure::{Entry, Figure, Symbol, grid};

/// Colors that people with any kind of color vision tell apart (Okabe and Ito); the first is gray.
pub const COLORS: [&str; 8] = ["#888888", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222"];
