//! All tests of cinesplat in one binary: one module an area of `src`, one file a concept.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "a test fails by panicking, and says on stderr what it skipped"
)]
#![allow(clippy::float_cmp, reason = "what is exact by design is compared exactly")]
#![allow(unreachable_pub, reason = "what areas share is public within this one binary")]

mod allocator;
mod architecture;
mod cli;
mod critic;
mod director;
mod evaluation;
mod export;
mod files;
mod geometry;
mod hostile;
mod language;
mod lens;
mod map;
mod objects;
mod operator;
mod pipeline;
mod reader;
mod render;
mod scene;
mod support;
mod synth;
mod training;
mod trajectory;
mod video;
mod vision;
