//! The network: text encoder, Q-former, causal decoders, heads.
//!
//! Enters: a batch of prompts with their objects in the scene's frame, and the keys before. Leaves: scores of every
//! choice that the next keys make, and poses. All computing is in `f32`; batches are padded, and padding changes nothing.

mod attention;
mod batch;
mod config;
mod decoder;
mod heads;
mod layers;
mod norm;
mod objects;
mod parameters;
mod slices;
mod text;

pub use batch::{KeyBatch, ObjectInput, POSE_WIDTH, PoseCode, Prompt, PromptBatch, TokenInput, anchor_places};
pub use config::ModelConfig;
pub use decoder::Memory;
pub use heads::Scores;
pub use layers::Dropout;
pub use parameters::Parameters;

use candle_core::{Result, Tensor};

/// The whole network.
#[derive(Debug, Clone)]
pub struct Network {
    text: text::TextEncoder,
    objects: objects::ObjectEncoder,
    intent: decoder::IntentDecoder,
    pose: decoder::PoseDecoder,
    heads: heads::Heads,
}

impl Network {
    /// Puts the network together from fresh or stored parameters.
    pub fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        Ok(Self {
            text: text::TextEncoder::new(parameters, config)?,
            objects: objects::ObjectEncoder::new(parameters, config)?,
            intent: decoder::IntentDecoder::new(parameters, config)?,
            pose: decoder::PoseDecoder::new(parameters, config)?,
            heads: heads::Heads::new(parameters, config)?,
        })
    }

    /// Reads prompts and objects.
    pub fn remember(&self, batch: &PromptBatch, dropout: &Dropout) -> Result<Memory> {
        let text = self.text.apply(batch, dropout)?; // [batch, tokens, width]
        let slots = self.text.rows(&batch.slots)?; // [batch * objects, width]
        let tokens = self.objects.apply(batch, &slots, dropout)?; // [batch * objects, queries, width]
        let (_, num_queries, width) = tokens.dims3()?;
        let objects = tokens.mean(1)?.reshape((batch.size, batch.num_objects, width))?; // [batch, objects, width]
        let tokens = tokens.reshape((batch.size, batch.num_objects * num_queries, width))?; // [batch, objects * queries, width]
        let object_tokens_exist: Vec<bool> =
            batch.object_exists.iter().flat_map(|exists| std::iter::repeat_n(*exists, num_queries)).collect();
        let all_exists = batch
            .token_exists
            .chunks_exact(batch.num_tokens)
            .zip(object_tokens_exist.chunks_exact(batch.num_objects * num_queries))
            .flat_map(|(text, objects)| [text, objects].concat())
            .collect();
        Ok(Memory {
            all: Tensor::cat(&[&text, &tokens], 1)?,
            all_exists,
            text,
            objects,
            object_tokens: tokens,
            object_tokens_exist: object_tokens_exist.into(),
        })
    }

    /// States that predict the keys and the one after them: `[batch, keys + 1, width]`.
    pub fn states(&self, keys: Option<&KeyBatch>, memory: &Memory, dropout: &Dropout) -> Result<Tensor> {
        self.intent.apply(keys, memory, dropout)
    }

    /// Scores of the keys that states predict.
    pub fn scores(&self, states: &Tensor, memory: &Memory, batch: &PromptBatch) -> Result<Scores> {
        self.heads.apply(states, memory, batch)
    }

    /// Poses of keys from the states that predicted them and the poses before: `[batch, keys, POSE_WIDTH]`.
    pub fn poses(
        &self,
        keys: &KeyBatch,
        states: &Tensor,
        previous: &Tensor,
        memory: &Memory,
        dropout: &Dropout,
    ) -> Result<Tensor> {
        self.pose.apply(keys, states, previous, memory, dropout)
    }
}
