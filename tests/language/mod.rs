//! The director's language: linking, quantities, the notation, the phrasebook, the exam.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking, in its helpers too")]

mod effects;
mod exam;
mod link;
mod notation;
mod prompt_sampler;
mod quantity;
