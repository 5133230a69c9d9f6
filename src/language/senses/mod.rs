//! What the words of a request tell a camera operator, whoever says them.
//!
//! A network that learns from some thousand sentences knows their words and no others. `prompts/senses.txt` says of many
//! more English words what they mean to a camera: `corkscrew` is `circle up down`, `linger` is `hold long`. The network
//! takes the senses of a word beside the word, and so reads words that its training never had.

mod set;
mod table;

pub use set::Senses;

use crate::error::LanguageError;
use crate::linked::Linked;
use crate::tokenizer::Word;
use table::Table;

/// The names of all senses, in the order of their indices.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list.
pub fn sense_names() -> Result<&'static [String], LanguageError> {
    Ok(Table::embedded()?.names())
}

impl Senses {
    /// The senses of these names; names that the list does not declare are left out.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] for a damaged list.
    pub fn named(names: &[&str]) -> Result<Self, LanguageError> {
        let is_named = |(_, name): &(usize, &String)| names.contains(&name.as_str());
        let indices = sense_names()?.iter().enumerate().filter(is_named).map(|(index, _)| index);
        Ok(indices.fold(Self::default(), Self::with))
    }
}

/// The senses of each word. A phrase of the list counts before its words.
pub(crate) fn senses_of(words: &[Word]) -> Result<Vec<Senses>, LanguageError> {
    let words: Vec<&str> = words.iter().map(|word| word.text.as_str()).collect();
    Ok(Table::embedded()?.senses(&words))
}

impl Linked {
    /// The senses of each word of [`Self::tokens_text`]. A phrase of the list counts before its words.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] for a damaged list.
    pub fn senses(&self) -> Result<Vec<Senses>, LanguageError> {
        let words: Vec<&str> = self.tokens_text.split(' ').collect();
        Ok(Table::embedded()?.senses(&words))
    }
}
