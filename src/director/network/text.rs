//! The text encoder: tokens to states that depend on the whole text.

use candle_core::{DType, Device, Result, Tensor};

use super::bert::Bert;
use super::config::ModelConfig;
use super::dropout::Dropout;
use super::layers::{AttentionLayer, FeedForward, Linear, Norm, Visibility};
use super::matrix_product::matrix_product;
use super::parameters::{Parameters, Start};
use super::prompt_batch::{NUM_KINDS, PromptBatch};

/// Embeddings and bidirectional layers.
#[derive(Debug, Clone)]
pub(super) struct TextEncoder {
    /// `[vocabulary, width]`, or `[special tokens + 1, width]` with BERT, whose word pieces share the last row. The object
    /// encoder uses the rows of the object slots too.
    table: Tensor,
    /// Understands word pieces, if the network was trained on top of one; then its states enter the layers.
    bert: Option<(Bert, Linear)>,
    /// `[NUM_KINDS, width]`
    kinds: Tensor,
    value: Linear,
    /// `[senses, width]`, if the network knows senses.
    senses: Option<Tensor>,
    layers: Vec<(AttentionLayer, FeedForward)>,
    norm: Norm,
}

impl TextEncoder {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let (width, heads) = (config.width, config.heads);
        let layer = |idx: usize, parameters: &mut Parameters| {
            Ok((
                AttentionLayer::over_sequence(parameters, &format!("text.{idx}.attention"), width, heads)?,
                FeedForward::new(parameters, &format!("text.{idx}.feed"), width, config.hidden)?,
            ))
        };
        Ok(Self {
            table: parameters.get("text.table", &[config.table_rows(), width], Start::Normal(0.5))?,
            bert: match &config.bert {
                None => None,
                Some(bert) => Some((
                    Bert::new(parameters, bert, config.vocabulary)?,
                    Linear::new(parameters, "text.from_bert", bert.width, width)?,
                )),
            },
            kinds: parameters.get("text.kinds", &[NUM_KINDS, width], Start::Normal(0.5))?,
            value: Linear::new(parameters, "text.value", 1, width)?,
            senses: match config.senses {
                0 => None,
                num => Some(parameters.get("text.senses", &[num, width], Start::Constant(0.0))?),
            },
            layers: (0..config.text_layers).map(|idx| layer(idx, parameters)).collect::<Result<_>>()?,
            norm: Norm::new(parameters, "text.norm", width)?,
        })
    }

    /// Rows of the embedding table, `[ids, width]`. All ids are below the size of the vocabulary: `Vocabulary::encode`
    /// checks them.
    pub(super) fn rows(&self, ids: &Tensor) -> Result<Tensor> {
        self.table.index_select(ids, 0)
    }

    /// States of all tokens in BERT, if there is one: `[batch, tokens, width of BERT]`.
    pub(super) fn bert_states(&self, batch: &PromptBatch) -> Result<Option<Tensor>> {
        self.bert.as_ref().map(|(bert, _)| bert.apply(batch, &Dropout::off())).transpose()
    }

    /// States of all tokens: `[batch, tokens, width]`.
    pub(super) fn apply(&self, batch: &PromptBatch, dropout: &Dropout) -> Result<Tensor> {
        let width = self.table.dim(1)?;
        let shape = (batch.size, batch.num_tokens, width);
        let words = self.rows(&batch.table_ids)?.reshape(shape)?; // [batch, tokens, width]
        let kinds = self.kinds.index_select(&batch.kinds, 0)?.reshape(shape)?; // [batch, tokens, width]
        let values = self.value.apply(&batch.values)?;
        let mut inputs = ((words + kinds)? + values)?;
        if let Some((bert, from_bert)) = &self.bert {
            inputs = (inputs + from_bert.apply(&bert.apply(batch, dropout)?)?)?;
        }
        if let Some(senses) = &self.senses {
            inputs = (inputs + matrix_product(&batch.senses, senses)?.reshape(shape)?)?;
        }
        let mut states = inputs.broadcast_add(&positions(batch.num_tokens, width)?)?;
        let all = Visibility { exists: batch.token_exists.clone(), causal: false };
        for (attention, feed) in &self.layers {
            states = feed.apply(&attention.apply(&states, None, &all, dropout)?, dropout)?;
        }
        self.norm.apply(&states)
    }
}

/// Position encoding of the tokens, `[tokens, width]`: sines and cosines of wavelengths from 2 pi to 2000 pi tokens, times
/// 0.3 (Vaswani et al. 2017).
fn positions(num_tokens: usize, width: usize) -> Result<Tensor> {
    let value = |at: usize, feature: usize| {
        let angle = at as f32 / 1000_f32.powf((feature / 2 * 2) as f32 / width as f32);
        if feature.is_multiple_of(2) { angle.sin() } else { angle.cos() }
    };
    let values: Vec<f32> =
        (0..num_tokens).flat_map(|at| (0..width).map(move |feature| 0.3 * value(at, feature))).collect();
    Tensor::from_vec(values, (num_tokens, width), &Device::Cpu)?.to_dtype(DType::F32)
}
