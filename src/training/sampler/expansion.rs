//! Expansion of templates: lists and choices resolved at random, quantities phrased, the meaning collected.

use rand_pcg::Pcg64;

use super::choice::choose_weighted;
use super::grammar::Grammar;
use super::template::{ClauseToken, Piece, Template};

/// The templates of the grammar that are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TemplateSplit {
    /// Only templates that are not held out.
    #[default]
    Train,
    /// All templates, and in almost every prompt at least one that is held out.
    HeldOut,
}

/// An expanded template.
#[derive(Debug, Clone, Default)]
pub(crate) struct Expansion {
    pub(crate) tokens: Vec<ClauseToken>,
    /// Tokens of the notation of programs.
    pub(crate) meaning: Vec<String>,
    /// Whether a held-out template was used.
    pub(crate) held_out: bool,
}

/// Expands templates of one split.
pub(crate) struct Expander<'a> {
    pub(crate) grammar: &'a Grammar,
    pub(crate) split: TemplateSplit,
    /// Empty templates are chosen eight times as often, for prompts without optional words.
    pub(crate) terse: bool,
}

impl Expander<'_> {
    /// One of `templates` by weight. The train split never chooses held-out templates, the held-out split chooses
    /// them twelve times as often.
    pub(crate) fn choose<'t>(
        &self,
        templates: impl Iterator<Item = &'t Template> + Clone,
        rng: &mut Pcg64,
    ) -> Option<&'t Template> {
        let weight = |template: &Template| match (self.split, template.held_out) {
            (TemplateSplit::Train, true) => 0.0,
            (TemplateSplit::HeldOut, true) => template.weight * 12.0,
            (_, false) if self.terse && template.pieces.is_empty() => template.weight * 8.0,
            (_, false) => template.weight,
        };
        choose_weighted(templates, weight, rng)
    }

    /// A template of the list `name`, expanded; empty without such a list.
    pub(crate) fn expand_list(&self, name: &str, rng: &mut Pcg64) -> Expansion {
        let mut expansion = Expansion::default();
        self.add_list(name, &mut expansion, rng);
        expansion
    }

    /// `template`, expanded.
    pub(crate) fn expand(&self, template: &Template, rng: &mut Pcg64) -> Expansion {
        let mut expansion = Expansion::default();
        self.add(template, &mut expansion, rng);
        expansion
    }

    fn add_list(&self, name: &str, expansion: &mut Expansion, rng: &mut Pcg64) {
        if let Some(list) = self.grammar.lists.get(name)
            && let Some(template) = self.choose(list.iter(), rng)
        {
            self.add(template, expansion, rng);
        }
    }

    fn add(&self, template: &Template, expansion: &mut Expansion, rng: &mut Pcg64) {
        expansion.held_out |= template.held_out;
        expansion.meaning.extend(template.meaning.iter().cloned());
        for piece in &template.pieces {
            match piece {
                Piece::Token(token) => expansion.tokens.push(token.clone()),
                Piece::Quantity(placeholder) => {
                    let phrase = placeholder.phrase(rng);
                    expansion.tokens.push(ClauseToken::Quantity(phrase.words));
                    expansion.meaning.push(phrase.meaning);
                }
                Piece::List(name) => self.add_list(name, expansion, rng),
                Piece::Choice(options) => {
                    if let Some(option) = self.choose(options.iter(), rng) {
                        self.add(option, expansion, rng);
                    }
                }
            }
        }
    }
}
