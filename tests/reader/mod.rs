//! Tests of `reader`: answers held to the notation, questions, and the whole path with tiny models trained in place.

mod answers;
mod files;
mod questions;
mod reading;
mod tiny_model;
