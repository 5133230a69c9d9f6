//! One layer of the network: attention among all tokens, then a feed-forward part on each.

use candle_core::{Result, Tensor};
use candle_nn::{LayerNorm, Linear, Module, ops};

use crate::config::Config;
use crate::error::VisionError;
use crate::tensors::Tensors;

/// One layer. Both parts see normalized tokens, and are scaled by channel before they are added.
pub(crate) struct Layer {
    attention_norm: LayerNorm,
    query: Linear,
    key: Linear,
    value: Linear,
    out: Linear,
    /// `[width]`
    attention_scale: Tensor,
    feed_norm: LayerNorm,
    up: Linear,
    down: Linear,
    /// `[width]`
    feed_scale: Tensor,
    num_heads: usize,
}

impl Layer {
    /// The layer of an index.
    ///
    /// # Errors
    /// Those of [`Tensors::get`].
    pub(crate) fn load(tensors: &Tensors, config: &Config, idx: usize) -> std::result::Result<Self, VisionError> {
        let (width, inner, epsilon) = (config.width, config.inner_width, config.norm_epsilon);
        let name = |part: &str| format!("encoder.layer.{idx}.{part}");
        let attention = |part: &str| {
            tensors.linear(&name(&format!("attention.attention.{part}")), [width, width], config.has_biases)
        };
        Ok(Self {
            attention_norm: tensors.norm(&name("norm1"), width, epsilon)?,
            query: attention("query")?,
            key: attention("key")?,
            value: attention("value")?,
            out: tensors.linear(&name("attention.output.dense"), [width, width], true)?,
            attention_scale: tensors.get(&name("layer_scale1.lambda1"), &[width])?,
            feed_norm: tensors.norm(&name("norm2"), width, epsilon)?,
            up: tensors.linear(&name("mlp.fc1"), [inner, width], true)?,
            down: tensors.linear(&name("mlp.fc2"), [width, inner], true)?,
            feed_scale: tensors.get(&name("layer_scale2.lambda1"), &[width])?,
            num_heads: config.num_heads,
        })
    }

    /// The tokens after the layer: `[tokens, width]`.
    pub(crate) fn apply(&self, tokens: &Tensor) -> Result<Tensor> {
        let attended = self.attend(&self.attention_norm.forward(tokens)?)?;
        let tokens = (tokens + attended.broadcast_mul(&self.attention_scale)?)?;
        let fed = self.down.forward(&self.up.forward(&self.feed_norm.forward(&tokens)?)?.gelu_erf()?)?;
        tokens + fed.broadcast_mul(&self.feed_scale)?
    }

    /// `softmax(Q K^T / sqrt(d)) V` for each head (Vaswani et al. 2017).
    fn attend(&self, tokens: &Tensor) -> Result<Tensor> {
        let (num_tokens, width) = tokens.dims2()?;
        let head_width = width / self.num_heads;
        let heads = |linear: &Linear| {
            let split = linear.forward(tokens)?.reshape((num_tokens, self.num_heads, head_width))?; // [token, head, channel]
            split.transpose(0, 1)?.contiguous() // [head, token, channel]
        };
        let (query, key, value) = (heads(&self.query)?, heads(&self.key)?, heads(&self.value)?);
        let scores = (query.matmul(&key.t()?)? * (head_width as f64).sqrt().recip())?; // [head, token, token]
        let mixed = ops::softmax_last_dim(&scores)?.matmul(&value)?; // [head, token, channel]
        self.out.forward(&mixed.transpose(0, 1)?.reshape((num_tokens, width))?) // [token, width]
    }
}
