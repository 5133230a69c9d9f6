//! Prompts with blanks in the place of some words, so that every other byte stays where it is.

use std::borrow::Cow;

/// Puts blanks in the place of some bytes of a prompt.
pub(crate) fn blank(prompt: &mut Cow<'_, str>, [start, end]: [usize; 2]) {
    prompt.to_mut().replace_range(start..end, &" ".repeat(end - start));
}

/// The prompt with blanks in the place of some of its bytes.
pub fn blanked<'a>(prompt: &'a str, ranges: &[[usize; 2]]) -> Cow<'a, str> {
    let mut blanked = Cow::Borrowed(prompt);
    ranges.iter().for_each(|&range| blank(&mut blanked, range));
    blanked
}

/// What blanks leave of a prompt, or the prompt where they leave nothing.
pub(crate) fn unless_empty<'a>(blanked: Cow<'a, str>, prompt: &'a str) -> Cow<'a, str> {
    if blanked.contains(char::is_alphanumeric) { blanked } else { Cow::Borrowed(prompt) }
}
