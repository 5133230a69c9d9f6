//! The keys and poses of a prompt, decoded one key at a time: greedily, then by beam search where greedy keys omit words.
//!
//! Every object and every quantity that the prompt mentions should be used by a step whose words mention it, and every word
//! that names a move should be in the span of a step. If the greedy keys omit one (such as the second of three clauses), a
//! beam search maximizes log-likelihood less a penalty per omission. The same input gives the same keys.

use candle_core::{Device, Tensor};

use super::coverage::omissions;
use super::key_choice::{ChosenKey, KeyCertainty, ScoreRow, WordRules, best_key, best_keys};
use crate::codes::{Field, KeyCode, NEXT_STOP, POSE_WIDTH, PoseCode, previous_poses};
use crate::error::DirectorError;
use crate::inputs::Prompt;
use crate::keys::MAX_KEYS;
use crate::network::{Dropout, KeyBatch, Memory, ModelConfig, Network, PromptBatch, anchor_objects};
use crate::tensor_file::{WEIGHTS_FILE, check_finite};

/// A result of the director.
type Result<T> = std::result::Result<T, DirectorError>;

/// Number of sequences that the beam holds.
const BEAM_WIDTH: usize = 6;
/// Alternatives to the most likely key that extend each sequence.
const MAX_ALTERNATIVES: usize = 5;
/// Penalty for an omitted mention of an object or of a quantity, in nats.
const MENTION_PENALTY: f64 = 4.0;
/// Penalty for an omitted word that names a move, in nats. It is lower: one step may have two such words, or a span that is
/// too short.
const MOVE_PENALTY: f64 = 2.0;

/// How much surer a reading with the unnamed objects must be than one without them, in nats.
const OTHERS_MARGIN: f64 = 1.0;

/// Keys and poses of a prompt.
#[derive(Debug, Clone, Default)]
pub(crate) struct DecodedPrompt {
    pub(crate) keys: Vec<KeyCode>,
    /// One per key.
    pub(crate) certainties: Vec<KeyCertainty>,
    /// One per key.
    pub(crate) poses: Vec<PoseCode>,
    /// Index of the quantity that is the length of the film.
    pub(crate) film_length: Option<usize>,
    /// For each token, whether the notation cannot say it.
    pub(crate) unmet: Vec<bool>,
}

impl DecodedPrompt {
    fn is_complete(&self) -> bool {
        self.keys.last().is_some_and(|key| key.class(Field::Next) == NEXT_STOP) || self.keys.len() >= MAX_KEYS
    }

    fn push(&mut self, chosen: ChosenKey) {
        if self.keys.is_empty() {
            self.film_length = chosen.film_length;
        }
        self.keys.push(chosen.key);
        self.certainties.push(chosen.certainty);
    }
}

/// A prompt that the network has encoded.
struct EncodedPrompt<'a> {
    network: &'a Network,
    prompt: &'a Prompt,
    batch: &'a PromptBatch,
    rules: &'a WordRules,
    memory: Memory,
}

/// Decodes one prompt: its keys from the words, as where things are does not change what a sentence asks for, then the
/// poses of the keys among the objects.
///
/// The words are read twice: with the named objects alone, and with the others beside them. The second reading counts
/// where it is surer by [`OTHERS_MARGIN`].
pub(crate) fn decode(
    (network, config): (&Network, &ModelConfig),
    prompt: &Prompt,
    rules: &WordRules,
) -> Result<DecodedPrompt> {
    let read = |num_objects| keys_of_words((network, config), &prompt.placeless(num_objects), rules);
    let (mut decoded, score) = read(prompt.num_named)?;
    if prompt.objects.len() > prompt.num_named {
        let (beside_others, other_score) = read(prompt.objects.len())?;
        if other_score > score + OTHERS_MARGIN {
            decoded = beside_others;
        }
    }
    let batch = PromptBatch::new(&[prompt], config)?;
    decoded.poses = EncodedPrompt::new(network, prompt, &batch, rules)?.poses(&decoded.keys)?;
    Ok(decoded)
}

/// The keys of a prompt, and their log-likelihood less the penalty for the words that they omit.
fn keys_of_words(
    (network, config): (&Network, &ModelConfig),
    words: &Prompt,
    rules: &WordRules,
) -> Result<(DecodedPrompt, f64)> {
    let batch = PromptBatch::new(&[words], config)?;
    let encoded = EncodedPrompt::new(network, words, &batch, rules)?;
    let mut decoded = encoded.greedy()?;
    if encoded.penalty(&decoded) > 0.0 {
        decoded = encoded.beam_search()?;
    }
    let unmet = network.unmet(&encoded.memory)?.squeeze(0)?.to_vec2::<f32>()?; // [tokens, 2]
    unmet.iter().try_for_each(|scores| check_finite(WEIGHTS_FILE, "scores of unmet words", scores))?;
    decoded.unmet = unmet.iter().map(|scores| matches!(scores[..], [said, unsaid] if unsaid > said)).collect();
    let choices = decoded.certainties.iter().flat_map(|certainty| &certainty.choices);
    let log_likelihood: f64 = choices.map(|(_, probability)| probability.max(1e-9).ln()).sum();
    let score = log_likelihood - encoded.penalty(&decoded);
    Ok((decoded, score))
}

impl<'a> EncodedPrompt<'a> {
    fn new(network: &'a Network, prompt: &'a Prompt, batch: &'a PromptBatch, rules: &'a WordRules) -> Result<Self> {
        let memory = network.encode(batch, &Dropout::off())?;
        Ok(Self { network, prompt, batch, rules, memory })
    }

    /// Scores of the key after the keys `before`.
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

    /// The most likely key at every step.
    fn greedy(&self) -> Result<DecodedPrompt> {
        let mut decoded = DecodedPrompt::default();
        while !decoded.is_complete() {
            let row = self.scores(&decoded.keys)?;
            decoded.push(best_key(self.prompt, self.rules, &row, &decoded.keys));
        }
        Ok(decoded)
    }

    /// The complete sequence of the highest score that the beam finds.
    fn beam_search(&self) -> Result<DecodedPrompt> {
        let mut beam = vec![(DecodedPrompt::default(), 0.0_f64)];
        while beam.iter().any(|(decoded, _)| !decoded.is_complete()) {
            let mut grown = Vec::new();
            for (decoded, log_likelihood) in beam {
                if decoded.is_complete() {
                    grown.push((decoded, log_likelihood));
                    continue;
                }
                let row = self.scores(&decoded.keys)?;
                for chosen in best_keys(self.prompt, self.rules, &row, &decoded.keys, MAX_ALTERNATIVES) {
                    let mut longer = decoded.clone();
                    let log_likelihood = log_likelihood + chosen.log_likelihood;
                    longer.push(chosen);
                    grown.push((longer, log_likelihood));
                }
            }
            grown.sort_by(|a, b| self.score(b).total_cmp(&self.score(a)));
            grown.truncate(BEAM_WIDTH);
            beam = grown;
        }
        Ok(beam.into_iter().next().map(|(decoded, _)| decoded).unwrap_or_default())
    }

    /// Log-likelihood less penalty.
    fn score(&self, (decoded, log_likelihood): &(DecodedPrompt, f64)) -> f64 {
        log_likelihood - self.penalty(decoded)
    }

    /// Penalty for the words that the keys omit.
    fn penalty(&self, decoded: &DecodedPrompt) -> f64 {
        let omissions = omissions(self.prompt, &self.rules.is_move, &decoded.keys, decoded.film_length);
        MENTION_PENALTY * omissions.mentions as f64 + MOVE_PENALTY * omissions.moves as f64
    }

    /// Poses of decoded keys, each from the poses before it.
    fn poses(&self, keys: &[KeyCode]) -> Result<Vec<PoseCode>> {
        let off = Dropout::off();
        let key_batch = KeyBatch::new(&[keys], &[self.prompt], self.batch)?;
        let states = self.network.states(Some(&key_batch), &self.memory, &off)?;
        let states = states.narrow(1, 0, keys.len())?.contiguous()?; // [1, keys, width]
        let mut poses: Vec<PoseCode> = Vec::with_capacity(keys.len());
        for (key_idx, anchor) in anchor_objects(keys).into_iter().enumerate() {
            let previous = previous_poses(&poses, keys.len());
            let previous = Tensor::from_vec(previous, (1, keys.len(), POSE_WIDTH + 1), &Device::Cpu)?; // [1, keys, POSE_WIDTH + 1]
            let out = self.network.poses(&key_batch, &states, &previous, &self.memory, &off)?;
            let out = out.narrow(1, key_idx, 1)?.flatten_all()?.to_vec1::<f32>()?;
            check_finite(WEIGHTS_FILE, "poses", &out)?;
            let anchor = anchor.and_then(|idx| self.prompt.objects.get(idx)).map(|object| object.center.as_vec3());
            poses.push(pose_code(&out, anchor.unwrap_or_default().to_array()));
        }
        Ok(poses)
    }
}

/// Pose of the pose head's output, whose position is relative to `anchor`. Values are clamped to a plausible range.
fn pose_code(out: &[f32], anchor: [f32; 3]) -> PoseCode {
    let within = |value: f32, limit: f32| value.clamp(-limit, limit);
    PoseCode {
        position: std::array::from_fn(|axis| anchor[axis] + within(out[axis], 4.0)),
        rotation_6d: std::array::from_fn(|idx| within(out[3 + idx], 10.0)),
        log_fov: within(out[9], 2.0),
        log_wait: within(out[10], 5.0).max(0.0),
    }
}
