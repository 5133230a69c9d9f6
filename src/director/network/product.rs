//! Products of small matrices that lie in larger ones, with vector instructions. (Packing them for a general product costs more
//! than the product.)
//!
//! Every number is summed in one order, whatever the width of the vectors, so that all machines compute the same.

#![allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]

use pulp::Simd;

/// Rows of the product that are computed together.
const ROWS: usize = 4;

/// Where a matrix lies in a slice.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// Index of its first number.
    pub(super) first: usize,
    /// From a number to that below it, and to that beside it.
    pub(super) row: usize,
    pub(super) column: usize,
}

impl Place {
    /// Index of a number.
    #[inline(always)]
    fn at(self, row: usize, column: usize) -> usize {
        self.first + row * self.row + column * self.column
    }

    /// The part of the matrix from a number on, to the right and below.
    #[inline(always)]
    fn from(self, row: usize, column: usize) -> Self {
        Self { first: self.at(row, column), ..self }
    }
}

/// Sizes of a product: `[rows, inner] [inner, columns]`.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub(super) rows: usize,
    pub(super) inner: usize,
    pub(super) columns: usize,
}

/// `out += left right`. The columns of `right` and `out` must lie side by side.
#[inline(always)]
pub(super) fn add_product<S: Simd>(
    simd: S,
    sizes: Sizes,
    left: (&[f32], Place),
    right: (&[f32], Place),
    out: (&mut [f32], Place),
) {
    let (out, place) = out;
    let mut row = 0;
    while row < sizes.rows {
        let (left, out) = ((left.0, left.1.from(row, 0)), (&mut *out, place.from(row, 0)));
        if row + ROWS <= sizes.rows {
            add_rows::<S, ROWS>(simd, sizes, left, right, out);
            row += ROWS;
        } else {
            add_rows::<S, 1>(simd, sizes, left, right, out);
            row += 1;
        }
    }
}

/// The first `N` rows of the product.
#[inline(always)]
fn add_rows<S: Simd, const N: usize>(
    simd: S,
    sizes: Sizes,
    left: (&[f32], Place),
    right: (&[f32], Place),
    out: (&mut [f32], Place),
) {
    let (out, place) = out;
    let mut column = 0;
    while column < sizes.columns {
        let (right, out) = ((right.0, right.1.from(0, column)), (&mut *out, place.from(0, column)));
        let rest = sizes.columns - column;
        if rest >= 2 * S::F32_LANES {
            add_block::<S, N, 2>(simd, sizes.inner, left, right, out);
            column += 2 * S::F32_LANES;
        } else if rest >= S::F32_LANES {
            add_block::<S, N, 1>(simd, sizes.inner, left, right, out);
            column += S::F32_LANES;
        } else {
            add_rest::<N>(Sizes { columns: rest, ..sizes }, left, right, out);
            column += rest;
        }
    }
}

/// `N` rows of `V` vectors each.
#[inline(always)]
fn add_block<S: Simd, const N: usize, const V: usize>(
    simd: S,
    inner: usize,
    left: (&[f32], Place),
    right: (&[f32], Place),
    out: (&mut [f32], Place),
) {
    let width = V * S::F32_LANES;
    let (out, place) = out;
    let mut sums = [[simd.splat_f32s(0.0); V]; N];
    for (n, sums) in sums.iter_mut().enumerate() {
        let start = place.at(n, 0);
        let (vectors, _) = S::as_simd_f32s(&out[start..start + width]);
        for (sum, vector) in sums.iter_mut().zip(vectors) {
            *sum = *vector;
        }
    }
    for i in 0..inner {
        let start = right.1.at(i, 0);
        let (vectors, _) = S::as_simd_f32s(&right.0[start..start + width]);
        for (n, sums) in sums.iter_mut().enumerate() {
            let factor = simd.splat_f32s(left.0[left.1.at(n, i)]);
            for (sum, vector) in sums.iter_mut().zip(vectors) {
                *sum = simd.add_f32s(*sum, simd.mul_f32s(factor, *vector));
            }
        }
    }
    for (n, sums) in sums.iter().enumerate() {
        let start = place.at(n, 0);
        let (vectors, _) = S::as_mut_simd_f32s(&mut out[start..start + width]);
        for (sum, vector) in sums.iter().zip(vectors) {
            *vector = *sum;
        }
    }
}

/// `N` rows of fewer columns than a vector has.
#[inline(always)]
fn add_rest<const N: usize>(sizes: Sizes, left: (&[f32], Place), right: (&[f32], Place), out: (&mut [f32], Place)) {
    let (out, place) = out;
    for n in 0..N {
        let start = place.at(n, 0);
        for i in 0..sizes.inner {
            let factor = left.0[left.1.at(n, i)];
            let start_right = right.1.at(i, 0);
            let row = &right.0[start_right..start_right + sizes.columns];
            for (sum, value) in out[start..start + sizes.columns].iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::{Arch, WithSimd};

    /// Sizes, the left matrix turned or not, and the matrices.
    struct Case<'a>(Sizes, bool, &'a [f32], &'a [f32], &'a mut [f32]);

    impl WithSimd for Case<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let Case(sizes, is_turned, left, right, out) = self;
            let of_left = if is_turned {
                Place { first: 2, row: 1, column: sizes.rows }
            } else {
                Place { first: 2, row: sizes.inner, column: 1 }
            };
            let wide = |first: usize| Place { first, row: sizes.columns + 3, column: 1 };
            add_product(simd, sizes, (left, of_left), (right, wide(1)), (out, wide(2)));
        }
    }

    #[test]
    fn products_of_all_sizes_are_those_of_the_definition_and_nothing_beside_them_changes() {
        let number = |i: usize| ((i * 37 % 101) as f32 - 50.0) / 16.0;
        for (rows, inner, columns) in [(1, 1, 1), (3, 5, 7), (4, 8, 16), (5, 2, 33), (9, 45, 48), (6, 3, 71), (2, 0, 5)]
        {
            for is_turned in [false, true] {
                let sizes = Sizes { rows, inner, columns };
                let left: Vec<f32> = (0..2 + rows * inner).map(number).collect();
                let right: Vec<f32> = (0..=inner * (columns + 3)).map(|i| number(i + 11)).collect();
                let before: Vec<f32> = (0..2 + rows * (columns + 3)).map(|i| number(i + 5)).collect();
                let mut out = before.clone();
                Arch::new().dispatch(Case(sizes, is_turned, &left, &right, &mut out));
                let mut expected = before;
                for row in 0..rows {
                    for column in 0..columns {
                        let of_left = |i: usize| left[2 + if is_turned { i * rows + row } else { row * inner + i }];
                        let of_right = |i: usize| right[1 + i * (columns + 3) + column];
                        let sum = &mut expected[2 + row * (columns + 3) + column];
                        *sum = (0..inner).fold(*sum, |sum, i| sum + of_left(i) * of_right(i));
                    }
                }
                assert_eq!(out, expected, "{rows} {inner} {columns} {is_turned}");
            }
        }
    }
}
