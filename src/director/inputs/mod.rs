//! Inputs of the network: a linked prompt as tokens, and objects as boxes with points.

mod grounding;
mod merges;
mod move_words;
mod objects;
mod prompt;
mod text;
mod tokenizer_parts;
mod vocabulary;

pub use grounding::Grounding;
pub use objects::{MAX_OTHER_OBJECTS, MAX_POINTS, ObjectInput, object_input};
pub use prompt::{Prompt, TokenInput};
pub use text::encode_text;
pub use vocabulary::{NUM_OBJECT_SLOTS, Vocabulary, object_token};

pub(crate) use objects::other_objects;
pub(crate) use tokenizer_parts::TOKENIZER_FILE;
pub(crate) use vocabulary::{NUM_SPECIAL_TOKENS, PAD};
