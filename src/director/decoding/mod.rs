//! Keys from the scores of the network.

mod beam_search;
mod choice;
mod coverage;
mod key_choice;

pub use choice::Choice;

pub(crate) use beam_search::{DecodedPrompt, decode};
pub(crate) use key_choice::{KeyCertainty, WordRules};
