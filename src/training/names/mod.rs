//! Training of the network of names: examples from the corpus, their augmentation, the loop, figures.

mod augmentation;
mod example;
mod figures;
mod rename;
mod run;

pub use figures::{NameFigures, NameMistake, examine_mentions, examine_names};
pub use run::{NameProgress, NameSettings, NameSummary, train_names};
