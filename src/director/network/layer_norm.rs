//! Layer normalization with gain and bias, forward and backward. (candle's own fused operation has no gradient.)

use candle_core::{CpuStorage, CustomOp3, Layout, Result, Shape, Tensor};

use super::parameters::{Parameters, Start};
use super::slices::{contiguous, read};

/// Added to the variance (Devlin et al. 2019, BERT).
const EPSILON: f32 = 1e-12;

/// `(x - mean(x)) / sqrt(variance(x) + eps) * gain + bias` over the last dimension, with learned gain and bias.
#[derive(Debug, Clone)]
pub(super) struct LayerNorm {
    /// `[width]`
    gain: Tensor,
    /// `[width]`
    bias: Tensor,
}

impl LayerNorm {
    pub(super) fn new(parameters: &mut Parameters, name: &str, width: usize) -> Result<Self> {
        Ok(Self {
            gain: parameters.get(&format!("{name}.gain"), &[width], Start::Constant(1.0))?,
            bias: parameters.get(&format!("{name}.bias"), &[width], Start::Constant(0.0))?,
        })
    }

    /// Normalizes `input` `[.., width]`.
    pub(super) fn apply(&self, input: &Tensor) -> Result<Tensor> {
        input.contiguous()?.apply_op3(&self.gain, &self.bias, Normalize)
    }
}

/// The operation of [`LayerNorm`].
#[derive(Debug, Clone, Copy)]
struct Normalize;

/// Mean and inverse standard deviation of a row.
fn moments(row: &[f32]) -> (f32, f32) {
    let width = row.len() as f32;
    let mean = row.iter().sum::<f32>() / width;
    let variance = row.iter().map(|x| (x - mean) * (x - mean)).sum::<f32>() / width;
    (mean, (variance + EPSILON).sqrt().recip())
}

/// Gradients of input, gain and bias. With the normalized row `n`, its inverse deviation `s`, the output gradient `g` and
/// `h = g gain` they are `s (h - mean(h) - n mean(h n))` and, summed over rows, `g n` and `g`.
fn backward(input: &[f32], gain: &[f32], grad: &[f32]) -> [Vec<f32>; 3] {
    let width = gain.len();
    let mut grad_input = Vec::with_capacity(input.len());
    let (mut grad_gain, mut grad_bias) = (vec![0.0; width], vec![0.0; width]);
    for (row, grad) in input.chunks_exact(width).zip(grad.chunks_exact(width)) {
        let (mean, scale) = moments(row);
        let (mut mean_h, mut mean_hn) = (0.0, 0.0);
        for ((x, gain), g) in row.iter().zip(gain).zip(grad) {
            let h = g * gain;
            mean_h += h;
            mean_hn += h * (x - mean) * scale;
        }
        mean_h /= width as f32;
        mean_hn /= width as f32;
        let slope = |((x, gain), g): ((&f32, &f32), &f32)| scale * (g * gain - mean_h - (x - mean) * scale * mean_hn);
        grad_input.extend(row.iter().zip(gain).zip(grad).map(slope));
        for (((gain, bias), x), g) in grad_gain.iter_mut().zip(&mut grad_bias).zip(row).zip(grad) {
            *gain += g * (x - mean) * scale;
            *bias += g;
        }
    }
    [grad_input, grad_gain, grad_bias]
}

impl CustomOp3 for Normalize {
    fn name(&self) -> &'static str {
        "layer-norm"
    }

    fn cpu_fwd(
        &self,
        input: &CpuStorage,
        input_layout: &Layout,
        gain: &CpuStorage,
        gain_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (gain, bias) = (contiguous(gain, gain_layout)?, contiguous(bias, bias_layout)?);
        let input = contiguous(input, input_layout)?;
        let mut out = Vec::with_capacity(input.len());
        for row in input.chunks_exact(gain.len()) {
            let (mean, scale) = moments(row);
            out.extend(row.iter().zip(gain).zip(bias).map(|((x, gain), bias)| (x - mean) * scale * gain + bias));
        }
        Ok((CpuStorage::F32(out), input_layout.shape().clone()))
    }

    fn bwd(
        &self,
        input: &Tensor,
        gain: &Tensor,
        bias: &Tensor,
        _out: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let [grad_input, grad_gain, grad_bias] =
            read(input, |x| read(gain, |gain| read(grad, |g| Ok(backward(x, gain, g)))))?;
        let tensor = |values: Vec<f32>, like: &Tensor| Tensor::from_vec(values, like.shape(), like.device()).map(Some);
        Ok((tensor(grad_input, input)?, tensor(grad_gain, gain)?, tensor(grad_bias, bias)?))
    }
}
