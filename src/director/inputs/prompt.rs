//! One prompt with its objects, before it is padded into a batch.

use cinesplat_language::Senses;

use super::objects::{ObjectInput, object_nowhere};

/// One prompt with its objects, in the frame of a [`SceneFrame`](crate::SceneFrame).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Prompt {
    /// Tokens; the first begins the text.
    pub tokens: Vec<TokenInput>,
    /// Number of quantities that the tokens point at.
    pub num_quantities: usize,
    /// Objects: those that the text names in the order of their slots, then others.
    pub objects: Vec<ObjectInput>,
    /// Number of objects that the text names.
    pub num_named: usize,
}

impl Prompt {
    /// The words with the first `num_objects` objects, all of them nowhere.
    pub(crate) fn placeless(&self, num_objects: usize) -> Self {
        Self {
            tokens: self.tokens.clone(),
            num_quantities: self.num_quantities,
            objects: (0..num_objects.min(self.objects.len())).map(object_nowhere).collect(),
            num_named: self.num_named,
        }
    }
}

/// One token as input of the network.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TokenInput {
    /// Row of the embedding table.
    pub id: u32,
    /// Index of the object that the token names.
    pub object: Option<usize>,
    /// Index of the quantity that the token names.
    pub quantity: Option<usize>,
    /// Kind of that quantity, from 1; 0 for other tokens.
    pub kind: u32,
    /// Senses of its word.
    pub senses: Senses,
    /// Natural logarithm of that quantity over 5, about -1.4..=1.9; 0 for other tokens.
    pub value: f32,
}
