//! Realized shots as training data: scenes with their objects' clouds, prompts, programs, and the cameras that the
//! operator found for them.
//!
//! A shard is a text file of JSON lines: a header, then one scene a line with its shots. Programs are stored in the
//! phrasebook's notation. What the network sees is made from it anew for every lesson.

mod error;
mod realized;
mod record;
mod write;

pub use error::DatasetError;
pub(crate) use realized::RealizedShot;
pub(crate) use realized::read_shards;
pub use write::{DatasetSettings, DatasetSummary, write_dataset};
