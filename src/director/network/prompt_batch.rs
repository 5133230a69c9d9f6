//! Prompts as padded tensors.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};

use super::config::ModelConfig;
use super::padding::padded;
use crate::inputs::{ObjectInput, PAD, Prompt, TokenInput};

/// Number of kinds of quantities, plus one for all other tokens.
pub(super) const NUM_KINDS: usize = 7;

/// Prompts as padded tensors. Padding does not change the output for a prompt.
#[derive(Debug, Clone)]
pub struct PromptBatch {
    pub(super) size: usize,
    pub(super) num_tokens: usize,
    pub(super) num_objects: usize,
    /// `[batch * tokens]`
    pub(super) ids: Tensor,
    /// Rows of the table of tokens that is not BERT's: `[batch * tokens]`
    pub(super) table_ids: Tensor,
    /// `[batch * tokens]`
    pub(super) kinds: Tensor,
    /// Senses of the tokens' words, each row of length 1 or 0: `[batch * tokens, senses]`
    pub(super) senses: Tensor,
    /// `[batch, tokens, 1]`
    pub(super) values: Tensor,
    /// `[batch * tokens]`
    pub(super) token_exists: Arc<[bool]>,
    /// Weight of each token in the mentions of an object; rows sum to 1, or to 0 without a mention: `[batch, objects, tokens]`
    pub(super) object_tokens: Tensor,
    /// The same per quantity: `[batch, quantities, tokens]`
    pub(super) quantity_tokens: Tensor,
    /// `[batch * quantities]`
    pub(super) quantity_exists: Vec<bool>,
    /// `[batch * objects]`
    pub(super) slots: Tensor,
    /// Encoded box centers and half extents: `[batch * objects, 6 * axis_features]`
    pub(super) boxes: Tensor,
    /// Encoded clouds: `[batch * objects, points, 3 * axis_features]`
    pub(super) points: Tensor,
    /// `[batch * objects * points]`
    pub(super) point_exists: Arc<[bool]>,
    /// `[batch * objects]`
    pub(super) object_exists: Vec<bool>,
}

impl PromptBatch {
    /// Pads prompts to the longest of them in tokens, objects, quantities and points. `config` gives the features per axis.
    ///
    /// # Errors
    /// A candle error when a tensor cannot be built.
    pub fn new(prompts: &[&Prompt], config: &ModelConfig) -> Result<Self> {
        let longest = |count: &dyn Fn(&Prompt) -> usize| prompts.iter().map(|p| count(p)).max().unwrap_or(0).max(1);
        let num_tokens = longest(&|p| p.tokens.len());
        let num_objects = longest(&|p| p.objects.len());
        let num_quantities = longest(&|p| p.num_quantities);
        let size = prompts.len();
        let tokens = || prompts.iter().flat_map(|p| padded(&p.tokens, num_tokens));
        let objects = || prompts.iter().flat_map(|p| padded(&p.objects, num_objects));
        let exists = |count: &dyn Fn(&Prompt) -> usize, length: usize| -> Vec<bool> {
            prompts.iter().flat_map(|p| (0..length).map(|idx| idx < count(p)).collect::<Vec<_>>()).collect()
        };
        let cpu = &Device::Cpu;
        let ids: Vec<u32> = tokens().map(|t| t.map_or(PAD, |t| t.id)).collect();
        let last_row = u32::try_from(config.table_rows().saturating_sub(1)).unwrap_or(u32::MAX);
        let table_ids: Vec<u32> = ids.iter().map(|id| (*id).min(last_row)).collect();
        let kinds: Vec<u32> = tokens().map(|t| t.map_or(0, |t| t.kind)).collect();
        let values: Vec<f32> = tokens().map(|t| t.map_or(0.0, |t| t.value)).collect();
        let slots: Vec<u32> = objects().map(|o| o.map_or(PAD, |o| o.slot_token)).collect();
        let (points, point_exists) = encode_points(objects(), config)?;
        Ok(Self {
            size,
            num_tokens,
            num_objects,
            ids: Tensor::from_vec(ids, size * num_tokens, cpu)?,
            table_ids: Tensor::from_vec(table_ids, size * num_tokens, cpu)?,
            kinds: Tensor::from_vec(kinds, size * num_tokens, cpu)?,
            senses: encode_senses(tokens(), size * num_tokens, config.senses)?,
            values: Tensor::from_vec(values, (size, num_tokens, 1), cpu)?,
            token_exists: exists(&|p| p.tokens.len(), num_tokens).into(),
            object_tokens: mentions(prompts, num_objects, num_tokens, |token| token.object)?,
            quantity_tokens: mentions(prompts, num_quantities, num_tokens, |token| token.quantity)?,
            quantity_exists: exists(&|p| p.num_quantities, num_quantities),
            slots: Tensor::from_vec(slots, size * num_objects, cpu)?,
            boxes: encode_boxes(objects(), config)?,
            points,
            point_exists,
            object_exists: exists(&|p| p.objects.len(), num_objects),
        })
    }
}

/// The senses of all tokens, each row of length 1 or 0: `[num_tokens, num_senses]`
fn encode_senses<'a>(
    tokens: impl Iterator<Item = Option<&'a TokenInput>>,
    num_tokens: usize,
    num_senses: usize,
) -> Result<Tensor> {
    let mut rows = vec![0.0_f32; num_tokens * num_senses];
    for (token, row) in tokens.zip(rows.chunks_exact_mut(num_senses.max(1))) {
        let senses = token.map(|token| token.senses).unwrap_or_default();
        let known: Vec<usize> = senses.indices().filter(|index| *index < num_senses).collect();
        let length = (known.len() as f32).sqrt();
        known.into_iter().for_each(|index| row[index] = length.recip());
    }
    Tensor::from_vec(rows, (num_tokens, num_senses), &Device::Cpu)
}

/// Per object or quantity, equal weights on the tokens that name it: `[batch, items, tokens]`. `item_of` gives the index of
/// the item that a token names.
fn mentions(
    prompts: &[&Prompt],
    num_items: usize,
    num_tokens: usize,
    item_of: impl Fn(&TokenInput) -> Option<usize>,
) -> Result<Tensor> {
    let mut shares = vec![0.0_f32; prompts.len() * num_items * num_tokens];
    for (prompt, shares) in prompts.iter().zip(shares.chunks_exact_mut(num_items * num_tokens)) {
        for (token_idx, token) in prompt.tokens.iter().enumerate() {
            if let Some(item) = item_of(token).filter(|item| *item < num_items) {
                shares[item * num_tokens + token_idx] = 1.0;
            }
        }
        for row in shares.chunks_exact_mut(num_tokens) {
            let count: f32 = row.iter().sum();
            row.iter_mut().for_each(|share| *share /= count.max(1.0));
        }
    }
    Tensor::from_vec(shares, (prompts.len(), num_items, num_tokens), &Device::Cpu)
}

/// Appends sines and cosines of one coordinate, about -1..=1, at wavelengths from 2 down to 1/32.
fn encode_axis(value: f32, num_features: usize, out: &mut Vec<f32>) {
    let bands = num_features / 2;
    for band in 0..bands {
        let octave = 6.0 * band as f32 / (bands.max(2) - 1) as f32;
        let (sin, cos) = (value * std::f32::consts::PI * octave.exp2()).sin_cos();
        out.extend([sin, cos]);
    }
}

/// Features of all boxes, one sixth per coordinate of center and half extents.
fn encode_boxes<'a>(objects: impl Iterator<Item = Option<&'a ObjectInput>>, config: &ModelConfig) -> Result<Tensor> {
    let nothing = ObjectInput::default();
    let mut features = Vec::new();
    let mut count = 0;
    for object in objects {
        let object = object.unwrap_or(&nothing);
        for value in object.center.to_array().into_iter().chain(object.half_extents.to_array()) {
            encode_axis(value as f32, config.axis_features, &mut features);
        }
        count += 1;
    }
    Tensor::from_vec(features, (count, 6 * config.axis_features), &Device::Cpu)
}

/// Features of all points, one third per coordinate, and which points exist.
fn encode_points<'a>(
    objects: impl Iterator<Item = Option<&'a ObjectInput>>,
    config: &ModelConfig,
) -> Result<(Tensor, Arc<[bool]>)> {
    let clouds: Vec<&[[f32; 3]]> = objects.map(|object| object.map_or(&[][..], |object| &object.points)).collect();
    let num_points = clouds.iter().map(|cloud| cloud.len()).max().unwrap_or(0).max(1);
    let mut features = Vec::with_capacity(clouds.len() * num_points * 3 * config.axis_features);
    let mut exists = Vec::with_capacity(clouds.len() * num_points);
    for point in clouds.iter().flat_map(|cloud| padded(cloud, num_points)) {
        exists.push(point.is_some());
        match point {
            Some(point) => point.iter().for_each(|value| encode_axis(*value, config.axis_features, &mut features)),
            None => features.extend(std::iter::repeat_n(0.0, 3 * config.axis_features)),
        }
    }
    let shape = (clouds.len(), num_points, 3 * config.axis_features);
    Ok((Tensor::from_vec(features, shape, &Device::Cpu)?, exists.into()))
}
