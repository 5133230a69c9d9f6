use std::path::Path;

use super::console;
use super::failure::Failure;
use cinesplat::director::Names;
use cinesplat::training::corpus::{Split, Writer, read_folder};
use cinesplat::training::{NameFigures, NameSettings, Tally, TrainError, examine_names, train_names};

/// Trains the network of names on the training writers of `sentences`.
pub(super) fn train(settings: &NameSettings, sentences: &Path, out: &Path) -> Result<(), Failure> {
    let writers = read_folder(sentences).map_err(TrainError::from)?;
    let total = settings.steps;
    let summary = train_names(settings, &of(&writers, Split::Training), out, &mut |progress| {
        console::note(&format!("step {}/{total}: loss {:.4}", progress.done, progress.loss));
    })?;
    console::note(&format!(
        "{} parameters, {} sentences, weights {}",
        summary.num_parameters, summary.num_sentences, summary.sha256
    ));
    examine(out, &writers)
}

/// Prints figures of the development writers of `sentences` and every sentence with a mistake.
pub(super) fn examine_model(model: &Path, sentences: &Path) -> Result<(), Failure> {
    examine(model, &read_folder(sentences).map_err(TrainError::from)?)
}

fn of(writers: &[Writer], split: Split) -> Vec<Writer> {
    writers.iter().filter(|writer| writer.split == split).cloned().collect()
}

fn examine(model: &Path, writers: &[Writer]) -> Result<(), Failure> {
    let names = if model.as_os_str() == "built-in" { Names::embedded()? } else { Names::load(model)? };
    for writer in of(writers, Split::Development) {
        let figures = examine_names(&names, std::slice::from_ref(&writer))?;
        console::data(&format!("{}: {}\n", writer.name, figures_line(&figures)))?;
        for mistake in &figures.mistakes {
            let (lost, invented) = (mistake.lost.join(" · "), mistake.invented.join(" · "));
            console::data(&format!("  {}\n    meant      {lost}\n    understood {invented}\n", mistake.prompt))?;
        }
    }
    Ok(())
}

fn figures_line(figures: &NameFigures) -> String {
    let percent = |tally: Tally| format!("{:.1} % of {}", 100.0 * tally.correct_frac(), tally.total);
    format!(
        "mentions right in {} sentences, {} mentions right, wrong refusals in {:.1} % of {} sentences, {} missing things found",
        percent(figures.sentences),
        percent(figures.mentions),
        100.0 - 100.0 * figures.accepted.correct_frac(),
        figures.accepted.total,
        percent(figures.missing)
    )
}
