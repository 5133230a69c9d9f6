//! A linked prompt and a scene's objects as the network reads them, and what its choices mean in them.

use glam::DVec3;

use super::DirectorError;
use super::codes::Grounding;
use super::coverage::tells_of_move;
use super::frame::SceneFrame;
use super::model::{ObjectInput, Prompt, TokenInput};
use super::vocabulary::{BEGIN, Token, Vocabulary, object_token};
use cinesplat_language::{Linked, Quantity, QuantityKind};
use cinesplat_objects::Object;
use cinesplat_operator::Amount;

/// Points of an object's cloud that the network sees.
pub const MAX_POINTS: usize = 64;
/// Objects beside those that the text names that the network sees.
pub const MAX_OTHERS: usize = 12;

/// What the places of a prompt stand for.
#[derive(Debug, Clone, Default)]
pub struct Ground {
    /// Object ids by place: the slots, then the others.
    pub ids: Vec<u32>,
    pub quantities: Vec<Quantity>,
    /// Byte range of the prompt and quantity for every token, the one that begins the text first.
    tokens: Vec<GroundToken>,
}

#[derive(Debug, Clone, Copy)]
struct GroundToken {
    bytes: [usize; 2],
    /// Which word of the text it is of.
    word: Option<usize>,
    quantity: Option<usize>,
}

/// Reads a linked text: tokens as the network wants them (`others` are the ids of the objects that follow the slots).
pub fn ground(
    linked: &Linked,
    others: &[u32],
    vocabulary: &Vocabulary,
) -> Result<(Vec<TokenInput>, Ground), DirectorError> {
    let tokens = vocabulary.encode(&linked.tokens_text)?;
    let word_starts = word_starts(&linked.tokens_text);
    let mut inputs = vec![TokenInput { id: BEGIN, ..TokenInput::default() }];
    let mut grounds = vec![GroundToken { bytes: [0, 0], word: None, quantity: None }];
    for token in tokens {
        let word_idx = word_starts.partition_point(|start| *start <= token.bytes[0]).saturating_sub(1);
        let input = token_input(token, &linked.quantities);
        let bytes = linked.spans.get(word_idx).copied().unwrap_or([0, 0]);
        grounds.push(GroundToken { bytes, word: Some(word_idx), quantity: input.quantity });
        inputs.push(input);
    }
    let ids = linked.slots.iter().chain(others).copied().collect();
    Ok((inputs, Ground { ids, quantities: linked.quantities.clone(), tokens: grounds }))
}

/// Where the words of a text with single spaces begin.
fn word_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.bytes().enumerate().filter(|(_, b)| *b == b' ').map(|(at, _)| at + 1)).collect()
}

fn token_input(token: Token, quantities: &[Quantity]) -> TokenInput {
    let quantity = token.quantity_slot().and_then(|place| quantities.get(place).map(|quantity| (place, quantity)));
    TokenInput {
        id: token.id,
        object: token.object_slot(),
        quantity: quantity.map(|(place, _)| place),
        kind: quantity.map_or(0, |(_, quantity)| kind_number(quantity.kind)),
        value: quantity.map_or(0.0, |(_, quantity)| (quantity.value.clamp(1e-3, 1e4).ln() / 5.0) as f32),
    }
}

fn kind_number(kind: QuantityKind) -> u32 {
    match kind {
        QuantityKind::Seconds => 1,
        QuantityKind::Degrees => 2,
        QuantityKind::Units => 3,
        QuantityKind::Factor => 4,
    }
}

impl Ground {
    /// For every quantity whether it is a time.
    pub fn is_time(&self) -> Vec<bool> {
        self.quantities.iter().map(|quantity| quantity.kind == QuantityKind::Seconds).collect()
    }

    /// For every token whether it begins a word of `text` that surely tells of a move.
    pub fn is_move(&self, text: &str) -> Vec<bool> {
        let words: Vec<&str> = text.split(' ').collect();
        let mut last = None;
        let mut begins = |token: &GroundToken| {
            let word = std::mem::replace(&mut last, token.word);
            token.word.filter(|idx| word != Some(*idx)).and_then(|idx| words.get(idx))
        };
        self.tokens.iter().map(|token| begins(token).is_some_and(|word| tells_of_move(word))).collect()
    }

    /// The quantity of this kind and value: the first within `span`, else the first at all.
    fn quantity_place(&self, kind: QuantityKind, value: f64, span: Option<[usize; 2]>) -> Option<usize> {
        let fits = |quantity: &Quantity| {
            quantity.kind == kind && (quantity.value - value).abs() <= 1e-6 * value.abs().max(1.0)
        };
        let is_place = |place: &usize| self.quantities.get(*place).is_some_and(fits);
        let inside = span.and_then(|[first, last]| {
            let tokens = self.tokens.get(first..=last).unwrap_or_default();
            tokens.iter().filter_map(|token| token.quantity).find(is_place)
        });
        inside.or_else(|| (0..self.quantities.len()).find(is_place))
    }
}

impl Grounding for Ground {
    fn object_place(&self, id: u32) -> Option<usize> {
        self.ids.iter().position(|known| *known == id)
    }

    fn object_id(&self, place: usize) -> Option<u32> {
        self.ids.get(place).copied()
    }

    fn amount_place(&self, amount: Amount, span: Option<[usize; 2]>) -> Option<usize> {
        match amount {
            Amount::Degrees(value) => self.quantity_place(QuantityKind::Degrees, value, span),
            Amount::Units(value) => self.quantity_place(QuantityKind::Units, value, span),
            Amount::Factor(value) => self.quantity_place(QuantityKind::Factor, value, span),
            Amount::Slight | Amount::Large => None,
        }
    }

    fn amount(&self, place: usize) -> Option<Amount> {
        let quantity = self.quantities.get(place)?;
        match quantity.kind {
            QuantityKind::Seconds => None,
            QuantityKind::Degrees => Some(Amount::Degrees(quantity.value)),
            QuantityKind::Units => Some(Amount::Units(quantity.value)),
            QuantityKind::Factor => Some(Amount::Factor(quantity.value)),
        }
    }

    fn seconds_place(&self, secs: f64, span: Option<[usize; 2]>) -> Option<usize> {
        self.quantity_place(QuantityKind::Seconds, secs, span)
    }

    fn seconds(&self, place: usize) -> Option<f64> {
        let is_time = |quantity: &&Quantity| quantity.kind == QuantityKind::Seconds;
        self.quantities.get(place).filter(is_time).map(|quantity| quantity.value)
    }

    fn tokens(&self, bytes: [usize; 2]) -> Option<[usize; 2]> {
        let inside = |token: &GroundToken| token.bytes[0] < bytes[1] && token.bytes[1] > bytes[0];
        let first = self.tokens.iter().position(inside)?;
        let last = self.tokens.iter().rposition(inside)?;
        Some([first, last])
    }

    fn bytes(&self, tokens: [usize; 2]) -> Option<[usize; 2]> {
        let [first, last] = tokens.map(|token_idx| self.tokens.get(token_idx));
        Some([first?.bytes[0], last?.bytes[1]]).filter(|[start, end]| start < end)
    }
}

/// A whole prompt: text and objects, of which the text names the first `num_named`.
pub fn prompt(tokens: Vec<TokenInput>, objects: Vec<ObjectInput>, ground: &Ground, num_named: usize) -> Prompt {
    Prompt { tokens, num_quantities: ground.quantities.len(), objects, num_named }
}

/// An object in the scene's frame, with at most [`MAX_POINTS`] points of its cloud, called `<obj-slot>`.
pub fn object_input(object: &Object, slot: usize, frame: &SceneFrame) -> ObjectInput {
    let half_extents = frame.half_extents(object.half_extents, object.rotation);
    let stride = object.points.len().div_ceil(MAX_POINTS).max(1);
    let points: Vec<DVec3> = object.points.iter().step_by(stride).map(|point| frame.point(*point)).collect();
    let centroid = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let scale = half_extents.length().max(1e-9).recip();
    ObjectInput {
        slot_token: object_token(slot),
        center: frame.point(object.center),
        half_extents,
        points: points
            .iter()
            .map(|point| ((*point - centroid) * scale).clamp_length_max(4.0).as_vec3().to_array())
            .collect(),
    }
}

/// Ids of the objects that the network sees beside the named ones: the nearest to the first named, else the largest.
pub fn others(objects: &[Object], named: &[u32]) -> Vec<u32> {
    let about = named.first().and_then(|id| objects.iter().find(|object| object.id == *id)).map(|object| object.center);
    let rank = |object: &Object| about.map_or(-object.radius(), |about| object.center.distance(about));
    let mut others: Vec<(f64, u32)> =
        objects.iter().filter(|object| !named.contains(&object.id)).map(|object| (rank(object), object.id)).collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    others.into_iter().take(MAX_OTHERS).map(|(_, id)| id).collect()
}
