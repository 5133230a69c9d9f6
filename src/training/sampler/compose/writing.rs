//! Atoms written onto the page: verbs inflected, objects named or meant by a pronoun.

use rand::RngExt;
use rand::seq::IndexedRandom;

use super::{Binding, Composer, bound, weighted};
use crate::sampler::wording::{Atom, Case};
use cinesplat_language::inflection::{Tense, inflect};

impl Composer<'_> {
    pub(super) fn add_list(&mut self, name: &str) -> Option<()> {
        let drawn = self.drawer.list(name, self.rng);
        for token in &drawn.meaning {
            let secs = token.strip_prefix("total=")?.strip_suffix('s')?.parse().ok()?;
            self.program.duration_secs = Some(secs);
        }
        self.held_out |= drawn.held_out;
        self.add_atoms(&drawn.atoms, Tense::Base, None, &[None; 3])
    }

    pub(super) fn add_atoms(
        &mut self,
        atoms: &[Atom],
        tense: Tense,
        clause: Option<usize>,
        binding: &Binding,
    ) -> Option<()> {
        let mut in_clause: Vec<u32> = Vec::new();
        let mut meant_by_pronoun: Option<u32> = None;
        for atom in atoms {
            match atom {
                Atom::Word(word) => self.page.add(word, clause, false),
                Atom::Verb(verb) => self.page.add(&inflect(verb, tense), clause, false),
                Atom::Figure(words) => self.page.add(words, clause, true),
                Atom::Object(letter, case) => {
                    let id = bound(binding, *letter)?;
                    let clear = meant_by_pronoun.is_none_or(|other| other == id);
                    let forced = matches!(case, Case::Pronoun | Case::PossessivePronoun);
                    let carried = !self.page.is_empty() && self.focus == [id] && in_clause.is_empty();
                    let again = in_clause.last() == Some(&id) && self.last_mentioned == Some(id);
                    let pronoun = forced
                        || (clear && ((carried && self.rng.random_bool(0.6)) || (again && self.rng.random_bool(0.7))));
                    if pronoun {
                        meant_by_pronoun = Some(id);
                    }
                    self.add_object(id, *case, pronoun, clause);
                    in_clause.push(id);
                }
            }
        }
        Some(())
    }

    fn add_object(&mut self, id: u32, case: Case, pronoun: bool, clause: Option<usize>) {
        let label = self.objects.iter().find(|object| object.id == id).map_or("", |object| object.label.as_str());
        let many = label.ends_with('s') && !label.ends_with("ss");
        if pronoun {
            let possessive = matches!(case, Case::Possessive | Case::PossessivePronoun);
            let word = match (possessive, many) {
                (false, false) => "it",
                (false, true) => "them",
                (true, false) => "its",
                (true, true) => "their",
            };
            self.page.add(word, clause, false);
            return;
        }
        let text = self.mention(id, label.to_owned().as_str());
        self.page.add(&text, clause, true);
        if case == Case::Possessive {
            self.page.add("'s", clause, true);
        }
        self.last_mentioned = Some(id);
        self.num_mentions += 1;
        if !self.mentioned.contains(&id) {
            self.mentioned.push(id);
        }
    }

    /// `<obj-7>`, `the golden skull`, `the skull`.
    fn mention(&mut self, id: u32, label: &str) -> String {
        if label.is_empty() || self.rng.random_bool(self.numbered) {
            let plain = [
                format!("obj {id}"),
                format!("object {id}"),
                format!("#{id}"),
                format!("obj-{id}"),
                format!("object #{id}"),
            ];
            let odd = plain.choose(self.rng).cloned().filter(|_| self.rng.random_bool(0.06));
            return odd.unwrap_or_else(|| format!("<obj-{id}>"));
        }
        let words: Vec<&str> = label.split_whitespace().collect();
        let last = words.last().copied().unwrap_or(label);
        let unique =
            self.objects.iter().filter(|object| object.label.split_whitespace().any(|word| word == last)).count() == 1;
        let name = if unique && words.len() > 1 && self.rng.random_bool(0.35) { last } else { label };
        let article = weighted(&[("the ", 90), ("", 4), ("that ", 2), ("this ", 1), ("our ", 1), ("a ", 2)], self.rng)
            .unwrap_or("the ");
        format!("{article}{name}")
    }
}
