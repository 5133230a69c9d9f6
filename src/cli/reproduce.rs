use std::ffi::OsString;

use super::console;

/// Prints the command that gives the same result: the given arguments, and the defaults in `deciding` that were not given.
pub(super) fn print(deciding: &[(&str, String)]) {
    console::note(&format!("reproduce with: {}", command(std::env::args_os().skip(1), deciding)));
}

/// The line that was typed.
pub(super) fn line() -> String {
    std::env::args_os().map(|word| quoted(&word.to_string_lossy())).collect::<Vec<_>>().join(" ")
}

/// The line that goes on with a stopped film: the one that was typed, without the flag that starts anew.
pub(super) fn line_to_go_on() -> String {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    words.filter(|word| word != "--fresh").map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
}

/// The line that makes the film whose parts this line renders.
pub(super) fn line_of_film() -> String {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    without(&words, &["--part"], &["--frames"]).iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

/// The words that render a part of the film that this line asks for; `command` is its subcommand. On this machine
/// `num_programs` programs share the cores.
pub(super) fn words_of_part(command: &str, num_programs: Option<usize>) -> Vec<String> {
    let own = ["--fresh", "--json", "--keep-frames", "--quiet", "-q"];
    let mut words = vec!["render".to_owned(), "--quiet".to_owned()];
    words.extend(without(&words_of_render(command), &own, &["--save-shot", "--sheet", "--map"]));
    if let Some(num_programs) = num_programs
        && !words.iter().any(|word| word.starts_with("--threads"))
    {
        let num_threads = (cinesplat::pipeline::num_cores() / num_programs).max(1);
        words.extend(["--threads".to_owned(), num_threads.to_string()]);
    }
    words
}

/// The words that make the film that this line asks for; `command` is its subcommand.
pub(super) fn words_of_film(command: &str) -> Vec<String> {
    [vec!["render".to_owned()], without(&words_of_render(command), &["--fresh"], &[])].concat()
}

/// The words after the subcommand of a farm that `render` knows.
fn words_of_render(command: &str) -> Vec<String> {
    let given: Vec<String> = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let at = given.iter().position(|word| word == command);
    let rest: Vec<String> =
        given.into_iter().enumerate().filter(|(idx, _)| Some(*idx) != at).map(|(_, word)| word).collect();
    without(&rest, &["--slurm", "--no-wait"], &["--local", "--parts", "--sbatch"])
}

/// The words without some flags, and without some that have a value behind them or behind an equals sign.
fn without(words: &[String], flags: &[&str], flags_with_value: &[&str]) -> Vec<String> {
    let (mut left, mut skips) = (Vec::new(), false);
    for word in words {
        let name = word.split('=').next().unwrap_or_default();
        let is_value = std::mem::replace(&mut skips, flags_with_value.contains(&word.as_str()));
        if !(is_value || flags.contains(&name) || flags_with_value.contains(&name)) {
            left.push(word.clone());
        }
    }
    left
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
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,%+@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
