//! Framings without a move: before all clauses, after them, alone, or two of the same subject.

use rand::RngExt;

use super::composer::{Bindings, Composer};
use super::consistency::{is_consistent, move_between};
use crate::sampler::choice::choose_weighted;
use crate::sampler::expansion::Expansion;
use crate::sampler::grammar::{ClauseForm, TemplateGroup};
use crate::sampler::template::{ClauseToken, ObjectPlaceholder};
use cinesplat_language::VerbForm;
use cinesplat_operator::{Framing, Step, SubjectPart};
use cinesplat_trajectory::Move;

/// End of a step that a framing describes, as in the notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display)]
#[strum(serialize_all = "kebab-case")]
enum Side {
    Start,
    End,
}

/// Lists of the words before a framing, by its form.
struct Introduction {
    noun_phrase: &'static str,
    statement: &'static str,
    /// Before an object alone.
    object: &'static str,
}

const OPENING: Introduction = Introduction { noun_phrase: "open.n", statement: "open.s", object: "open.on" };
const ALONE: Introduction = Introduction { noun_phrase: "lead.n", statement: "silence", object: "open.show" };
const CLOSING: Introduction = Introduction { noun_phrase: "close.n", statement: "close.s", object: "close.on" };

impl<'a> Composer<'a> {
    /// Adds a framing after its introduction; `subject` is its subject, `None` for any.
    fn add_framing(
        &mut self,
        introduction: &Introduction,
        side: Side,
        subject: Option<u32>,
        clause: usize,
    ) -> Option<Framing> {
        for _ in 0..20 {
            let Some((group, form, expansion, bindings)) = self.choose_framing(subject) else { continue };
            let Some(framing) = self.framing_of(group, &expansion, &bindings, side) else { continue };
            let is_plain = framing.size.is_none() && framing.angle.is_none() && framing.subjects.len() < 2;
            let begins_with_object = matches!(expansion.tokens.first(), Some(ClauseToken::Object(..)));
            let list = match form {
                ClauseForm::NounPhrase => introduction.noun_phrase,
                // `look down at it` needs no introduction, but is a framing only at the start.
                ClauseForm::VerbPhrase if side == Side::Start || self.text.is_empty() => "silence",
                ClauseForm::VerbPhrase => continue,
                ClauseForm::Statement if begins_with_object && is_plain => introduction.object,
                ClauseForm::Statement if begins_with_object && side == Side::Start => "open.show",
                ClauseForm::Statement if begins_with_object => continue,
                ClauseForm::Statement => introduction.statement,
            };
            self.add_list(list)?;
            self.add_tokens(&expansion.tokens, VerbForm::Base, Some(clause), &bindings)?;
            self.held_out |= expansion.held_out;
            return Some(framing);
        }
        None
    }

    fn choose_framing(&mut self, subject: Option<u32>) -> Option<(&'a TemplateGroup, ClauseForm, Expansion, Bindings)> {
        let grammar = self.expander.grammar;
        let num_objects = self.objects.len();
        let is_possible = |group: &&TemplateGroup| {
            group.placeholders.len() <= num_objects
                && (subject.is_none() || group.placeholders == [ObjectPlaceholder::A])
        };
        let group = choose_weighted(grammar.framings.iter().filter(is_possible), |group| group.weight, self.rng)?;
        let mut bindings = self.bind();
        if let Some(id) = subject {
            bindings[0] = Some(id);
        }
        let forms = [ClauseForm::NounPhrase, ClauseForm::Statement, ClauseForm::VerbPhrase];
        let (form, template) = self.choose_template(group, &forms)?;
        let expansion = self.expander.expand(template, self.rng);
        Some((group, form, expansion, bindings))
    }

    fn framing_of(
        &self,
        group: &TemplateGroup,
        expansion: &Expansion,
        bindings: &Bindings,
        side: Side,
    ) -> Option<Framing> {
        let tokens = group.steps.first()?.iter().chain(&expansion.meaning);
        let sided = tokens.map(|token| {
            if token.starts_with([':', '!']) { format!("{side}{token}") } else { format!("{side}={token}") }
        });
        let step = self.step(sided.chain([Move::Static.to_string()]), bindings)?;
        Some(match side {
            Side::Start => step.start,
            Side::End => step.end,
        })
    }

    /// Adds a framing before all clauses: `start close on A`.
    pub(super) fn add_opening(&mut self) -> Option<Framing> {
        let framing = self.add_framing(&OPENING, Side::Start, None, self.num_clauses)?;
        self.focus.clone_from(&framing.subjects);
        Some(framing)
    }

    /// Adds a framing that is the whole prompt: a static step.
    pub(super) fn add_framing_alone(&mut self) -> Option<()> {
        let framing = self.add_framing(&ALONE, Side::End, None, self.num_clauses)?;
        self.push_step(Step { end: framing, ..Step::of(Move::Static) });
        Some(())
    }

    /// Adds two framings of one subject (`close on A, then wide`); the move between them follows from the framings.
    pub(super) fn add_two_framings(&mut self) -> Option<()> {
        let start = self.add_opening().filter(|f| f.subjects.len() == 1)?;
        self.add_list("join.frame")?;
        let expansion = self.expander.expand_list("frame.then", self.rng);
        let subject = start.subjects.first().copied();
        let side = Side::End;
        let tokens = [format!("{side}=A"), Move::Static.to_string()];
        let qualifiers = expansion.meaning.iter().rev().map(|token| format!("{side}{token}"));
        let end = self.step(tokens.into_iter().chain(qualifiers), &[subject, None, None])?.end;
        let movement = move_between(&start, &end)?;
        self.add_tokens(&expansion.tokens, VerbForm::Base, Some(self.num_clauses), &[None; 3])?;
        self.held_out |= expansion.held_out;
        self.push_step(Step { start, end, ..Step::of(movement) });
        Some(())
    }

    /// Adds a framing after all clauses (`, ending on a close-up of it`): of the object in focus, of another one, or of
    /// the room.
    pub(super) fn add_closing(&mut self) -> Option<()> {
        let same = self.focus.first().copied().filter(|_| self.focus.len() == 1 && self.rng.random_bool(0.6));
        // A framing of the object in focus belongs to the last clause.
        let clause = if same.is_some() { self.num_clauses.checked_sub(1)? } else { self.num_clauses };
        let framing = self.add_framing(&CLOSING, Side::End, same, clause)?;
        if same.is_none() && framing.subjects == self.focus {
            return None;
        }
        let last = self.program.steps.last_mut()?;
        let holds =
            matches!(last.movement, Move::Static | Move::RollCw | Move::RollCcw | Move::RackFocus | Move::Handheld);
        if same.is_some() && !holds && !last.returns {
            let open = last.end.size.is_none()
                && last.end.angle.is_none()
                && !last.end.whole
                && last.end.part == SubjectPart::Middle;
            if !open || last.end.subjects != framing.subjects {
                return None;
            }
            last.end = framing;
            return is_consistent(last).then_some(());
        }
        let room = framing.subjects.is_empty();
        let movement = if room { Move::PullOut } else { Move::Follow };
        if same.is_some() || (room && last.movement == Move::PullOut) {
            return None;
        }
        self.push_step(Step { end: framing, ..Step::of(movement) });
        Some(())
    }
}
