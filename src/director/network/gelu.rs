//! The activation of BERT as one operation, forward and backward. (candle's own takes the error function one value at a
//! time, which costs as much as the matrix products.)

use candle_core::{CpuStorage, CustomOp1, Layout, Result, Shape, Tensor};

use super::exp::exp;
use super::slices::{contiguous, read};

/// `x Phi(x)`, where `Phi` is the distribution function of the standard normal distribution (Hendrycks and Gimpel 2016,
/// GELU). Absolute error below 1e-6 for |x| < 4.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gelu;

impl Gelu {
    /// Applies to each value.
    pub(super) fn apply(self, input: &Tensor) -> Result<Tensor> {
        input.contiguous()?.apply_op1(self)
    }
}

/// `Phi(x)` and the density at `x`. Abramowitz and Stegun 1964, 7.1.26: absolute error of the error function 1.5e-7.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn normal(x: f32) -> (f32, f32) {
    let z = x.abs() * std::f32::consts::FRAC_1_SQRT_2;
    let t = 1.0 / (1.0 + 0.327_591_1 * z);
    let series = ((((1.061_405_4 * t - 1.453_152_1) * t + 1.421_413_8) * t - 0.284_496_74) * t + 0.254_829_6) * t;
    let exp = exp(-z * z);
    let tail = 0.5 * series * exp;
    let below = if x < 0.0 { tail } else { 1.0 - tail };
    (below, exp * 0.398_942_3)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn forward(input: &[f32], out: &mut [f32]) {
    for (x, out) in input.iter().zip(out) {
        *out = x * normal(*x).0;
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn backward(input: &[f32], grad: &[f32], out: &mut [f32]) {
    for ((x, grad), out) in input.iter().zip(grad).zip(out) {
        let (below, density) = normal(*x);
        *out = grad * (below + x * density);
    }
}

impl CustomOp1 for Gelu {
    fn name(&self) -> &'static str {
        "gelu"
    }

    fn cpu_fwd(&self, input: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let input = contiguous(input, layout)?;
        let mut out = vec![0.0; input.len()];
        pulp::Arch::new().dispatch(|| forward(input, &mut out));
        Ok((CpuStorage::F32(out), layout.shape().clone()))
    }

    fn bwd(&self, input: &Tensor, _out: &Tensor, grad: &Tensor) -> Result<Option<Tensor>> {
        let slopes = read(input, |x| {
            read(grad, |grad| {
                let mut out = vec![0.0; x.len()];
                pulp::Arch::new().dispatch(|| backward(x, grad, &mut out));
                Ok(out)
            })
        })?;
        Tensor::from_vec(slopes, input.shape(), input.device()).map(Some)
    }
}
