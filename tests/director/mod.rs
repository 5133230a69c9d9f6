//! Tests of `director`: keys and their codes, scene frame, vocabulary, model files, directions.

mod beats;
mod bert;
mod calibration;
mod circles;
mod codes;
mod compositions;
mod direction;
mod frame;
mod heights;
mod hostile;
mod keys;
mod model_files;
mod names;
mod parts_and_times;
mod plain_words;
mod said;
mod said_of_all;
mod vocabulary;
