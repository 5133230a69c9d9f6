//! Keys out of the network, one by one, under rules: what comes out is always a program that can be carried out.
//!
//! Rules: at most [`MAX_KEYS`] keys, the first begins a step, a cut is followed by a step; objects are those that the text
//! names (any where it names none), each once; an amount or a duration is a quantity of the right kind; words run
//! forward; poses are finite.

use candle_core::{Result, Tensor};
use glam::DQuat;

use super::codes::{
    AMOUNT_QUANTITY, Field, KeyCode, NEXT_CUT, NEXT_SEGMENT, NEXT_STOP, NUM_FIELDS, OBJECT_POINTERS, PLACES,
};
use super::keys::MAX_KEYS;
use super::model::{Dropout, KeyBatch, Memory, Network, POSE_WIDTH, PoseCode, Prompt, PromptBatch, anchor_places};

/// How sure the network is of one key: the probability of each choice that it made.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct KeyCertainty {
    /// `(what, probability)`, only choices that apply.
    pub(crate) choices: Vec<(&'static str, f64)>,
}

/// What the network makes of a prompt.
#[derive(Debug, Clone, Default)]
pub(crate) struct Decoded {
    pub(crate) keys: Vec<KeyCode>,
    pub(crate) certainties: Vec<KeyCertainty>,
    /// One a key.
    pub(crate) poses: Vec<PoseCode>,
    /// Place of the film's length among the quantities.
    pub(crate) film: Option<usize>,
}

/// Which quantities may be what.
#[derive(Debug, Clone, Default)]
pub(crate) struct QuantityRules {
    /// Quantities that are times.
    pub(crate) is_time: Vec<bool>,
}

/// Decodes one prompt.
pub(crate) fn decode(
    network: &Network,
    prompt: &Prompt,
    batch: &PromptBatch,
    rules: &QuantityRules,
) -> Result<Decoded> {
    let off = Dropout::off();
    let memory = network.remember(batch, &off)?;
    let mut decoded = Decoded::default();
    while decoded.keys.last().is_none_or(|key| key.class(Field::Next) != NEXT_STOP) && decoded.keys.len() < MAX_KEYS {
        let before = match decoded.keys.len() {
            0 => None,
            _ => Some(KeyBatch::new(&[&decoded.keys], &[prompt], batch)?),
        };
        let states = network.states(before.as_ref(), &memory, &off)?;
        let last = states.narrow(1, decoded.keys.len(), 1)?.contiguous()?; // [1, 1, width]
        let scores = network.scores(&last, &memory, batch)?;
        let mut chooser = Chooser { prompt, rules, certainty: KeyCertainty::default() };
        if decoded.keys.is_empty() {
            let film = scores.film.flatten_all()?.to_vec1::<f32>()?;
            decoded.film = chooser.quantity("film length", &film, true).and_then(|place| place.checked_sub(1));
        }
        let row = ScoreRow {
            classes: scores.classes.flatten_all()?.to_vec1()?,
            objects: scores.objects.reshape((OBJECT_POINTERS, ()))?.to_vec2()?,
            quantities: scores.quantities.reshape((2, ()))?.to_vec2()?,
            words: scores.words.reshape((2, ()))?.to_vec2()?,
        };
        let key = chooser.key(&row, &decoded.keys);
        decoded.keys.push(key);
        decoded.certainties.push(chooser.certainty);
    }
    decoded.poses = poses(network, prompt, batch, &memory, &decoded.keys)?;
    Ok(decoded)
}

/// Scores of one key.
struct ScoreRow {
    classes: Vec<f32>,
    objects: Vec<Vec<f32>>,
    quantities: Vec<Vec<f32>>,
    words: Vec<Vec<f32>>,
}

struct Chooser<'a> {
    prompt: &'a Prompt,
    rules: &'a QuantityRules,
    certainty: KeyCertainty,
}

impl Chooser<'_> {
    /// The best choice among those allowed, with its probability among all.
    fn choose(&mut self, what: &'static str, scores: &[f32], allowed: impl Fn(usize) -> bool) -> Option<usize> {
        let best = (0..scores.len()).filter(|idx| allowed(*idx)).max_by(|a, b| scores[*a].total_cmp(&scores[*b]))?;
        let top = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let sum: f64 = scores.iter().map(|score| f64::from(score - top).exp()).sum();
        self.certainty.choices.push((what, f64::from(scores[best] - top).exp() / sum));
        Some(best)
    }

    fn key(&mut self, row: &ScoreRow, before: &[KeyCode]) -> KeyCode {
        let mut key = KeyCode::default();
        let next = self.next(&row.classes, before);
        let is_first = before.is_empty();
        let mut offset = 0;
        for field_idx in 0..NUM_FIELDS {
            let field = Field::ALL[field_idx];
            let scores = &row.classes[offset..offset + field.num_classes()];
            offset += field.num_classes();
            if field == Field::Next {
                key.classes[field_idx] = Some(next);
            } else if field.applies(next, is_first) {
                let has_quantity = self.rules.is_time.iter().any(|is_time| !is_time);
                let has_object = !self.prompt.objects.is_empty();
                let allowed = |class: usize| match field {
                    Field::Amount => has_quantity || class != usize::from(AMOUNT_QUANTITY),
                    Field::Via => has_object || class == 0,
                    _ => true,
                };
                key.classes[field_idx] = self.choose(field.name(), scores, allowed).map(|class| class as u8);
            }
        }
        self.point(row, &mut key, is_first);
        key
    }

    fn next(&mut self, classes: &[f32], before: &[KeyCode]) -> u8 {
        let room = MAX_KEYS - before.len();
        let after_cut = before.last().is_some_and(|key| key.class(Field::Next) == NEXT_CUT);
        let must_move = before.is_empty() || after_cut;
        let allowed = |class: usize| match class as u8 {
            NEXT_SEGMENT => room >= 2,
            NEXT_CUT => room >= 3 && !must_move,
            _ => !must_move || room < 2,
        };
        let scores = &classes[..Field::Next.num_classes()];
        self.choose(Field::Next.name(), scores, allowed).map_or(NEXT_STOP, |class| class as u8)
    }

    /// Sets the pointers of a key whose classes are set.
    fn point(&mut self, row: &ScoreRow, key: &mut KeyCode, is_first: bool) {
        if !is_first {
            self.objects("end subjects", &row.objects, 0, false, key);
        }
        if key.class(Field::Next) != NEXT_SEGMENT {
            return;
        }
        self.objects("start subjects", &row.objects, PLACES, false, key);
        if key.class(Field::Via) > 0 {
            self.objects("objects on the way", &row.objects, 2 * PLACES, true, key);
        }
        if key.class(Field::Amount) == AMOUNT_QUANTITY {
            key.quantities[0] = self.quantity("amount", &row.quantities[0], false).map(|place| place as u8);
        }
        key.quantities[1] = self.quantity("duration", &row.quantities[1], true).map(|place| place as u8);
        key.span = self.words(&row.words);
    }

    /// Up to [`PLACES`] different objects; `needed`: at least one.
    fn objects(&mut self, what: &'static str, scores: &[Vec<f32>], first: usize, needed: bool, key: &mut KeyCode) {
        let named = self.prompt.num_named;
        let limit = if named > 0 { named } else { self.prompt.objects.len() };
        let mut taken: Vec<usize> = Vec::new();
        for rank in 0..PLACES {
            let must = needed && rank == 0 && limit > 0;
            let allowed = |place: usize| match place {
                0 => !must,
                place => place <= limit && !taken.contains(&place),
            };
            let place = self.choose(what, &scores[first + rank], allowed).unwrap_or(0);
            if place == 0 {
                break;
            }
            taken.push(place);
        }
        for rank in 0..PLACES {
            key.objects[first + rank] = Some(taken.get(rank).map_or(0, |place| *place as u8));
        }
    }

    /// A quantity that is a time, or that is none; for a time also nothing (0).
    fn quantity(&mut self, what: &'static str, scores: &[f32], time: bool) -> Option<usize> {
        let is_time = &self.rules.is_time;
        let allowed = |place: usize| match place.checked_sub(1) {
            None => time,
            Some(place) => is_time.get(place) == Some(&time),
        };
        self.choose(what, scores, allowed)
    }

    /// The likeliest first and last token with first <= last; never the token that begins the text.
    fn words(&mut self, scores: &[Vec<f32>]) -> Option<[usize; 2]> {
        let num_tokens = self.prompt.tokens.len();
        let mut best: Option<([usize; 2], f32)> = None;
        let mut first = 1;
        for last in 1..num_tokens {
            if scores[0][last] > scores[0][first] {
                first = last;
            }
            let score = scores[0][first] + scores[1][last];
            if best.is_none_or(|(_, top)| score > top) {
                best = Some(([first, last], score));
            }
        }
        best.map(|(span, _)| span)
    }
}

/// Poses of decoded keys, each from those before it.
fn poses(
    network: &Network,
    prompt: &Prompt,
    batch: &PromptBatch,
    memory: &Memory,
    keys: &[KeyCode],
) -> Result<Vec<PoseCode>> {
    let off = Dropout::off();
    let key_batch = KeyBatch::new(&[keys], &[prompt], batch)?;
    let states = network.states(Some(&key_batch), memory, &off)?.narrow(1, 0, keys.len())?.contiguous()?; // [1, keys, width]
    let anchors = anchor_places(keys);
    let mut poses: Vec<PoseCode> = Vec::with_capacity(keys.len());
    for (key_idx, place) in anchors.iter().enumerate() {
        let previous = previous_poses(&poses, keys.len());
        let previous = Tensor::from_vec(previous, (1, keys.len(), POSE_WIDTH + 1), &candle_core::Device::Cpu)?;
        let out = network.poses(&key_batch, &states, &previous, memory, &off)?;
        let out = out.narrow(1, key_idx, 1)?.flatten_all()?.to_vec1::<f32>()?;
        let anchor = place.and_then(|place| prompt.objects.get(place)).map(|object| object.center.as_vec3());
        poses.push(pose_code(&out, anchor.unwrap_or_default().to_array()));
    }
    Ok(poses)
}

/// For each key whether there is a pose before it, and that pose: `keys * (POSE_WIDTH + 1)`.
pub(crate) fn previous_poses(poses: &[PoseCode], num_keys: usize) -> Vec<f32> {
    let mut out = vec![0.0; num_keys * (POSE_WIDTH + 1)];
    for (pose, row) in poses.iter().zip(out.chunks_exact_mut(POSE_WIDTH + 1).skip(1)) {
        row[0] = 1.0;
        row[1..].copy_from_slice(&pose.to_array());
    }
    out
}

/// A pose from the numbers of the head, put where its anchor is; numbers beyond any sense are brought back.
fn pose_code(out: &[f32], anchor: [f32; 3]) -> PoseCode {
    let within = |value: f32, limit: f32| if value.is_finite() { value.clamp(-limit, limit) } else { 0.0 };
    PoseCode {
        position: std::array::from_fn(|axis| anchor[axis] + within(out[axis], 4.0)),
        rotation_6d: std::array::from_fn(|idx| within(out[3 + idx], 10.0)),
        log_fov: within(out[9], 2.0),
        log_wait: within(out[10], 5.0).max(0.0),
    }
}

/// Rotation to fall back to when the network's is degenerate: looking along -z of the frame, level.
pub(crate) fn level_rotation() -> DQuat {
    DQuat::from_rotation_x(std::f64::consts::PI)
}
