//! Files of prompts: one film or shot per line.
//!
//! Enters: text with one prompt per line, `NAME<TAB>PROMPT` to name it; blank lines and lines that start with `#` are
//! skipped. Leaves: prompts with unique names that are safe in file names; a line without a name gets its number.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::console;
use super::failure::{Exit, Failure};
use super::outputs;

/// Placeholder for the name of a prompt in the path of an output.
const PLACEHOLDER: &str = "{}";

/// A prompt of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NamedPrompt {
    /// The name of its line, or the line's number in three digits.
    pub(super) name: String,
    pub(super) prompt: String,
}

/// Reads a file of prompts.
pub(super) fn read(path: &Path) -> Result<Vec<NamedPrompt>, Failure> {
    let text = outputs::read_text(path)?;
    let prompts = parse(&text).map_err(|found| {
        let help = "write one prompt per line, or NAME, a tab and the prompt; names have letters, digits, - _ .";
        Failure::new("PROMPTS", format!("{}: {found}", path.display()), help, Exit::BadData)
    })?;
    Ok(prompts)
}

fn parse(text: &str) -> Result<Vec<NamedPrompt>, String> {
    let mut lines_of = BTreeMap::new();
    let mut prompts = Vec::new();
    for (idx, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let number = idx + 1;
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let (name, prompt) = match line.split_once('\t') {
            Some((name, prompt)) => (name.trim().to_owned(), prompt),
            None => (format!("{number:03}"), line),
        };
        let is_safe = |c: char| c.is_alphanumeric() || "-_.".contains(c);
        if name.is_empty() || name.starts_with('.') || !name.chars().all(is_safe) {
            return Err(format!("line {number}: name {name:?} cannot be part of a file name"));
        }
        if prompt.trim().is_empty() {
            return Err(format!("line {number}: no prompt after the name {name:?}"));
        }
        if let Some(first) = lines_of.insert(name.clone(), number) {
            return Err(format!("lines {first} and {number} both have the name {name:?}, expected unique names"));
        }
        prompts.push(NamedPrompt { name, prompt: prompt.trim().to_owned() });
    }
    if prompts.is_empty() {
        return Err("no prompt in the file".to_owned());
    }
    Ok(prompts)
}

/// The output of one prompt: `{}` in the path is its name. Its folder is created.
pub(super) fn output_of(path: &Path, name: &str) -> Result<PathBuf, Failure> {
    let text = path.to_string_lossy();
    if !text.contains(PLACEHOLDER) {
        let found = format!("{text}: one name for all prompts of a file, expected {PLACEHOLDER} where the names go");
        return Err(Failure::usage(found, format!("write -o films/{PLACEHOLDER}.mp4 or -o shots/{PLACEHOLDER}.json")));
    }
    let path = PathBuf::from(text.replace(PLACEHOLDER, name));
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        cinesplat::files::create_folder(folder)?;
    }
    Ok(path)
}

/// Runs `work` for every prompt. A failure is reported and the next prompt follows; a stop by the user ends the loop.
///
/// After failures it returns one that counts them, with the exit code of the first.
pub(super) fn for_each<T>(
    jobs: &[(NamedPrompt, T)],
    mut work: impl FnMut(&NamedPrompt, &T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut failed: Vec<(&str, Failure)> = Vec::new();
    for (idx, (named, job)) in jobs.iter().enumerate() {
        console::note(&format!("prompt {}/{} {}: {}", idx + 1, jobs.len(), named.name, named.prompt));
        match work(named, job) {
            Err(failure) if failure.exit() == Exit::Stopped => return Err(failure),
            Err(failure) => {
                console::error(&failure);
                failed.push((&named.name, failure));
            }
            Ok(()) => {}
        }
    }
    let names: Vec<&str> = failed.iter().map(|(name, _)| *name).collect();
    let names = names.join(" ");
    let Some((_, first)) = failed.first() else { return Ok(()) };
    let found = format!("{} of {} prompts failed: {names}", failed.len(), jobs.len());
    Err(Failure::new("PROMPTS", found, "the errors above say why; the other prompts are done", first.exit()))
}
