//! Outputs of commands: checked before any work, complete or absent, `-` for standard output.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use cinesplat::files::{self, Existing, Limits};

use super::failure::{Exit, Failure};
use super::{console, heading};

pub(super) use cinesplat::files::{create_folder, relative_to};

/// The flag that lets a command overwrite files.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(super) struct Overwrite {
    /// Overwrite files that exist already [default: refuse]
    ///
    /// A sequence of pictures also replaces those of a longer one: the numbers behind its end are removed up to the first gap.
    #[arg(long, help_heading = heading::OUTPUT)]
    overwrite: bool,
}

impl Overwrite {
    pub(super) fn existing(self) -> Existing {
        Existing::replace_if(self.overwrite)
    }

    /// Checks before any work that a file can be created.
    pub(super) fn check(self, path: &Path) -> Result<(), Failure> {
        if is_stdout(path) { Ok(()) } else { Ok(files::check_free(path, self.existing())?) }
    }

    /// As [`Overwrite::write`]; a file that holds these bytes already is left as it is.
    pub(super) fn write_once(self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        if files::holds(path, bytes) { Ok(()) } else { self.write(path, bytes) }
    }

    /// Writes a complete file, or data to standard output.
    pub(super) fn write(self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        if is_stdout(path) { console::data_bytes(bytes) } else { Ok(files::write(path, bytes, self.existing())?) }
    }
}

/// The folder that a bench writes its results to.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct BenchFolder {
    /// Folder for CSV, tables and plots [default: CSV on stdout only]
    ///
    /// The folder is created where it is missing.
    #[arg(short, long, value_name = "DIR", help_heading = heading::OUTPUT)]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl BenchFolder {
    /// Creates the folder and checks before any work that these files can be created in it.
    pub(super) fn prepare(&self, names: &[&str]) -> Result<(), Failure> {
        let Some(folder) = &self.output else { return Ok(()) };
        create_folder(folder)?;
        names.iter().try_for_each(|name| self.overwrite.check(&folder.join(name)))
    }

    /// Whether there is a folder.
    pub(super) fn is_given(&self) -> bool {
        self.output.is_some()
    }

    /// The text of a file that an earlier run wrote to the folder.
    pub(super) fn read(&self, name: &str) -> Result<Option<String>, Failure> {
        let file = self.output.as_ref().map(|folder| folder.join(name)).filter(|file| file.is_file());
        file.map(|file| read_text(&file)).transpose()
    }

    /// Writes a file of the folder over that of an earlier moment of this run, or of a run that it goes on with.
    pub(super) fn rewrite(&self, name: &str, text: &str) -> Result<(), Failure> {
        let Some(folder) = &self.output else { return Ok(()) };
        Ok(files::write(&folder.join(name), text.as_bytes(), Existing::Replace)?)
    }

    /// Writes a file of the folder, where there is one.
    pub(super) fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let Some(folder) = &self.output else { return Ok(()) };
        self.overwrite.write(&folder.join(name), text.as_bytes())
    }
}

/// Refuses two outputs of one path before any work. Each output comes with the flag that names it.
pub(super) fn check_distinct<'a>(outputs: impl IntoIterator<Item = (&'a str, &'a Path)>) -> Result<(), Failure> {
    let mut flag_of_place = BTreeMap::new();
    for (flag, path) in outputs {
        if let Some(first) = flag_of_place.insert(place_of(path), flag) {
            let found = format!("{}: {first} and {flag} both write this file", path.display());
            return Err(Failure::usage(format!("{found}, expected two files"), "give each output a name of its own"));
        }
    }
    Ok(())
}

/// Refuses an output that would replace an input, before any work. Each output comes with the flag that names it, each input
/// with its name, if it is given; of an input that is a folder the files count by which scenes and captures are read.
pub(super) fn check_not_inputs<'a>(
    outputs: impl IntoIterator<Item = (&'a str, &'a Path)>,
    inputs: impl IntoIterator<Item = (&'a str, Option<&'a Path>)>,
) -> Result<(), Failure> {
    let given = inputs.into_iter().filter_map(|(name, path)| Some((name, path?)));
    let of_input = |(name, path): (&'a str, &'a Path)| {
        [path.to_owned(), path.join("meta.json"), path.join("transforms.json")].map(|file| (name, file))
    };
    let replaceable: Vec<(&str, PathBuf)> = given.flat_map(of_input).collect();
    for (flag, output) in outputs {
        if let Some((name, _)) = replaceable.iter().find(|(_, input)| files::is_same_file(output, input)) {
            let found = format!("{}: {flag} would replace {name}, expected another file", output.display());
            return Err(Failure::usage(found, "give the output a name of its own"));
        }
    }
    Ok(())
}

/// One name per file: the folder without links and `..`, then the name.
fn place_of(path: &Path) -> PathBuf {
    match (files::folder_of(path).canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Whether a path stands for standard output.
pub(super) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// The text of a UTF-8 file.
pub(super) fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(files::read(path, Limits::DEFAULT.text_bytes)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let found = format!("{}: byte {at} is not UTF-8, expected text", path.display());
        Failure::new("NOT-TEXT", found, "is this the right file?", Exit::BadData)
    })
}
