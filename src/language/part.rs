//! A part of a linked prompt as a prompt of its own.

use super::linked::{Linked, OBJECT, QUANTITY, slot_of};
use super::quantity::{Quantity, QuantityKind};

/// Pronouns that stand for the subject of the part before.
const PRONOUNS: [&str; 5] = ["it", "them", "that", "this", "those"];

/// Bare numbers that are times in a list of times, seconds.
const LISTED_SECS: std::ops::RangeInclusive<f64> = 0.1..=120.0;

impl Linked {
    /// The words that begin in `bytes`, with their objects and quantities numbered anew. In a part that names no
    /// object, pronouns stand for `antecedent`, the id of an object or group.
    #[must_use]
    pub fn part(&self, bytes: [usize; 2], antecedent: Option<u32>) -> Self {
        let names_object = self.words_in(bytes).any(|(word, _)| word.starts_with(OBJECT));
        self.of_words(self.words_in(bytes), antecedent.filter(|_| !names_object))
    }

    /// All words but those that begin in some bytes, with their objects and quantities numbered anew; the parts stay. In
    /// what names no object, pronouns stand for `antecedent`.
    #[must_use]
    pub fn without(&self, bytes: &[[usize; 2]], antecedent: Option<u32>) -> Self {
        let is_left = |span: &[usize; 2]| !bytes.iter().any(|[from, to]| (*from..*to).contains(&span[0]));
        let left = || self.words_in([0, usize::MAX]).filter(|(_, span)| is_left(span));
        let names_object = left().any(|(word, _)| word.starts_with(OBJECT));
        Self { timeline: self.timeline.clone(), ..self.of_words(left(), antecedent.filter(|_| !names_object)) }
    }

    /// Some of the words, with their objects and quantities numbered anew.
    pub(crate) fn of_words<'a>(
        &self,
        words: impl Iterator<Item = (&'a str, [usize; 2])>,
        antecedent: Option<u32>,
    ) -> Self {
        let mut part = Self {
            groups: self.groups.clone(),
            wholes: self.wholes.clone(),
            parts: self.parts.clone(),
            unknown: self.unknown.clone(),
            ..Self::default()
        };
        for (word, span) in words {
            let id = match slot_of(word, OBJECT) {
                Some(slot) => self.slots.get(slot).copied(),
                None => antecedent.filter(|_| PRONOUNS.contains(&word)),
            };
            let quantity = slot_of(word, QUANTITY).and_then(|slot| self.quantities.get(slot));
            let text = match (id, quantity) {
                (Some(id), _) => {
                    let known = part.slots.iter().position(|known| *known == id);
                    let slot = known.unwrap_or(part.slots.len());
                    if known.is_none() {
                        part.slots.push(id);
                    }
                    format!("<obj-{slot}>")
                }
                (None, Some(quantity)) => {
                    part.quantities.push(*quantity);
                    format!("<qty-{}>", part.quantities.len() - 1)
                }
                (None, None) => word.to_owned(),
            };
            if !part.tokens_text.is_empty() {
                part.tokens_text.push(' ');
            }
            part.tokens_text.push_str(&text);
            part.spans.push(span);
        }
        part
    }

    /// The id that a placeholder of an object stands for.
    pub fn slot_at(&self, word: &str) -> Option<u32> {
        self.slots.get(slot_of(word, OBJECT)?).copied()
    }

    /// Whether a word is the placeholder of an object, or of a group that it belongs to.
    pub fn names(&self, word: &str, id: u32) -> bool {
        self.slot_at(word).is_some_and(|slot| self.expanded(&[slot]).contains(&id))
    }

    /// Whether a word is the placeholder of these objects, and of no others.
    pub fn stands_for(&self, word: &str, ids: &[u32]) -> bool {
        self.slot_at(word).is_some_and(|slot| self.expanded(&[slot]) == ids)
    }

    /// Whether a word is the placeholder of a quantity.
    pub fn is_quantity(&self, word: &str) -> bool {
        slot_of(word, QUANTITY).is_some_and(|slot| slot < self.quantities.len())
    }

    /// The quantity that a placeholder stands for.
    pub fn quantity_at(&self, word: &str) -> Option<Quantity> {
        self.quantities.get(slot_of(word, QUANTITY)?).copied()
    }

    /// The seconds that a placeholder stands for.
    pub fn secs_at(&self, word: &str) -> Option<f64> {
        let quantity = self.quantity_at(word).filter(|quantity| quantity.kind == QuantityKind::Seconds)?;
        Some(quantity.value)
    }

    /// The seconds that a word of a list of times says, where a bare number is one, too.
    pub fn listed_secs_at(&self, word: &str) -> Option<f64> {
        let number = || word.parse().ok().filter(|value| LISTED_SECS.contains(value));
        self.secs_at(word).or_else(number)
    }

    /// The id that stands for some objects: that of an object, or of a group that the prompt names.
    pub fn id_of(&self, objects: &[u32]) -> Option<u32> {
        match objects {
            [] => None,
            [id] => Some(*id),
            _ => self
                .groups
                .iter()
                .find(|group| group.members == objects)
                .map(|group| group.id)
                .or(objects.first().copied()),
        }
    }
}
