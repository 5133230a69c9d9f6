//! Prompts and keys as padded tensors.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};
use glam::DVec3;

use super::super::codes::{Field, KeyCode, PLACES};
use super::super::vocabulary::PAD;
use super::config::ModelConfig;

/// One prompt with its objects, in the scene's frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Prompt {
    /// Its tokens, the beginning first.
    pub tokens: Vec<TokenInput>,
    /// Number of quantities that its tokens point at.
    pub num_quantities: usize,
    /// The objects: those that the text names in order of their places, then others.
    pub objects: Vec<ObjectInput>,
    /// How many of them the text names.
    pub num_named: usize,
}

/// One token as the network reads it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TokenInput {
    /// Row of the embedding table.
    pub id: u32,
    /// Place of the object that it names.
    pub object: Option<usize>,
    /// Place of the quantity that it names.
    pub quantity: Option<usize>,
    /// Kind of that quantity, from 1; 0 for other tokens.
    pub kind: u32,
    /// Logarithm of that quantity, about -1..=1.
    pub value: f32,
}

/// One object as the network sees it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjectInput {
    /// Token id of its slot.
    pub slot_token: u32,
    /// Middle of its box, in the scene's frame.
    pub center: DVec3,
    /// Half of its extent along the frame's axes.
    pub half_extents: DVec3,
    /// Its cloud about its centroid, in units of its box's half diagonal.
    pub points: Vec<[f32; 3]>,
}

/// Prompts side by side.
#[derive(Debug, Clone)]
pub struct PromptBatch {
    pub(super) size: usize,
    pub(super) num_tokens: usize,
    pub(super) num_objects: usize,
    /// `[batch * tokens]`
    pub(super) ids: Tensor,
    /// `[batch * tokens]`
    pub(super) kinds: Tensor,
    /// `[batch, tokens, 1]`
    pub(super) values: Tensor,
    pub(super) token_exists: Arc<[bool]>,
    /// Share of each token in the mentions of an object, rows sum to 1 or 0: `[batch, objects, tokens]`
    pub(super) object_tokens: Tensor,
    /// The same for quantities: `[batch, quantities, tokens]`
    pub(super) quantity_tokens: Tensor,
    pub(super) quantity_exists: Vec<bool>,
    /// `[batch * objects]`
    pub(super) slots: Tensor,
    /// Encoded box centers and half extents: `[batch * objects, 6 * axis_features]`
    pub(super) boxes: Tensor,
    /// Encoded clouds: `[batch * objects, points, 3 * axis_features]`
    pub(super) points: Tensor,
    pub(super) point_exists: Arc<[bool]>,
    pub(super) object_exists: Vec<bool>,
}

impl PromptBatch {
    /// Pads prompts to the longest of them.
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
        let kinds: Vec<u32> = tokens().map(|t| t.map_or(0, |t| t.kind)).collect();
        let values: Vec<f32> = tokens().map(|t| t.map_or(0.0, |t| t.value)).collect();
        let slots: Vec<u32> = objects().map(|o| o.map_or(PAD, |o| o.slot_token)).collect();
        let (points, point_exists) = encode_points(objects(), config)?;
        Ok(Self {
            size,
            num_tokens,
            num_objects,
            ids: Tensor::from_vec(ids, size * num_tokens, cpu)?,
            kinds: Tensor::from_vec(kinds, size * num_tokens, cpu)?,
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

/// The items, then `None` up to `length`.
fn padded<T>(items: &[T], length: usize) -> impl Iterator<Item = Option<&T>> {
    items.iter().map(Some).chain(std::iter::repeat(None)).take(length)
}

/// For every place the tokens that name it, in equal shares: `[batch, places, tokens]`.
fn mentions(
    prompts: &[&Prompt],
    num_places: usize,
    num_tokens: usize,
    place_of: impl Fn(&TokenInput) -> Option<usize>,
) -> Result<Tensor> {
    let mut shares = vec![0.0_f32; prompts.len() * num_places * num_tokens];
    for (prompt, shares) in prompts.iter().zip(shares.chunks_exact_mut(num_places * num_tokens)) {
        for (token_idx, token) in prompt.tokens.iter().enumerate() {
            if let Some(place) = place_of(token).filter(|place| *place < num_places) {
                shares[place * num_tokens + token_idx] = 1.0;
            }
        }
        for row in shares.chunks_exact_mut(num_tokens) {
            let count: f32 = row.iter().sum();
            row.iter_mut().for_each(|share| *share /= count.max(1.0));
        }
    }
    Tensor::from_vec(shares, (prompts.len(), num_places, num_tokens), &Device::Cpu)
}

/// Sines and cosines of one coordinate, about -1..=1, at wavelengths from 2 down to 1/32.
fn encode_axis(value: f32, num_features: usize, out: &mut Vec<f32>) {
    let bands = num_features / 2;
    for band in 0..bands {
        let octave = 6.0 * band as f32 / (bands.max(2) - 1) as f32;
        let (sin, cos) = (value * std::f32::consts::PI * octave.exp2()).sin_cos();
        out.extend([sin, cos]);
    }
}

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

/// The feature of a point is split in three parts, one for each of its coordinates about the object's centroid.
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

/// A camera in the scene's frame, as the pose heads put it out.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseCode {
    /// Camera center in scene sizes.
    pub position: [f32; 3],
    /// First two columns of the rotation.
    pub rotation_6d: [f32; 6],
    /// Vertical field of view over 50 degrees, logarithm.
    pub log_fov: f32,
    /// Logarithm of 1 + the seconds since the key before.
    pub log_wait: f32,
}

/// Numbers of a [`PoseCode`].
pub const POSE_WIDTH: usize = 11;
/// Numbers that say where the object that a key is about stands: whether there is one, center, half extents.
pub const ANCHOR_WIDTH: usize = 7;

impl PoseCode {
    /// All numbers in order.
    pub fn to_array(self) -> [f32; POSE_WIDTH] {
        let mut out = [0.0; POSE_WIDTH];
        out[..3].copy_from_slice(&self.position);
        out[3..9].copy_from_slice(&self.rotation_6d);
        out[9] = self.log_fov;
        out[10] = self.log_wait;
        out
    }
}

/// Keys that were emitted (or, in training, should be), as the decoder reads them back.
#[derive(Debug, Clone)]
pub struct KeyBatch {
    /// One-hot classes of all fields: `[batch, keys, classes]`
    pub(super) classes: Tensor,
    /// Weights on the objects of arrival, departure and way, the first the most: 3 x `[batch, keys, objects]`
    pub(super) objects: [Tensor; 3],
    /// Equal shares on the tokens of the key's words: `[batch, keys, tokens]`
    pub(super) words: Tensor,
    /// One on the last of them: `[batch, keys, tokens]`
    pub(super) last_word: Tensor,
    /// The object that each key is about: `[batch, keys, ANCHOR_WIDTH]`
    pub(super) anchors: Tensor,
    pub(super) key_exists: Arc<[bool]>,
}

impl KeyBatch {
    /// Pads lists of keys to the longest of them; `prompts` are those of the batch.
    pub fn new(keys: &[&[KeyCode]], prompts: &[&Prompt], batch: &PromptBatch) -> Result<Self> {
        let num_keys = keys.iter().map(|keys| keys.len()).max().unwrap_or(0).max(1);
        let all = || keys.iter().flat_map(|keys| padded(keys, num_keys));
        let role = |role: usize| {
            rows(all(), batch.num_objects, |key, row| {
                for (rank, place) in key.objects[role * PLACES..(role + 1) * PLACES].iter().enumerate() {
                    let place = place.and_then(|place| usize::from(place).checked_sub(1));
                    if let Some(weight) = place.and_then(|place| row.get_mut(place)) {
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

/// One row of `width` numbers a key, zeros where there is no key.
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

fn one_hot(key: &KeyCode, row: &mut [f32]) {
    let mut offset = 0;
    for (field, class) in Field::ALL.iter().zip(&key.classes) {
        if let Some(class) = class.filter(|class| usize::from(*class) < field.num_classes()) {
            row[offset + usize::from(class)] = 1.0;
        }
        offset += field.num_classes();
    }
}

/// The box of the object that each key is about: its own, else that of the nearest key before, else none.
pub fn anchor_places(keys: &[KeyCode]) -> Vec<Option<usize>> {
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
        let places = anchor_places(keys);
        for key_idx in 0..num_keys {
            let place = places.get(key_idx).copied().flatten();
            out.extend(anchor(place.and_then(|place| prompt.objects.get(place))));
        }
    }
    out
}

fn anchor(object: Option<&ObjectInput>) -> [f32; ANCHOR_WIDTH] {
    let Some(object) = object else { return [0.0; ANCHOR_WIDTH] };
    let (center, half) = (object.center.as_vec3(), object.half_extents.as_vec3());
    [1.0, center.x, center.y, center.z, half.x, half.y, half.z]
}
