use std::ffi::OsString;

use super::console;

/// Prints the command that gives the same result: the given arguments, and the defaults in `deciding` that were not given.
pub(super) fn print(deciding: &[(&str, String)]) {
    console::note(&format!("reproduce with: {}", command(std::env::args_os().skip(1), deciding)));
}

fn command(arguments: impl Iterator<Item = OsString>, deciding: &[(&str, String)]) -> String {
    let given: Vec<String> = arguments.map(|argument| argument.to_string_lossy().into_owned()).collect();
    let given =
        if deciding.iter().any(|(flag, _)| *flag == "--quality") { without_requirements(&given) } else { given };
    let is_given = |flag: &str| given.iter().any(|word| word == flag || word.starts_with(&format!("{flag}=")));
    let missing = deciding.iter().filter(|(flag, _)| !is_given(flag));
    let added = missing.flat_map(|(flag, value)| [(*flag).to_owned(), value.clone()]);
    let words = given.iter().cloned().chain(added).map(|word| quoted(&word));
    std::iter::once("cinesplat".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// The words without the requirements that a quality was chosen for.
fn without_requirements(words: &[String]) -> Vec<String> {
    let is_requirement = |word: &str| word == "--budget" || word == "--min-psnr";
    let is_value = |idx: usize| idx > 0 && is_requirement(&words[idx - 1]);
    let stays = |(idx, word): &(usize, &String)| {
        !is_requirement(word) && !is_value(*idx) && !word.starts_with("--budget=") && !word.starts_with("--min-psnr=")
    };
    words.iter().enumerate().filter(stays).map(|(_, word)| word.clone()).collect()
}

/// A word quoted for a POSIX shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,%+@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
