//! Examples of the network of names.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use cinesplat_director::DirectorError;
use cinesplat_director::names::{Label, MentionInput, NameWord, SceneNames, Sentence, name_words};
use cinesplat_language::{Mention, NamedObject, tokenize};

use crate::corpus::Writer;

/// Words of a sentence: outside of mentions one by one, or those of a mention with the ids of its objects.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    Word(NameWord),
    Mention { words: Vec<NameWord>, ids: Vec<u32> },
}

/// A sentence about a scene, that can be changed.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct RawExample {
    pub(super) pieces: Vec<Piece>,
    pub(super) objects: Vec<NamedObject>,
}

impl RawExample {
    pub(super) fn new(prompt: &str, mentions: &[Mention], objects: &[NamedObject]) -> Self {
        let mut pieces = Vec::new();
        let mut open: Option<usize> = None;
        for word in name_words(&tokenize(prompt)) {
            let at = mentions.iter().position(|m| (m.bytes[0]..m.bytes[1]).contains(&word.bytes[0]));
            match (at, pieces.last_mut()) {
                (Some(at), Some(Piece::Mention { words, .. })) if open == Some(at) => words.push(word),
                (Some(at), _) => {
                    let ids = mentions[at].ids.iter().copied().filter(|id| objects.iter().any(|o| o.id == *id));
                    pieces.push(Piece::Mention { words: vec![word], ids: ids.collect() });
                }
                (None, _) => pieces.push(Piece::Word(word)),
            }
            open = at;
        }
        Self { pieces, objects: objects.to_vec() }
    }

    /// All words in order.
    pub(super) fn words(&self) -> Vec<NameWord> {
        self.pieces
            .iter()
            .flat_map(|piece| match piece {
                Piece::Word(word) => std::slice::from_ref(word),
                Piece::Mention { words, .. } => words.as_slice(),
            })
            .cloned()
            .collect()
    }

    /// The words of each mention, and its ids.
    pub(super) fn mentions(&self) -> Vec<(Range<usize>, Vec<u32>)> {
        let mut at = 0;
        let mut out = Vec::new();
        for piece in &self.pieces {
            match piece {
                Piece::Word(_) => at += 1,
                Piece::Mention { words, ids } => {
                    out.push((at..at + words.len(), ids.clone()));
                    at += words.len();
                }
            }
        }
        out
    }

    /// Label of an object.
    pub(super) fn label(&self, id: u32) -> Option<&str> {
        self.objects.iter().find(|object| object.id == id).map(|object| object.label.as_str())
    }
}

/// Labels that have been read.
#[derive(Debug, Default)]
pub(super) struct Labels(BTreeMap<String, Arc<Label>>);

impl Labels {
    pub(super) fn get(&mut self, label: &str) -> Arc<Label> {
        if let Some(found) = self.0.get(label) {
            return found.clone();
        }
        let new = Arc::new(Label::new(label));
        self.0.insert(label.to_owned(), new.clone());
        new
    }
}

/// An example as the network reads it.
#[derive(Debug, Clone)]
pub(super) struct Example {
    pub(super) sentence: Sentence,
    /// Tag of each word.
    pub(super) tags: Vec<usize>,
    pub(super) mentions: Vec<MentionInput>,
    /// Indices of the objects of each mention.
    pub(super) targets: Vec<Vec<usize>>,
}

impl Example {
    pub(super) fn new(raw: &RawExample, labels: &mut Labels) -> Result<Self, DirectorError> {
        let scene = SceneNames::new(&raw.objects, &mut |label| labels.get(label));
        let sentence = Sentence::new(raw.words(), scene)?;
        let mut tags = vec![0; sentence.words.len()];
        let (mut mentions, mut targets): (Vec<MentionInput>, Vec<Vec<usize>>) = (Vec::new(), Vec::new());
        for (words, ids) in raw.mentions().into_iter().filter(|(words, _)| !words.is_empty()) {
            tags[words.clone()].fill(2);
            tags[words.start] = 1;
            let index = |id: &u32| sentence.scene.objects.iter().position(|object| object.id == *id);
            mentions.push(MentionInput::new(&sentence, words, &targets));
            targets.push(ids.iter().filter_map(index).collect());
        }
        Ok(Self { sentence, tags, mentions, targets })
    }
}

/// The examples of writers.
pub(super) fn examples_of(writers: &[Writer]) -> Vec<RawExample> {
    let of = |writer: &Writer| {
        let example = |sentence: &crate::corpus::CorpusSentence| {
            let objects = writer.scenes.get(&sentence.scene).map_or(&[][..], Vec::as_slice);
            RawExample::new(&sentence.prompt, &sentence.mentions, objects)
        };
        writer.sentences.iter().map(example).collect::<Vec<_>>()
    };
    writers.iter().flat_map(of).collect()
}
