use super::LanguageError;
use super::grammar::Grammar;
use super::lexicon::Lexicon;
use super::mention::numbered_at;
use super::names::{NameIndex, NameMatch, NamedObject, shown};
use super::quantity::{Quantity, quantity_at};
use super::unknown::{UnknownName, report, suspect_at};
use super::words::{Word, words};

/// Longest prompt, in bytes.
pub const MAX_PROMPT_BYTES: usize = 8192;
/// Most objects of one prompt: the model's identifiers `<obj-0>`..`<obj-99>`.
pub const MAX_SLOTS: usize = 100;
/// Most quantities of one prompt; further ones stay as they were written.
pub const MAX_QUANTITIES: usize = 32;

/// A prompt as the model reads it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Linked {
    /// Words and punctuation, lower case, parted by one space each; `<obj-S>` for objects, `<qty-Q>` for quantities.
    pub tokens_text: String,
    /// Byte range of the prompt for every word of `tokens_text`.
    pub spans: Vec<[usize; 2]>,
    /// Object id of every slot, in order of first mention.
    pub slots: Vec<u32>,
    /// The quantities, `<qty-0>` first.
    pub quantities: Vec<Quantity>,
    /// Names that match no object.
    pub unknown: Vec<UnknownName>,
    /// What was guessed, for the user to read.
    pub warnings: Vec<String>,
}

/// `prompt` with its objects and quantities found.
///
/// A determiner and plain adjectives before a name belong to it, `the chairs` names every chair, numbers in words and
/// figures become quantities (their defaults: `quantity.rs`). Takes time linear in the prompt.
///
/// # Errors
/// [`LanguageError::TooLong`] above [`MAX_PROMPT_BYTES`] · [`LanguageError::Empty`] without a word ·
/// [`LanguageError::UnknownObject`] for `<obj-N>` that the scene lacks, for a name that surely is a thing it lacks, and
/// for any unknown name when the prompt names no known object · [`LanguageError::TooManyObjects`] above [`MAX_SLOTS`].
pub fn link(prompt: &str, objects: &[NamedObject]) -> Result<Linked, LanguageError> {
    if prompt.len() > MAX_PROMPT_BYTES {
        return Err(LanguageError::TooLong { found: prompt.len(), limit: MAX_PROMPT_BYTES });
    }
    let words = words(prompt);
    if !words.iter().any(|word| word.text.starts_with(char::is_alphanumeric)) {
        return Err(LanguageError::Empty);
    }
    let lexicon = Lexicon::embedded()?;
    let index = NameIndex::new(objects, lexicon);
    let mut linker = Linker {
        prompt,
        words: &words,
        objects,
        lexicon,
        grammar: Grammar::embedded()?,
        index,
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
    grammar: &'a Grammar,
    index: NameIndex<'a>,
    linked: Linked,
}

impl Linker<'_> {
    fn run(&mut self) -> Result<(), LanguageError> {
        let mut i = 0;
        let mut suspected_to = 0;
        while i < self.words.len() {
            if let Some(len) = self.object_at(i)? {
                i += len;
                continue;
            }
            if self.linked.quantities.len() < MAX_QUANTITIES
                && let Some((len, quantity)) = quantity_at(self.words, i)
            {
                self.push(&format!("<qty-{}>", self.linked.quantities.len()), i, len);
                self.linked.quantities.push(quantity);
                i += len;
                continue;
            }
            if i >= suspected_to
                && let Some((end, objects)) = self.suspect(i)
            {
                suspected_to = end;
                if let Some(object) = objects {
                    self.push_objects(&[object], i, end - i)?;
                    i = end;
                    continue;
                }
            }
            let words = self.words;
            self.push(words.get(i).map_or("", |word| word.text.as_str()), i, 1);
            i += 1;
        }
        Ok(())
    }

    /// A mention by number or by name at word `i`; the number of words it took.
    fn object_at(&mut self, i: usize) -> Result<Option<usize>, LanguageError> {
        let skip = usize::from(self.is_determiner(i));
        for start in [i, i + skip] {
            if let Some(numbered) = numbered_at(self.words, start) {
                let found = numbered.id.and_then(|id| self.objects.iter().position(|object| object.id == id));
                let len = start + numbered.len - i;
                let Some(object) = found else { return Err(self.no_such_number(start, numbered.len, numbered.id)) };
                self.push_objects(&[object], i, len)?;
                return Ok(Some(len));
            }
        }
        let Some((start, found)) = self.name_at(i) else { return Ok(None) };
        self.warn_of_rivals(&found);
        let len = start + found.len - i;
        self.push_objects(&found.objects, i, len)?;
        Ok(Some(len))
    }

    fn is_determiner(&self, i: usize) -> bool {
        self.words.get(i).is_some_and(|word| self.lexicon.determiners.contains(&word.text))
    }

    /// A name at word `i`, after its determiner and adjectives that the label lacks (`the big skull`).
    fn name_at(&self, i: usize) -> Option<(usize, NameMatch)> {
        if let Some(found) = self.index.match_at(self.words, i) {
            return Some((i, found));
        }
        // `close on` and `full shot of` are talk: only after a determiner does an adjective surely belong to a name.
        if !self.is_determiner(i) {
            return None;
        }
        let adjective = |at: &usize| self.words.get(*at).is_some_and(|w| self.lexicon.adjectives.contains(&w.text));
        let num_adjectives = (i + 1..i + 4).take_while(adjective).count();
        (i + 1..=i + 1 + num_adjectives).find_map(|start| Some((start, self.index.match_at(self.words, start)?)))
    }

    /// Whether an unknown name begins at word `i`: where it ends, and the object meant if it is only misspelled.
    fn suspect(&mut self, i: usize) -> Option<(usize, Option<usize>)> {
        let word = |at: usize| self.words.get(at).map_or("", |word| word.text.as_str());
        let knows = |at: usize| self.grammar.knows(word(at)) || self.index.match_at(self.words, at).is_some();
        let mut suspect = suspect_at(self.words, i, self.lexicon, &knows)?;
        suspect.certain &= !self.describes();
        let end = suspect.start + suspect.len;
        let last = self.words.get(end - 1).map(|word| word.text.clone()).unwrap_or_default();
        if !suspect.certain
            && let Some(object) = self.index.misspelled(&last)
        {
            let meant = self.objects.get(object).map(shown).unwrap_or_default();
            self.linked.warnings.push(format!("\"{last}\" was read as {meant}"));
            return Some((end, Some(object)));
        }
        let unknown = report(self.prompt, self.words, &suspect, &self.index, self.objects);
        self.linked.unknown.push(unknown);
        Some((end, None))
    }

    /// Whether what follows only tells where a known object is: `the skull on the desk`.
    fn describes(&self) -> bool {
        let mut last = self.linked.tokens_text.rsplit(' ');
        let (first, second) = (last.next().unwrap_or_default(), last.next().unwrap_or_default());
        let object = |word: &str| word.starts_with("<obj-");
        match (second, first) {
            ("next", "to") | ("front" | "top", "of") => true,
            (_, "on" | "by" | "near" | "beside" | "behind" | "in" | "under" | "at" | "above" | "with" | "inside") => {
                object(second)
            }
            _ => false,
        }
    }

    fn warn_of_rivals(&mut self, found: &NameMatch) {
        if found.rivals.is_empty() {
            return;
        }
        let name = |i: &usize| self.objects.get(*i).map(shown);
        let chosen: Vec<String> = found.objects.iter().filter_map(name).collect();
        let rivals: Vec<String> = found.rivals.iter().take(5).filter_map(name).collect();
        let warning = format!("took {}; {} could be meant as well", chosen.join(", "), rivals.join(", "));
        if !self.linked.warnings.contains(&warning) && self.linked.warnings.len() < 32 {
            self.linked.warnings.push(warning);
        }
    }

    fn no_such_number(&self, start: usize, len: usize, id: Option<u32>) -> LanguageError {
        let inside = self.words.get(start..start + len).unwrap_or_default();
        let span = [inside.first().map_or(0, |w| w.span[0]), inside.last().map_or(0, |w| w.span[1])];
        let mut near: Vec<&NamedObject> = self.objects.iter().collect();
        near.sort_by_key(|object| (id.map_or(object.id, |id| object.id.abs_diff(id)), object.id));
        LanguageError::UnknownObject {
            name: self.prompt.get(span[0]..span[1]).unwrap_or_default().to_owned(),
            nearest: near.into_iter().take(3).map(shown).collect(),
        }
    }

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

    fn push(&mut self, text: &str, start: usize, len: usize) {
        let inside = self.words.get(start..start + len).unwrap_or_default();
        let (Some(first), Some(last)) = (inside.first(), inside.last()) else { return };
        if !self.linked.tokens_text.is_empty() {
            self.linked.tokens_text.push(' ');
        }
        self.linked.tokens_text.push_str(text);
        self.linked.spans.push([first.span[0], last.span[1]]);
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
