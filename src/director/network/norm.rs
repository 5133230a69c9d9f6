//! Root-mean-square normalization with a gain, forward and backward. (candle's own has no gradient.)

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor};

use super::slices::{contiguous, read};

/// Added to the mean square, so that a row of zeros stays a row of zeros.
const EPSILON: f32 = 1e-5;

/// `x / sqrt(mean(x^2) + eps) * gain` over the last dimension.
#[derive(Debug, Clone, Copy)]
pub(super) struct RmsNorm;

impl RmsNorm {
    /// Normalizes `input` `[.., width]` with `gain` `[width]`.
    pub(super) fn apply(self, input: &Tensor, gain: &Tensor) -> Result<Tensor> {
        input.contiguous()?.apply_op2(gain, self)
    }
}

/// `1 / sqrt(mean(x^2) + eps)` of a row.
fn scale_of(row: &[f32]) -> f32 {
    let squares: f32 = row.iter().map(|x| x * x).sum();
    (squares / row.len() as f32 + EPSILON).sqrt().recip()
}

fn forward(input: &[f32], gain: &[f32]) -> Vec<f32> {
    let mut out = Vec::with_capacity(input.len());
    for row in input.chunks_exact(gain.len()) {
        let scale = scale_of(row);
        out.extend(row.iter().zip(gain).map(|(x, gain)| x * scale * gain));
    }
    out
}

/// Gradients of the input and of the gain. With the scale `s`, the output gradient `g` and `h = g gain` they are
/// `s h - x s^3 mean(h x)` and, summed over rows, `g x s`.
fn backward(input: &[f32], gain: &[f32], grad: &[f32]) -> (Vec<f32>, Vec<f32>) {
    let width = gain.len();
    let mut grad_input = Vec::with_capacity(input.len());
    let mut grad_gain = vec![0.0; width];
    for (row, grad) in input.chunks_exact(width).zip(grad.chunks_exact(width)) {
        let scale = scale_of(row);
        let mean: f32 = row.iter().zip(gain).zip(grad).map(|((x, gain), g)| x * gain * g).sum::<f32>() / width as f32;
        let pull = scale * scale * scale * mean;
        grad_input.extend(row.iter().zip(gain).zip(grad).map(|((x, gain), g)| scale * g * gain - x * pull));
        for ((sum, x), g) in grad_gain.iter_mut().zip(row).zip(grad) {
            *sum += g * x * scale;
        }
    }
    (grad_input, grad_gain)
}

impl CustomOp2 for RmsNorm {
    fn name(&self) -> &'static str {
        "rms-norm"
    }

    fn cpu_fwd(
        &self,
        input: &CpuStorage,
        input_layout: &Layout,
        gain: &CpuStorage,
        gain_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let out = forward(contiguous(input, input_layout)?, contiguous(gain, gain_layout)?);
        Ok((CpuStorage::F32(out), input_layout.shape().clone()))
    }

    fn bwd(
        &self,
        input: &Tensor,
        gain: &Tensor,
        _out: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let (grad_input, grad_gain) = read(input, |x| read(gain, |gain| read(grad, |g| Ok(backward(x, gain, g)))))?;
        Ok((
            Some(Tensor::from_vec(grad_input, input.shape(), input.device())?),
            Some(Tensor::from_vec(grad_gain, gain.shape(), gain.device())?),
        ))
    }
}
