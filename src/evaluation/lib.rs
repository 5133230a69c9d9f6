//! How far one camera path is from another, and how a path moves: errors, alignment, smoothness, motion tags, plots.
//!
//! Enters: timed poses. Leaves: numbers, JSON values and SVG text. Error measures are those of `evo_ape` and `evo_rpe`
//! and equal to theirs where those are right; where they raise or mislead (straight, still and turning-only paths) the
//! answer is defined and says why. The one invariant: nothing is aligned unless asked. Never does IO.

mod alignment;
mod associate;
mod batch;
mod error;
mod evaluate;
mod fourier;
mod framing;
mod lens;
mod motion;
mod named_move;
mod pairs;
mod plot;
mod relation;
mod report;
mod singular;
mod smoothness;
mod statistics;
mod table;
mod tagger;
mod trajectory;

pub use alignment::{Align, Alignment, align};
pub use associate::{Matches, Matching, associate};
pub use batch::{BatchRow, FilePairs, pair_files, summary_csv, summary_json, summary_text};
pub use error::{EvaluationError, SettingName};
pub use evaluate::{EvalSettings, Evaluation, Metric, evaluate};
pub use framing::{FramingError, SubjectSphere, framing_error};
pub use lens::{FocalError, focal_error};
pub use motion::{motion_json, motion_text};
pub use named_move::{NamedMove, name_move};
pub use pairs::{Delta, DeltaUnit, PairSettings, pairs};
pub use plot::plot_svg;
pub use relation::Relation;
pub use smoothness::{Smoothness, smoothness};
pub use statistics::Statistics;
pub use table::{TableRow, keyframe_table, table_json, table_text};
pub use tagger::{MotionTag, TagSegment, Tagger, Turn};
pub use trajectory::Trajectory;
