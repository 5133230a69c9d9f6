//! Errors between camera paths and measures of one path: alignment, smoothness, motion tags, named moves, plots.
//!
//! Enters: timed poses. Leaves: numbers, JSON text, tables and SVG text. The one invariant: paths are aligned only on
//! request. The absolute and relative pose errors equal those of `evo_ape` and `evo_rpe` (evo 1.38.1). For paths on which
//! evo fails or is ambiguous (straight, stationary, turning in place) the result is defined here, and a note states how.
//! This crate does no IO.

mod alignment;
mod associate;
mod batch;
mod convention;
mod describe;
mod description;
mod error;
mod error_figure;
mod evaluate;
mod focal;
mod fourier;
mod framing;
mod motion;
mod named_move;
mod pairs;
mod path_figure;
mod progress;
mod reduce;
mod relation;
mod report;
mod result_table;
mod smoothness;
mod statistics;
mod svd;
mod table;
mod tag_runs;
mod tagger;
mod trajectory;

pub use alignment::{Align, AlignSettings, Alignment, align};
pub use associate::{MatchSettings, Matches, Matching, associate};
pub use batch::{BatchRow, FilePairs, pair_files, summary_csv, summary_json, summary_text};
pub use convention::Convention;
pub use describe::{DescribedMove, describe};
pub use description::{Description, SizeBand};
pub use error::{EvaluationError, SettingName};
pub use error_figure::error_figure;
pub use evaluate::{EvalSettings, Evaluation, Metric, evaluate};
pub use focal::FocalError;
pub use framing::{FramingError, SubjectSphere, framing_error};
pub use motion::motion_text;
pub use named_move::{NamedMove, name_move};
pub use pairs::{Delta, DeltaUnit, PairSettings, pairs};
pub use path_figure::{compared_figure, path_figure};
pub use reduce::{MotionFilter, Reduction, Role};
pub use relation::Relation;
pub use result_table::{result_latex, result_markdown};
pub use smoothness::{Smoothness, smoothness};
pub use statistics::Statistics;
pub use table::{TableRow, keyframe_table, table_json, table_text};
pub use tagger::{MotionTag, TagSegment, Tagger, Turn};
pub use trajectory::Trajectory;
