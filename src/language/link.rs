//! Linking: objects and quantities of a prompt replaced by placeholders.
//!
//! Enters: a prompt and the scene's named objects. Leaves: lower-case words with `<obj-S>` and `<qty-Q>`, each with its
//! bytes of the prompt. One pass from left to right; at each word a mention by number is tried first, then a name, a
//! quantity, an unknown name.

use super::effects::effect_words;
use super::error::LanguageError;
use super::known_words::KnownWords;
use super::lexicon::Lexicon;
use super::linked::{Linked, MAX_PROMPT_BYTES, MAX_QUANTITIES, MAX_SLOTS, OBJECT};
use super::names::{NameIndex, NameMatch, NamedObject, display_name};
use super::numbered::numbered_mention_at;
use super::quantity::{is_unread_number, quantity_at};
use super::tokenizer::{Word, span_of, tokenize, word_at};
use super::unknown::{unknown_candidate_at, unknown_name};

/// Most warnings about numbers and ambiguous mentions.
const MAX_WARNINGS: usize = 32;

/// Replaces the objects and quantities of `prompt` by placeholders.
///
/// A determiner and adjectives before a name belong to the mention. `the chairs` names every chair. A quantity is a
/// number in digits or words with its unit: `two seconds` becomes `<qty-0>`. A mention that fits several objects takes
/// the first of them and adds a warning. Takes time linear in the length of the prompt.
///
/// # Errors
/// - [`LanguageError::TooLong`]: more than [`MAX_PROMPT_BYTES`].
/// - [`LanguageError::Empty`]: no word.
/// - [`LanguageError::UnknownObject`]: `<obj-N>` without such an object, a noun of the lexicon that names no object, or
///   any unknown name in a prompt that names no known object.
/// - [`LanguageError::TooManyObjects`]: more than [`MAX_SLOTS`].
/// - [`LanguageError::BadData`]: the embedded lexicon is malformed.
///
/// # Example
/// ```
/// use cinesplat_language::{NamedObject, link};
///
/// let objects = [NamedObject { id: 7, label: "golden skull".to_owned() }];
/// let linked = link("Orbit the skull for two seconds.", &objects)?;
/// assert_eq!(linked.tokens_text, "orbit <obj-0> for <qty-0> .");
/// assert_eq!(linked.slots, [7]);
/// assert_eq!(linked.quantities[0].value, 2.0);
/// # Ok::<(), cinesplat_language::LanguageError>(())
/// ```
pub fn link(prompt: &str, objects: &[NamedObject]) -> Result<Linked, LanguageError> {
    if prompt.len() > MAX_PROMPT_BYTES {
        return Err(LanguageError::TooLong { found: prompt.len(), limit: MAX_PROMPT_BYTES });
    }
    let words = tokenize(prompt);
    if !words.iter().any(|word| word.text.contains(char::is_alphanumeric)) {
        return Err(LanguageError::Empty);
    }
    let lexicon = Lexicon::embedded()?;
    let index = NameIndex::new(objects, lexicon);
    let is_effect = effect_words(prompt, &words)?;
    let mut linker = Linker {
        prompt,
        words: &words,
        objects,
        lexicon,
        known_words: KnownWords::embedded(),
        index,
        is_effect,
        linked: Linked::default(),
    };
    linker.run()?;
    linker.finish()
}

struct Linker<'a> {
    prompt: &'a str,
    words: &'a [Word],
    objects: &'a [NamedObject],
    lexicon: &'a Lexicon,
    known_words: &'a KnownWords,
    index: NameIndex<'a>,
    /// Words of phrases for effects.
    is_effect: Vec<bool>,
    linked: Linked,
}

impl Linker<'_> {
    fn run(&mut self) -> Result<(), LanguageError> {
        let mut i = 0;
        let mut candidate_end = 0;
        while i < self.words.len() {
            if let Some(len) = self.object_at(i)? {
                i += len;
                continue;
            }
            if self.linked.quantities.len() < MAX_QUANTITIES
                && !self.is_effect[i]
                && let Some((len, quantity)) = quantity_at(self.words, i)
            {
                self.push(&format!("<qty-{}>", self.linked.quantities.len()), i, len);
                self.linked.quantities.push(quantity);
                i += len;
                continue;
            }
            if i >= candidate_end
                && let Some((end, misspelled)) = self.unknown_at(i)
            {
                candidate_end = end;
                if let Some(object) = misspelled {
                    self.push_objects(&[object], i, end - i)?;
                    i = end;
                    continue;
                }
            }
            self.warn_if_unread_number(i);
            self.push(word_at(self.words, i), i, 1);
            i += 1;
        }
        Ok(())
    }

    /// Links the mention by number or name at word `i`. Returns the number of its words.
    fn object_at(&mut self, i: usize) -> Result<Option<usize>, LanguageError> {
        let skip = usize::from(self.is_determiner(i));
        for start in [i, i + skip] {
            if let Some(numbered) = numbered_mention_at(self.words, start) {
                let index = numbered.id.and_then(|id| self.objects.iter().position(|object| object.id == id));
                let len = start + numbered.len - i;
                let Some(object) = index else { return Err(self.no_such_number(start, numbered.len, numbered.id)) };
                self.push_objects(&[object], i, len)?;
                return Ok(Some(len));
            }
        }
        let Some((start, found)) = self.name_at(i) else { return Ok(None) };
        self.warn_if_ambiguous(&found);
        let len = start + found.len - i;
        self.push_objects(&found.objects, i, len)?;
        Ok(Some(len))
    }

    fn is_determiner(&self, i: usize) -> bool {
        self.lexicon.determiners.contains(word_at(self.words, i))
    }

    /// A name at word `i`, or after its determiner and adjectives that the label lacks (`the big skull`): the first word
    /// of the name, and the match.
    fn name_at(&self, i: usize) -> Option<(usize, NameMatch)> {
        if let Some(found) = self.index.match_at(self.words, i) {
            return Some((i, found));
        }
        // Without a determiner an adjective may be shot language: `close on`, `full shot of`.
        if !self.is_determiner(i) {
            return None;
        }
        let is_adjective = |at: &usize| self.lexicon.adjectives.contains(word_at(self.words, *at));
        let num_adjectives = (i + 1..i + 4).take_while(is_adjective).count();
        (i + 1..=i + 1 + num_adjectives).find_map(|start| Some((start, self.index.match_at(self.words, start)?)))
    }

    /// The unknown name that begins at word `i`: the word after it, and the object if the name is only misspelled. Adds
    /// a misspelled name to the warnings, any other to the unknown names.
    fn unknown_at(&mut self, i: usize) -> Option<(usize, Option<usize>)> {
        let is_known = |at: usize| {
            self.is_effect.get(at) == Some(&true)
                || self.known_words.contains(word_at(self.words, at))
                || self.index.match_at(self.words, at).is_some()
        };
        let mut candidate = unknown_candidate_at(self.words, i, self.lexicon, &is_known)?;
        candidate.certain &= !self.is_after_preposition_of_place();
        let end = candidate.start + candidate.len;
        let last = word_at(self.words, end - 1);
        if !candidate.certain
            && let Some(object) = self.index.misspelled(last)
        {
            let meant = self.objects.get(object).map(display_name).unwrap_or_default();
            self.linked.warnings.push(format!("\"{last}\" was read as {meant}"));
            return Some((end, Some(object)));
        }
        let unknown = unknown_name(self.prompt, self.words, &candidate, &self.index, self.objects);
        self.linked.unknown.push(unknown);
        Some((end, None))
    }

    /// Whether the words linked so far end in an object and a preposition of place, or in `next to`, `front of`, `top of`:
    /// the next name only gives the place of an object (`the skull on the desk`).
    fn is_after_preposition_of_place(&self) -> bool {
        let mut last = self.linked.tokens_text.rsplit(' ');
        let (first, second) = (last.next().unwrap_or_default(), last.next().unwrap_or_default());
        let is_object = |word: &str| word.starts_with(OBJECT);
        match (second, first) {
            ("next", "to") | ("front" | "top", "of") => true,
            (_, "on" | "by" | "near" | "beside" | "behind" | "in" | "under" | "at" | "above" | "with" | "inside") => {
                is_object(second)
            }
            _ => false,
        }
    }

    fn warn_if_ambiguous(&mut self, found: &NameMatch) {
        if found.alternatives.is_empty() {
            return;
        }
        let name = |i: &usize| self.objects.get(*i).map(display_name);
        let chosen: Vec<String> = found.objects.iter().filter_map(name).collect();
        let alternatives: Vec<String> = found.alternatives.iter().take(5).filter_map(name).collect();
        let warning = format!("took {}; {} could be meant as well", chosen.join(", "), alternatives.join(", "));
        if !self.linked.warnings.contains(&warning) && self.linked.warnings.len() < MAX_WARNINGS {
            self.linked.warnings.push(warning);
        }
    }

    fn warn_if_unread_number(&mut self, i: usize) {
        if !is_unread_number(self.words, i) || self.linked.warnings.len() >= MAX_WARNINGS {
            return;
        }
        let word = word_at(self.words, i);
        let expected = "expected digits below 1000000, or words below one thousand";
        self.linked.warnings.push(format!("the number \"{word}\" was ignored, {expected}"));
    }

    fn no_such_number(&self, start: usize, len: usize, id: Option<u32>) -> LanguageError {
        let inside = self.words.get(start..start + len).unwrap_or_default();
        let span = span_of(inside);
        let mut near: Vec<&NamedObject> = self.objects.iter().collect();
        near.sort_by_key(|object| (id.map_or(object.id, |id| object.id.abs_diff(id)), object.id));
        LanguageError::UnknownObject {
            name: self.prompt.get(span[0]..span[1]).unwrap_or_default().to_owned(),
            nearest: near.into_iter().take(3).map(display_name).collect(),
        }
    }

    /// Appends the placeholders of several objects, joined by `and`. All get the bytes of the mention.
    fn push_objects(&mut self, objects: &[usize], start: usize, len: usize) -> Result<(), LanguageError> {
        for (nth, id) in objects.iter().filter_map(|i| self.objects.get(*i)).map(|object| object.id).enumerate() {
            if nth > 0 {
                self.push("and", start, len);
            }
            let slot = self.slot(id)?;
            self.push(&format!("<obj-{slot}>"), start, len);
        }
        Ok(())
    }

    /// The slot of an object, a new one at its first mention.
    fn slot(&mut self, id: u32) -> Result<usize, LanguageError> {
        if let Some(slot) = self.linked.slots.iter().position(|known| *known == id) {
            return Ok(slot);
        }
        if self.linked.slots.len() >= MAX_SLOTS {
            return Err(LanguageError::TooManyObjects { limit: MAX_SLOTS });
        }
        self.linked.slots.push(id);
        Ok(self.linked.slots.len() - 1)
    }

    /// Appends `text` with the byte range of words `start..start + len`.
    fn push(&mut self, text: &str, start: usize, len: usize) {
        let inside = self.words.get(start..start + len).unwrap_or_default();
        if inside.is_empty() {
            return;
        }
        if !self.linked.tokens_text.is_empty() {
            self.linked.tokens_text.push(' ');
        }
        self.linked.tokens_text.push_str(text);
        self.linked.spans.push(span_of(inside));
    }

    fn finish(self) -> Result<Linked, LanguageError> {
        let nothing_known = self.linked.slots.is_empty();
        let fatal = self.linked.unknown.iter().find(|unknown| unknown.certain || nothing_known);
        if let Some(unknown) = fatal {
            return Err(LanguageError::UnknownObject { name: unknown.name.clone(), nearest: unknown.nearest.clone() });
        }
        Ok(self.linked)
    }
}
