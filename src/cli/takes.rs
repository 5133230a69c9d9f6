//! Several takes of one prompt: the best films that clearly differ, numbered files, and one sheet to choose from.

use std::path::{Path, PathBuf};

use clap::Args;

use super::failure::Failure;
use super::{console, heading};
use cinesplat::files::Existing;
use cinesplat::pipeline;
use cinesplat::render::Renderer;
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;

/// Stands for the number of the take in an output.
const PLACEHOLDER: &str = "{}";

/// Number of takes.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct TakesArgs {
    /// Films to keep that clearly differ in side, height or path, the best first
    ///
    /// The outputs are numbered: NAME.1.json, NAME.2.json and so on, or the number takes the place of {}. A sheet shows the
    /// takes side by side.
    #[arg(long = "takes", value_name = "N", help_heading = heading::SHOT, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=9))]
    pub(super) count: u8,
}

impl TakesArgs {
    /// Whether outputs are numbered.
    pub(super) fn is_several(self) -> bool {
        self.count > 1
    }

    /// Numbers of the takes.
    pub(super) fn numbers(self) -> impl Iterator<Item = usize> {
        1..=usize::from(self.count)
    }

    /// Says where fewer films clearly differ than were asked for.
    pub(super) fn note_fewer(self, num_found: usize) {
        if num_found < usize::from(self.count) {
            let films = if num_found == 1 { "only one film meets" } else { "only some films meet" };
            console::warnings([format!(
                "{num_found} of {} takes: {films} the words and clearly differ from better ones",
                self.count
            )]);
        }
    }
}

/// The output of a take: its number takes the place of `{}`, or stands before the extension.
pub(super) fn output_of(path: &Path, number: usize) -> PathBuf {
    let text = path.to_string_lossy();
    if text.contains(PLACEHOLDER) {
        return PathBuf::from(text.replace(PLACEHOLDER, &number.to_string()));
    }
    named(path, &number.to_string(), path.extension().map(|extension| extension.to_string_lossy().into_owned()))
}

/// The sheet of the takes of an output, beside it.
pub(super) fn sheet_beside(path: &Path) -> PathBuf {
    let plain = PathBuf::from(path.to_string_lossy().replace(PLACEHOLDER, "takes"));
    if plain == path { named(path, "takes", Some("png".to_owned())) } else { plain.with_extension("png") }
}

fn named(path: &Path, word: &str, extension: Option<String>) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let extension = extension.map_or_else(String::new, |extension| format!(".{extension}"));
    path.with_file_name(format!("{stem}.{word}{extension}"))
}

/// Writes the sheet of some takes.
pub(super) fn write_sheet(
    (scene, renderer): (&Scene, &Renderer<'_>),
    shots: &[Shot],
    path: &Path,
    existing: Existing,
) -> Result<(), Failure> {
    pipeline::takes_sheet(scene, renderer, shots)?.write(path, existing)?;
    console::note(&format!("{}: {} takes side by side", path.display(), shots.len()));
    Ok(())
}
