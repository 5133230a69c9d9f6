//! Programs as short text, for training data, the exam and people. The crate docs give the grammar.

mod error;
mod parse;
mod print;

pub use error::NotationError;
pub use parse::{program_from_notation, step_from_notation};
pub use print::program_to_notation;
