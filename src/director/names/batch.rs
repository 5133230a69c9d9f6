//! Sentences and mentions as padded tensors.

use std::collections::BTreeMap;
use std::sync::Arc;

use candle_core::{Device, Result, Tensor};

use super::mention_input::{MAX_SPAN, MentionInput, NUM_MENTION_FEATURES, NUM_PAIR_FEATURES};
use super::ngrams::rows_of;
use super::sentence::{NUM_MATCHES, NUM_WORD_FEATURES, Sentence};

/// Most words of a label that count; the last ones.
const MAX_LABEL_WORDS: usize = 4;

/// Sentences, padded to the longest.
#[derive(Debug)]
pub struct SentenceBatch {
    pub(super) size: usize,
    /// Number of words of the longest sentence.
    pub num_words: usize,
    /// Rows of the n-grams of all different words, `[n-grams]`
    pub(super) ngrams: Tensor,
    /// Index of the different word that each of them belongs to, `[n-grams]`
    pub(super) ngram_words: Tensor,
    /// One over the root of the number of its n-grams for each different word, `[different, 1]`
    pub(super) ngram_weights: Tensor,
    /// Index of each word among the different ones, `[batch * words]`
    pub(super) word_rows: Tensor,
    /// `[batch, words, NUM_WORD_FEATURES]`
    pub(super) features: Tensor,
    /// `[batch * words]`
    pub(super) exists: Arc<[bool]>,
    different: BTreeMap<String, u32>,
}

impl SentenceBatch {
    /// Pads sentences.
    ///
    /// # Errors
    /// A candle error when a tensor cannot be made.
    pub fn new(sentences: &[&Sentence]) -> Result<Self> {
        let size = sentences.len();
        let num_words = sentences.iter().map(|sentence| sentence.words.len()).max().unwrap_or(0).max(1);
        let mut different: BTreeMap<String, u32> = BTreeMap::new();
        let mut order: Vec<String> = Vec::new();
        let mut row_of = |text: &str| {
            *different.entry(text.to_owned()).or_insert_with(|| {
                order.push(text.to_owned());
                order.len() as u32 - 1
            })
        };
        row_of("");
        let mut word_rows = vec![0; size * num_words];
        let mut features = vec![0.0; size * num_words * NUM_WORD_FEATURES];
        let mut exists = vec![false; size * num_words];
        for (b, sentence) in sentences.iter().enumerate() {
            for (i, word) in sentence.words.iter().enumerate() {
                let at = b * num_words + i;
                word_rows[at] = row_of(&word.text);
                exists[at] = true;
                features[at * NUM_WORD_FEATURES..(at + 1) * NUM_WORD_FEATURES].copy_from_slice(&sentence.features[i]);
            }
            for object in &sentence.scene.objects {
                object.label.texts.iter().for_each(|text| {
                    row_of(text);
                });
            }
        }
        let num_different = order.len();
        // The first different word is the padding; it gets one n-gram of weight 0.
        let (mut ngrams, mut ngram_words, mut weights) = (vec![0_u32], vec![0_u32], vec![0.0_f32]);
        for (at, text) in order.iter().enumerate().skip(1) {
            let rows = rows_of(text);
            weights.push((rows.len() as f32).sqrt().recip());
            ngram_words.extend(std::iter::repeat_n(at as u32, rows.len()));
            ngrams.extend(rows);
        }
        let device = Device::Cpu;
        Ok(Self {
            size,
            num_words,
            ngrams: Tensor::new(ngrams, &device)?,
            ngram_words: Tensor::new(ngram_words, &device)?,
            ngram_weights: Tensor::from_vec(weights, (num_different, 1), &device)?,
            word_rows: Tensor::from_vec(word_rows, size * num_words, &device)?,
            features: Tensor::from_vec(features, (size, num_words, NUM_WORD_FEATURES), &device)?,
            exists: exists.into(),
            different,
        })
    }
}

/// Mentions of a batch of sentences with the objects that they could name, padded to the most words and objects.
#[derive(Debug)]
pub struct MentionBatch {
    pub(super) size: usize,
    /// Number of objects of the largest scene.
    pub num_objects: usize,
    /// Index of each word among those of the batch, `[mentions * MAX_SPAN]`
    pub(super) words: Tensor,
    /// 0 for a word and -1e4 for padding, `[mentions, MAX_SPAN]`
    pub(super) word_mask: Tensor,
    /// `[mentions, objects * NUM_MATCHES, MAX_SPAN]`
    pub(super) matches: Tensor,
    /// `[mentions, objects, NUM_MATCHES + NUM_PAIR_FEATURES + NUM_MENTION_FEATURES]`
    pub(super) features: Tensor,
    /// `[mentions, NUM_MENTION_FEATURES]`
    pub(super) own: Tensor,
    /// 1 for an object and 0 for padding, `[mentions, objects, 1]`
    pub(super) object_mask: Tensor,
    /// Different words of the labels, `[mentions * objects * MAX_LABEL_WORDS]`
    pub(super) label_rows: Tensor,
    /// Weight of each of them, `[mentions * objects, MAX_LABEL_WORDS, 1]`
    pub(super) label_weights: Tensor,
}

impl MentionBatch {
    /// Pads mentions, each with the number of its sentence in `batch`.
    ///
    /// # Errors
    /// A candle error when a tensor cannot be made.
    pub fn new(mentions: &[(usize, &MentionInput)], sentences: &[&Sentence], batch: &SentenceBatch) -> Result<Self> {
        const WIDTH: usize = NUM_MATCHES + NUM_PAIR_FEATURES + NUM_MENTION_FEATURES;
        let size = mentions.len();
        let count = |at: usize| sentences[at].scene.objects.len();
        let num_objects = mentions.iter().map(|(at, _)| count(*at)).max().unwrap_or(0).max(1);
        let mut words = vec![0_u32; size * MAX_SPAN];
        let mut word_mask = vec![-1e4_f32; size * MAX_SPAN];
        let mut matches = vec![0.0_f32; size * num_objects * NUM_MATCHES * MAX_SPAN];
        let mut features = vec![0.0_f32; size * num_objects * WIDTH];
        let mut own = Vec::with_capacity(size * NUM_MENTION_FEATURES);
        let mut object_mask = vec![0.0_f32; size * num_objects];
        let mut label_rows = vec![0_u32; size * num_objects * MAX_LABEL_WORDS];
        let mut label_weights = vec![0.0_f32; size * num_objects * MAX_LABEL_WORDS];
        for (m, (at, mention)) in mentions.iter().enumerate() {
            own.extend(mention.own);
            for (k, word) in mention.words.clone().enumerate() {
                words[m * MAX_SPAN + k] = (at * batch.num_words + word) as u32;
                word_mask[m * MAX_SPAN + k] = 0.0;
            }
            for (o, object) in sentences[*at].scene.objects.iter().enumerate() {
                let pair = m * num_objects + o;
                object_mask[pair] = 1.0;
                for (k, row) in mention.matches.iter().enumerate() {
                    for (f, value) in row[o].iter().enumerate() {
                        matches[(pair * NUM_MATCHES + f) * MAX_SPAN + k] = *value;
                    }
                }
                let row = mention.best[o].iter().chain(&mention.pairs[o]).chain(&mention.own);
                features[pair * WIDTH..(pair + 1) * WIDTH].iter_mut().zip(row).for_each(|(to, from)| *to = *from);
                let texts = &object.label.texts;
                let texts = &texts[texts.len().saturating_sub(MAX_LABEL_WORDS)..];
                for (k, text) in texts.iter().enumerate() {
                    label_rows[pair * MAX_LABEL_WORDS + k] = batch.different.get(text).copied().unwrap_or(0);
                    label_weights[pair * MAX_LABEL_WORDS + k] = (texts.len() as f32).recip();
                }
            }
        }
        let device = Device::Cpu;
        Ok(Self {
            size,
            num_objects,
            words: Tensor::from_vec(words, size * MAX_SPAN, &device)?,
            word_mask: Tensor::from_vec(word_mask, (size, MAX_SPAN), &device)?,
            matches: Tensor::from_vec(matches, (size, num_objects * NUM_MATCHES, MAX_SPAN), &device)?,
            features: Tensor::from_vec(features, (size, num_objects, WIDTH), &device)?,
            own: Tensor::from_vec(own, (size, NUM_MENTION_FEATURES), &device)?,
            object_mask: Tensor::from_vec(object_mask, (size, num_objects, 1), &device)?,
            label_rows: Tensor::from_vec(label_rows, size * num_objects * MAX_LABEL_WORDS, &device)?,
            label_weights: Tensor::from_vec(label_weights, (size * num_objects, MAX_LABEL_WORDS, 1), &device)?,
        })
    }
}
