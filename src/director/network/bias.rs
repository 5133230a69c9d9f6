//! Adding a bias as one operation, forward and backward. (candle sums the gradient of a repeated bias one value at a time, which
//! costs a fifth of the matrix products.)

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor};

use super::slices::{contiguous, read};

/// `x + bias` for every row `x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct AddBias;

impl AddBias {
    /// Adds `bias` `[width]` to every row of `input` `[rows, width]`.
    pub(super) fn apply(self, input: &Tensor, bias: &Tensor) -> Result<Tensor> {
        input.contiguous()?.apply_op2(bias, self)
    }
}

/// Sum over the rows of `grad`.
fn sum_of_rows(grad: &[f32], width: usize) -> Vec<f32> {
    let mut sum = vec![0.0; width];
    for row in grad.chunks_exact(width) {
        for (sum, value) in sum.iter_mut().zip(row) {
            *sum += value;
        }
    }
    sum
}

impl CustomOp2 for AddBias {
    fn name(&self) -> &'static str {
        "add-bias"
    }

    fn cpu_fwd(
        &self,
        input: &CpuStorage,
        input_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (input, bias) = (contiguous(input, input_layout)?, contiguous(bias, bias_layout)?);
        let mut out = Vec::with_capacity(input.len());
        for row in input.chunks_exact(bias.len()) {
            out.extend(row.iter().zip(bias).map(|(x, bias)| x + bias));
        }
        Ok((CpuStorage::F32(out), input_layout.shape().clone()))
    }

    fn bwd(
        &self,
        _input: &Tensor,
        bias: &Tensor,
        _out: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let sum = read(grad, |grad| Ok(sum_of_rows(grad, bias.elem_count())))?;
        Ok((Some(grad.clone()), Some(Tensor::from_vec(sum, bias.shape(), bias.device())?)))
    }
}
