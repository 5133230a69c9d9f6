//! The names of a scene's objects, prepared for comparison with words.

use std::collections::BTreeMap;
use std::sync::Arc;

use cinesplat_language::{NamedObject, Things, Word, stem, tokenize};

/// Words that end the front of a label, after which its tail begins.
const TAIL_PREPOSITIONS: [&str; 8] = ["of", "with", "on", "in", "for", "from", "at", "under"];

/// A label in its parts.
#[derive(Debug, Clone, Default)]
pub struct Label {
    /// All words but numbers, as stems.
    pub(super) stems: Vec<String>,
    /// All words but numbers.
    pub(super) texts: Vec<String>,
    /// Index of the head within `stems`.
    pub(super) head: usize,
    /// Index of the first word after a preposition; the number of words without one.
    pub(super) tail: usize,
    /// Neighboring words in one word (`armchair` for `arm chair`).
    pub(super) joined: Vec<String>,
    /// Last number of the label.
    pub(super) number: Option<u32>,
    /// The head is a plural.
    pub(super) plural: bool,
    /// Phrases related to the thing.
    pub(super) related: BTreeMap<String, u8>,
}

impl Label {
    /// Reads a label.
    pub fn new(label: &str) -> Self {
        let words = tokenize(label);
        let number = words.iter().rev().find_map(|word| word.text.parse().ok());
        let named: Vec<_> = words.into_iter().filter(Word::is_alphabetic).collect();
        let link = named.iter().position(|word| TAIL_PREPOSITIONS.contains(&word.text.as_str())).filter(|at| *at > 0);
        let head = link.unwrap_or(named.len()).saturating_sub(1);
        let join = |pair: &[Word]| stem(&format!("{}{}", pair[0].text, pair[1].text));
        let things = Things::embedded();
        Self {
            joined: named.windows(2).map(join).collect(),
            plural: named.get(head).is_some_and(|word| word.stem != word.text),
            head,
            tail: link.map_or(named.len(), |link| link + 1),
            number,
            stems: named.iter().map(|word| word.stem.clone()).collect(),
            texts: named.into_iter().map(|word| word.text).collect(),
            related: things.related(&things.kinds_of(label)),
        }
    }

    /// Stems of the words of the label but numbers.
    pub fn stems(&self) -> &[String] {
        &self.stems
    }

    /// Relations of a phrase (stems, separated by spaces) to the thing: a set of
    /// [`Relation`](cinesplat_language::Relation)s.
    pub fn relations(&self, phrase: &str) -> u8 {
        self.related.get(phrase).copied().unwrap_or(0)
    }

    pub(super) fn head_stem(&self) -> &str {
        self.stems.get(self.head).map_or("", String::as_str)
    }
}

/// An object with its prepared name.
#[derive(Debug, Clone)]
pub struct SceneObject {
    /// Its id.
    pub id: u32,
    /// Its name.
    pub label: Arc<Label>,
    /// Number of objects of a lower id with the same name.
    pub(super) rank: usize,
    /// Number of objects with the same name.
    pub(super) num_same: usize,
}

/// The objects of a scene by ascending id.
#[derive(Debug, Clone, Default)]
pub struct SceneNames {
    /// The objects.
    pub objects: Vec<SceneObject>,
}

impl SceneNames {
    /// Prepares the names of a scene. `label` reads a label, so that a caller can keep what it has read.
    pub fn new(objects: &[NamedObject], label: &mut dyn FnMut(&str) -> Arc<Label>) -> Self {
        let mut sorted: Vec<&NamedObject> = objects.iter().collect();
        sorted.sort_by_key(|object| object.id);
        let mut labels: Vec<Arc<Label>> = Vec::new();
        for object in &sorted {
            labels.push(label(&object.label));
        }
        let objects = sorted.iter().enumerate().map(|(at, object)| {
            let is_same = |other: &usize| labels[*other].stems == labels[at].stems;
            SceneObject {
                id: object.id,
                label: labels[at].clone(),
                rank: (0..at).filter(is_same).count(),
                num_same: (0..labels.len()).filter(is_same).count(),
            }
        });
        Self { objects: objects.collect() }
    }
}
