//! Surface realization: tokens of clauses become text, verbs inflected, objects referred to by name, number or pronoun.

use rand::RngExt;
use rand::seq::IndexedRandom;

use super::composer::{Bindings, Composer, bound};
use crate::sampler::choice::choose_from_table;
use crate::sampler::template::{ClauseToken, ReferenceForm};
use cinesplat_language::{VerbForm, inflect};

const ARTICLES: [(&str, u32); 6] = [("the ", 90), ("", 4), ("that ", 2), ("this ", 1), ("our ", 1), ("a ", 2)];

impl Composer<'_> {
    /// Adds the text of a template of the list `name`, outside of all clauses. Its meaning is empty or the film's length.
    pub(super) fn add_list(&mut self, name: &str) -> Option<()> {
        let expansion = self.expander.expand_list(name, self.rng);
        for token in &expansion.meaning {
            let secs = token.strip_prefix("total=")?.strip_suffix('s')?.parse().ok()?;
            self.program.duration_secs = Some(secs);
        }
        self.held_out |= expansion.held_out;
        self.add_tokens(&expansion.tokens, VerbForm::Base, None, &[None; 3])
    }

    /// Adds the text of `tokens`; `None` where a placeholder has no object.
    pub(super) fn add_tokens(
        &mut self,
        tokens: &[ClauseToken],
        verb_form: VerbForm,
        clause: Option<usize>,
        bindings: &Bindings,
    ) -> Option<()> {
        let mut in_clause: Vec<u32> = Vec::new();
        let mut referent: Option<u32> = None;
        for token in tokens {
            match token {
                ClauseToken::Word(word) => self.text.add(word, clause, false),
                ClauseToken::Verb(verb) => self.text.add(&inflect(verb, verb_form), clause, false),
                ClauseToken::Quantity(words) => self.text.add(words, clause, true),
                ClauseToken::Requires(_) => {}
                ClauseToken::Object(placeholder, form) => {
                    let id = bound(bindings, *placeholder)?;
                    let is_forced = matches!(form, ReferenceForm::Pronoun | ReferenceForm::PossessivePronoun);
                    let pronoun = is_forced || self.may_be_pronoun(id, referent, &in_clause);
                    if pronoun {
                        referent = Some(id);
                    }
                    self.add_reference(id, *form, pronoun, clause);
                    in_clause.push(id);
                }
            }
        }
        Some(())
    }

    /// Whether a pronoun stands for object `id`, by chance, where it is unambiguous: the object is the focus of the
    /// clause before, or was the last one mentioned in this clause. `referent` is the object of this clause's pronouns.
    fn may_be_pronoun(&mut self, id: u32, referent: Option<u32>, in_clause: &[u32]) -> bool {
        let is_unambiguous = referent.is_none_or(|other| other == id);
        let is_in_focus = !self.text.is_empty() && self.focus == [id] && in_clause.is_empty();
        let is_repeated = in_clause.last() == Some(&id) && self.last_mentioned == Some(id);
        is_unambiguous && ((is_in_focus && self.rng.random_bool(0.6)) || (is_repeated && self.rng.random_bool(0.7)))
    }

    fn add_reference(&mut self, id: u32, form: ReferenceForm, pronoun: bool, clause: Option<usize>) {
        let label = self.objects.iter().find(|object| object.id == id).map_or("", |object| object.label.as_str());
        let is_plural = label.ends_with('s') && !label.ends_with("ss");
        if pronoun {
            let is_possessive = matches!(form, ReferenceForm::Possessive | ReferenceForm::PossessivePronoun);
            let word = match (is_possessive, is_plural) {
                (false, false) => "it",
                (false, true) => "them",
                (true, false) => "its",
                (true, true) => "their",
            };
            self.text.add(word, clause, false);
            return;
        }
        let mention = self.mention(id, label.to_owned().as_str());
        self.text.add(&mention, clause, true);
        if form == ReferenceForm::Possessive {
            self.text.add("'s", clause, true);
        }
        self.last_mentioned = Some(id);
        self.num_mentions += 1;
        if !self.mentioned.contains(&id) {
            self.mentioned.push(id);
        }
    }

    /// `<obj-7>`, `the golden skull`, or `the skull` where no other label has that word.
    fn mention(&mut self, id: u32, label: &str) -> String {
        if label.is_empty() || self.rng.random_bool(self.numbered_frac) {
            let variants = [
                format!("obj {id}"),
                format!("object {id}"),
                format!("#{id}"),
                format!("obj-{id}"),
                format!("object #{id}"),
            ];
            let variant = variants.choose(self.rng).cloned().filter(|_| self.rng.random_bool(0.06));
            return variant.unwrap_or_else(|| format!("<obj-{id}>"));
        }
        let words: Vec<&str> = label.split_whitespace().collect();
        let last = words.last().copied().unwrap_or(label);
        let has_last = |label: &str| label.split_whitespace().any(|word| word == last);
        let is_unique = self.objects.iter().filter(|object| has_last(&object.label)).count() == 1;
        let name = if is_unique && words.len() > 1 && self.rng.random_bool(0.35) { last } else { label };
        let article = choose_from_table(&ARTICLES, self.rng).unwrap_or("the ");
        format!("{article}{name}")
    }
}
