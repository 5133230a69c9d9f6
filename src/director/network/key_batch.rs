//! Keys as padded tensors.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};
use strum::VariantArray;

use super::padding::padded;
use super::prompt_batch::PromptBatch;
use crate::codes::{Field, KeyCode, MAX_SUBJECTS};
use crate::inputs::{ObjectInput, Prompt};

/// Number of values that describe a key's anchor: 1 if there is an anchor, its center, its half extents.
pub(super) const ANCHOR_WIDTH: usize = 7;

/// Keys as the decoder reads them back: emitted keys, or in training the correct ones.
#[derive(Debug, Clone)]
pub struct KeyBatch {
    /// One-hot classes of all fields: `[batch, keys, classes]`
    pub(super) classes: Tensor,
    /// Weights on the objects of arrival, departure and way; 1, 1/2, 1/4 in order: 3 x `[batch, keys, objects]`
    pub(super) objects: [Tensor; 3],
    /// Equal weights on the tokens of the key's span: `[batch, keys, tokens]`
    pub(super) words: Tensor,
    /// 1 at the last token of the span: `[batch, keys, tokens]`
    pub(super) last_word: Tensor,
    /// Box of each key's anchor object: `[batch, keys, ANCHOR_WIDTH]`
    pub(super) anchors: Tensor,
    /// `[batch * keys]`
    pub(super) key_exists: Arc<[bool]>,
}

impl KeyBatch {
    /// Pads lists of keys to the longest of them. `keys` and `prompts` have one item per prompt of `batch`.
    ///
    /// # Errors
    /// A candle error when a tensor cannot be built.
    pub fn new(keys: &[&[KeyCode]], prompts: &[&Prompt], batch: &PromptBatch) -> Result<Self> {
        let num_keys = keys.iter().map(|keys| keys.len()).max().unwrap_or(0).max(1);
        let all = || keys.iter().flat_map(|keys| padded(keys, num_keys));
        let role = |role: usize| {
            rows(all(), batch.num_objects, |key, row| {
                for (rank, pointer) in key.objects[role * MAX_SUBJECTS..(role + 1) * MAX_SUBJECTS].iter().enumerate() {
                    let idx = pointer.and_then(|pointer| usize::from(pointer).checked_sub(1));
                    if let Some(weight) = idx.and_then(|idx| row.get_mut(idx)) {
                        *weight = 0.5_f32.powi(rank as i32);
                    }
                }
            })
        };
        let tensor =
            |values: Vec<f32>, width: usize| Tensor::from_vec(values, (keys.len(), num_keys, width), &Device::Cpu);
        let num_tokens = batch.num_tokens;
        let words = rows(all(), num_tokens, |key, row| {
            if let Some([first, last]) = key.span {
                let last = last.min(num_tokens - 1);
                let share = ((last + 1).saturating_sub(first).max(1) as f32).recip();
                row[first.min(last)..=last].fill(share);
            }
        });
        let last_word = rows(all(), num_tokens, |key, row| {
            if let Some(spot) = key.span.and_then(|[_, last]| row.get_mut(last)) {
                *spot = 1.0;
            }
        });
        Ok(Self {
            classes: tensor(rows(all(), Field::total_classes(), one_hot), Field::total_classes())?,
            objects: [
                tensor(role(0), batch.num_objects)?,
                tensor(role(1), batch.num_objects)?,
                tensor(role(2), batch.num_objects)?,
            ],
            words: tensor(words, num_tokens)?,
            last_word: tensor(last_word, num_tokens)?,
            anchors: tensor(anchors(keys, prompts, num_keys), ANCHOR_WIDTH)?,
            key_exists: all().map(|key| key.is_some()).collect(),
        })
    }
}

/// One row of `width` values per key; zeros where there is no key.
fn rows<'a>(
    keys: impl Iterator<Item = Option<&'a KeyCode>>,
    width: usize,
    fill: impl Fn(&KeyCode, &mut [f32]),
) -> Vec<f32> {
    let mut out = Vec::new();
    for key in keys {
        let start = out.len();
        out.resize(start + width, 0.0);
        if let Some(key) = key {
            fill(key, &mut out[start..]);
        }
    }
    out
}

/// Sets 1 at the class of each field that has one.
fn one_hot(key: &KeyCode, row: &mut [f32]) {
    let mut offset = 0;
    for (field, class) in Field::VARIANTS.iter().zip(&key.classes) {
        if let Some(class) = class.filter(|class| usize::from(*class) < field.num_classes()) {
            row[offset + usize::from(class)] = 1.0;
        }
        offset += field.num_classes();
    }
}

/// Per key the index of its anchor, the object that its pose is relative to: the key's main object, else the anchor of the
/// key before, else `None`.
pub fn anchor_objects(keys: &[KeyCode]) -> Vec<Option<usize>> {
    let mut last = None;
    let own = keys.iter().map(|key| {
        last = key.main_object().or(last);
        last
    });
    own.collect()
}

fn anchors(keys: &[&[KeyCode]], prompts: &[&Prompt], num_keys: usize) -> Vec<f32> {
    let mut out = Vec::with_capacity(keys.len() * num_keys * ANCHOR_WIDTH);
    for (keys, prompt) in keys.iter().zip(prompts) {
        let anchors = anchor_objects(keys);
        for key_idx in 0..num_keys {
            let idx = anchors.get(key_idx).copied().flatten();
            out.extend(anchor_box(idx.and_then(|idx| prompt.objects.get(idx))));
        }
    }
    out
}

fn anchor_box(object: Option<&ObjectInput>) -> [f32; ANCHOR_WIDTH] {
    let Some(object) = object else { return [0.0; ANCHOR_WIDTH] };
    let (center, half) = (object.center.as_vec3(), object.half_extents.as_vec3());
    [1.0, center.x, center.y, center.z, half.x, half.y, half.z]
}
