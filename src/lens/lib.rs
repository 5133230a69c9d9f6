//! Effects of the lens that a shot calls for: which ones there are, and what becomes of each.
//!
//! Enters: what the words call for, and what a person chose with `--effects`. Leaves: one decision an effect, as a
//! value of the shot and a line of its report. The invariant: an effect that was called for is either in the picture or
//! named as absent.

mod decision;
mod effect;

pub use decision::{Call, Decision, Outcome, decide};
pub use effect::{Effect, EffectChoice, UnknownEffect};
