//! Programs as short text, for training data, the exam and people. The crate docs give the grammar.

mod error;
mod grammar;
mod parse;
mod pattern;
mod print;

pub use error::NotationError;
pub use grammar::{MAX_LISTED, MAX_STEPS, program_pattern};
pub use parse::{program_from_notation, step_from_notation};
pub use pattern::{Automaton, Pattern, States};
pub use print::program_to_notation;
