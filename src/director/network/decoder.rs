//! The causal decoders: one for the intents of keys, one for their poses.
//!
//! The intent of a key (its classes, objects, quantities and words) depends on the text, the objects and the intents of
//! the keys before it. Its pose depends on the intents up to its own and on the poses before it. Poses never influence
//! intents, so that the words alone decide the program.

use std::sync::Arc;

use candle_core::{Result, Tensor};

use super::config::ModelConfig;
use super::dropout::Dropout;
use super::key_batch::{ANCHOR_WIDTH, KeyBatch};
use super::layers::{AttentionLayer, FeedForward, Linear, Norm, Visibility};
use super::matrix_product::matrix_product;
use super::parameters::{Parameters, Start};
use crate::codes::{Field, POSE_WIDTH};
use crate::keys::MAX_KEYS;

/// Encoded prompts, which the decoders attend to.
#[derive(Debug, Clone)]
pub struct Memory {
    /// States of the text tokens: `[batch, tokens, width]`
    pub(super) text: Tensor,
    /// One vector per object: `[batch, objects, width]`
    pub(super) objects: Tensor,
    /// Text and object tokens together: `[batch, tokens + objects * queries, width]`
    pub(super) all: Tensor,
    /// `[batch * (tokens + objects * queries)]`
    pub(super) all_exists: Arc<[bool]>,
    /// Object tokens alone: `[batch, objects * queries, width]`
    pub(super) object_tokens: Tensor,
    /// `[batch * objects * queries]`
    pub(super) object_tokens_exist: Arc<[bool]>,
}

/// Embedding of keys.
#[derive(Debug, Clone)]
struct KeyEmbedding {
    classes: Linear,
    objects: Linear,
    words: Linear,
}

impl KeyEmbedding {
    fn new(parameters: &mut Parameters, name: &str, width: usize) -> Result<Self> {
        Ok(Self {
            classes: Linear::new(parameters, &format!("{name}.classes"), Field::total_classes(), width)?,
            objects: Linear::new(parameters, &format!("{name}.objects"), 3 * width, width)?,
            words: Linear::new(parameters, &format!("{name}.words"), 2 * width, width)?,
        })
    }

    /// Embeddings of keys: `[batch, keys, width]`
    fn apply(&self, keys: &KeyBatch, memory: &Memory) -> Result<Tensor> {
        let [arrive, depart, way] = &keys.objects;
        let attended = [arrive, depart, way].map(|weights| matrix_product(weights, &memory.objects));
        let [arrive, depart, way] = attended;
        let objects = Tensor::cat(&[arrive?, depart?, way?], 2)?; // [batch, keys, 3 width]
        let (words, last) =
            (matrix_product(&keys.words, &memory.text)?, matrix_product(&keys.last_word, &memory.text)?);
        let words = Tensor::cat(&[words, last], 2)?; // [batch, keys, 2 width]
        let sum = (self.classes.apply(&keys.classes)? + self.objects.apply(&objects)?)?;
        sum + self.words.apply(&words)?
    }
}

#[derive(Debug, Clone)]
struct Layer {
    self_attention: AttentionLayer,
    cross_attention: AttentionLayer,
    feed: FeedForward,
}

impl Layer {
    fn stack(parameters: &mut Parameters, name: &str, num: usize, config: &ModelConfig) -> Result<Vec<Self>> {
        let (width, heads) = (config.width, config.heads);
        let layer = |idx: usize| {
            Ok(Self {
                self_attention: AttentionLayer::over_sequence(
                    parameters,
                    &format!("{name}.{idx}.among"),
                    width,
                    heads,
                )?,
                cross_attention: AttentionLayer::over_memory(
                    parameters,
                    &format!("{name}.{idx}.memory"),
                    width,
                    heads,
                )?,
                feed: FeedForward::new(parameters, &format!("{name}.{idx}.feed"), width, config.hidden)?,
            })
        };
        (0..num).map(layer).collect()
    }
}

/// Runs layers over the states of keys; `visible` is for the keys, then for the memory.
fn run(
    layers: &[Layer],
    states: Tensor,
    visible: [&Visibility; 2],
    memory: &Tensor,
    dropout: &Dropout,
) -> Result<Tensor> {
    let mut states = states;
    for layer in layers {
        states = layer.self_attention.apply(&states, None, visible[0], dropout)?;
        states = layer.cross_attention.apply(&states, Some(memory), visible[1], dropout)?;
        states = layer.feed.apply(&states, dropout)?;
    }
    Ok(states)
}

/// The intent decoder.
#[derive(Debug, Clone)]
pub(super) struct IntentDecoder {
    /// Embedding in front of the first key: `[width]`
    begin: Tensor,
    /// Embedding of each position: `[MAX_KEYS + 1, width]`
    positions: Tensor,
    embedding: KeyEmbedding,
    layers: Vec<Layer>,
    norm: Norm,
}

impl IntentDecoder {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let width = config.width;
        Ok(Self {
            begin: parameters.get("intent.begin", &[width], Start::Normal(0.5))?,
            positions: parameters.get("intent.places", &[MAX_KEYS + 1, width], Start::Normal(0.2))?,
            embedding: KeyEmbedding::new(parameters, "intent.key", width)?,
            layers: Layer::stack(parameters, "intent", config.intent_layers, config)?,
            norm: Norm::new(parameters, "intent.norm", width)?,
        })
    }

    /// States that predict key 0, 1, .. from the keys before it: `[batch, keys + 1, width]`. The last state predicts the
    /// key after the given ones.
    pub(super) fn apply(&self, keys: Option<&KeyBatch>, memory: &Memory, dropout: &Dropout) -> Result<Tensor> {
        let (batch, _, width) = memory.text.dims3()?;
        let begin = self.begin.reshape((1, 1, width))?.broadcast_as((batch, 1, width))?; // [batch, 1, width]
        let states = match keys {
            Some(keys) => Tensor::cat(&[begin, self.embedding.apply(keys, memory)?], 1)?,
            None => begin.contiguous()?,
        };
        let num_states = states.dim(1)?;
        let states = states.broadcast_add(&self.positions.narrow(0, 0, num_states)?)?;
        let before = Visibility { exists: vec![true; batch * num_states].into(), causal: true };
        let all = Visibility { exists: memory.all_exists.clone(), causal: false };
        self.norm.apply(&run(&self.layers, states, [&before, &all], &memory.all, dropout)?)
    }
}

/// The pose decoder.
#[derive(Debug, Clone)]
pub(super) struct PoseDecoder {
    embedding: KeyEmbedding,
    state: Linear,
    previous: Linear,
    anchor: Linear,
    layers: Vec<Layer>,
    norm: Norm,
    out: Linear,
}

impl PoseDecoder {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let width = config.width;
        Ok(Self {
            embedding: KeyEmbedding::new(parameters, "pose.key", width)?,
            state: Linear::new(parameters, "pose.state", width, width)?,
            // One more value: 1 if there is a pose before, else 0.
            previous: Linear::new(parameters, "pose.previous", POSE_WIDTH + 1, width)?,
            anchor: Linear::new(parameters, "pose.anchor", ANCHOR_WIDTH, width)?,
            layers: Layer::stack(parameters, "pose", config.pose_layers, config)?,
            norm: Norm::new(parameters, "pose.norm", width)?,
            out: Linear::biased(parameters, "pose.out", width, POSE_WIDTH)?,
        })
    }

    /// Poses of the keys with positions relative to the anchor: `[batch, keys, POSE_WIDTH]`. `states` are those that
    /// predicted the keys, `[batch, keys, width]`; `previous` are the poses before, `[batch, keys, POSE_WIDTH + 1]`.
    pub(super) fn apply(
        &self,
        keys: &KeyBatch,
        states: &Tensor,
        previous: &Tensor,
        memory: &Memory,
        dropout: &Dropout,
    ) -> Result<Tensor> {
        let intents = (self.embedding.apply(keys, memory)? + self.state.apply(states)?)?;
        let around = (self.previous.apply(previous)? + self.anchor.apply(&keys.anchors)?)?;
        let before = Visibility { exists: keys.key_exists.clone(), causal: true };
        let objects = Visibility { exists: memory.object_tokens_exist.clone(), causal: false };
        let states = run(&self.layers, (intents + around)?, [&before, &objects], &memory.object_tokens, dropout)?;
        self.out.apply(&self.norm.apply(&states)?)
    }
}
