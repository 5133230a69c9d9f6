//! Words and objects to programs, by a language model that the user brings.
//!
//! Enters: a GGUF file of the family Qwen2 or Llama, and a [`Question`]: a prompt with the objects of the scene. Leaves: an
//! [`Interpretation`]: the program, the words that each step comes from, and how sure the model is. The one invariant:
//! the answer is a program in the notation about objects of the question. The model chooses only among tokens that the
//! notation allows at that place ([`decode()`]), so it cannot say anything else.
//!
//! The model runs on the CPU, and nothing is fetched. candle does not apply the scaled rotations that Llama 3.1 and later
//! store as `rope_freqs.weight`; they matter for texts longer than the questions here.
//!
//! Without the feature `models` the crate has the same interface and [`Reader::load`] refuses every file.

#![cfg_attr(not(feature = "models"), allow(dead_code, reason = "only language models use it"))]

mod answer;
#[cfg(feature = "models")]
mod conversation;
#[cfg(feature = "models")]
mod decode;
mod error;
#[cfg(feature = "models")]
mod gguf_header;
mod interpretation;
mod question;
#[cfg(feature = "models")]
mod reader;
#[cfg(not(feature = "models"))]
#[path = "no_models.rs"]
mod reader;
#[cfg(feature = "models")]
mod shape;
#[cfg(feature = "models")]
mod vocabulary;
#[cfg(feature = "models")]
mod weights;

pub use answer::Answer;
#[cfg(feature = "models")]
pub use conversation::question_tokens;
#[cfg(feature = "models")]
pub use decode::decode;
pub use error::ReaderError;
pub use interpretation::{Certainty, Interpretation};
pub use question::{MAX_OBJECTS, Question};
pub use reader::Reader;
#[cfg(feature = "models")]
pub use vocabulary::Vocabulary;
