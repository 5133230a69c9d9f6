//! Realized shots as training data: scenes with the clouds of their objects, prompts, programs, and the cameras that the
//! operator found for them.
//!
//! A shard is a text file of JSON lines: a header, then one scene per line with its shots. Programs are stored in the
//! notation of `language`. The inputs of the network are recomputed for every example.

mod error;
mod realized;
mod record;
mod scene_shots;
mod settings;
mod write;

pub use error::DatasetError;
pub use settings::DatasetSettings;
pub use write::{DatasetSummary, write_dataset};

pub(crate) use realized::{RealizedShot, read_shards};
