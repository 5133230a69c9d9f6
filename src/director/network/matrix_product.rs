//! Matrix products of whole tensors.
//!
//! Without gradients they are computed here: candle asks the operating system for the number of cores (it reads
//! `/proc/cpuinfo`) before every product, which takes longer than most products of a prompt, and the last digits of its sums
//! depend on the machine. Training multiplies batches, which candle spreads over the cores, and so uses candle's.

#![allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor};
use pulp::{Simd, WithSimd};

use super::product::{Place, Sizes, add_product};
use super::slices::contiguous;

/// Columns that are computed for all rows before the next ones: their part of the right matrix stays in the fastest cache.
const STRIP: usize = 32;

/// `left right`: `[.., rows, inner] [.., inner, columns]`, or one right matrix `[inner, columns]` for all left ones.
///
/// # Errors
/// A candle error when the shapes do not fit, or numbers are not `f32` on the CPU.
pub(crate) fn matrix_product(left: &Tensor, right: &Tensor) -> Result<Tensor> {
    if left.track_op() || right.track_op() {
        return left.broadcast_matmul(right);
    }
    left.contiguous()?.apply_op2_no_bwd(&right.contiguous()?, &MatrixProduct)
}

/// The product as an operation of candle.
struct MatrixProduct;

impl CustomOp2 for MatrixProduct {
    fn name(&self) -> &'static str {
        "matrix-product"
    }

    fn cpu_fwd(
        &self,
        left: &CpuStorage,
        left_layout: &Layout,
        right: &CpuStorage,
        right_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (left, right) = (contiguous(left, left_layout)?, contiguous(right, right_layout)?);
        let ([of_left @ .., rows, inner], [of_right @ .., right_rows, columns]) =
            (left_layout.dims(), right_layout.dims())
        else {
            candle_core::bail!("product of {left_layout:?} and {right_layout:?}");
        };
        if inner != right_rows || !(of_right.is_empty() || of_right == of_left) {
            candle_core::bail!("product of {left_layout:?} and {right_layout:?}");
        }
        let (rows, inner, columns) = (*rows, *inner, *columns);
        let batch: usize = of_left.iter().product();
        let mut out = vec![0.0; batch * rows * columns];
        // One right matrix for all: the left ones are one matrix with more rows.
        let (batch, rows) = if of_right.is_empty() { (1, batch * rows) } else { (batch, rows) };
        let sizes = Sizes { rows, inner, columns };
        for idx in 0..batch {
            pulp::Arch::new().dispatch(OneProduct {
                sizes,
                left: &left[idx * rows * inner..],
                right: &right[idx * inner * columns..],
                out: &mut out[idx * rows * columns..],
            });
        }
        Ok((CpuStorage::F32(out), Shape::from([of_left, &[left_layout.dims()[of_left.len()], columns]].concat())))
    }
}

/// One product as a value, so that it is compiled for the vector instructions.
struct OneProduct<'a> {
    sizes: Sizes,
    left: &'a [f32],
    right: &'a [f32],
    out: &'a mut [f32],
}

impl WithSimd for OneProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { sizes, left, right, out } = self;
        let of_left = Place { first: 0, row: sizes.inner, column: 1 };
        for first in (0..sizes.columns).step_by(STRIP) {
            let strip = Place { first, row: sizes.columns, column: 1 };
            let sizes = Sizes { columns: STRIP.min(sizes.columns - first), ..sizes };
            add_product(simd, sizes, (left, of_left), (right, strip), (&mut *out, strip));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use candle_core::{Device, Var};

    fn numbers(shape: &[usize], offset: usize) -> Tensor {
        let count = shape.iter().product::<usize>();
        let values = (0..count).map(|i| (((i + offset) * 37 % 101) as f32 - 50.0) / 16.0).collect();
        Tensor::from_vec::<_, f32>(values, shape, &Device::Cpu).unwrap()
    }

    #[test]
    fn products_are_those_of_candle() {
        for (left, right) in [
            (vec![1, 1], vec![1, 1]),
            (vec![5, 7], vec![7, 70]),
            (vec![2, 3, 9], vec![2, 9, 33]),
            (vec![2, 3, 4, 9], vec![9, 16]),
            (vec![3, 0], vec![0, 4]),
        ] {
            let (left, right) = (numbers(&left, 3), numbers(&right, 11));
            let (ours, theirs) = (matrix_product(&left, &right).unwrap(), left.broadcast_matmul(&right).unwrap());
            assert_eq!(ours.dims(), theirs.dims());
            let difference = (ours - theirs).unwrap().abs().unwrap().flatten_all().unwrap().to_vec1::<f32>().unwrap();
            assert!(difference.iter().all(|difference| *difference < 1e-3), "{left} {right}");
        }
    }

    #[test]
    fn views_are_multiplied_as_they_look() {
        let (left, right) = (numbers(&[7, 5], 1).t().unwrap(), numbers(&[4, 7], 2).t().unwrap());
        let (ours, theirs) = (matrix_product(&left, &right).unwrap(), left.matmul(&right).unwrap());
        assert_eq!(ours.to_vec2::<f32>().unwrap(), theirs.to_vec2::<f32>().unwrap());
    }

    #[test]
    fn shapes_that_do_not_fit_are_an_error() {
        for (left, right) in [(vec![2, 3], vec![4, 2]), (vec![2, 2, 3], vec![3, 3, 2]), (vec![3], vec![3, 2])] {
            assert!(matrix_product(&numbers(&left, 0), &numbers(&right, 0)).is_err());
        }
    }

    #[test]
    fn weights_in_training_get_gradients() {
        let weight = Var::from_tensor(&numbers(&[3, 2], 0)).unwrap();
        let sum = matrix_product(&numbers(&[4, 3], 5), weight.as_tensor()).unwrap().sum_all().unwrap();
        assert!(sum.backward().unwrap().get(weight.as_tensor()).is_some());
    }
}
