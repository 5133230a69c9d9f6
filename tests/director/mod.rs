//! Tests of `director`: keys, frame, vocabulary, network, weights, training.

mod direction;
mod frame;
mod keys;
mod model_files;
mod training;
mod vocabulary;
