//! A whole prompt: opening, clauses, closing, film length, writing style.

use rand::RngExt;
use rand_pcg::Pcg64;

use super::composer::{ClauseOrder, ClausePosition, Composer, Voice};
use super::consistency::normalize_durations;
use crate::sampler::choice::choose_from_table;
use crate::sampler::expansion::TemplateSplit;
use crate::sampler::grammar::Grammar;
use crate::sampler::labeled_prompt::LabeledPrompt;
use crate::sampler::surface::WritingStyle;
use cinesplat_language::NamedObject;
use cinesplat_trajectory::Move;

const WRITING_STYLES: [(WritingStyle, u32); 5] = [
    (WritingStyle::Standard, 66),
    (WritingStyle::Lowercase, 18),
    (WritingStyle::Unpunctuated, 4),
    (WritingStyle::Uppercase, 2),
    (WritingStyle::Typo, 10),
];

/// Numbers of clauses.
const LENGTHS: [(usize, u32); 5] = [(1, 30), (2, 32), (3, 26), (4, 9), (5, 3)];

/// A composed prompt with the mentions that linking must find in it.
pub(crate) struct Composed {
    pub(crate) labeled: LabeledPrompt,
    /// Object ids in order of first mention.
    pub(crate) mentioned: Vec<u32>,
    /// Number of mentions without pronouns.
    pub(crate) num_mentions: usize,
    /// Whether a held-out template was used.
    pub(crate) held_out: bool,
}

/// A random prompt about some of `objects`; `None` for a draw that contradicts itself.
pub(crate) fn compose(
    grammar: &Grammar,
    split: TemplateSplit,
    objects: &[NamedObject],
    rng: &mut Pcg64,
) -> Option<Composed> {
    Composer::new(grammar, split, objects, rng).compose()
}

impl Composer<'_> {
    fn compose(mut self) -> Option<Composed> {
        if self.rng.random_bool(0.07) {
            self.add_list("total.pre")?;
        }
        match self.rng.random_range(0..100) {
            0..5 => self.add_framing_alone()?,
            5..9 => self.add_two_framings()?,
            _ => self.add_clauses()?,
        }
        // `then pause. 8 seconds.` would be the length of the pause.
        let ends_in_pause = self.program.steps.last().is_some_and(|step| step.movement == Move::Static);
        if self.program.duration_secs.is_none() && !ends_in_pause && self.rng.random_bool(0.1) {
            self.add_list("total.post")?;
        }
        if self.rng.random_bool(0.08) {
            self.add_list("fluff")?;
        }
        if self.rng.random_bool(0.3) {
            self.add_list("tail.please")?;
        }
        self.finish()
    }

    fn add_clauses(&mut self) -> Option<()> {
        let count = choose_from_table(&LENGTHS, self.rng)?;
        let opening = if self.voice != Voice::ThirdPerson && self.rng.random_bool(0.2) {
            Some(self.add_opening()?)
        } else {
            None
        };
        let after_opening = opening.is_some();
        if !after_opening && self.voice == Voice::Imperative {
            self.order = self.choose_order(count);
        }
        for index in 0..count {
            let subordinate = self.order != ClauseOrder::Written && index == 0;
            let position = ClausePosition { index, count, after_opening, subordinate };
            self.add_clause(position, opening.as_ref().filter(|_| index == 0))?;
        }
        if self.order == ClauseOrder::Before {
            return self.swap_clauses();
        }
        if self.rng.random_bool(0.14) {
            self.add_closing()?;
        }
        Some(())
    }

    fn choose_order(&mut self, count: usize) -> ClauseOrder {
        match self.rng.random_range(0..100) {
            0..14 if count > 1 => ClauseOrder::After,
            // A third clause would continue from the step that is written first but happens second.
            14..20 if count == 2 => ClauseOrder::Before,
            _ => ClauseOrder::Written,
        }
    }

    /// Moves the steps of the first clause behind those of the second.
    fn swap_clauses(&mut self) -> Option<()> {
        let first = self.clause_of_step.iter().filter(|clause| **clause == 0).count();
        self.program.steps.rotate_left(first);
        self.clause_of_step.rotate_left(first);
        (!self.program.steps.iter().any(|step| step.cut || step.returns)).then_some(())
    }

    fn finish(mut self) -> Option<Composed> {
        if self.program.steps.is_empty() {
            return None;
        }
        normalize_durations(&mut self.program)?;
        self.text.normalize();
        let style = choose_from_table(&WRITING_STYLES, self.rng).unwrap_or(WritingStyle::Standard);
        self.text.apply(style, self.rng);
        let (prompt, spans) = self.text.text_and_spans(self.num_clauses);
        for (step, clause) in self.program.steps.iter_mut().zip(&self.clause_of_step) {
            step.words = spans.get(*clause).copied().flatten();
        }
        let labeled = LabeledPrompt { prompt, program: self.program };
        let Self { mentioned, num_mentions, held_out, .. } = self;
        Some(Composed { labeled, mentioned, num_mentions, held_out })
    }
}
