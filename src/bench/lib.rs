//! Benchmarks of the renderer: accuracy against time, and time and memory against the amount of work.
//!
//! Enters: a renderer, cameras and [`Variant`]s of its settings. Leaves: [`BenchRow`]s, and from them a CSV, Markdown
//! tables and Pareto plots. Times are those of 8-bit color, which films use. Accuracy is that of the same picture in
//! `f32`. The time of other outputs ([`RenderOutput`]) is measured alternately with that of color alone.
//! [`scaling`] measures how time and memory grow with the amount of work. The one invariant: a variant of
//! [`KnobKind::Free`] must equal the picture of `standard` bit by bit; all others are compared with `reference`.

mod difference;
mod measure;
mod output;
mod pareto;
mod report;
pub mod scaling;
mod variants;

pub use difference::{Difference, difference};
pub use measure::{BenchPlan, BenchRow, Timing, measure};
pub use output::RenderOutput;
pub use pareto::{AccuracyAxis, pareto_svg};
pub use report::{to_csv, to_table};
pub use variants::{KnobKind, Variant, presets, variants};
