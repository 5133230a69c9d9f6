//! Sizes of the network.

use serde::{Deserialize, Serialize};

use crate::inputs::NUM_SPECIAL_TOKENS;

/// Sizes of the network.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelConfig {
    /// Width of a token's state.
    pub width: usize,
    /// Attention heads; each has an equal part of the width.
    pub heads: usize,
    /// Hidden width of a feed-forward layer.
    pub hidden: usize,
    /// Layers of the text encoder.
    pub text_layers: usize,
    /// Layers of the Q-former.
    pub object_layers: usize,
    /// Learned queries, which become the tokens of an object.
    pub queries: usize,
    /// Layers of the intent decoder.
    pub intent_layers: usize,
    /// Layers of the pose decoder.
    pub pose_layers: usize,
    /// Width of a pointer's query and key.
    pub pointer_width: usize,
    /// Features of one coordinate; a position has three times as many.
    pub axis_features: usize,
    /// Number of tokens of the vocabulary.
    pub vocabulary: usize,
    /// Number of senses of words; 0 in networks that know none.
    #[serde(default)]
    pub senses: usize,
    /// Sizes of the part of the text encoder that was trained beforehand; `None` in networks without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bert: Option<BertConfig>,
}

impl ModelConfig {
    /// The sizes of the shipped weights, for a vocabulary of this many tokens and this many senses of words.
    pub fn shipped(vocabulary: usize, senses: usize) -> Self {
        Self {
            width: 128,
            heads: 4,
            hidden: 512,
            text_layers: 3,
            object_layers: 2,
            queries: 4,
            intent_layers: 3,
            pose_layers: 2,
            pointer_width: 64,
            axis_features: 32,
            vocabulary,
            senses,
            bert: None,
        }
    }

    /// Small sizes for tests; every kind of layer is present.
    pub fn tiny(vocabulary: usize, senses: usize) -> Self {
        Self {
            width: 16,
            heads: 2,
            hidden: 24,
            text_layers: 1,
            object_layers: 1,
            queries: 2,
            intent_layers: 1,
            pose_layers: 1,
            pointer_width: 8,
            axis_features: 8,
            vocabulary,
            senses,
            bert: Some(BertConfig { width: 12, heads: 2, hidden: 20, layers: 2, positions: 256 }),
        }
    }

    /// Rows of the table of tokens that is not BERT's.
    pub(super) fn table_rows(&self) -> usize {
        if self.bert.is_some() { NUM_SPECIAL_TOKENS + 1 } else { self.vocabulary }
    }

    /// Whether a network of these sizes can be built and is of a plausible size.
    pub(crate) fn is_sound(&self) -> bool {
        let sizes = [self.width, self.heads, self.hidden, self.queries, self.pointer_width, self.vocabulary];
        let layers = [self.text_layers, self.object_layers, self.intent_layers, self.pose_layers];
        sizes.iter().all(|size| (1..=65_536).contains(size))
            && layers.iter().all(|layers| (1..=64).contains(layers))
            && self.width.is_multiple_of(self.heads)
            && self.width <= 4096
            && self.senses <= 1024
            && self.bert.as_ref().is_none_or(BertConfig::is_sound)
            && self.hidden <= 16_384
            && self.axis_features.is_multiple_of(2)
            && (2..=512).contains(&self.axis_features)
    }
}

/// Sizes of BERT.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct BertConfig {
    /// Width of a token's state.
    pub width: usize,
    /// Attention heads; each has an equal part of the width.
    pub heads: usize,
    /// Hidden width of a feed-forward layer.
    pub hidden: usize,
    /// Number of layers.
    pub layers: usize,
    /// Number of positions: the limit on the tokens of a text.
    pub positions: usize,
}

impl BertConfig {
    /// Whether a network of these sizes can be built and is of a plausible size.
    fn is_sound(&self) -> bool {
        (1..=4096).contains(&self.width)
            && (1..=16_384).contains(&self.hidden)
            && (1..=64).contains(&self.layers)
            && (256..=4096).contains(&self.positions)
            && self.heads > 0
            && self.width.is_multiple_of(self.heads)
    }
}
