use std::ffi::OsString;

use super::console;

/// Prints the command that gives the same result: this one's arguments, and the defaults that decide the result too.
pub(super) fn print(deciding: &[(&str, String)]) {
    console::note(&format!("reproduce with: {}", command(std::env::args_os().skip(1), deciding)));
}

fn command(arguments: impl Iterator<Item = OsString>, deciding: &[(&str, String)]) -> String {
    let given: Vec<String> = arguments.map(|argument| argument.to_string_lossy().into_owned()).collect();
    let given = if deciding.iter().any(|(flag, _)| *flag == "--quality") { without_wishes(&given) } else { given };
    let is_given = |flag: &str| given.iter().any(|word| word == flag || word.starts_with(&format!("{flag}=")));
    let missing = deciding.iter().filter(|(flag, _)| !is_given(flag));
    let added = missing.flat_map(|(flag, value)| [(*flag).to_owned(), value.clone()]);
    let words = given.iter().cloned().chain(added).map(|word| quoted(&word));
    std::iter::once("cinesplat".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// The words less those that leave the quality open.
fn without_wishes(words: &[String]) -> Vec<String> {
    let is_wish = |word: &str| word == "--budget" || word == "--min-psnr";
    let is_value = |idx: usize| idx > 0 && is_wish(&words[idx - 1]);
    let stays = |(idx, word): &(usize, &String)| {
        !is_wish(word) && !is_value(*idx) && !word.starts_with("--budget=") && !word.starts_with("--min-psnr=")
    };
    words.iter().enumerate().filter(stays).map(|(_, word)| word.clone()).collect()
}

/// A word as a POSIX shell takes it back.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,%+@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_with_spaces_and_quotes_survive_a_shell() {
        let arguments = ["plan", "my room.spz", "-p", "the cat's bed", "--seed=4"].map(OsString::from).into_iter();
        let deciding = [("--seed", "0".to_owned()), ("--fps", "30".to_owned())];
        assert_eq!(
            command(arguments, &deciding),
            r"cinesplat plan 'my room.spz' -p 'the cat'\''s bed' --seed=4 --fps 30"
        );
    }

    #[test]
    fn a_quality_that_was_chosen_stands_in_place_of_the_wish() {
        let arguments = ["render", "a.spz", "--budget", "90s", "--min-psnr=50", "-o", "a.mp4"].map(OsString::from);
        let deciding = [("--quality", "draft".to_owned())];
        assert_eq!(command(arguments.into_iter(), &deciding), "cinesplat render a.spz -o a.mp4 --quality draft");
    }
}
