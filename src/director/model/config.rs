use serde::{Deserialize, Serialize};

/// Sizes of the network.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelConfig {
    /// Numbers a token.
    pub width: usize,
    /// Attention heads; they share the width.
    pub heads: usize,
    /// Numbers in the middle of a feed-forward layer.
    pub hidden: usize,
    /// Layers of the text encoder.
    pub text_layers: usize,
    /// Layers of the Q-former.
    pub object_layers: usize,
    /// Learned queries an object: the object's tokens.
    pub queries: usize,
    /// Layers of the decoder of intents.
    pub intent_layers: usize,
    /// Layers of the decoder of poses.
    pub pose_layers: usize,
    /// Numbers of a pointer's query and key.
    pub pointer_width: usize,
    /// Numbers of the encoding of one coordinate; a position takes three times as many.
    pub axis_features: usize,
    /// Tokens of the vocabulary.
    pub vocabulary: usize,
}

impl ModelConfig {
    /// The sizes of the shipped weights, for a vocabulary.
    pub fn shipped(vocabulary: usize) -> Self {
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
        }
    }

    /// Sizes for tests: everything present, nothing large.
    pub fn tiny(vocabulary: usize) -> Self {
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
        }
    }

    /// Whether a network of these sizes can be built and is of a size that anybody would train here.
    pub fn is_sound(&self) -> bool {
        let sizes = [self.width, self.heads, self.hidden, self.queries, self.pointer_width, self.vocabulary];
        let layers = [self.text_layers, self.object_layers, self.intent_layers, self.pose_layers];
        sizes.iter().all(|size| (1..=65_536).contains(size))
            && layers.iter().all(|layers| (1..=64).contains(layers))
            && self.width.is_multiple_of(self.heads)
            && self.width <= 4096
            && self.hidden <= 16_384
            && self.axis_features.is_multiple_of(2)
            && (2..=512).contains(&self.axis_features)
    }
}
