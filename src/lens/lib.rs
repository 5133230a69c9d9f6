//! Effects of the lens and the film stock that a shot requests, and the decision on each.
//!
//! Enters: the effects that the prompt requests, and those that the user chose with `--effects`. Leaves: one decision
//! per request, as an entry of the shot and a line of its report. The invariant: every requested effect is either in
//! the picture or reported as missing.

mod decision;
mod effect;

pub use decision::{Decision, EffectCall, EffectKind, Verdict, decide};
pub use effect::{Effect, EffectChoice, UnknownEffect};
