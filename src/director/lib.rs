//! The director: a small network that turns words and objects into a camera program.
//!
//! Enters: a linked prompt, and the scene's objects with their sparse clouds. Leaves: a [`Direction`], which is a
//! program of steps and one camera per key. A Q-former turns each object's cloud into a few tokens. A small causal
//! decoder attends to text tokens and object tokens, and emits keys one by one until it emits a stop. The one
//! invariant: for every prompt, the program names only objects of the scene, and all numbers are finite.
//!
//! [`Director`] runs the network; most callers need nothing else. The other items serve training:
//! - [`keys`] converts a program into the keys that the network emits, and back;
//! - [`codes`] converts keys and camera poses into class numbers, pointers and values, and back;
//! - [`inputs`] converts a linked prompt and objects into tokens and points;
//! - [`names`] finds the mentions of objects in a prompt; [`Names`] runs it;
//! - [`network`] holds the layers, their parameters and padded batches;
//! - [`ModelFiles`] stores and loads a trained network.
//!
//! Only this crate and `training` use candle, and only this crate uses tokenizers.

mod acting;
mod alternatives;
mod appositions;
mod banned;
mod bearers;
mod beats;
mod calibration;
pub mod codes;
mod compositions;
mod consensus;
mod contained;
mod decoding;
mod direction;
mod director;
mod error;
mod explained;
mod frame;
mod heads;
mod hung;
mod idle;
pub mod inputs;
pub mod keys;
mod lacking;
mod lettered;
mod likeness;
mod located;
mod lost;
mod manifest;
mod model;
mod model_files;
pub mod names;
pub mod network;
mod numbered_lists;
mod ordinals;
mod pairs;
mod placed;
mod reading;
mod said;
mod said_again;
mod scan_parts;
mod sized;
mod tensor_file;
mod times;
mod told;
mod uses;
mod verbs_apart;

pub use calibration::Calibration;
pub use decoding::Choice;
pub use direction::{Direction, StepCertainty, Voices};
pub use director::{Director, SceneContext};
pub use error::DirectorError;
pub use frame::SceneFrame;
pub use model_files::ModelFiles;
pub use names::{FoundMention, Names, NamesFiles};
pub use placed::Places;
pub use said::take_levels;
