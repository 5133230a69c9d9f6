//! Marks of a sentence: mentions, steps, unmet words.

use cinesplat_language::Mention;

/// A sentence without its marks, and what they said.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Marked {
    /// The sentence.
    pub text: String,
    /// Its mentions of objects, in order.
    pub mentions: Vec<Mention>,
    /// Parts of the sentence in order, each with the number of its step; 0 for no step.
    pub parts: Vec<(usize, [usize; 2])>,
    /// Byte ranges of words that the notation cannot say.
    pub unmet: Vec<[usize; 2]>,
}

impl Marked {
    /// Bytes from the first to the last part of a step, counted from 1; `None` without a part.
    pub fn words_of(&self, step: usize) -> Option<[usize; 2]> {
        let mut own = self.parts.iter().filter(|(number, [start, end])| *number == step && start < end);
        let (_, [start, end]) = own.next()?;
        Some(own.fold([*start, *end], |[start, _], (_, [_, last])| [start, *last]))
    }
}

/// Reads a marked sentence; the text of the error says what is wrong.
///
/// # Errors
/// A mark that is not closed, a mention without ids, or an id that is no number.
pub fn parse_marked(marked: &str) -> Result<Marked, String> {
    let mut out = Marked::default();
    let mut part = (0, 0);
    let (mut mention_start, mut unmet_start) = (None, None);
    let mut rest = marked;
    while let Some(mark) = rest.chars().next() {
        let tail = &rest[mark.len_utf8()..];
        let here = out.text.len();
        match mark {
            '[' if begins_mention(tail) => (mention_start, rest) = (Some(here), tail),
            '|' if mention_start.is_some() => {
                let (ids, after) = tail.split_once(']').ok_or("mention without ]")?;
                let start = mention_start.take().unwrap_or(here);
                out.mentions.push(Mention { bytes: [start, here], ids: ids_of(ids)? });
                rest = after;
            }
            '{' => (unmet_start, rest) = (Some(here), tail),
            '}' => {
                out.unmet.push([unmet_start.take().ok_or("} without {")?, here]);
                rest = tail;
            }
            '@' if tail.starts_with(|c: char| c.is_ascii_digit()) => {
                out.parts.push((part.0, [part.1, here]));
                part = (usize::from(tail.as_bytes()[0] - b'0'), here);
                rest = tail[1..].strip_prefix(' ').unwrap_or(&tail[1..]);
            }
            other => {
                out.text.push(other);
                rest = tail;
            }
        }
    }
    if mention_start.is_some() || unmet_start.is_some() {
        return Err("mark without its end".to_owned());
    }
    out.parts.push((part.0, [part.1, out.text.len()]));
    Ok(out)
}

/// Whether the text after a `[` is a mention: it has a bar before the bracket that closes it.
fn begins_mention(tail: &str) -> bool {
    let inside = tail.split(['[', ']']).next().unwrap_or_default();
    inside.contains('|') && tail[inside.len()..].starts_with(']')
}

/// Ids of a mention: all of `3+4`, the first of `3/4`, none of `?`.
fn ids_of(text: &str) -> Result<Vec<u32>, String> {
    let mut ids = Vec::new();
    for id in text.split('+').filter(|id| *id != "?") {
        let first = id.split('/').next().unwrap_or_default().trim();
        ids.push(first.parse().map_err(|_| format!("\"{text}\" are no ids"))?);
    }
    ids.sort_unstable();
    ids.dedup();
    Ok(ids)
}
