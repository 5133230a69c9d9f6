//! A program as the sequence of keys that the decoder emits, and back.
//!
//! Enters: a [`Program`] of n steps. Leaves: n + 1 keys, one more for every cut. A key says what the picture shows when
//! the camera arrives, what it shows when the camera departs, and what comes next. Nothing is lost either way, except
//! a cut on the first step (there is nothing to cut from) and the words that nobody can do, which are not keys.

use cinesplat_operator::{Amount, Framing, Program, Speed, Step, Via};
use cinesplat_trajectory::{Easing, Move};

/// Most keys that the decoder emits.
pub const MAX_KEYS: usize = 12;

/// One key: the boundary between two steps, or an end of the film.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Key {
    /// How the step before ends.
    pub arrive: Framing,
    /// How the step after begins.
    pub depart: Framing,
    /// What follows.
    pub next: Next,
}

/// What follows a key.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Next {
    /// A step.
    Segment(Segment),
    /// A cut to the next key.
    Cut,
    /// Nothing: the film ends here.
    #[default]
    Stop,
}

/// The part of a step that belongs to neither of its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// What the camera does.
    pub movement: Move,
    /// A second move at the same time.
    pub with: Option<Move>,
    /// The direction of the move is open.
    pub either_way: bool,
    /// What it passes.
    pub via: Option<Via>,
    /// How far it goes.
    pub amount: Option<Amount>,
    /// How long it takes.
    pub duration_secs: Option<f64>,
    /// How fast it is.
    pub speed: Speed,
    /// How its speed changes.
    pub easing: Option<Easing>,
    /// It ends where the film began.
    pub returns: bool,
    /// Byte range of the prompt.
    pub words: Option<[usize; 2]>,
}

/// The keys of a program, in order. A program without steps gives one key.
pub fn keys_of(program: &Program) -> Vec<Key> {
    let mut keys = Vec::with_capacity(program.steps.len() + 1);
    let mut arrive = Framing::default();
    for (step_idx, step) in program.steps.iter().enumerate() {
        if step.cut && step_idx > 0 {
            keys.push(Key { arrive: std::mem::take(&mut arrive), depart: Framing::default(), next: Next::Cut });
        }
        let next = Next::Segment(segment_of(step));
        keys.push(Key { arrive, depart: step.start.clone(), next });
        arrive = step.end.clone();
    }
    keys.push(Key { arrive, depart: Framing::default(), next: Next::Stop });
    keys
}

/// The steps of keys: total, so that whatever a decoder emits has a meaning. A segment that nothing follows ends in an
/// empty framing; whatever stands behind the first stop is left out.
pub fn steps_of(keys: &[Key]) -> Vec<Step> {
    let end = keys.iter().position(|key| key.next == Next::Stop).map_or(keys.len(), |stop_idx| stop_idx + 1);
    let keys = &keys[..end];
    let mut steps: Vec<Step> = Vec::new();
    let mut cut = false;
    for (key_idx, key) in keys.iter().enumerate() {
        match &key.next {
            Next::Segment(segment) => {
                let end = keys.get(key_idx + 1).map(|next| next.arrive.clone()).unwrap_or_default();
                steps.push(step_of(key.depart.clone(), segment, end, cut));
                cut = false;
            }
            Next::Cut => cut = !steps.is_empty(),
            Next::Stop => {}
        }
    }
    steps
}

/// For every step of the program that the keys make: the indices of the keys at its start and at its end.
pub fn boundaries_of(keys: &[Key]) -> Vec<[usize; 2]> {
    let segments = keys.iter().enumerate().filter(|(_, key)| matches!(key.next, Next::Segment(_)));
    segments.map(|(key_idx, _)| [key_idx, (key_idx + 1).min(keys.len() - 1)]).collect()
}

fn segment_of(step: &Step) -> Segment {
    Segment {
        movement: step.movement,
        with: step.with,
        either_way: step.either_way,
        via: step.via.clone(),
        amount: step.amount,
        duration_secs: step.duration_secs,
        speed: step.speed,
        easing: step.easing,
        returns: step.returns,
        words: step.words,
    }
}

fn step_of(start: Framing, segment: &Segment, end: Framing, cut: bool) -> Step {
    Step {
        movement: segment.movement,
        with: segment.with,
        either_way: segment.either_way,
        start,
        end,
        via: segment.via.clone(),
        amount: segment.amount,
        duration_secs: segment.duration_secs,
        speed: segment.speed,
        easing: segment.easing,
        cut,
        returns: segment.returns,
        words: segment.words,
    }
}
