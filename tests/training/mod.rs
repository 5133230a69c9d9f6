//! Tests of `training`: dataset and training loop.

mod dataset;
mod train;
