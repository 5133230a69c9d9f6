//! The director: words and object tokens to keyframes, by a network trained here.
//!
//! Enters: a linked prompt and the scene's objects with their sparse clouds. Leaves: a [`Direction`]: a program of steps
//! and a camera for every key. A Q-former turns each object's cloud into a few tokens, a small causal decoder attends to
//! text and object tokens and emits keys one by one until it stops. The one invariant: whatever the words, the program
//! names only objects of the scene and all numbers are finite. The only folder with candle and tokenizers.

pub mod choices;
pub mod codes;
mod coverage;
pub mod decode;
pub mod directing;
mod error;
pub mod frame;
pub mod ground;
pub mod keys;
mod merges;
pub mod model;
pub mod vocabulary;
pub mod weights;

pub use directing::{Direction, Director, Stage, StepCertainty};
pub use error::DirectorError;
pub use frame::SceneFrame;
pub use model::ModelConfig;
pub use vocabulary::Vocabulary;
