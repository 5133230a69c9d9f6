//! Tests of `training`: dataset and training loop.

mod corpus;
mod dataset;
mod modifiers;
mod phrases;
mod train;
