//! Keys out of the network, one by one: what it finds likeliest, unless that leaves some of the words out.
//!
//! Every object and every quantity that the prompt names has to be used by a step that speaks of it, and every word for a
//! move has to be among the words of a step. Where the likeliest keys leave one out (the middle one of three clauses, say),
//! a beam search weighs their likelihood against that of keys that leave out less. The same input gives the same keys.

use candle_core::{Result, Tensor};
use glam::DQuat;

use super::choices::{ChosenKey, KeyCertainty, ScoreRow, WordRules, alternatives, likeliest};
use super::codes::{Field, KeyCode, NEXT_STOP};
use super::coverage::left_out;
use super::keys::MAX_KEYS;
use super::model::{Dropout, KeyBatch, Memory, Network, POSE_WIDTH, PoseCode, Prompt, PromptBatch, anchor_places};

/// Sequences of keys that the search follows at once.
const BEAM: usize = 6;
/// Second-best choices of a key that it tries.
const TWISTS: usize = 5;
/// What leaving out the mention of an object or of a quantity costs, as the logarithm of a likelihood.
const MENTION_COST: f64 = 4.0;
/// What leaving out a word for a move costs; a step may also have two such words, or be told in too few words.
const MOVE_COST: f64 = 2.0;

/// What the network makes of a prompt.
#[derive(Debug, Clone, Default)]
pub struct Decoded {
    pub keys: Vec<KeyCode>,
    pub certainties: Vec<KeyCertainty>,
    /// One a key.
    pub poses: Vec<PoseCode>,
    /// Place of the film's length among the quantities.
    pub film: Option<usize>,
}

impl Decoded {
    fn is_whole(&self) -> bool {
        self.keys.last().is_some_and(|key| key.class(Field::Next) == NEXT_STOP) || self.keys.len() >= MAX_KEYS
    }

    fn take(&mut self, chosen: ChosenKey) {
        if self.keys.is_empty() {
            self.film = chosen.film;
        }
        self.keys.push(chosen.key);
        self.certainties.push(chosen.certainty);
    }
}

/// What is needed to score keys.
struct Reading<'a> {
    network: &'a Network,
    prompt: &'a Prompt,
    batch: &'a PromptBatch,
    rules: &'a WordRules,
    memory: Memory,
}

/// Decodes one prompt.
pub fn decode(network: &Network, prompt: &Prompt, batch: &PromptBatch, rules: &WordRules) -> Result<Decoded> {
    let memory = network.remember(batch, &Dropout::off())?;
    let reading = Reading { network, prompt, batch, rules, memory };
    let mut decoded = reading.likeliest()?;
    if reading.cost(&decoded) > 0.0 {
        decoded = reading.search()?;
    }
    decoded.poses = poses(network, prompt, batch, &reading.memory, &decoded.keys)?;
    Ok(decoded)
}

impl Reading<'_> {
    /// Scores of the key after those `before`.
    fn scores(&self, before: &[KeyCode]) -> Result<ScoreRow> {
        let off = Dropout::off();
        let keys = match before {
            [] => None,
            _ => Some(KeyBatch::new(&[before], &[self.prompt], self.batch)?),
        };
        let states = self.network.states(keys.as_ref(), &self.memory, &off)?;
        let last = states.narrow(1, before.len(), 1)?.contiguous()?; // [1, 1, width]
        ScoreRow::of(&self.network.scores(&last, &self.memory, self.batch)?)
    }

    /// The likeliest key each time.
    fn likeliest(&self) -> Result<Decoded> {
        let mut decoded = Decoded::default();
        while !decoded.is_whole() {
            let row = self.scores(&decoded.keys)?;
            let chosen = likeliest(self.prompt, self.rules, &row, &decoded.keys);
            decoded.take(chosen);
        }
        Ok(decoded)
    }

    /// The sequence of the best likelihood less the cost of what it leaves out.
    fn search(&self) -> Result<Decoded> {
        let mut beam = vec![(Decoded::default(), 0.0_f64)];
        while beam.iter().any(|(decoded, _)| !decoded.is_whole()) {
            let mut grown = Vec::new();
            for (decoded, likelihood) in beam {
                if decoded.is_whole() {
                    grown.push((decoded, likelihood));
                    continue;
                }
                let row = self.scores(&decoded.keys)?;
                for chosen in alternatives(self.prompt, self.rules, &row, &decoded.keys, TWISTS) {
                    let mut longer = decoded.clone();
                    let likelihood = likelihood + chosen.log_likelihood;
                    longer.take(chosen);
                    grown.push((longer, likelihood));
                }
            }
            grown.sort_by(|a, b| self.worth(b).total_cmp(&self.worth(a)));
            grown.truncate(BEAM);
            beam = grown;
        }
        Ok(beam.into_iter().next().map(|(decoded, _)| decoded).unwrap_or_default())
    }

    fn worth(&self, (decoded, likelihood): &(Decoded, f64)) -> f64 {
        likelihood - self.cost(decoded)
    }

    /// What the words cost that the keys leave out.
    fn cost(&self, decoded: &Decoded) -> f64 {
        let left_out = left_out(self.prompt, &self.rules.is_move, &decoded.keys, decoded.film);
        MENTION_COST * left_out.mentions as f64 + MOVE_COST * left_out.moves as f64
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
pub fn previous_poses(poses: &[PoseCode], num_keys: usize) -> Vec<f32> {
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
pub fn level_rotation() -> DQuat {
    DQuat::from_rotation_x(std::f64::consts::PI)
}
