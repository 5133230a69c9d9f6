//! The network: text encoder, Q-former, causal decoders, heads.
//!
//! The text encoder may begin with BERT, whose weights were trained beforehand on texts of all kinds: people use more words
//! than any corpus of camera moves has.
//!
//! Enters: a batch of prompts with their objects in the scene's frame, and the keys so far. Leaves: scores of every choice
//! of the next keys, and poses. All arithmetic is in `f32` on the CPU. Batches are padded; padding does not change a result.

mod attention;
mod bert;
mod bias;
mod config;
mod decoder;
mod dropout;
mod exp;
mod gelu;
mod heads;
mod key_batch;
mod layer_norm;
mod layers;
mod matrix_product;
mod norm;
mod objects;
mod padding;
mod parameters;
mod product;
mod prompt_batch;
mod slices;
mod text;

pub use config::{BertConfig, ModelConfig};
pub use decoder::Memory;
pub use dropout::Dropout;
pub use heads::Scores;
pub use key_batch::{KeyBatch, anchor_objects};
pub(crate) use layers::{AttentionLayer, FeedForward, Linear, Norm, Visibility};
pub(crate) use matrix_product::matrix_product;
pub use parameters::Parameters;
pub(crate) use parameters::Start;
pub use prompt_batch::PromptBatch;

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
    /// Builds the network from fresh or stored parameters. The parameters are taken in a fixed order, so that one seed
    /// always gives the same network.
    ///
    /// # Errors
    /// A candle error when a stored parameter is missing or has another shape.
    pub fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        Ok(Self {
            text: text::TextEncoder::new(parameters, config)?,
            objects: objects::ObjectEncoder::new(parameters, config)?,
            intent: decoder::IntentDecoder::new(parameters, config)?,
            pose: decoder::PoseDecoder::new(parameters, config)?,
            heads: heads::Heads::new(parameters, config)?,
        })
    }

    /// Encodes prompts and objects for the decoders.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn encode(&self, batch: &PromptBatch, dropout: &Dropout) -> Result<Memory> {
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

    /// States of all tokens in BERT, before the other layers of the text encoder, `[batch, tokens, width of BERT]`; `None` for
    /// a network without one.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn bert_states(&self, batch: &PromptBatch) -> Result<Option<Tensor>> {
        self.text.bert_states(batch)
    }

    /// States that predict each key and the one after the last, each from the keys before it: `[batch, keys + 1, width]`.
    /// `None` stands for no keys.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn states(&self, keys: Option<&KeyBatch>, memory: &Memory, dropout: &Dropout) -> Result<Tensor> {
        self.intent.apply(keys, memory, dropout)
    }

    /// Scores of the keys that `states` (`[batch, keys, width]`) predict.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn scores(&self, states: &Tensor, memory: &Memory, batch: &PromptBatch) -> Result<Scores> {
        self.heads.apply(states, memory, batch)
    }

    /// Per token, scores of "the notation can say it" and "it cannot": `[batch, tokens, 2]`
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn unmet(&self, memory: &Memory) -> Result<Tensor> {
        self.heads.unmet(memory)
    }

    /// Poses of keys, `[batch, keys, POSE_WIDTH]`; positions are relative to the anchor. `states` are those that predicted
    /// the keys, `[batch, keys, width]`; `previous` are the rows of
    /// [`previous_poses`](crate::codes::previous_poses), `[batch, keys, POSE_WIDTH + 1]`.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
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
