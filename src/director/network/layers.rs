//! The layers that encoders and decoders are built from.

use std::sync::Arc;

use candle_core::{Device, Module, Result, Tensor};
use candle_nn::Activation;

use super::attention::Attention;
use super::bias::AddBias;
use super::dropout::Dropout;
use super::matrix_product::matrix_product;
use super::norm::RmsNorm;
use super::parameters::{Parameters, Start};

/// Largest distance between two tokens that has its own attention bias; larger distances share one.
const REACH: usize = 24;

/// `x W + b`.
#[derive(Debug, Clone)]
pub(crate) struct Linear {
    /// `[in, out]`
    weight: Tensor,
    /// `[out]`
    bias: Option<Tensor>,
}

impl Linear {
    /// Without a bias.
    pub(crate) fn new(parameters: &mut Parameters, name: &str, from: usize, to: usize) -> Result<Self> {
        Self::scaled(parameters, name, [from, to], 1.0)
    }

    /// Without a bias; the initial weights are `scale` times as large as usual.
    fn scaled(parameters: &mut Parameters, name: &str, shape: [usize; 2], scale: f32) -> Result<Self> {
        let start = Start::Normal(scale * (shape[0] as f32).sqrt().recip());
        Ok(Self { weight: parameters.get(&format!("{name}.weight"), &shape, start)?, bias: None })
    }

    /// With a bias, initially zero.
    pub(crate) fn biased(parameters: &mut Parameters, name: &str, from: usize, to: usize) -> Result<Self> {
        let bias = parameters.get(&format!("{name}.bias"), &[to], Start::Constant(0.0))?;
        Ok(Self { bias: Some(bias), ..Self::new(parameters, name, from, to)? })
    }

    /// Applies to the last dimension.
    pub(crate) fn apply(&self, input: &Tensor) -> Result<Tensor> {
        let mut shape = input.dims().to_vec();
        let (from, to) = self.weight.dims2()?;
        let rows = input.elem_count() / from;
        let flat = matrix_product(&input.reshape((rows, from))?, &self.weight)?; // [rows, out]
        let flat = match &self.bias {
            Some(bias) => AddBias.apply(&flat, bias)?,
            None => flat,
        };
        if let Some(last) = shape.last_mut() {
            *last = to;
        }
        flat.reshape(shape)
    }
}

/// Root-mean-square normalization with a learned gain.
#[derive(Debug, Clone)]
pub(crate) struct Norm {
    gain: Tensor,
}

impl Norm {
    pub(crate) fn new(parameters: &mut Parameters, name: &str, width: usize) -> Result<Self> {
        Ok(Self { gain: parameters.get(&format!("{name}.gain"), &[width], Start::Constant(1.0))? })
    }

    pub(crate) fn apply(&self, input: &Tensor) -> Result<Tensor> {
        RmsNorm.apply(input, &self.gain)
    }
}

/// Which keys a query may attend to.
#[derive(Debug, Clone)]
pub(crate) struct Visibility {
    /// Whether a key exists: `[batch * keys]`
    pub(crate) exists: Arc<[bool]>,
    /// Whether a query attends only to keys at its own position and before.
    pub(crate) causal: bool,
}

/// Attention with its normalization and residual connection.
#[derive(Debug, Clone)]
pub(crate) struct AttentionLayer {
    norm: Norm,
    query: Linear,
    key_value: Linear,
    out: Linear,
    /// `[heads, 2 * reach + 1]`
    bias: Tensor,
    heads: usize,
}

impl AttentionLayer {
    /// Self-attention over a sequence, with a learned bias per distance.
    pub(crate) fn over_sequence(parameters: &mut Parameters, name: &str, width: usize, heads: usize) -> Result<Self> {
        let bias = parameters.get(&format!("{name}.distance"), &[heads, 2 * REACH + 1], Start::Normal(0.1))?;
        Self::new(parameters, name, [width, heads], bias)
    }

    /// Cross-attention over a memory without order.
    pub(crate) fn over_memory(parameters: &mut Parameters, name: &str, width: usize, heads: usize) -> Result<Self> {
        let bias = Tensor::zeros((heads, 1), candle_core::DType::F32, &Device::Cpu)?;
        Self::new(parameters, name, [width, heads], bias)
    }

    fn new(parameters: &mut Parameters, name: &str, [width, heads]: [usize; 2], bias: Tensor) -> Result<Self> {
        Ok(Self {
            norm: Norm::new(parameters, &format!("{name}.norm"), width)?,
            query: Linear::new(parameters, &format!("{name}.query"), width, width)?,
            key_value: Linear::new(parameters, &format!("{name}.key_value"), width, 2 * width)?,
            out: Linear::scaled(parameters, &format!("{name}.out"), [width, width], 0.4)?,
            bias,
            heads,
        })
    }

    /// `x + attention(norm(x))`. Keys and values come from `memory`, or from `norm(x)` without one.
    pub(crate) fn apply(
        &self,
        x: &Tensor,
        memory: Option<&Tensor>,
        visible: &Visibility,
        dropout: &Dropout,
    ) -> Result<Tensor> {
        let normed = self.norm.apply(x)?;
        let key_value = self.key_value.apply(memory.unwrap_or(&normed))?; // [batch, keys, 2 width]
        let attention = Attention { heads: self.heads, exists: visible.exists.clone(), causal: visible.causal };
        let attended = attention.apply(&self.query.apply(&normed)?, &key_value, &self.bias)?;
        x.add(&dropout.apply(&self.out.apply(&attended)?)?)
    }
}

/// Two linear layers with a `SiLU` between them, normalization and residual connection.
#[derive(Debug, Clone)]
pub(crate) struct FeedForward {
    norm: Norm,
    up: Linear,
    down: Linear,
}

impl FeedForward {
    pub(crate) fn new(parameters: &mut Parameters, name: &str, width: usize, hidden: usize) -> Result<Self> {
        Ok(Self {
            norm: Norm::new(parameters, &format!("{name}.norm"), width)?,
            up: Linear::new(parameters, &format!("{name}.up"), width, hidden)?,
            down: Linear::scaled(parameters, &format!("{name}.down"), [hidden, width], 0.4)?,
        })
    }

    pub(crate) fn apply(&self, x: &Tensor, dropout: &Dropout) -> Result<Tensor> {
        let hidden = Activation::Silu.forward(&self.up.apply(&self.norm.apply(x)?)?)?;
        x.add(&dropout.apply(&self.down.apply(&hidden)?)?)
    }
}
