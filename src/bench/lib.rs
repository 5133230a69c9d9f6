//! Accuracy against time: scenes at several settings, each timed and held against the spec image.
//!
//! Enters: a renderer, cameras, [`Variant`]s. Leaves: [`BenchRow`]s, and of them a CSV, a table and Pareto plots. Times
//! are those of color in eight bits, which films take; accuracy is that of the same picture as numbers. What other
//! outputs cost is measured in turn with color alone ([`RenderOutput`]). [`scaling`] measures how cost grows with the
//! work instead. The one invariant: a variant of [`KnobKind::Free`] is held against the picture of `standard` bit by
//! bit, all others against `reference`.

mod difference;
mod measure;
mod output;
mod pareto;
mod report;
pub mod scaling;
mod variants;

pub use difference::{Difference, difference};
pub use measure::{BenchPlan, BenchRow, Timing, measure, time};
pub use output::RenderOutput;
pub use pareto::{AccuracyAxis, pareto_svg};
pub use report::{to_csv, to_table};
pub use variants::{KnobKind, Variant, presets, variants};
