//! Clauses: connectives, choice of templates, binding of objects, meaning.

use rand::RngExt;

use super::composer::{Bindings, ClauseOrder, ClausePosition, Composer, Connectives, Voice, bound};
use super::consistency::{apply_opening, is_consistent, is_redundant};
use crate::sampler::choice::choose_weighted;
use crate::sampler::expansion::Expansion;
use crate::sampler::grammar::{ClauseForm, Requirement, TemplateGroup};
use crate::sampler::template::{ClauseToken, NextForm, Template};
use cinesplat_language::{VerbForm, step_from_notation};
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

/// An expanded clause with its meaning.
struct Clause {
    expansion: Expansion,
    form: ClauseForm,
    steps: Vec<Step>,
    bindings: Bindings,
}

impl<'a> Composer<'a> {
    /// Adds a clause; `start` is an opening framing right before it.
    pub(super) fn add_clause(&mut self, position: ClausePosition, start: Option<&Framing>) -> Option<()> {
        let connective = self.connective(position);
        let (form, verb_form) = self.forms_after(&connective, position);
        let is_plain_verb = form == ClauseForm::VerbPhrase && verb_form == VerbForm::Base;
        let duration = if is_plain_verb { self.leading_duration(&connective, position) } else { None };
        let clause = self.choose_clause(form, position, start, duration.as_ref())?;
        self.add_connective(&connective, position, clause.form);
        self.add_tokens(&clause.expansion.tokens, verb_form, Some(self.num_clauses), &clause.bindings)?;
        self.held_out |= clause.expansion.held_out;
        let steps = clause.steps;
        if let Some(last) = steps.last() {
            self.update_focus(last);
        }
        for step in steps {
            self.moved |= step.movement != Move::Static;
            self.clause_of_step.push(self.num_clauses);
            self.program.steps.push(step);
        }
        self.num_clauses += 1;
        Some(())
    }

    /// The words between this clause and the text before it.
    fn connective(&mut self, position: ClausePosition) -> Expansion {
        let list = if position.is_first() { self.lead_list(position) } else { self.join_list(position) };
        self.expander.expand_list(list, self.rng)
    }

    fn lead_list(&self, position: ClausePosition) -> &'static str {
        match (self.voice, self.order) {
            (_, ClauseOrder::After) if position.subordinate => "lead.after",
            (_, ClauseOrder::Before) if position.subordinate => "lead.before",
            (Voice::Imperative, _) => "lead.imp",
            (Voice::Request, _) => "lead.request",
            (Voice::ThirdPerson, _) => "lead.third",
            (Voice::Gerund, _) => "silence",
            (Voice::NounPhrase, _) => "lead.n",
        }
    }

    fn join_list(&mut self, position: ClausePosition) -> &'static str {
        let is_last = position.index > 0 && position.index + 1 == position.count;
        let is_list = self.connectives == Connectives::List && position.count > 1;
        match (self.connectives, self.voice == Voice::NounPhrase) {
            (_, false) if is_list && is_last => "join.end",
            (_, false) if is_list => "join.list",
            (_, true) if is_list && is_last => "join.n.end",
            (_, true) if is_list => "join.n.list",
            (_, true) => "join.n",
            (Connectives::Then, false) => "join.then",
            (Connectives::Sentences, false) => "join.sentence",
            _ if is_last && self.rng.random_bool(0.35) => "join.last",
            _ => "join",
        }
    }

    /// A duration before its clause (`over 3 seconds, push in`), by chance, where the connective begins a new part.
    fn leading_duration(&mut self, connective: &Expansion, position: ClausePosition) -> Option<Expansion> {
        let begins_part = match connective.tokens.last() {
            Some(ClauseToken::Word(word)) if word == "," => connective.tokens.len() > 1,
            Some(ClauseToken::Word(word)) => matches!(word.as_str(), "then" | "." | ";" | "now" | "next"),
            _ => false,
        };
        let list = if position.index > 0 && begins_part && self.rng.random_bool(0.08) {
            "dur.pre"
        } else if position.is_first() && self.rng.random_bool(0.02) {
            "dur.take"
        } else {
            return None;
        };
        Some(self.expander.expand_list(list, self.rng))
    }

    /// The forms of a clause and its verb after a connective.
    fn forms_after(&mut self, connective: &Expansion, position: ClausePosition) -> (ClauseForm, VerbForm) {
        match connective.tokens.last() {
            Some(ClauseToken::Requires(NextForm::Gerund)) => return (ClauseForm::VerbPhrase, VerbForm::Gerund),
            Some(ClauseToken::Requires(NextForm::NounPhrase)) => return (ClauseForm::NounPhrase, VerbForm::Base),
            _ => {}
        }
        match self.voice {
            _ if position.subordinate => (ClauseForm::VerbPhrase, VerbForm::Base),
            Voice::NounPhrase => (ClauseForm::NounPhrase, VerbForm::Base),
            Voice::ThirdPerson => (ClauseForm::VerbPhrase, VerbForm::ThirdPerson),
            Voice::Gerund => (ClauseForm::VerbPhrase, VerbForm::Gerund),
            Voice::Imperative if position.index == 0 && connective.tokens.is_empty() && self.rng.random_bool(0.1) => {
                (ClauseForm::Statement, VerbForm::Base)
            }
            Voice::Imperative | Voice::Request => (ClauseForm::VerbPhrase, VerbForm::Base),
        }
    }

    fn add_connective(&mut self, connective: &Expansion, position: ClausePosition, form: ClauseForm) {
        let clause = self.num_clauses;
        if position.index == 1 && self.order != ClauseOrder::Written {
            self.text.add(",", None, false);
            return;
        }
        let mut ends_sentence = false;
        for token in &connective.tokens {
            match token {
                ClauseToken::Word(word) => {
                    self.text.add(word, Some(clause), false);
                    ends_sentence |= word == ".";
                }
                ClauseToken::Requires(NextForm::NounPhrase) => self.text.add("a", Some(clause), false),
                _ => {}
            }
        }
        if self.voice == Voice::ThirdPerson
            && !position.is_first()
            && ends_sentence
            && form == ClauseForm::VerbPhrase
            && self.rng.random_bool(0.8)
        {
            self.text.add("the camera", Some(clause), false);
        }
        self.held_out |= connective.held_out;
    }

    /// Draws clauses until one fits: its tokens agree, its objects exist, its steps are consistent with those before.
    /// `duration` is the duration before the clause.
    fn choose_clause(
        &mut self,
        form: ClauseForm,
        position: ClausePosition,
        start: Option<&Framing>,
        duration: Option<&Expansion>,
    ) -> Option<Clause> {
        for _ in 0..40 {
            let Some(group) = self.choose_group(position) else { continue };
            let Some((form, template)) = self.choose_template(group, &[form]) else { continue };
            let mut expansion = self.expander.expand(template, self.rng);
            if let Some(duration) = duration.filter(|_| group.steps.len() == 1) {
                expansion.tokens.splice(0..0, duration.tokens.iter().cloned());
                expansion.meaning.extend(duration.meaning.iter().cloned());
                expansion.held_out |= duration.held_out;
            }
            // `the camera pans the camera`.
            let is_camera = |token: &ClauseToken| matches!(token, ClauseToken::Word(word) if word == "camera");
            if self.voice == Voice::ThirdPerson && expansion.tokens.iter().take(4).any(is_camera) {
                continue;
            }
            let bindings = self.bind();
            if let Some(steps) = self.steps_of(group, &expansion, &bindings, start) {
                return Some(Clause { expansion, form, steps, bindings });
            }
        }
        None
    }

    /// A group of clauses whose context is given.
    fn choose_group(&mut self, position: ClausePosition) -> Option<&'a TemplateGroup> {
        let grammar = self.expander.grammar;
        let (focused, moved, num_objects) = (self.focus.len() == 1, self.moved, self.objects.len());
        let is_possible = |group: &&TemplateGroup| {
            (!position.is_first() || !group.requires(Requirement::Before))
                && (focused || !group.requires(Requirement::Focus))
                && (moved || !group.requires(Requirement::Moved))
                && (position.index > 0 || !group.cuts())
                && group.placeholders.iter().all(|placeholder| (*placeholder as usize) < num_objects)
        };
        choose_weighted(grammar.clauses.iter().filter(is_possible), |group| group.weight, self.rng)
    }

    /// A template of one of `forms`.
    pub(super) fn choose_template<'g>(
        &mut self,
        group: &'g TemplateGroup,
        forms: &[ClauseForm],
    ) -> Option<(ClauseForm, &'g Template)> {
        let fitting = group.templates.iter().filter(|(form, _)| forms.contains(form));
        let template = self.expander.choose(fitting.clone().map(|(_, template)| template), self.rng)?;
        let form = fitting.clone().find(|(_, other)| std::ptr::eq(other, template)).map(|(form, _)| *form)?;
        Some((form, template))
    }

    /// Different objects for the placeholders; more often than not `A` is the object in focus.
    pub(super) fn bind(&mut self) -> Bindings {
        let mut ids: Vec<u32> = self.objects.iter().map(|object| object.id).collect();
        let mut bindings = [None; 3];
        if self.focus.len() == 1 && self.rng.random_bool(0.55) {
            bindings[0] = self.focus.first().copied();
        }
        ids.retain(|id| {
            Some(*id) != bindings[0]
                && (bindings[0].is_some()
                    || self.focus.len() != 1
                    || !self.focus.contains(id)
                    || self.objects.len() < 3)
        });
        for bound in &mut bindings {
            if bound.is_none() && !ids.is_empty() {
                let at = self.rng.random_range(0..ids.len());
                *bound = Some(ids.swap_remove(at));
            }
        }
        bindings
    }

    /// The step of tokens of the notation, in which a placeholder, `F` or `H` stands for objects.
    pub(super) fn step(&self, tokens: impl Iterator<Item = String>, bindings: &Bindings) -> Option<Step> {
        let tokens: Vec<String> = tokens.collect();
        let resolve = |name: &str| match name {
            "F" => Some(self.focus.clone()),
            // A hold is of the one object in focus, or of nothing in particular.
            "H" => Some(self.focus.iter().copied().filter(|_| self.focus.len() == 1).collect()),
            _ => bound(bindings, name.parse().ok()?).map(|id| vec![id]),
        };
        let tokens: Vec<&str> = tokens.iter().map(String::as_str).collect();
        step_from_notation(&tokens, &resolve).ok()
    }

    /// The steps of a clause; `None` where they contradict themselves, each other or the steps before.
    fn steps_of(
        &self,
        group: &TemplateGroup,
        expansion: &Expansion,
        bindings: &Bindings,
        start: Option<&Framing>,
    ) -> Option<Vec<Step>> {
        let last = group.steps.len().checked_sub(1)?;
        // In `rush up to A and hold for 2 seconds` the duration belongs to the hold, the speed to the first step.
        let ends_in_hold = last > 0 && group.steps.last()?.first().is_some_and(|name| name == Move::Static.as_ref());
        let belongs_to = |index: usize, token: &String| {
            if ends_in_hold && !token.starts_with("dur=") { index == 0 } else { index == last }
        };
        let mut steps = Vec::new();
        for (index, tokens) in group.steps.iter().enumerate() {
            let more = expansion.meaning.iter().filter(|token| belongs_to(index, token));
            steps.push(self.step(tokens.iter().chain(more).cloned(), bindings)?);
        }
        if let Some(start) = start {
            apply_opening(steps.first_mut()?, start)?;
        }
        let before = self.program.steps.last();
        let repeats = before.is_some_and(|before| steps.first().is_some_and(|now| is_redundant(before, now)));
        (!repeats && steps.iter().all(is_consistent)).then_some(steps)
    }

    /// Sets the focus to what the camera looks at after a step.
    fn update_focus(&mut self, step: &Step) {
        let via = step.via.as_ref().map(|via| via.objects.clone()).filter(|ids| ids.len() == 1);
        let turns_away = step.movement.looks_elsewhere();
        let stays = matches!(
            step.movement,
            Move::Static | Move::RollCw | Move::RollCcw | Move::ZoomIn | Move::ZoomOut | Move::PushIn
        );
        if !step.end.subjects.is_empty() {
            self.focus.clone_from(&step.end.subjects);
        } else if let Some(ids) = via {
            self.focus = ids;
        } else if !turns_away && step.start.subjects.len() == 1 {
            self.focus.clone_from(&step.start.subjects);
        } else if !stays || step.end.size.is_some() {
            self.focus.clear();
        }
        self.focus.dedup();
    }

    /// Adds a step that is a clause of its own.
    pub(super) fn push_step(&mut self, step: Step) {
        self.clause_of_step.push(self.num_clauses);
        self.num_clauses += 1;
        self.program.steps.push(step);
    }
}
