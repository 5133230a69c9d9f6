//! State of a prompt while it is composed, and the choices that hold for all of it.

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use crate::sampler::choice::choose_from_table;
use crate::sampler::expansion::{Expander, TemplateSplit};
use crate::sampler::grammar::Grammar;
use crate::sampler::surface::SurfaceText;
use crate::sampler::template::ObjectPlaceholder;
use cinesplat_language::NamedObject;
use cinesplat_operator::Program;

/// Syntactic form of the clauses of a prompt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Voice {
    /// `push in`.
    Imperative,
    /// `can you push in`.
    Request,
    /// `the camera pushes in`.
    ThirdPerson,
    /// `pushing in`.
    Gerund,
    /// `a push-in`.
    NounPhrase,
}

const VOICES: [(Voice, u32); 5] = [
    (Voice::Imperative, 58),
    (Voice::Request, 10),
    (Voice::ThirdPerson, 14),
    (Voice::Gerund, 4),
    (Voice::NounPhrase, 14),
];

/// Which connectives join the clauses of a prompt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Connectives {
    /// Any, chosen separately at each joint.
    Mixed,
    /// `push in, pan left and pull back`.
    List,
    /// `push in, then pan left, then pull back`.
    Then,
    /// `Push in. Pan left. Then pull back.`
    Sentences,
}

const CONNECTIVES: [(Connectives, u32); 4] =
    [(Connectives::Mixed, 44), (Connectives::List, 36), (Connectives::Then, 10), (Connectives::Sentences, 10)];

/// Temporal order of the first two clauses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ClauseOrder {
    /// As written.
    Written,
    /// `after pushing in, pan left`: as written, the first clause subordinate.
    After,
    /// `before pushing in, pan left`: the second clause happens first.
    Before,
}

/// Position of a clause in its prompt.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClausePosition {
    pub(super) index: usize,
    /// Number of clauses of the prompt.
    pub(super) count: usize,
    /// A framing comes before all clauses.
    pub(super) after_opening: bool,
    /// The first of a pair that begins with `after` or `before`.
    pub(super) subordinate: bool,
}

impl ClausePosition {
    pub(super) fn is_first(self) -> bool {
        self.index == 0 && !self.after_opening
    }
}

/// Object ids that the placeholders `A`, `B`, `C` of a clause stand for.
pub(super) type Bindings = [Option<u32>; 3];

/// The object of a placeholder.
pub(super) fn bound(bindings: &Bindings, placeholder: ObjectPlaceholder) -> Option<u32> {
    bindings.get(placeholder as usize).copied().flatten()
}

/// A prompt while it is composed.
pub(super) struct Composer<'a> {
    pub(super) expander: Expander<'a>,
    pub(super) objects: &'a [NamedObject],
    pub(super) rng: &'a mut Pcg64,
    pub(super) voice: Voice,
    pub(super) connectives: Connectives,
    pub(super) order: ClauseOrder,
    /// Share of mentions by number.
    pub(super) numbered_frac: f64,
    pub(super) text: SurfaceText,
    pub(super) program: Program,
    /// Index of the clause of every step.
    pub(super) clause_of_step: Vec<usize>,
    pub(super) num_clauses: usize,
    /// Objects that the camera looks at after the last clause.
    pub(super) focus: Vec<u32>,
    /// Whether the camera has moved.
    pub(super) moved: bool,
    /// Whether a held-out template was used.
    pub(super) held_out: bool,
    /// Object ids in order of first mention.
    pub(super) mentioned: Vec<u32>,
    /// Number of mentions without pronouns.
    pub(super) num_mentions: usize,
    pub(super) last_mentioned: Option<u32>,
}

impl<'a> Composer<'a> {
    /// An empty prompt with its voice, connectives and share of numbered mentions chosen.
    pub(super) fn new(
        grammar: &'a Grammar,
        split: TemplateSplit,
        objects: &'a [NamedObject],
        rng: &'a mut Pcg64,
    ) -> Self {
        let voice = choose_from_table(&VOICES, rng).unwrap_or(Voice::Imperative);
        let connectives = choose_from_table(&CONNECTIVES, rng).unwrap_or(Connectives::Mixed);
        let numbered_frac = [1.0, 0.0, 0.0, 0.5].choose(rng).copied().unwrap_or(0.0);
        Self {
            expander: Expander { grammar, split, terse: rng.random_bool(0.5) },
            objects,
            rng,
            voice,
            connectives,
            order: ClauseOrder::Written,
            numbered_frac,
            text: SurfaceText::default(),
            program: Program::default(),
            clause_of_step: Vec::new(),
            num_clauses: 0,
            focus: Vec::new(),
            moved: false,
            held_out: false,
            mentioned: Vec::new(),
            num_mentions: 0,
            last_mentioned: None,
        }
    }
}
