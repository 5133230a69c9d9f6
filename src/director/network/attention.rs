//! Attention over heads as one operation, forward and backward, in `f32`.
//!
//! Enters: queries, keys and values side by side, a table of relative-position biases, and which keys exist. Leaves: the
//! weighted values. A query without a visible key gets zeros, not NaN. It is one operation for two reasons: at these sizes
//! the transposed copies for matrix products per head cost more than the products, and candle's own `softmax_last_dim` has
//! no gradient.

#![allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]

use std::sync::Arc;

use candle_core::{CpuStorage, CustomOp3, Layout, Result, Shape, Tensor};
use pulp::{Simd, WithSimd};

use super::exp::exp;
use super::product::{Place, Sizes, add_product};
use super::slices::{contiguous, read};

/// Scaled dot-product attention: softmax(q k^T / sqrt(head width) + bias) v over the visible keys.
#[derive(Debug, Clone)]
pub(super) struct Attention {
    /// Number of heads; each has an equal part of the width.
    pub(super) heads: usize,
    /// Whether a key exists: `[batch * keys]`.
    pub(super) exists: Arc<[bool]>,
    /// Whether a query attends only to keys at its own position and before.
    pub(super) causal: bool,
}

/// Numbers that a vector register holds. Rows of scores are padded to a multiple of it, so that no loop over them has a rest.
const LANES: usize = 16;

/// Sizes of one call.
#[derive(Clone, Copy)]
struct Dims {
    batch: usize,
    queries: usize,
    keys: usize,
    width: usize,
    heads: usize,
    /// Columns of the bias table, for distances -reach..=reach; larger distances are clamped.
    distances: usize,
}

impl Dims {
    fn head_width(&self) -> usize {
        self.width / self.heads
    }

    fn scale(&self) -> f32 {
        (self.head_width() as f32).sqrt().recip()
    }

    /// Numbers in a row of scores.
    fn padded_keys(&self) -> usize {
        self.keys.next_multiple_of(LANES)
    }

    /// Numbers in a row of biases by distance from `1 - queries` on.
    fn span(&self) -> usize {
        self.queries + self.padded_keys()
    }

    /// Column of the bias table for a place in such a row.
    fn distance(&self, place: usize) -> usize {
        let reach = (self.distances / 2) as isize;
        (((place + 1) as isize - self.queries as isize).clamp(-reach, reach) + reach) as usize
    }

    /// Where the scores of a query begin in such a row.
    fn first_place(&self, query: usize) -> usize {
        self.queries - 1 - query
    }

    /// Keys and values of an example.
    fn rows_of(&self, batch: usize) -> std::ops::Range<usize> {
        let len = self.keys * 2 * self.width;
        batch * len..(batch + 1) * len
    }

    /// Columns of the keys and values of an example, from `first` on.
    fn of_rows(&self, first: usize) -> Place {
        Place { first, row: 2 * self.width, column: 1 }
    }

    /// Columns of the queries of an example, from `first` on.
    fn of_queries(&self, batch: usize, first: usize) -> Place {
        Place { first: batch * self.queries * self.width + first, row: self.width, column: 1 }
    }

    /// A matrix with one column per key.
    fn of_keys(&self) -> Place {
        Place { first: 0, row: self.padded_keys(), column: 1 }
    }
}

/// Gradients of one call, in the layout of the arguments.
struct Gradients {
    query: Vec<f32>,
    key_value: Vec<f32>,
    bias: Vec<f32>,
}

/// The arguments of one call.
struct Inputs<'a> {
    query: &'a [f32],
    key_value: &'a [f32],
    bias: &'a [f32],
}

/// What the queries of one head of one example share.
struct Head {
    dims: Dims,
    /// First column of the head.
    first: usize,
    /// Transposed keys, scaled, and values: `[head width, padded keys]`.
    keys_t: Vec<f32>,
    values_t: Vec<f32>,
    /// Biases by distance, `[span]`.
    biases: Vec<f32>,
    /// 1 for a key that exists, otherwise 0: `[padded keys]`.
    exists: Vec<f32>,
    causal: bool,
}

impl Head {
    fn new(dims: Dims, causal: bool) -> Self {
        let transposed = vec![0.0; dims.head_width() * dims.padded_keys()];
        Self {
            dims,
            first: 0,
            keys_t: transposed.clone(),
            values_t: transposed,
            biases: vec![0.0; dims.span()],
            exists: vec![0.0; dims.padded_keys()],
            causal,
        }
    }

    /// Attention weights of all queries, `[queries, padded keys]`: the softmax of `scale q k^T + bias` over the keys that a
    /// query sees. `queries` are those of this head, one row each.
    #[inline(always)]
    fn weights<S: Simd>(&self, simd: S, queries: (&[f32], Place), weights: &mut [f32]) {
        let (dims, padded) = (self.dims, self.dims.padded_keys());
        for (query, scores) in weights.chunks_exact_mut(padded).enumerate() {
            let place = dims.first_place(query);
            scores.copy_from_slice(&self.biases[place..place + padded]);
        }
        let sizes = Sizes { rows: dims.queries, inner: dims.head_width(), columns: padded };
        add_product(simd, sizes, queries, (&self.keys_t, dims.of_keys()), (weights, dims.of_keys()));
        for (query, scores) in weights.chunks_exact_mut(padded).enumerate() {
            self.weigh(query, scores);
        }
    }

    /// Replaces the scores of a query by its weights.
    #[inline(always)]
    fn weigh(&self, query: usize, scores: &mut [f32]) {
        let seen = if self.causal { (query + 1).min(self.dims.keys) } else { self.dims.keys };
        // Damaged weights must show; the exponential below would hide them.
        if scores[..seen].iter().any(|score| score.is_nan()) {
            scores.fill(f32::NAN);
            return;
        }
        let mut top = f32::NEG_INFINITY;
        for (score, exists) in scores[..seen].iter().zip(&self.exists) {
            top = if *exists > 0.0 && *score > top { *score } else { top };
        }
        if top == f32::NEG_INFINITY {
            scores.fill(0.0);
            return;
        }
        for (score, exists) in scores.iter_mut().zip(&self.exists) {
            *score = exists * exp((*score - top).min(0.0));
        }
        scores[seen..].fill(0.0);
        let scale = scores.iter().sum::<f32>().recip();
        scores.iter_mut().for_each(|score| *score *= scale);
    }
}

impl Attention {
    /// Weighted values `[batch, queries, width]`. `query` is `[batch, queries, width]`, `key_value` is
    /// `[batch, keys, 2 * width]` (keys, then values), `bias` is `[heads, 2 * reach + 1]` by distance key - query.
    pub(super) fn apply(self, query: &Tensor, key_value: &Tensor, bias: &Tensor) -> Result<Tensor> {
        query.contiguous()?.apply_op3(&key_value.contiguous()?, &bias.contiguous()?, self)
    }

    fn dims(&self, query: &Shape, key_value: &Shape, bias: &Shape) -> Result<Dims> {
        let (batch, queries, width) = query.dims3()?;
        let (key_batch, keys, both) = key_value.dims3()?;
        let (bias_heads, distances) = bias.dims2()?;
        let fits = key_batch == batch
            && both == 2 * width
            && bias_heads == self.heads
            && self.exists.len() == batch * keys
            && width.is_multiple_of(self.heads);
        if !fits {
            candle_core::bail!("attention over {query:?}, {key_value:?}, {bias:?} with {} heads", self.heads);
        }
        Ok(Dims { batch, queries, keys, width, heads: self.heads, distances })
    }

    fn forward(&self, dims: Dims, inputs: &Inputs<'_>) -> Vec<f32> {
        let mut out = vec![0.0; dims.batch * dims.queries * dims.width];
        pulp::Arch::new().dispatch(Forward { attention: self, dims, inputs, out: &mut out });
        out
    }

    fn backward(&self, dims: Dims, inputs: &Inputs<'_>, grad: &[f32]) -> Gradients {
        let mut gradients = Gradients {
            query: vec![0.0; inputs.query.len()],
            key_value: vec![0.0; inputs.key_value.len()],
            bias: vec![0.0; inputs.bias.len()],
        };
        pulp::Arch::new().dispatch(Backward { attention: self, dims, inputs, grad, gradients: &mut gradients });
        gradients
    }

    /// Sets `head` to a head of an example, whose keys and values are `rows`.
    #[inline(always)]
    fn enter(&self, head: &mut Head, [batch, head_idx]: [usize; 2], rows: &[f32], bias: &[f32]) {
        let dims = head.dims;
        head.first = head_idx * dims.head_width();
        transpose_columns(rows, 2 * dims.width, head.first, &mut head.keys_t, dims.padded_keys());
        head.keys_t.iter_mut().for_each(|value| *value *= dims.scale());
        transpose_columns(rows, 2 * dims.width, dims.width + head.first, &mut head.values_t, dims.padded_keys());
        for (place, out) in head.biases.iter_mut().enumerate() {
            *out = bias[head_idx * dims.distances + dims.distance(place)];
        }
        for (key, out) in head.exists[..dims.keys].iter_mut().enumerate() {
            *out = f32::from(u8::from(self.exists[batch * dims.keys + key]));
        }
    }

    #[inline(always)]
    fn forward_into<S: Simd>(&self, simd: S, dims: Dims, inputs: &Inputs<'_>, out: &mut [f32]) {
        let mut head = Head::new(dims, self.causal);
        let mut weights = vec![0.0; dims.queries * dims.padded_keys()];
        for batch in 0..dims.batch {
            let rows = &inputs.key_value[dims.rows_of(batch)];
            for head_idx in 0..dims.heads {
                self.enter(&mut head, [batch, head_idx], rows, inputs.bias);
                let of_queries = dims.of_queries(batch, head.first);
                head.weights(simd, (inputs.query, of_queries), &mut weights);
                let sizes = Sizes { rows: dims.queries, inner: dims.keys, columns: dims.head_width() };
                let values = (rows, dims.of_rows(dims.width + head.first));
                add_product(simd, sizes, (&weights, dims.of_keys()), values, (out, of_queries));
            }
        }
    }

    #[inline(always)]
    fn backward_into<S: Simd>(
        &self,
        simd: S,
        dims: Dims,
        inputs: &Inputs<'_>,
        grad: &[f32],
        gradients: &mut Gradients,
    ) {
        let (width, head_width, padded) = (dims.width, dims.head_width(), dims.padded_keys());
        let mut head = Head::new(dims, self.causal);
        let mut weights = vec![0.0; dims.queries * padded];
        let mut slopes = vec![0.0; dims.queries * padded];
        let mut bias_slopes = vec![0.0; dims.span()];
        for batch in 0..dims.batch {
            let rows = &inputs.key_value[dims.rows_of(batch)];
            let grad_rows = &mut gradients.key_value[dims.rows_of(batch)];
            for head_idx in 0..dims.heads {
                self.enter(&mut head, [batch, head_idx], rows, inputs.bias);
                let of_queries = dims.of_queries(batch, head.first);
                head.weights(simd, (inputs.query, of_queries), &mut weights);
                slopes.fill(0.0);
                let sizes = Sizes { rows: dims.queries, inner: head_width, columns: padded };
                add_product(
                    simd,
                    sizes,
                    (grad, of_queries),
                    (&head.values_t, dims.of_keys()),
                    (&mut slopes, dims.of_keys()),
                );
                bias_slopes.fill(0.0);
                let of_query = weights.chunks_exact(padded).zip(slopes.chunks_exact_mut(padded)).enumerate();
                for (query, (weights, slopes)) in of_query {
                    score_slopes(weights, slopes);
                    let place = dims.first_place(query);
                    for (sum, slope) in bias_slopes[place..place + padded].iter_mut().zip(&mut *slopes) {
                        *sum += *slope;
                        *slope *= dims.scale();
                    }
                }
                let to_queries = Sizes { rows: dims.queries, inner: dims.keys, columns: head_width };
                let keys = (rows, dims.of_rows(head.first));
                add_product(simd, to_queries, (&slopes, dims.of_keys()), keys, (&mut gradients.query, of_queries));
                let to_rows = Sizes { rows: dims.keys, inner: dims.queries, columns: head_width };
                let turned = Place { first: 0, row: 1, column: padded };
                let queries = (inputs.query, of_queries);
                add_product(simd, to_rows, (&slopes, turned), queries, (grad_rows, dims.of_rows(head.first)));
                let of_values = dims.of_rows(width + head.first);
                add_product(simd, to_rows, (&weights, turned), (grad, of_queries), (grad_rows, of_values));
                let of_head = &mut gradients.bias[head_idx * dims.distances..(head_idx + 1) * dims.distances];
                for (place, slope) in bias_slopes.iter().enumerate() {
                    of_head[dims.distance(place)] += slope;
                }
            }
        }
    }
}

/// The forward pass as a value: of a closure of this size only the call would be compiled for the vector instructions.
struct Forward<'a> {
    attention: &'a Attention,
    dims: Dims,
    inputs: &'a Inputs<'a>,
    out: &'a mut [f32],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.attention.forward_into(simd, self.dims, self.inputs, self.out);
    }
}

/// The backward pass as a value.
struct Backward<'a> {
    attention: &'a Attention,
    dims: Dims,
    inputs: &'a Inputs<'a>,
    grad: &'a [f32],
    gradients: &'a mut Gradients,
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.attention.backward_into(simd, self.dims, self.inputs, self.grad, self.gradients);
    }
}

/// Replaces derivatives `g` by the weights `w` by those by the scores: `w (g - sum w g)`.
#[inline(always)]
fn score_slopes(weights: &[f32], slopes: &mut [f32]) {
    for (slope, weight) in slopes.iter_mut().zip(weights) {
        *slope *= weight;
    }
    let mean: f32 = slopes.iter().sum();
    for (slope, weight) in slopes.iter_mut().zip(weights) {
        *slope -= weight * mean;
    }
}

/// Columns of `rows` from `first` on as rows of `out`, which are `padded` long; what is beyond the last row stays.
#[inline(always)]
fn transpose_columns(rows: &[f32], stride: usize, first: usize, out: &mut [f32], padded: usize) {
    let columns = out.len() / padded;
    for (row_idx, row) in rows.chunks_exact(stride).enumerate() {
        for (column, value) in row[first..first + columns].iter().enumerate() {
            out[column * padded + row_idx] = *value;
        }
    }
}

impl CustomOp3 for Attention {
    fn name(&self) -> &'static str {
        "attention"
    }

    fn cpu_fwd(
        &self,
        query: &CpuStorage,
        query_layout: &Layout,
        key_value: &CpuStorage,
        key_value_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let dims = self.dims(query_layout.shape(), key_value_layout.shape(), bias_layout.shape())?;
        let inputs = Inputs {
            query: contiguous(query, query_layout)?,
            key_value: contiguous(key_value, key_value_layout)?,
            bias: contiguous(bias, bias_layout)?,
        };
        let out = self.forward(dims, &inputs);
        Ok((CpuStorage::F32(out), query_layout.shape().clone()))
    }

    fn bwd(
        &self,
        query: &Tensor,
        key_value: &Tensor,
        bias: &Tensor,
        _out: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let dims = self.dims(query.shape(), key_value.shape(), bias.shape())?;
        let gradients = read(query, |q| {
            read(key_value, |kv| {
                let backward =
                    |b: &[f32], g: &[f32]| Ok(self.backward(dims, &Inputs { query: q, key_value: kv, bias: b }, g));
                read(bias, |b| read(grad, |g| backward(b, g)))
            })
        })?;
        let tensor = |values: Vec<f32>, like: &Tensor| Tensor::from_vec(values, like.shape(), like.device());
        Ok((
            Some(tensor(gradients.query, query)?),
            Some(tensor(gradients.key_value, key_value)?),
            Some(tensor(gradients.bias, bias)?),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use candle_core::Device;

    /// Attention of two queries over three keys, of which the last does not exist.
    fn attended(query: [f32; 4], causal: bool) -> Vec<f32> {
        let tensor = |values: &[f32], shape: &[usize]| Tensor::from_slice(values, shape, &Device::Cpu).unwrap();
        let key_value = tensor(&[1.0, 0.0, 1.0, 10.0, 0.0, 1.0, 2.0, 20.0, 9.0, 9.0, 3.0, 30.0], &[1, 3, 4]);
        let bias = tensor(&[0.0], &[1, 1]);
        let attention = Attention { heads: 1, exists: [true, true, false].into(), causal };
        let out = attention.apply(&tensor(&query, &[1, 2, 2]), &key_value, &bias).unwrap();
        out.flatten_all().unwrap().to_vec1().unwrap()
    }

    #[test]
    fn weights_are_the_softmax_over_the_keys_that_exist() {
        let out = attended([0.5, -0.25, 0.0, 2.0], false);
        for (query, out) in [[0.5_f32, -0.25], [0.0, 2.0]].iter().zip(out.chunks_exact(2)) {
            let [a, b] = query.map(|score| (score / 2.0_f32.sqrt()).exp());
            let value = (a + 2.0 * b) / (a + b);
            assert!((out[0] - value).abs() < 1e-5 && (out[1] - 10.0 * value).abs() < 1e-4, "{out:?} {value}");
        }
        // The first query sees the first key alone.
        assert_eq!(attended([0.5, -0.25, 0.0, 2.0], true)[..2], [1.0, 10.0]);
    }

    #[test]
    fn numbers_that_are_none_stay_so() {
        let out = attended([f32::NAN, 0.0, 0.0, 0.0], false);
        assert!(
            out[..2].iter().all(|value| value.is_nan()) && out[2..].iter().all(|value| value.is_finite()),
            "{out:?}"
        );
    }
}
