//! Sets of senses.

/// The most senses that the list may declare.
pub(super) const MAX_SENSES: usize = 128;

/// The senses of a word: a set of indices into [`sense_names`](super::sense_names).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Senses(u128);

impl Senses {
    /// The indices, ascending.
    pub fn indices(self) -> impl Iterator<Item = usize> {
        (0..MAX_SENSES).filter(move |index| self.0 >> index & 1 == 1)
    }

    /// Whether the word has no sense.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether the sets have a sense in common.
    pub fn overlaps(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    pub(super) fn with(self, index: usize) -> Self {
        Self(self.0 | 1 << index)
    }
}
