//! Tests of `director`: keys and their codes, scene frame, vocabulary, model files, directions.

mod codes;
mod direction;
mod frame;
mod keys;
mod model_files;
mod vocabulary;
