//! Attention over heads as one operation, forward and backward, in `f32`.
//!
//! Enters: queries, keys and values side by side, a table of relative-position biases, and which keys exist. Leaves: the
//! weighted values. A query without a visible key gets zeros, not NaN. It is one operation for two reasons: at these sizes
//! the transposed copies for matrix products per head cost more than the products, and candle's own `softmax_last_dim` has
//! no gradient.

use std::sync::Arc;

use candle_core::{CpuStorage, CustomOp3, Layout, Result, Shape, Tensor};

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

    /// Column of the bias table for a query and a key.
    fn distance(&self, query: usize, key: usize) -> usize {
        let reach = (self.distances / 2) as isize;
        ((key as isize - query as isize).clamp(-reach, reach) + reach) as usize
    }
}

/// Gradients of one call, in the layout of the arguments.
struct Gradients {
    query: Vec<f32>,
    key_value: Vec<f32>,
    bias: Vec<f32>,
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

    /// Replaces the `scores` of one query by its attention weights.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inlined code is compiled for the vector instructions that pulp selects"
    )]
    fn weigh(&self, scores: &mut [f32], batch: usize, query: usize) {
        let exists = &self.exists[batch * scores.len()..(batch + 1) * scores.len()];
        let sees = |key: usize| exists[key] && !(self.causal && key > query);
        let mut top = f32::NEG_INFINITY;
        for (key, score) in scores.iter().enumerate() {
            if sees(key) {
                top = top.max(*score);
            }
        }
        let mut sum = 0.0;
        for (key, score) in scores.iter_mut().enumerate() {
            *score = if sees(key) { (*score - top).exp() } else { 0.0 };
            sum += *score;
        }
        let scale = if sum > 0.0 { sum.recip() } else { 0.0 };
        scores.iter_mut().for_each(|score| *score *= scale);
    }

    /// Attention weights of one query, in `scores`: the softmax of `scale q k^T + bias`. `keys_t` is `[head width, keys]`.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inlined code is compiled for the vector instructions that pulp selects"
    )]
    fn weights_of(&self, at: QueryAt, query: &[f32], keys_t: &[f32], bias: &[f32], scores: &mut [f32]) {
        let dims = at.dims;
        for (key, score) in scores.iter_mut().enumerate() {
            *score = bias[at.head * dims.distances + dims.distance(at.query, key)];
        }
        for (value, row) in query.iter().zip(keys_t.chunks_exact(dims.keys)) {
            add_scaled(scores, row, value * dims.scale());
        }
        self.weigh(scores, at.batch, at.query);
    }

    fn forward(&self, dims: Dims, query: &[f32], key_value: &[f32], bias: &[f32]) -> Vec<f32> {
        let mut out = vec![0.0; dims.batch * dims.queries * dims.width];
        pulp::Arch::new().dispatch(|| self.forward_into(dims, query, key_value, bias, &mut out));
        out
    }

    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inlined code is compiled for the vector instructions that pulp selects"
    )]
    fn forward_into(&self, dims: Dims, query: &[f32], key_value: &[f32], bias: &[f32], out: &mut [f32]) {
        let (width, head_width) = (dims.width, dims.head_width());
        let mut keys_t = vec![0.0; head_width * dims.keys];
        let mut scores = vec![0.0; dims.keys];
        for batch in 0..dims.batch {
            let rows = &key_value[batch * dims.keys * 2 * width..(batch + 1) * dims.keys * 2 * width];
            for head in 0..dims.heads {
                transpose_columns(rows, 2 * width, head * head_width, &mut keys_t, dims.keys);
                for query_idx in 0..dims.queries {
                    let start = (batch * dims.queries + query_idx) * width + head * head_width;
                    let at = QueryAt { dims, batch, head, query: query_idx };
                    self.weights_of(at, &query[start..start + head_width], &keys_t, bias, &mut scores);
                    let out = &mut out[start..start + head_width];
                    for (weight, row) in scores.iter().zip(rows.chunks_exact(2 * width)) {
                        let value = width + head * head_width;
                        add_scaled(out, &row[value..value + head_width], *weight);
                    }
                }
            }
        }
    }

    fn backward(&self, dims: Dims, query: &[f32], key_value: &[f32], bias: &[f32], grad: &[f32]) -> Gradients {
        let mut gradients = Gradients {
            query: vec![0.0; query.len()],
            key_value: vec![0.0; key_value.len()],
            bias: vec![0.0; bias.len()],
        };
        let forward = Inputs { query, key_value, bias };
        pulp::Arch::new().dispatch(|| self.backward_into(dims, &forward, grad, &mut gradients));
        gradients
    }

    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inlined code is compiled for the vector instructions that pulp selects"
    )]
    fn backward_into(&self, dims: Dims, inputs: &Inputs<'_>, grad: &[f32], gradients: &mut Gradients) {
        let (width, head_width) = (dims.width, dims.head_width());
        let mut keys_t = vec![0.0; head_width * dims.keys];
        let mut values_t = vec![0.0; head_width * dims.keys];
        let (mut weights, mut slopes) = (vec![0.0; dims.keys], vec![0.0; dims.keys]);
        for batch in 0..dims.batch {
            let range = batch * dims.keys * 2 * width..(batch + 1) * dims.keys * 2 * width;
            let rows = &inputs.key_value[range.clone()];
            let grad_rows = &mut gradients.key_value[range];
            for head in 0..dims.heads {
                transpose_columns(rows, 2 * width, head * head_width, &mut keys_t, dims.keys);
                transpose_columns(rows, 2 * width, width + head * head_width, &mut values_t, dims.keys);
                for query_idx in 0..dims.queries {
                    let start = (batch * dims.queries + query_idx) * width + head * head_width;
                    let query = &inputs.query[start..start + head_width];
                    let grad = &grad[start..start + head_width];
                    let at = QueryAt { dims, batch, head, query: query_idx };
                    self.weights_of(at, query, &keys_t, inputs.bias, &mut weights);
                    score_slopes(grad, &values_t, &weights, &mut slopes);
                    let grad_query = &mut gradients.query[start..start + head_width];
                    let parts = Row { at, query, grad, weights: &weights, slopes: &slopes };
                    parts.spread(rows, grad_rows, grad_query, &mut gradients.bias);
                }
            }
        }
    }
}

/// One query of one head.
#[derive(Clone, Copy)]
struct QueryAt {
    dims: Dims,
    batch: usize,
    head: usize,
    query: usize,
}

/// The arguments of one call.
struct Inputs<'a> {
    query: &'a [f32],
    key_value: &'a [f32],
    bias: &'a [f32],
}

/// One query's contribution to the gradients.
struct Row<'a> {
    at: QueryAt,
    query: &'a [f32],
    grad: &'a [f32],
    weights: &'a [f32],
    slopes: &'a [f32],
}

impl Row<'_> {
    /// Adds the contribution to the gradients of keys, values, query and biases.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "only inlined code is compiled for the vector instructions that pulp selects"
    )]
    fn spread(&self, rows: &[f32], grad_rows: &mut [f32], grad_query: &mut [f32], grad_bias: &mut [f32]) {
        let QueryAt { dims, head, query, .. } = self.at;
        let (width, head_width, scale) = (dims.width, dims.head_width(), dims.scale());
        let (key_at, value_at) = (head * head_width, width + head * head_width);
        for key in 0..dims.keys {
            if self.weights[key] == 0.0 {
                continue;
            }
            let row = &rows[key * 2 * width..(key + 1) * 2 * width];
            let grad_row = &mut grad_rows[key * 2 * width..(key + 1) * 2 * width];
            add_scaled(grad_query, &row[key_at..key_at + head_width], scale * self.slopes[key]);
            add_scaled(&mut grad_row[key_at..key_at + head_width], self.query, scale * self.slopes[key]);
            add_scaled(&mut grad_row[value_at..value_at + head_width], self.grad, self.weights[key]);
            grad_bias[head * dims.distances + dims.distance(query, key)] += self.slopes[key];
        }
    }
}

/// Derivatives of the loss by the scores: `w (g - sum w g)`, where `g` are the derivatives by the weights `w`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn score_slopes(grad: &[f32], values_t: &[f32], weights: &[f32], slopes: &mut [f32]) {
    slopes.fill(0.0);
    for (value, row) in grad.iter().zip(values_t.chunks_exact(weights.len())) {
        add_scaled(slopes, row, *value);
    }
    let mean: f32 = slopes.iter().zip(weights).map(|(slope, weight)| slope * weight).sum();
    for (slope, weight) in slopes.iter_mut().zip(weights) {
        *slope = weight * (*slope - mean);
    }
}

/// `sum += scale * row`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn add_scaled(sum: &mut [f32], row: &[f32], scale: f32) {
    for (sum, value) in sum.iter_mut().zip(row) {
        *sum += scale * value;
    }
}

/// Columns `first..first + out.len() / count` of `count` rows, transposed.
#[inline(always)]
#[allow(clippy::inline_always, reason = "only inlined code is compiled for the vector instructions that pulp selects")]
fn transpose_columns(rows: &[f32], stride: usize, first: usize, out: &mut [f32], count: usize) {
    for (column, out) in out.chunks_exact_mut(count).enumerate() {
        for (row, out) in out.iter_mut().enumerate() {
            *out = rows[row * stride + first + column];
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
        let query = contiguous(query, query_layout)?;
        let out = self.forward(dims, query, contiguous(key_value, key_value_layout)?, contiguous(bias, bias_layout)?);
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
            read(key_value, |kv| read(bias, |b| read(grad, |g| Ok(self.backward(dims, q, kv, b, g)))))
        })?;
        let tensor = |values: Vec<f32>, like: &Tensor| Tensor::from_vec(values, like.shape(), like.device());
        Ok((
            Some(tensor(gradients.query, query)?),
            Some(tensor(gradients.key_value, key_value)?),
            Some(tensor(gradients.bias, bias)?),
        ))
    }
}
