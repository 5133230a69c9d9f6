//! A whole prompt, composed clause by clause, with the program it means.
//!
//! What makes the meaning sure: every wording brings its tokens; contradictions ("slowly .. fast") are drawn again; a
//! pronoun stands only for the one thing the clause before looked at; a framing before a move is where that move starts.

mod clauses;
mod framings;
mod sense;
mod writing;

use std::cmp::Ordering;

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use self::sense::settle_durations;
use super::prompt_sampler::{LabeledPrompt, TemplateSplit};
use super::surface::{Hand, Page};
use super::wording::Drawer;
use cinesplat_language::NamedObject;
use cinesplat_language::grammar::{Family, Grammar};
use cinesplat_operator::Program;
use cinesplat_trajectory::Move;

/// How the writer of a prompt puts sentences.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Voice {
    Imperative,
    Request,
    Third,
    Gerund,
    Noun,
}

const VOICES: [(Voice, u32); 5] =
    [(Voice::Imperative, 58), (Voice::Request, 10), (Voice::Third, 14), (Voice::Gerund, 4), (Voice::Noun, 14)];
const HANDS: [(Hand, u32); 5] =
    [(Hand::Neat, 66), (Hand::Lower, 18), (Hand::Bare, 4), (Hand::Upper, 2), (Hand::Slip, 10)];
const LENGTHS: [(usize, u32); 5] = [(1, 30), (2, 32), (3, 26), (4, 9), (5, 3)];
const STYLES: [(Style, u32); 4] = [(Style::Mixed, 44), (Style::List, 36), (Style::Then, 10), (Style::Sentences, 10)];

/// How the writer of a prompt joins clauses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Style {
    /// Each joint by itself.
    Mixed,
    /// `push in, pan left and pull back`.
    List,
    /// `push in, then pan left, then pull back`.
    Then,
    /// `Push in. Pan left. Then pull back.`
    Sentences,
}

/// How the first two clauses of a prompt stand in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Order {
    /// As they are told.
    Told,
    /// `after pushing in, pan left`.
    After,
    /// `before pushing in, pan left`: the second one told comes first.
    Before,
}

fn weighted<T: Copy>(choices: &[(T, u32)], rng: &mut Pcg64) -> Option<T> {
    let total: u32 = choices.iter().map(|(_, weight)| weight).sum();
    let mut at = rng.random_range(0..total.max(1));
    choices
        .iter()
        .find(|(_, weight)| {
            let here = at < *weight;
            at = at.saturating_sub(*weight);
            here
        })
        .map(|(choice, _)| *choice)
}

/// Where a clause stands in its prompt.
#[derive(Debug, Clone, Copy)]
struct Place {
    nth: usize,
    count: usize,
    /// A framing was said before all clauses.
    opened: bool,
    /// It is the first of a pair that begins with `after` or `before`.
    inverted: bool,
}

impl Place {
    fn is_first(self) -> bool {
        self.nth == 0 && !self.opened
    }
}

/// Objects behind the letters A, B, C of one clause.
type Binding = [Option<u32>; 3];

fn bound(binding: &Binding, letter: char) -> Option<u32> {
    binding.get((letter as usize).checked_sub('A' as usize)?).copied().flatten()
}

pub(crate) struct Composer<'a> {
    drawer: Drawer<'a>,
    objects: &'a [NamedObject],
    rng: &'a mut Pcg64,
    voice: Voice,
    style: Style,
    /// Share of mentions by number.
    numbered: f64,
    page: Page,
    program: Program,
    /// Clause of every step.
    clause_of_step: Vec<usize>,
    num_clauses: usize,
    focus: Vec<u32>,
    moved: bool,
    order: Order,
    held_out: bool,
    /// Object ids in order of first mention, as the linker has to find them.
    mentioned: Vec<u32>,
    num_mentions: usize,
    last_mentioned: Option<u32>,
}

/// A finished prompt with what the linker has to find in it.
pub(crate) struct Composed {
    pub(crate) sample: LabeledPrompt,
    /// Object ids in order of first mention.
    pub(crate) mentioned: Vec<u32>,
    /// How often objects are named, pronouns aside.
    pub(crate) num_mentions: usize,
    pub(crate) held_out: bool,
}

impl<'a> Composer<'a> {
    pub(crate) fn new(
        grammar: &'a Grammar,
        split: TemplateSplit,
        objects: &'a [NamedObject],
        rng: &'a mut Pcg64,
    ) -> Self {
        let voice = weighted(&VOICES, rng).unwrap_or(Voice::Imperative);
        let style = weighted(&STYLES, rng).unwrap_or(Style::Mixed);
        let numbered = [1.0, 0.0, 0.0, 0.5].choose(rng).copied().unwrap_or(0.0);
        Self {
            drawer: Drawer { grammar, split, terse: rng.random_bool(0.5) },
            objects,
            rng,
            voice,
            style,
            numbered,
            page: Page::default(),
            program: Program::default(),
            clause_of_step: Vec::new(),
            num_clauses: 0,
            focus: Vec::new(),
            moved: false,
            order: Order::Told,
            held_out: false,
            mentioned: Vec::new(),
            num_mentions: 0,
            last_mentioned: None,
        }
    }

    /// One prompt; `None` when the draw came to nothing and another one is due.
    pub(crate) fn compose(mut self) -> Option<Composed> {
        if self.rng.random_bool(0.07) {
            self.add_list("total.pre")?;
        }
        match self.rng.random_range(0..100) {
            0..5 => self.add_framing_alone()?,
            5..9 => self.add_two_framings()?,
            _ => self.add_clauses()?,
        }
        // `then pause. 8 seconds.` would be the pause's.
        let pauses = self.program.steps.last().is_some_and(|step| step.movement == Move::Static);
        if self.program.duration_secs.is_none() && !pauses && self.rng.random_bool(0.1) {
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
        let count = weighted(&LENGTHS, self.rng)?;
        let opening =
            if self.voice != Voice::Third && self.rng.random_bool(0.2) { Some(self.add_opening()?) } else { None };
        let opened = opening.is_some();
        if !opened && self.voice == Voice::Imperative {
            self.order = self.draw_order(count);
        }
        for nth in 0..count {
            let place = Place { nth, count, opened, inverted: self.order != Order::Told && nth == 0 };
            self.add_clause(place, opening.as_ref().filter(|_| nth == 0))?;
        }
        if self.order == Order::Before {
            return self.swap_clauses();
        }
        if self.rng.random_bool(0.14) {
            self.add_closing()?;
        }
        Some(())
    }

    fn draw_order(&mut self, count: usize) -> Order {
        match self.rng.random_range(0..100) {
            0..14 if count > 1 => Order::After,
            // What a third clause goes on from would be the one told first.
            14..20 if count == 2 => Order::Before,
            _ => Order::Told,
        }
    }

    /// Puts the steps of the clause told first behind those of the other.
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
        settle_durations(&mut self.program)?;
        self.page.tidy();
        let hand = weighted(&HANDS, self.rng).unwrap_or(Hand::Neat);
        self.page.write(hand, self.rng);
        let (prompt, spans) = self.page.finish(self.num_clauses);
        for (step, clause) in self.program.steps.iter_mut().zip(&self.clause_of_step) {
            step.words = spans.get(*clause).copied().flatten();
        }
        let sample = LabeledPrompt { prompt, program: self.program };
        let Self { mentioned, num_mentions, held_out, .. } = self;
        Some(Composed { sample, mentioned, num_mentions, held_out })
    }
}

fn pick_family<'f>(families: impl Iterator<Item = &'f Family> + Clone, rng: &mut Pcg64) -> Option<&'f Family> {
    let total: f64 = families.clone().map(|family| family.weight).sum();
    if total.partial_cmp(&0.0) != Some(Ordering::Greater) {
        return None;
    }
    let mut at = rng.random_range(0.0..total);
    families.into_iter().find(|family| {
        at -= family.weight;
        at < 0.0
    })
}
