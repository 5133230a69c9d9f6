//! Benchmarks of the renderer: accuracy against time, and time and memory against the amount of work.
//!
//! Enters: a renderer, cameras and [`Variant`]s of its settings. Leaves: [`BenchRow`]s, and from them a CSV, Markdown
//! tables and Pareto plots. Times are those of 8-bit color, which films use. Accuracy is that of the same picture in
//! `f32`. The time of other outputs ([`RenderOutput`]) is measured alternately with that of color alone.
//! [`LensBench`] measures motion blur and depth of field, [`measure_auto`] what leaving effects out saves and costs, and
//! [`measure_costs`] every effect alone. [`scaling`] measures how time and memory grow with the amount of work. The one invariant: a variant of
//! [`KnobKind::Free`] must equal the picture of `standard` bit by bit; all others are compared with `reference`.

mod difference;
mod lens;
mod lens_auto;
mod lens_costs;
mod lens_report;
mod measure;
mod output;
mod pareto;
mod report;
pub mod scaling;
mod variants;

pub use difference::{Difference, difference};
pub use lens::{BlurSource, LENS_CASES, LensBench, LensCase, LensMethod, LensRow};
pub use lens_auto::{AUTO_CSV_HEADER, AUTO_FLOORS, AUTO_FRAMES, AutoRow, AutoShot, measure_auto};
pub use lens_costs::{COST_CSV_HEADER, CostRow, measure_costs};
pub use lens_report::{LENS_CSV_HEADER, lens_csv_line, lens_row_of, lens_svg};
pub use measure::{BenchPlan, BenchRow, Timing, measure};
pub use output::RenderOutput;
pub use pareto::{AccuracyAxis, pareto_svg};
pub use report::{median, to_csv, to_table};
pub use variants::{KnobKind, Variant, presets, variants};
