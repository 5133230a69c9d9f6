//! The network of names: a tagger over words, and a pointer from mentions to objects.

use candle_core::{D, Module, Result, Tensor};
use candle_nn::Activation;
use serde::{Deserialize, Serialize};

use super::batch::{MentionBatch, SentenceBatch};
use super::mention_input::{MAX_SPAN, NUM_MENTION_FEATURES, NUM_PAIR_FEATURES};
use super::ngrams::NUM_BUCKETS;
use super::sentence::{NUM_MATCHES, NUM_WORD_FEATURES};
use crate::network::{
    AttentionLayer, Dropout, FeedForward, Linear, Norm, Parameters, Start, Visibility, matrix_product,
};

/// Number of tags: outside, first word of a mention, further word.
pub const NUM_TAGS: usize = 3;

/// Sizes of the network.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NamesConfig {
    /// Rows of the table of n-grams.
    buckets: usize,
    /// Width of a word's vector.
    embedding: usize,
    /// Width of a word's state.
    width: usize,
    /// Attention heads.
    heads: usize,
    /// Hidden width of a feed-forward layer.
    hidden: usize,
    /// Layers over the words.
    layers: usize,
    /// Width of a mention and an object together.
    pair: usize,
    /// Width of a pointer's query and key.
    pointer: usize,
}

impl Default for NamesConfig {
    fn default() -> Self {
        Self { buckets: NUM_BUCKETS, embedding: 48, width: 96, heads: 4, hidden: 192, layers: 2, pair: 64, pointer: 32 }
    }
}

impl NamesConfig {
    /// Small sizes for tests.
    pub fn tiny() -> Self {
        Self { embedding: 8, width: 16, heads: 2, hidden: 16, layers: 1, pair: 16, pointer: 8, ..Self::default() }
    }

    /// Whether a network of these sizes can be built and is of a plausible size.
    pub(super) fn is_sound(&self) -> bool {
        let sizes = [self.embedding, self.width, self.heads, self.hidden, self.pair, self.pointer];
        self.buckets == NUM_BUCKETS
            && sizes.iter().all(|size| (1..=4096).contains(size))
            && (1..=16).contains(&self.layers)
            && self.width.is_multiple_of(self.heads)
    }
}

/// The network.
#[derive(Debug, Clone)]
pub struct NamesNetwork {
    table: Tensor,
    word: Linear,
    features: Linear,
    layers: Vec<(AttentionLayer, FeedForward)>,
    norm: Norm,
    tag: Linear,
    focus: Linear,
    query: Linear,
    key: Linear,
    context: Linear,
    pair: Linear,
    decide: Linear,
    object: Linear,
    lack: Linear,
    missing: Linear,
}

/// States of the words of a batch and the vectors of its different words.
#[derive(Debug, Clone)]
pub struct WordStates {
    /// `[batch, words, width]`
    states: Tensor,
    /// `[different, embedding]`
    vectors: Tensor,
}

/// Scores of mentions.
#[derive(Debug, Clone)]
pub struct MentionScores {
    /// No and yes for each object, `[mentions * objects, 2]`
    pub objects: Tensor,
    /// No and yes for a thing that the scene lacks, `[mentions, 2]`
    pub missing: Tensor,
}

impl NamesNetwork {
    /// Builds the network from fresh or stored parameters.
    ///
    /// # Errors
    /// A candle error when a stored parameter is missing or has another shape.
    pub fn new(parameters: &mut Parameters, config: &NamesConfig) -> Result<Self> {
        let &NamesConfig { embedding, width, heads, hidden, pair, pointer, .. } = config;
        let layer = |at: usize, parameters: &mut Parameters| {
            let attention = AttentionLayer::over_sequence(parameters, &format!("words.{at}.attention"), width, heads)?;
            Ok((attention, FeedForward::new(parameters, &format!("words.{at}.feed"), width, hidden)?))
        };
        let p = parameters;
        let pair_width = 2 * NUM_MATCHES + NUM_PAIR_FEATURES + NUM_MENTION_FEATURES + 2 * pointer;
        Ok(Self {
            table: p.get("words.table", &[config.buckets, embedding], Start::Normal(0.3))?,
            word: Linear::new(p, "words.vector", embedding, width)?,
            features: Linear::biased(p, "words.features", NUM_WORD_FEATURES, width)?,
            layers: (0..config.layers).map(|at| layer(at, p)).collect::<Result<_>>()?,
            norm: Norm::new(p, "words.norm", width)?,
            tag: Linear::biased(p, "tag", width, NUM_TAGS)?,
            focus: Linear::biased(p, "pointer.focus", width, 1)?,
            query: Linear::new(p, "pointer.query", width, pointer)?,
            key: Linear::new(p, "pointer.key", embedding, pointer)?,
            context: Linear::new(p, "pointer.context", width, pointer)?,
            pair: Linear::biased(p, "pointer.pair", pair_width, pair)?,
            decide: Linear::biased(p, "pointer.decide", 2 * pair, pair)?,
            object: Linear::biased(p, "pointer.object", pair, 2)?,
            lack: Linear::biased(p, "pointer.lack", pair + width + NUM_MENTION_FEATURES, pair)?,
            missing: Linear::biased(p, "pointer.missing", pair, 2)?,
        })
    }

    /// States of all words.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn states(&self, batch: &SentenceBatch, dropout: &Dropout) -> Result<WordStates> {
        let width = self.table.dim(1)?;
        let rows = self.table.index_select(&batch.ngrams, 0)?; // [n-grams, embedding]
        let empty = Tensor::zeros((batch.ngram_weights.dim(0)?, width), rows.dtype(), rows.device())?;
        let sums = empty.index_add(&batch.ngram_words, &rows, 0)?; // [different, embedding]
        // Whole words are dropped too, so that the network also learns to read words that it has never seen.
        let vectors = dropout.apply(&sums.broadcast_mul(&dropout.apply(&batch.ngram_weights)?)?)?; // [different, embedding]
        let words = vectors.index_select(&batch.word_rows, 0)?.reshape((batch.size, batch.num_words, width))?; // [batch, words, embedding]
        let mut states = (self.word.apply(&words)? + self.features.apply(&batch.features)?)?;
        let all = Visibility { exists: batch.exists.clone(), causal: false };
        for (attention, feed) in &self.layers {
            states = feed.apply(&attention.apply(&states, None, &all, dropout)?, dropout)?;
        }
        Ok(WordStates { states: self.norm.apply(&states)?, vectors })
    }

    /// Scores of the tags, `[batch * words, NUM_TAGS]`.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn tags(&self, words: &WordStates) -> Result<Tensor> {
        self.tag.apply(&words.states)?.reshape(((), NUM_TAGS)) // [batch * words, tags]
    }

    /// Scores of mentions.
    ///
    /// # Errors
    /// A candle error when a tensor operation fails.
    pub fn point(&self, words: &WordStates, batch: &MentionBatch, dropout: &Dropout) -> Result<MentionScores> {
        let (size, objects) = (batch.size, batch.num_objects);
        let width = words.states.dim(2)?;
        let states = words.states.reshape(((), width))?; // [batch * words, width]
        let inside = states.index_select(&batch.words, 0)?.reshape((size, MAX_SPAN, width))?; // [mentions, span, width]
        let focus = (self.focus.apply(&inside)?.squeeze(2)? + &batch.word_mask)?; // [mentions, span]
        let weights = candle_nn::ops::softmax(&focus, D::Minus1)?.unsqueeze(2)?; // [mentions, span, 1]
        let vector = dropout.apply(&inside.broadcast_mul(&weights)?.sum(1)?)?; // [mentions, width]
        let focused = matrix_product(&batch.matches, &weights)?.reshape((size, objects, NUM_MATCHES))?; // [mentions, objects, matches]
        let (_, embedding) = words.vectors.dims2()?;
        let labels = words.vectors.index_select(&batch.label_rows, 0)?.reshape((size * objects, (), embedding))?; // [pairs, words, embedding]
        let labels = labels.broadcast_mul(&batch.label_weights)?.sum(1)?; // [pairs, embedding]
        let keys = self.key.apply(&labels)?.reshape((size, objects, ()))?; // [mentions, objects, pointer]
        let product = keys.broadcast_mul(&self.query.apply(&vector)?.unsqueeze(1)?)?;
        let context = self.context.apply(&vector)?.unsqueeze(1)?.broadcast_as(product.shape())?;
        let pairs = Tensor::cat(&[&batch.features, &focused, &product, &context.contiguous()?], 2)?;
        let pairs = Activation::Silu.forward(&self.pair.apply(&pairs)?)?; // [mentions, objects, pair]
        let best = pairs.broadcast_mul(&batch.object_mask)?.max_keepdim(1)?; // [mentions, 1, pair]
        let behind = pairs.broadcast_sub(&best)?;
        let decided = Activation::Silu.forward(&self.decide.apply(&Tensor::cat(&[&pairs, &behind], 2)?)?)?;
        let lack = Tensor::cat(&[&best.squeeze(1)?, &vector, &batch.own], 1)?; // [mentions, pair + width + features]
        let lack = Activation::Silu.forward(&self.lack.apply(&lack)?)?;
        Ok(MentionScores {
            objects: self.object.apply(&dropout.apply(&decided)?)?.reshape(((), 2))?, // [mentions * objects, 2]
            missing: self.missing.apply(&dropout.apply(&lack)?)?,
        })
    }
}
