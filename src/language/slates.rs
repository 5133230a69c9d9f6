//! Names of shots and of requirements before what happens in them: `cam_rail_02: push in`, `7A | CU | the bust`, `REQ-01: pan
//! by 40 degrees. REQ-02: ..`.

use std::borrow::Cow;

use super::blanks::blanked;

/// Most bytes of such a name.
const MOST_BYTES: usize = 24;

/// Fewest and most letters of the name of a requirement, and most digits behind it.
const LETTERS: std::ops::RangeInclusive<usize> = 2..=4;
const MOST_DIGITS: usize = 4;

/// Bytes of the names of requirements, each with its colon.
fn requirements(prompt: &str) -> Vec<[usize; 2]> {
    let named = |colon: usize| {
        let from =
            colon - prompt[..colon].chars().rev().take_while(|c| !c.is_whitespace()).map(char::len_utf8).sum::<usize>();
        let (letters, digits) = prompt[from..colon].split_once('-')?;
        let is_name = LETTERS.contains(&letters.len()) && letters.chars().all(|letter| letter.is_ascii_uppercase());
        let is_number = (1..=MOST_DIGITS).contains(&digits.len()) && digits.chars().all(|digit| digit.is_ascii_digit());
        (is_name && is_number).then_some([from, colon + 1])
    };
    prompt.match_indices(':').filter_map(|(colon, _)| named(colon)).collect()
}

/// A prompt with blanks in the place of the name of its shot, and of those of its requirements; every other byte stays where it
/// is.
pub fn without_slate(prompt: &str) -> Cow<'_, str> {
    let named = requirements(prompt);
    if !named.is_empty() {
        return blanked(prompt, &named);
    }
    let Some((before, rest)) = prompt.split_once([':', '|']).filter(|(name, _)| name.len() <= MOST_BYTES) else {
        return Cow::Borrowed(prompt);
    };
    let name = before.trim();
    let is_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let is_identifier = name.contains('_') && name.chars().all(is_word);
    let digits = name.chars().take_while(char::is_ascii_digit).count();
    let is_number =
        prompt[before.len()..].starts_with('|') && digits > 0 && name.len() <= digits + 1 && name.chars().all(is_word);
    if !(is_identifier || is_number) || rest.trim().is_empty() {
        return Cow::Borrowed(prompt);
    }
    blanked(prompt, &[[0, prompt.len() - rest.len()]])
}

/// How people ask after a film that they think of.
const REMEMBERS: [&str; 8] = [
    "you know the",
    "you know that",
    "do you know the",
    "do you remember the",
    "remember the",
    "remember that",
    "ever seen the",
    "have you seen the",
];
const WORKS: [&str; 8] = ["film", "movie", "scene", "shot", "advert", "series", "game", "trailer"];

/// A prompt with blanks in the place of questions after films that somebody thinks of, where it goes on: `You know the tricycle in
/// The Shining? Roll at ..`.
pub fn without_references(prompt: &str) -> Cow<'_, str> {
    let mut from = 0;
    let mut asked: Vec<[usize; 2]> = style_of(prompt).into_iter().collect();
    for (at, mark) in prompt.match_indices(['.', '!', '?']) {
        let sentence = &prompt[from..at];
        let low = sentence.trim().to_lowercase();
        let is_asked = mark == "?" && REMEMBERS.iter().any(|words| low.starts_with(words));
        let is_title = |word: &str| word.starts_with(char::is_uppercase) && word != "I";
        let names_work = sentence.split_whitespace().skip(1).any(is_title)
            || low.split_whitespace().any(|word| WORKS.contains(&word));
        if is_asked && names_work && prompt[at + 1..].contains(char::is_alphabetic) {
            asked.push([from, at + 1]);
        }
        from = at + 1;
    }
    blanked(prompt, &asked)
}

/// Words that begin what a film is to be like, before a colon, and most words of it.
const LIKE: [&str; 3] = ["think", "vibe", "mood"];
const MOST_STYLE_WORDS: usize = 7;

/// Bytes of the style that a prompt names first: `think survival horror safe room: creep in from the door`.
fn style_of(prompt: &str) -> Option<[usize; 2]> {
    let (style, rest) = prompt.split_once(':')?;
    let words: Vec<String> = style.split_whitespace().map(str::to_lowercase).collect();
    let is_style = words.len() > 1 && words.len() <= MOST_STYLE_WORDS && LIKE.contains(&words[0].as_str());
    (is_style && rest.contains(char::is_alphabetic)).then_some([0, style.len() + 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_that_somebody_thinks_of_are_not_read() {
        let read = |prompt| without_references(prompt).trim().to_owned();
        assert_eq!(read("You know the tricycle in The Shining? Roll in."), "Roll in.");
        assert_eq!(read("Remember that shot with the tram? Push in."), "Push in.");
        assert_eq!(read("think survival horror: creep in from the door"), "creep in from the door");
        assert_eq!(read("think of the lamp, then push in"), "think of the lamp, then push in");
        assert_eq!(read("You know the lamp in the corner? Push in."), "You know the lamp in the corner? Push in.");
    }

    #[test]
    fn names_of_shots_are_not_read() {
        let read = |prompt| without_slate(prompt).trim().to_owned();
        assert_eq!(read("cam_rail_02: push in on the stove"), "push in on the stove");
        assert_eq!(read("7A | CU | white bust"), "CU | white bust");
        assert_eq!(
            read("REQ-01: pan left. REQ-02: hold").split_whitespace().collect::<Vec<_>>().join(" "),
            "pan left. hold"
        );
        for kept in ["0:00 wide | 0:04 close", "start: wide", "1: wide, 2: close", "CU | bust", "7A | "] {
            assert_eq!(without_slate(kept), kept);
        }
    }
}
