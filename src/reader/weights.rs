//! A quantized language model: tokens to scores of the next token.
//!
//! Enters: a checked GGUF file. Leaves: one score per token of the vocabulary. The network is candle's.

use std::fs::File;
use std::path::Path;

use candle_core::quantized::gguf_file::{Content, Value};
use candle_core::{Device, Tensor};
use candle_transformers::models::{quantized_llama, quantized_qwen2};

use crate::error::ReaderError;
use crate::shape::{Family, Shape};

/// Most tokens of prompt and answer together: candle's table of rotations for `llama` has this length.
pub(crate) const MAX_TOKENS: usize = quantized_llama::MAX_SEQ_LEN;
/// Tokens of a prompt that pass the network at once. Memory for attention grows with it times the tokens before.
const CHUNK: usize = 256;

/// A loaded network, with the tokens that it has seen since the last start.
pub(crate) struct Weights {
    network: Network,
    num_seen: usize,
}

enum Network {
    Qwen2(quantized_qwen2::ModelWeights),
    Llama(quantized_llama::ModelWeights),
}

impl Weights {
    /// Loads the network of a file whose header and [`Shape`] are checked.
    ///
    /// # Errors
    /// [`ReaderError::BadModel`] when candle refuses the file.
    pub(crate) fn load(path: &Path, file: &mut File, mut content: Content, shape: &Shape) -> Result<Self, ReaderError> {
        let bad = |error: candle_core::Error| {
            ReaderError::bad_model(
                path,
                "the network",
                &format!("damaged: {error}"),
                &format!("one of the family {}", shape.family.name()),
            )
        };
        // candle makes tables of the whole context, which may be a million tokens long.
        let max_tokens = shape.max_tokens.min(MAX_TOKENS) as u32;
        let key = format!("{}.context_length", shape.family.name());
        content.metadata.insert(key, Value::U32(max_tokens));
        let network = match shape.family {
            Family::Qwen2 => quantized_qwen2::ModelWeights::from_gguf(content, file, &Device::Cpu).map(Network::Qwen2),
            Family::Llama => quantized_llama::ModelWeights::from_gguf(content, file, &Device::Cpu).map(Network::Llama),
        };
        Ok(Self { network: network.map_err(bad)?, num_seen: 0 })
    }

    /// Forgets all tokens and reads a prompt. Returns the scores of the token after it.
    ///
    /// # Errors
    /// [`ReaderError::Compute`] when a tensor operation fails.
    pub(crate) fn begin(&mut self, prompt: &[u32]) -> Result<Vec<f32>, ReaderError> {
        self.num_seen = 0;
        let mut scores = Vec::new();
        for chunk in prompt.chunks(CHUNK) {
            scores = self.push(chunk)?;
        }
        Ok(scores)
    }

    /// Reads more tokens. Returns the scores of the token after them.
    ///
    /// # Errors
    /// [`ReaderError::Compute`] when a tensor operation fails.
    pub(crate) fn push(&mut self, tokens: &[u32]) -> Result<Vec<f32>, ReaderError> {
        let scores = self.forward(tokens).map_err(|error| ReaderError::compute(&error))?;
        self.num_seen += tokens.len();
        Ok(scores)
    }

    fn forward(&mut self, tokens: &[u32]) -> candle_core::Result<Vec<f32>> {
        let input = Tensor::new(tokens, &Device::Cpu)?.unsqueeze(0)?; // [1, token]
        let scores = match &mut self.network {
            Network::Qwen2(network) => network.forward(&input, self.num_seen)?,
            Network::Llama(network) => network.forward(&input, self.num_seen)?,
        };
        scores.squeeze(0)?.to_vec1() // [vocabulary]
    }
}
