//! The part of the text encoder that is trained beforehand on texts of all kinds: BERT (Devlin et al. 2019).
//!
//! Enters: ids of word pieces, and the kinds of the quantities among them. Leaves: states that depend on the whole text.
//! Layers normalize after they add, attend in both directions and know positions by learned rows, as the weights of that
//! family expect.

use candle_core::{DType, Device, Result, Tensor};

use super::attention::Attention;
use super::config::BertConfig;
use super::dropout::Dropout;
use super::gelu::Gelu;
use super::layer_norm::LayerNorm;
use super::layers::{Linear, Visibility};
use super::parameters::{Parameters, Start};
use super::prompt_batch::{NUM_KINDS, PromptBatch};

/// Fresh embeddings. (A network that starts from BERT gets its.)
const START: Start = Start::Normal(0.5);

/// Embeddings and layers.
#[derive(Debug, Clone)]
pub(super) struct Bert {
    /// `[vocabulary, width]`
    table: Tensor,
    /// `[positions, width]`
    positions: Tensor,
    /// `[NUM_KINDS, width]`
    kinds: Tensor,
    norm: LayerNorm,
    layers: Vec<Layer>,
}

impl Bert {
    pub(super) fn new(parameters: &mut Parameters, config: &BertConfig, vocabulary: usize) -> Result<Self> {
        let width = config.width;
        Ok(Self {
            table: parameters.get("bert.table", &[vocabulary, width], START)?,
            positions: parameters.get("bert.positions", &[config.positions, width], START)?,
            kinds: parameters.get("bert.kinds", &[NUM_KINDS, width], START)?,
            norm: LayerNorm::new(parameters, "bert.norm", width)?,
            layers: (0..config.layers).map(|idx| Layer::new(parameters, config, idx)).collect::<Result<_>>()?,
        })
    }

    /// States of all tokens: `[batch, tokens, width]`.
    pub(super) fn apply(&self, batch: &PromptBatch, dropout: &Dropout) -> Result<Tensor> {
        let width = self.table.dim(1)?;
        let shape = (batch.size, batch.num_tokens, width);
        let pieces = self.table.index_select(&batch.ids, 0)?.reshape(shape)?; // [batch, tokens, width]
        let kinds = self.kinds.index_select(&batch.kinds, 0)?.reshape(shape)?; // [batch, tokens, width]
        let positions = self.positions.narrow(0, 0, batch.num_tokens)?; // [tokens, width]
        let mut states = dropout.apply(&self.norm.apply(&(pieces + kinds)?.broadcast_add(&positions)?)?)?;
        let all = Visibility { exists: batch.token_exists.clone(), causal: false };
        for layer in &self.layers {
            states = layer.apply(&states, &all, dropout)?;
        }
        Ok(states)
    }
}

/// Attention, then two linear layers; each is added to its input and the sum normalized.
#[derive(Debug, Clone)]
struct Layer {
    query: Linear,
    key_value: Linear,
    out: Linear,
    norm: LayerNorm,
    up: Linear,
    down: Linear,
    feed_norm: LayerNorm,
    heads: usize,
}

impl Layer {
    fn new(parameters: &mut Parameters, config: &BertConfig, idx: usize) -> Result<Self> {
        let (width, hidden) = (config.width, config.hidden);
        let name = |part: &str| format!("bert.{idx}.{part}");
        Ok(Self {
            query: Linear::biased(parameters, &name("query"), width, width)?,
            key_value: Linear::biased(parameters, &name("key_value"), width, 2 * width)?,
            out: Linear::biased(parameters, &name("out"), width, width)?,
            norm: LayerNorm::new(parameters, &name("norm"), width)?,
            up: Linear::biased(parameters, &name("up"), width, hidden)?,
            down: Linear::biased(parameters, &name("down"), hidden, width)?,
            feed_norm: LayerNorm::new(parameters, &name("feed_norm"), width)?,
            heads: config.heads,
        })
    }

    fn apply(&self, x: &Tensor, visible: &Visibility, dropout: &Dropout) -> Result<Tensor> {
        let attention = Attention { heads: self.heads, exists: visible.exists.clone(), causal: visible.causal };
        let bias = Tensor::zeros((self.heads, 1), DType::F32, &Device::Cpu)?;
        let attended = attention.apply(&self.query.apply(x)?, &self.key_value.apply(x)?, &bias)?;
        let x = self.norm.apply(&x.add(&dropout.apply(&self.out.apply(&attended)?)?)?)?;
        let fed = self.down.apply(&Gelu.apply(&self.up.apply(&x)?)?)?;
        self.feed_norm.apply(&x.add(&dropout.apply(&fed)?)?)
    }
}
