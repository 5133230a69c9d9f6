//! Words: a prompt's objects and quantities found (`link`), and prompts with their meaning invented (`Phrasebook`).
//!
//! Enters: a sentence and the scene's named objects. Leaves: the sentence as plain words with `<obj-S>` and `<qty-Q>` in
//! place of names and quantities, every word with its bytes of the prompt; or (sentence, program) pairs for training and
//! for the exam. The one invariant: spans always lie on character boundaries of the prompt they came from. Nothing here
//! decides what a sentence means: that is the model's part.

pub mod counting;
mod effects;
mod error;
pub mod grammar;
pub mod inflection;
pub mod lexicon;
mod link;
mod mention;
pub mod names;
pub mod notation;
mod quantity;
mod unknown;
pub mod words;

pub use effects::{CalledFor, effects_called_for};
pub use error::LanguageError;
pub use link::{Linked, MAX_PROMPT_BYTES, MAX_QUANTITIES, MAX_SLOTS, link};
pub use names::NamedObject;
pub use notation::{program_from_notation, program_to_notation};
pub use quantity::{Quantity, QuantityKind};
pub use unknown::UnknownName;
