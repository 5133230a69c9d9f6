//! Tests of `src/evaluation`, one file per concept.
#![allow(clippy::float_cmp, reason = "counts, times and exact cases are compared bit by bit")]

mod associate;
mod batch;
mod conventions;
mod degenerate;
mod describe;
mod evo_pairs;
mod evo_parity;
mod framing;
mod named_moves;
mod paths;
mod plot;
mod smoothness;
mod table;
mod taggers;
