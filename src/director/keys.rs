//! A program as the sequence of keys that the decoder emits, and back.
//!
//! Enters: a [`Program`] of n steps. Leaves: n + 1 keys, and one more per cut. A key holds the framing when the camera
//! arrives, the framing when the camera departs, and what follows. The conversion keeps everything in both directions,
//! except a cut on the first step (there is nothing to cut from) and the length of the film.

use cinesplat_operator::{Amount, Framing, Look, Program, Speed, Step, Via};
use cinesplat_trajectory::{Easing, Move};

/// Limit on the keys of one prompt.
pub const MAX_KEYS: usize = 12;

/// One key: the boundary between two steps, or the start or end of the film.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Key {
    /// Framing at the end of the step before.
    pub arrive: Framing,
    /// Framing at the start of the step after.
    pub depart: Framing,
    /// What follows the key.
    pub next: Next,
}

/// What follows a key.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Next {
    /// A step.
    Segment(Segment),
    /// A cut to the next key.
    Cut,
    /// Nothing; the film ends here.
    #[default]
    Stop,
}

/// A step without the framings of its two ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// The camera move.
    pub movement: Move,
    /// Further moves at the same time.
    pub with: Vec<Move>,
    /// Whether the direction of the move is open.
    pub either_way: bool,
    /// Objects that the camera passes, and how.
    pub via: Option<Via>,
    /// What the camera looks at while it travels elsewhere.
    pub look: Option<Look>,
    /// Ids of objects that stay in view.
    pub keep: Vec<u32>,
    /// Ids of objects that are never in view.
    pub avoid: Vec<u32>,
    /// Extent of the move.
    pub amount: Option<Amount>,
    /// Duration.
    pub duration_secs: Option<f64>,
    /// Speed.
    pub speed: Speed,
    /// Easing.
    pub easing: Option<Easing>,
    /// Whether the step ends where the film began.
    pub returns: bool,
    /// Byte range of the prompt that the step comes from.
    pub words: Option<[usize; 2]>,
}

/// Keys of a program, in order. A program without steps gives one key.
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

/// The steps that keys describe. The function is total: every sequence of keys has a meaning. A segment
/// without a key after it ends in an empty framing; keys after the first stop are ignored.
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

/// For each step of [`steps_of`], the indices of the keys at its start and at its end.
pub fn boundaries_of(keys: &[Key]) -> Vec<[usize; 2]> {
    let segments = keys.iter().enumerate().filter(|(_, key)| matches!(key.next, Next::Segment(_)));
    segments.map(|(key_idx, _)| [key_idx, (key_idx + 1).min(keys.len() - 1)]).collect()
}

fn segment_of(step: &Step) -> Segment {
    Segment {
        movement: step.movement,
        with: step.with.clone(),
        look: step.look.clone(),
        keep: step.keep.clone(),
        avoid: step.avoid.clone(),
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
        with: segment.with.clone(),
        look: segment.look.clone(),
        keep: segment.keep.clone(),
        avoid: segment.avoid.clone(),
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
