//! Names of shots before what happens in them: `cam_rail_02: push in`, `7A | CU | the bust`.

use std::borrow::Cow;

use super::blanks::blanked;

/// Most bytes of such a name.
const MOST_BYTES: usize = 24;

/// A prompt with blanks in the place of the name of its shot; every other byte stays where it is.
pub fn without_slate(prompt: &str) -> Cow<'_, str> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_shots_are_not_read() {
        let read = |prompt| without_slate(prompt).trim().to_owned();
        assert_eq!(read("cam_rail_02: push in on the stove"), "push in on the stove");
        assert_eq!(read("7A | CU | white bust"), "CU | white bust");
        for kept in ["0:00 wide | 0:04 close", "start: wide", "1: wide, 2: close", "CU | bust", "7A | "] {
            assert_eq!(without_slate(kept), kept);
        }
    }
}
