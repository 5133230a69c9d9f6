//! The activation of BERT as one operation, forward and backward. (candle's own takes the error function one value at a
//! time, which costs as much as the matrix products.)

use candle_core::{CpuStorage, CustomOp1, Layout, Result, Shape, Tensor};

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

/// `e^x` for x <= 0, without a branch: `2^n` by its bits times a polynomial of the rest (Cody and Waite 1980). Relative error
/// 2e-7; values below e^-87 are e^-87.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn exp(x: f32) -> f32 {
    let x = x.max(-87.0);
    let n = (x * std::f32::consts::LOG2_E - 0.5) as i32;
    let whole = n as f32;
    let r = x - whole * 0.693_359_4 + whole * 2.121_944_4e-4;
    let polynomial =
        1.0 + r * (1.0 + r * (0.5 + r * (0.166_666_67 + r * (0.041_666_67 + r * (0.008_333_34 + r * 0.001_388_9)))));
    polynomial * f32::from_bits(((n + 127) << 23) as u32)
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
