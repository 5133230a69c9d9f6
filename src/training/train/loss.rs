//! The training loss.
//!
//! Choices: cross-entropy, summed over the choices that apply. Poses: Huber loss. Each is a single operation with its own
//! gradient, because the overhead of some thirty small softmaxes per key would cost more than the network.

use std::ops::Range;

use candle_core::{CpuStorage, CustomOp1, Layout, Result, Shape, Tensor};
use strum::VariantArray;

use super::examples::Example;
use cinesplat_director::codes::{Field, NUM_FIELDS, OBJECT_POINTERS, POSE_WIDTH, PoseCode, QUANTITY_POINTERS};
use cinesplat_director::network::{Scores, anchor_objects};

/// Weight of a word span; a class has weight 1.
const WORDS_WEIGHT: f32 = 0.3;
/// Weight of a token that the notation can or cannot say; a class has weight 1.
const UNMET_WEIGHT: f32 = 0.1;
/// Weight of one value of a pose; a class has weight 1.
const POSE_WEIGHT: f32 = 0.5;
/// Relative weights of the values of a pose: position in scene sizes, rotation, field of view, time.
const POSE_WEIGHTS: [f32; POSE_WIDTH] = [4.0, 4.0, 4.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.3];
/// Error at which the Huber loss turns from quadratic to linear.
const HUBER_DELTA: f32 = 0.1;

/// Sum over rows and segments of `-weight ln softmax(row[segment])[target]`.
struct CrossEntropy {
    /// Segments of a row, each with its own softmax and weight.
    segments: Vec<(Range<usize>, f32)>,
    /// Class within its segment, `[rows * segments]`; `None` adds no loss.
    targets: Vec<Option<usize>>,
}

impl CrossEntropy {
    /// Calls `each(range in the flat scores, weight, target)` for every target.
    fn for_each(&self, row_width: usize, mut each: impl FnMut(Range<usize>, f32, usize)) {
        for (row, targets) in self.targets.chunks_exact(self.segments.len()).enumerate() {
            for ((segment, weight), target) in self.segments.iter().zip(targets) {
                if let Some(target) = target.filter(|target| *target < segment.len()) {
                    let start = row * row_width + segment.start;
                    each(start..start + segment.len(), *weight, target);
                }
            }
        }
    }
}

/// Logarithm of the sum of exponentials.
fn log_sum_exp(scores: &[f32]) -> f32 {
    let top = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    top + scores.iter().map(|score| (score - top).exp()).sum::<f32>().ln()
}

/// The values of a contiguous `f32` tensor.
fn floats<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    match layout.contiguous_offsets() {
        Some((start, end)) => Ok(&storage.as_slice::<f32>()?[start..end]),
        None => candle_core::bail!("expected contiguous scores, found {layout:?}"),
    }
}

impl CustomOp1 for CrossEntropy {
    fn name(&self) -> &'static str {
        "cross-entropy"
    }

    fn cpu_fwd(&self, storage: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let scores = floats(storage, layout)?;
        let mut sum = 0.0_f64;
        self.for_each(layout.dims()[1], |range, weight, target| {
            let scores = &scores[range];
            sum += f64::from(weight * (log_sum_exp(scores) - scores[target]));
        });
        Ok((CpuStorage::F32(vec![sum as f32]), Shape::from(())))
    }

    fn bwd(&self, scores: &Tensor, _loss: &Tensor, grad: &Tensor) -> Result<Option<Tensor>> {
        let grad = grad.to_scalar::<f32>()?;
        let values = scores.flatten_all()?.to_vec1::<f32>()?;
        let mut slopes = vec![0.0; values.len()];
        self.for_each(scores.dim(1)?, |range, weight, target| {
            let scores = &values[range.clone()];
            let sum = log_sum_exp(scores);
            let slopes = &mut slopes[range];
            for (slope, score) in slopes.iter_mut().zip(scores) {
                *slope = grad * weight * (score - sum).exp();
            }
            slopes[target] -= grad * weight;
        });
        Ok(Some(Tensor::from_vec(slopes, scores.shape(), scores.device())?))
    }
}

/// Sum of weighted Huber losses of the distances to targets.
struct Huber {
    targets: Vec<f32>,
    weights: Vec<f32>,
}

impl CustomOp1 for Huber {
    fn name(&self) -> &'static str {
        "huber"
    }

    fn cpu_fwd(&self, storage: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let values = floats(storage, layout)?;
        let one = |((value, target), weight): ((&f32, &f32), &f32)| {
            let off = (value - target).abs();
            let loss = if off < HUBER_DELTA { 0.5 * off * off / HUBER_DELTA } else { off - 0.5 * HUBER_DELTA };
            f64::from(weight * loss)
        };
        let sum: f64 = values.iter().zip(&self.targets).zip(&self.weights).map(one).sum();
        Ok((CpuStorage::F32(vec![sum as f32]), Shape::from(())))
    }

    fn bwd(&self, values: &Tensor, _loss: &Tensor, grad: &Tensor) -> Result<Option<Tensor>> {
        let grad = grad.to_scalar::<f32>()?;
        let flat = values.flatten_all()?.to_vec1::<f32>()?;
        let one = |((value, target), weight): ((&f32, &f32), &f32)| {
            grad * weight * ((value - target) / HUBER_DELTA).clamp(-1.0, 1.0)
        };
        let slopes: Vec<f32> = flat.iter().zip(&self.targets).zip(&self.weights).map(one).collect();
        Ok(Some(Tensor::from_vec(slopes, values.shape(), values.device())?))
    }
}

/// Applies [`CrossEntropy`] over the last dimension of `scores`; each row is one segment.
pub(crate) fn whole_rows(scores: &Tensor, weight: f32, targets: Vec<Option<usize>>) -> Result<Tensor> {
    let width = scores.dims().last().copied().unwrap_or(1);
    let rows = scores.reshape(((), width))?.contiguous()?;
    rows.apply_op1(CrossEntropy { segments: vec![(0..width, weight)], targets })
}

/// Loss of all choices of a batch, summed over its keys. Examples are padded to `num_keys` keys.
pub(super) fn choice_loss(scores: &Scores, examples: &[&Example], num_keys: usize) -> Result<Tensor> {
    let keys = || examples.iter().flat_map(|example| (0..num_keys).map(|key_idx| example.keys.get(key_idx)));
    let classes: Vec<Option<usize>> = keys()
        .flat_map(|key| (0..NUM_FIELDS).map(move |idx| key.and_then(|key| key.classes[idx]).map(usize::from)))
        .collect();
    let segments =
        Field::VARIANTS.iter().map(|field| (field.offset()..field.offset() + field.num_classes(), 1.0)).collect();
    let rows = scores.classes.reshape(((), Field::total_classes()))?.contiguous()?; // [batch * keys, classes]
    let classes = rows.apply_op1(CrossEntropy { segments, targets: classes })?;
    let objects = keys()
        .flat_map(|key| (0..OBJECT_POINTERS).map(move |idx| key.and_then(|key| key.objects[idx]).map(usize::from)))
        .collect();
    let quantities = keys()
        .flat_map(|key| (0..QUANTITY_POINTERS).map(move |idx| key.and_then(|key| key.quantities[idx]).map(usize::from)))
        .collect();
    let words =
        keys().flat_map(|key| (0..2).map(move |end| key.and_then(|key| key.span).map(|span| span[end]))).collect();
    let num_tokens = scores.unmet.dim(1)?;
    let unmet = examples.iter().flat_map(|example| {
        (0..num_tokens).map(|token_idx| example.unmet.get(token_idx).map(|unmet| usize::from(*unmet)))
    });
    let unmet = unmet.collect();
    let film_length = examples.iter().map(|example| example.film_length).collect();
    let sum = (classes + whole_rows(&scores.objects, 1.0, objects)?)?;
    let sum = (sum + whole_rows(&scores.quantities, 1.0, quantities)?)?;
    let sum = (sum + whole_rows(&scores.words, WORDS_WEIGHT, words)?)?;
    let sum = (sum + whole_rows(&scores.unmet, UNMET_WEIGHT, unmet)?)?;
    sum + whole_rows(&scores.film_length, 1.0, film_length)?
}

/// Loss of the poses of a batch, summed over the keys that have one. `out` is `[batch, keys, POSE_WIDTH]` with positions
/// relative to the anchor.
pub(super) fn pose_loss(out: &Tensor, examples: &[&Example], num_keys: usize) -> Result<Tensor> {
    let mut targets = Vec::with_capacity(examples.len() * num_keys * POSE_WIDTH);
    let mut weights = Vec::with_capacity(targets.capacity());
    for example in examples {
        let anchors = anchor_objects(&example.keys);
        for key_idx in 0..num_keys {
            let pose = example.poses.get(key_idx);
            let anchor = anchors.get(key_idx).copied().flatten().and_then(|idx| example.prompt.objects.get(idx));
            let anchor = anchor.map_or([0.0; 3], |object| object.center.as_vec3().to_array());
            targets.extend(relative(pose.copied().unwrap_or_default(), anchor).to_array());
            let weight = if pose.is_some() { POSE_WEIGHT } else { 0.0 };
            weights.extend(POSE_WEIGHTS.map(|own| own * weight));
        }
    }
    out.contiguous()?.apply_op1(Huber { targets, weights })
}

/// The pose with its position relative to an anchor.
fn relative(pose: PoseCode, anchor: [f32; 3]) -> PoseCode {
    PoseCode { position: std::array::from_fn(|axis| pose.position[axis] - anchor[axis]), ..pose }
}
