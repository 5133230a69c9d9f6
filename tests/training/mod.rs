//! Tests of `training`: dataset and training loop.

mod corpus;
mod dataset;
mod phrases;
mod train;
