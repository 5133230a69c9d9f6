//! Framings said by themselves: at the start of a prompt, at its end, alone, or two of the same thing.

use rand::RngExt;

use super::sense::{is_sensible, move_between};
use super::{Binding, Composer, pick_family};
use crate::sampler::wording::{Atom, Drawn};
use cinesplat_language::grammar::{Family, Form};
use cinesplat_language::inflection::Tense;
use cinesplat_operator::{Framing, Step, SubjectPart};
use cinesplat_trajectory::Move;

impl<'a> Composer<'a> {
    /// Draws a framing and says it after words of one of three lists: before a noun, a statement, a bare object.
    fn say_framing(&mut self, lists: [&str; 3], side: &str, subject: Option<u32>, clause: usize) -> Option<Framing> {
        for _ in 0..20 {
            let Some((family, form, drawn, binding)) = self.draw_framing(subject) else { continue };
            let Some(framing) = self.framing_of(family, &drawn, &binding, side) else { continue };
            let plain = framing.size.is_none() && framing.angle.is_none() && framing.subjects.len() < 2;
            let begins_with_object = matches!(drawn.atoms.first(), Some(Atom::Object(..)));
            let list = match form {
                Form::Noun => lists[0],
                // `look down at it` says itself, but only as a start.
                Form::Verb if side == "start" || self.page.is_empty() => "silence",
                Form::Verb => continue,
                Form::Statement if begins_with_object && plain => lists[2],
                Form::Statement if begins_with_object && side == "start" => "open.show",
                Form::Statement if begins_with_object => continue,
                Form::Statement => lists[1],
            };
            self.add_list(list)?;
            self.add_atoms(&drawn.atoms, Tense::Base, Some(clause), &binding)?;
            self.held_out |= drawn.held_out;
            return Some(framing);
        }
        None
    }

    fn draw_framing(&mut self, subject: Option<u32>) -> Option<(&'a Family, Form, Drawn, Binding)> {
        let grammar = self.drawer.grammar;
        let num_objects = self.objects.len();
        let able = |family: &&Family| {
            family.letters().len() <= num_objects && (subject.is_none() || family.letters() == ['A'])
        };
        let family = pick_family(grammar.framings.iter().filter(able), self.rng)?;
        let mut binding = self.bind();
        if let Some(id) = subject {
            binding[0] = Some(id);
        }
        let (form, wording) = self.pick_clause(family, &[Form::Noun, Form::Statement, Form::Verb])?;
        let drawn = self.drawer.wording(wording, self.rng);
        Some((family, form, drawn, binding))
    }

    fn framing_of(&self, family: &Family, drawn: &Drawn, binding: &Binding, side: &str) -> Option<Framing> {
        let tokens = family.steps.first()?.iter().chain(&drawn.meaning);
        let sided = tokens.map(|token| {
            if token.starts_with([':', '!']) { format!("{side}{token}") } else { format!("{side}={token}") }
        });
        let step = self.step(sided.chain(["static".to_owned()]), binding)?;
        Some(if side == "start" { step.start } else { step.end })
    }

    pub(super) fn add_opening(&mut self) -> Option<Framing> {
        let framing = self.say_framing(["open.n", "open.s", "open.on"], "start", None, self.num_clauses)?;
        self.focus.clone_from(&framing.subjects);
        Some(framing)
    }

    pub(super) fn add_framing_alone(&mut self) -> Option<()> {
        let framing = self.say_framing(["lead.n", "silence", "open.show"], "end", None, self.num_clauses)?;
        self.push_step(Step { end: framing, ..Step::of(Move::Static) });
        Some(())
    }

    /// `close on A, then wide`: the move between them follows from the framings.
    pub(super) fn add_two_framings(&mut self) -> Option<()> {
        let start = self.add_opening().filter(|f| f.subjects.len() == 1)?;
        self.add_list("join.frame")?;
        let drawn = self.drawer.list("frame.then", self.rng);
        let sided = drawn.meaning.iter().map(|token| format!("end{token}"));
        let subject = start.subjects.first().copied();
        let all = sided.chain(["static".to_owned(), "end=A".to_owned()]).collect::<Vec<_>>();
        let end = self.step(all.into_iter().rev(), &[subject, None, None])?.end;
        let movement = move_between(&start, &end)?;
        self.add_atoms(&drawn.atoms, Tense::Base, Some(self.num_clauses), &[None; 3])?;
        self.held_out |= drawn.held_out;
        self.push_step(Step { start, end, ..Step::of(movement) });
        Some(())
    }

    /// `, ending on a close-up of it`: of what the last step looks at, of another thing, or of the room.
    pub(super) fn add_closing(&mut self) -> Option<()> {
        let same = self.focus.first().copied().filter(|_| self.focus.len() == 1 && self.rng.random_bool(0.6));
        // Words about what the last step looks at belong to that step.
        let clause = if same.is_some() { self.num_clauses.checked_sub(1)? } else { self.num_clauses };
        let framing = self.say_framing(["close.n", "close.s", "close.on"], "end", same, clause)?;
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
            return is_sensible(last).then_some(());
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
