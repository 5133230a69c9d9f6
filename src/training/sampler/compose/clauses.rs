//! Clauses: which one comes next, what it is bound to, what it means, and the words that join it on.

use rand::RngExt;

use super::sense::{is_idle, is_sensible, open_with};
use super::{Binding, Composer, Order, Place, Style, Voice, bound, pick_family};
use crate::sampler::wording::{Atom, Drawn};
use cinesplat_language::grammar::{Family, Form, Wording};
use cinesplat_language::inflection::Tense;
use cinesplat_language::notation::step_from_tokens;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

/// A clause that fits.
struct Clause {
    drawn: Drawn,
    form: Form,
    steps: Vec<Step>,
    binding: Binding,
}

impl Composer<'_> {
    /// Adds clause `place`; `start` is a framing that was said right before it.
    pub(super) fn add_clause(&mut self, place: Place, start: Option<&Framing>) -> Option<()> {
        let joint = self.joint(place);
        let (forms, tense) = self.forms_after(&joint, place);
        let time = if forms == [Form::Verb] && tense == Tense::Base { self.time_first(&joint, place) } else { None };
        let clause = self.draw_clause(&forms, place, start, time.as_ref())?;
        self.add_joint(&joint, place, clause.form);
        self.add_atoms(&clause.drawn.atoms, tense, Some(self.num_clauses), &clause.binding)?;
        self.held_out |= clause.drawn.held_out;
        let steps = clause.steps;
        if let Some(last) = steps.last() {
            self.look(last);
        }
        for step in steps {
            self.moved |= step.movement != Move::Static;
            self.clause_of_step.push(self.num_clauses);
            self.program.steps.push(step);
        }
        self.num_clauses += 1;
        Some(())
    }

    /// The words between this clause and what stands before it; a last word ending in `+g` or `+n` asks for a form.
    fn joint(&mut self, place: Place) -> Drawn {
        let name = if place.is_first() { self.lead(place) } else { self.link(place) };
        self.drawer.list(name, self.rng)
    }

    fn lead(&self, place: Place) -> &'static str {
        match (self.voice, self.order) {
            (_, Order::After) if place.inverted => "lead.after",
            (_, Order::Before) if place.inverted => "lead.before",
            (Voice::Imperative, _) => "lead.imp",
            (Voice::Request, _) => "lead.request",
            (Voice::Third, _) => "lead.third",
            (Voice::Gerund, _) => "silence",
            (Voice::Noun, _) => "lead.n",
        }
    }

    fn link(&mut self, place: Place) -> &'static str {
        let last = place.nth > 0 && place.nth + 1 == place.count;
        match (self.style, self.voice == Voice::Noun) {
            (Style::List, false) if place.count > 1 => {
                if last {
                    "join.end"
                } else {
                    "join.list"
                }
            }
            (Style::List, true) if place.count > 1 => {
                if last {
                    "join.n.end"
                } else {
                    "join.n.list"
                }
            }
            (_, true) => "join.n",
            (Style::Then, false) => "join.then",
            (Style::Sentences, false) => "join.sentence",
            _ if last && self.rng.random_bool(0.35) => "join.last",
            _ => "join",
        }
    }

    /// `over 3 seconds,` before what takes them; only after words that begin anew.
    fn time_first(&mut self, joint: &Drawn, place: Place) -> Option<Drawn> {
        let opens = match joint.atoms.last() {
            Some(Atom::Word(word)) if word == "," => joint.atoms.len() > 1,
            Some(Atom::Word(word)) => matches!(word.as_str(), "then" | "." | ";" | "now" | "next"),
            _ => false,
        };
        let list = if place.nth > 0 && opens && self.rng.random_bool(0.08) {
            "dur.pre"
        } else if place.nth == 0 && !place.opened && self.rng.random_bool(0.02) {
            "dur.take"
        } else {
            return None;
        };
        Some(self.drawer.list(list, self.rng))
    }

    fn forms_after(&mut self, joint: &Drawn, place: Place) -> (Vec<Form>, Tense) {
        let marked = |mark: &str| matches!(joint.atoms.last(), Some(Atom::Word(word)) if word.ends_with(mark));
        if marked("+g") {
            return (vec![Form::Verb], Tense::Gerund);
        }
        if marked("+n") {
            return (vec![Form::Noun], Tense::Base);
        }
        match self.voice {
            _ if place.inverted => (vec![Form::Verb], Tense::Base),
            Voice::Noun => (vec![Form::Noun], Tense::Base),
            Voice::Third => (vec![Form::Verb], Tense::Third),
            Voice::Gerund => (vec![Form::Verb], Tense::Gerund),
            Voice::Imperative if place.nth == 0 && joint.atoms.is_empty() && self.rng.random_bool(0.1) => {
                (vec![Form::Statement], Tense::Base)
            }
            Voice::Imperative | Voice::Request => (vec![Form::Verb], Tense::Base),
        }
    }

    fn add_joint(&mut self, joint: &Drawn, place: Place, form: Form) {
        let clause = self.num_clauses;
        if place.nth == 1 && self.order != Order::Told {
            self.page.add(",", None, false);
            return;
        }
        for atom in &joint.atoms {
            let Atom::Word(word) = atom else { continue };
            let word = word.trim_end_matches("+g").trim_end_matches("+n");
            self.page.add(word, Some(clause), false);
        }
        if joint.atoms.last().is_some_and(|atom| matches!(atom, Atom::Word(word) if word.ends_with("+n"))) {
            self.page.add("a", Some(clause), false);
        }
        let ends_sentence = joint.atoms.iter().any(|atom| matches!(atom, Atom::Word(word) if word == "."));
        if self.voice == Voice::Third
            && !place.is_first()
            && ends_sentence
            && form == Form::Verb
            && self.rng.random_bool(0.8)
        {
            self.page.add("the camera", Some(clause), false);
        }
        self.held_out |= joint.held_out;
    }

    /// Draws until a clause fits: its tokens agree, its objects exist, it makes sense after what came before.
    /// `time` is said before it.
    fn draw_clause(
        &mut self,
        forms: &[Form],
        place: Place,
        start: Option<&Framing>,
        time: Option<&Drawn>,
    ) -> Option<Clause> {
        for _ in 0..40 {
            let grammar = self.drawer.grammar;
            let (focused, moved, num_objects) = (self.focus.len() == 1, self.moved, self.objects.len());
            let able = |family: &&Family| {
                (!place.is_first() || !family.needs_before)
                    && (focused || !family.needs_focus)
                    && (moved || !family.needs_move)
                    && (place.nth > 0 || !family.steps.iter().flatten().any(|t| t == "cut"))
                    && family.letters().iter().all(|letter| (*letter as usize) < 'A' as usize + num_objects)
            };
            let Some(family) = pick_family(grammar.families.iter().filter(able), self.rng) else { continue };
            let Some((form, wording)) = self.pick_clause(family, forms) else { continue };
            let mut drawn = self.drawer.wording(wording, self.rng);
            if let Some(time) = time.filter(|_| family.steps.len() == 1) {
                drawn.atoms.splice(0..0, time.atoms.iter().cloned());
                drawn.meaning.extend(time.meaning.iter().cloned());
                drawn.held_out |= time.held_out;
            }
            // `the camera pans the camera`.
            let doubled = |atom: &Atom| matches!(atom, Atom::Word(word) if word == "camera");
            if self.voice == Voice::Third && drawn.atoms.iter().take(4).any(doubled) {
                continue;
            }
            let binding = self.bind();
            if let Some(steps) = self.steps_of(family, &drawn, &binding, start) {
                return Some(Clause { drawn, form, steps, binding });
            }
        }
        None
    }

    pub(super) fn pick_clause<'f>(&mut self, family: &'f Family, forms: &[Form]) -> Option<(Form, &'f Wording)> {
        let fitting = family.clauses.iter().filter(|(form, _)| forms.contains(form));
        let wording = self.drawer.pick(fitting.clone().map(|(_, wording)| wording), self.rng)?;
        let form = fitting.clone().find(|(_, other)| std::ptr::eq(other, wording)).map(|(form, _)| *form)?;
        Some((form, wording))
    }

    /// Different objects for A, B, C; A is rather the thing looked at.
    pub(super) fn bind(&mut self) -> Binding {
        let mut ids: Vec<u32> = self.objects.iter().map(|object| object.id).collect();
        let mut binding = [None; 3];
        if self.focus.len() == 1 && self.rng.random_bool(0.55) {
            binding[0] = self.focus.first().copied();
        }
        ids.retain(|id| {
            Some(*id) != binding[0]
                && (binding[0].is_some() || self.focus.len() != 1 || !self.focus.contains(id) || self.objects.len() < 3)
        });
        for place in &mut binding {
            if place.is_none() && !ids.is_empty() {
                let at = self.rng.random_range(0..ids.len());
                *place = Some(ids.swap_remove(at));
            }
        }
        binding
    }

    pub(super) fn step(&self, tokens: impl Iterator<Item = String>, binding: &Binding) -> Option<Step> {
        let tokens: Vec<String> = tokens.collect();
        let resolve = |name: &str| match name {
            "F" => Some(self.focus.clone()),
            // What a hold looks at: that one thing, or nothing in particular.
            "H" => Some(self.focus.iter().copied().filter(|_| self.focus.len() == 1).collect()),
            _ => bound(binding, name.chars().next()?).map(|id| vec![id]),
        };
        let tokens: Vec<&str> = tokens.iter().map(String::as_str).collect();
        step_from_tokens(&tokens, &resolve).ok()
    }

    fn steps_of(
        &self,
        family: &Family,
        drawn: &Drawn,
        binding: &Binding,
        start: Option<&Framing>,
    ) -> Option<Vec<Step>> {
        let last = family.steps.len().checked_sub(1)?;
        // Of `rush up to A and hold for 2 seconds` the time is the hold's and the speed is not.
        let holds = last > 0 && family.steps.last()?.first().is_some_and(|movement| movement == "static");
        let belongs = |token: &String, index: usize| {
            if holds && !token.starts_with("dur=") { index == 0 } else { index == last }
        };
        let mut steps = Vec::new();
        for (index, tokens) in family.steps.iter().enumerate() {
            let more = drawn.meaning.iter().filter(|token| belongs(token, index));
            let step = self.step(tokens.iter().chain(more).cloned(), binding)?;
            steps.push(step);
        }
        if let Some(start) = start {
            open_with(steps.first_mut()?, start)?;
        }
        let repeats =
            self.program.steps.last().is_some_and(|before| steps.first().is_some_and(|now| is_idle(before, now)));
        (!repeats && steps.iter().all(is_sensible)).then_some(steps)
    }

    /// What the camera looks at after a step.
    fn look(&mut self, step: &Step) {
        let via = step.via.as_ref().map(|via| via.objects.clone()).filter(|ids| ids.len() == 1);
        let turns_away =
            matches!(step.movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::WhipPan);
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

    pub(super) fn push_step(&mut self, step: Step) {
        self.clause_of_step.push(self.num_clauses);
        self.num_clauses += 1;
        self.program.steps.push(step);
    }
}
