//! Idioms: ways to say a move that are not the words of the trade, rewritten into them.
//!
//! `let the mug slide past from right to left` is `truck right past the mug`, `take it in a full lap` an orbit of 360
//! degrees. `prompts/idioms.txt` lists patterns over linked words, each with the words that it stands for, and describes
//! its own format. Enters: a linked prompt. Leaves: the same prompt with the matches exchanged, each with the bytes of the
//! prompt that it stands for. One pass from left to right; at each word the longest match wins, then the first in the file.

mod matching;
mod parse;
mod table;

use super::error::LanguageError;
use super::inflection::{VerbForm, inflect};
use super::linked::{Linked, MAX_QUANTITIES};
use matching::Found;
use parse::Output;
use table::Table;

/// Most words of a prompt whose idioms are rewritten. Every word tries a few patterns.
const MAX_WORDS: usize = 2000;

impl Linked {
    /// Exchanges idioms for plain words.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when the embedded list is malformed.
    pub(super) fn rewrite_idioms(&mut self) -> Result<(), LanguageError> {
        let table = Table::embedded()?;
        let text = std::mem::take(&mut self.tokens_text);
        let words: Vec<&str> = text.split(' ').collect();
        if words.len() > MAX_WORDS || words.len() != self.spans.len() {
            self.tokens_text = text;
            return Ok(());
        }
        let spans = std::mem::take(&mut self.spans);
        // The part of a timeline that a word belongs to: no idiom reaches beyond it.
        let beats = self.timeline.iter().flat_map(|timeline| &timeline.beats);
        let ends: Vec<usize> = beats.map(|beat| beat.bytes[1]).collect();
        let part_of = |span: &[usize; 2]| ends.iter().filter(|end| **end <= span[0]).count();
        let mut part_ends = Vec::with_capacity(words.len());
        for part in spans.chunk_by(|a, b| part_of(a) == part_of(b)) {
            part_ends.resize(part_ends.len() + part.len(), part_ends.len() + part.len());
        }
        let mut out: Vec<String> = Vec::with_capacity(words.len());
        let mut i = 0;
        while i < words.len() {
            let Some((found, output)) = table.longest_at(&words[..part_ends[i]], i, &self.quantities) else {
                out.push(words[i].to_owned());
                self.spans.push(spans[i]);
                i += 1;
                continue;
            };
            let inside = &spans[i..found.end];
            let start = inside.iter().map(|span| span[0]).min().unwrap_or_default();
            let end = inside.iter().map(|span| span[1]).max().unwrap_or_default();
            let mut written = self.written(output, &found, &words);
            if written.is_empty() {
                written = words[i..found.end].iter().map(|word| (*word).to_owned()).collect();
            }
            self.spans.extend(written.iter().map(|_| [start, end]));
            out.extend(written);
            i = found.end;
        }
        self.tokens_text = out.join(" ");
        Ok(())
    }

    /// The words that a match stands for.
    fn written(&mut self, output: &[Output], found: &Found<'_>, words: &[&str]) -> Vec<String> {
        let mut out = Vec::new();
        for part in output {
            match part {
                Output::Word(word) => out.push(word.clone()),
                Output::Verb(verb) => {
                    out.push(inflect(verb, found.form.unwrap_or(VerbForm::Base)));
                }
                Output::Captured(name) => {
                    let range = found.captured(name);
                    out.extend(range.map(|[from, to]| &words[from..to]).into_iter().flatten().map(|w| (*w).to_owned()));
                }
                Output::Quantity(quantity) if self.quantities.len() < MAX_QUANTITIES => {
                    out.push(format!("<qty-{}>", self.quantities.len()));
                    self.quantities.push(*quantity);
                }
                Output::Quantity(_) => {}
            }
        }
        out
    }
}
