//! Wordings drawn from the grammar: the atoms of a clause, and the tokens that say what it means.

use std::cmp::Ordering;

use rand::RngExt;
use rand_pcg::Pcg64;

use super::figures::figure;
use super::prompt_sampler::TemplateSplit;
use cinesplat_language::grammar::{Grammar, Part, Wording, is_figure};

/// A piece of a clause before it is written out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Atom {
    /// A word or punctuation.
    Word(String),
    /// A verb in base form, to be inflected.
    Verb(String),
    /// An object by its letter.
    Object(char, Case),
    /// A quantity in words.
    Figure(String),
}

/// How an object stands in the clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Case {
    /// `the skull`, or a pronoun where it is clear.
    Plain,
    /// `the skull's`, or `its`.
    Possessive,
    /// `it` in any case.
    Pronoun,
    /// `its` in any case.
    PossessivePronoun,
}

/// What was drawn.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawn {
    pub(crate) atoms: Vec<Atom>,
    pub(crate) meaning: Vec<String>,
    /// A wording that training never sees was among them.
    pub(crate) held_out: bool,
}

/// Draws from lists, keeping to one side of the split.
pub(crate) struct Drawer<'a> {
    pub(crate) grammar: &'a Grammar,
    pub(crate) split: TemplateSplit,
    /// The writer says no more than is needed: wordings that say nothing come far more often.
    pub(crate) terse: bool,
}

impl Drawer<'_> {
    /// One of `wordings` by weight; in training never a held-out one, in the held-out split those far more often.
    pub(crate) fn pick<'w>(
        &self,
        wordings: impl Iterator<Item = &'w Wording> + Clone,
        rng: &mut Pcg64,
    ) -> Option<&'w Wording> {
        let weight = |wording: &Wording| match (self.split, wording.held_out) {
            (TemplateSplit::Train, true) => 0.0,
            (TemplateSplit::HeldOut, true) => wording.weight * 12.0,
            (_, false) if self.terse && wording.parts.is_empty() => wording.weight * 8.0,
            (_, false) => wording.weight,
        };
        let total: f64 = wordings.clone().map(weight).sum();
        if total.partial_cmp(&0.0) != Some(Ordering::Greater) {
            return None;
        }
        let mut at = rng.random_range(0.0..total);
        wordings.into_iter().find(|wording| {
            at -= weight(wording);
            at < 0.0
        })
    }

    /// A wording of list `name`.
    pub(crate) fn list(&self, name: &str, rng: &mut Pcg64) -> Drawn {
        let mut drawn = Drawn::default();
        self.draw_list(name, &mut drawn, rng);
        drawn
    }

    /// `wording` with everything in it drawn.
    pub(crate) fn wording(&self, wording: &Wording, rng: &mut Pcg64) -> Drawn {
        let mut drawn = Drawn::default();
        self.draw(wording, &mut drawn, rng);
        drawn
    }

    fn draw_list(&self, name: &str, drawn: &mut Drawn, rng: &mut Pcg64) {
        if is_figure(name) {
            let (words, meaning) = figure(name, rng);
            drawn.atoms.push(Atom::Figure(words));
            drawn.meaning.push(meaning);
        } else if let Some(list) = self.grammar.lists.get(name)
            && let Some(wording) = self.pick(list.iter(), rng)
        {
            self.draw(wording, drawn, rng);
        }
    }

    fn draw(&self, wording: &Wording, drawn: &mut Drawn, rng: &mut Pcg64) {
        drawn.held_out |= wording.held_out;
        drawn.meaning.extend(wording.meaning.iter().cloned());
        for part in &wording.parts {
            match part {
                Part::Text(text) => drawn.atoms.extend(text.split_whitespace().map(atom)),
                Part::List(name) => self.draw_list(name, drawn, rng),
                Part::Choice(options) => {
                    if let Some(option) = self.pick(options.iter(), rng) {
                        self.draw(option, drawn, rng);
                    }
                }
            }
        }
    }
}

fn atom(word: &str) -> Atom {
    let letter = word.chars().next().unwrap_or_default();
    let rest = word.get(letter.len_utf8()..).unwrap_or_default();
    if let 'A'..='C' = letter {
        match rest {
            "" => return Atom::Object(letter, Case::Plain),
            "'s" => return Atom::Object(letter, Case::Possessive),
            ".it" => return Atom::Object(letter, Case::Pronoun),
            ".its" => return Atom::Object(letter, Case::PossessivePronoun),
            _ => {}
        }
    }
    match word.strip_prefix('*') {
        Some(verb) => Atom::Verb(verb.to_owned()),
        None => Atom::Word(word.to_owned()),
    }
}
