//! Failures of commands: one file per stage maps the error of that stage to an exit code and a line of help.
//!
//! Enters: a library's error, which says what happened. Leaves: a [`Failure`], which adds a line of help and the exit
//! code. Every match lists all variants, so a new variant does not compile without both.

mod director;
mod evaluation;
mod exit;
mod export;
mod files;
mod job;
mod language;
mod map;
mod message;
mod objects;
mod pipeline;
mod plot;
mod reader;
mod render;
mod scene;
#[cfg(feature = "training")]
mod training;
mod video;
mod vision;

pub(super) use exit::Exit;
pub(super) use message::Failure;
