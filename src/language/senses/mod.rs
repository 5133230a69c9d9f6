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
use table::Table;

/// The names of all senses, in the order of their indices.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list.
pub fn sense_names() -> Result<&'static [String], LanguageError> {
    Ok(Table::embedded()?.names())
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

    /// Whether a word of `bytes` has one of the senses of these names.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] for a damaged list.
    pub fn has_sense(&self, bytes: [usize; 2], names: &[&str]) -> Result<bool, LanguageError> {
        let all = sense_names()?;
        let is_asked = |index: usize| all.get(index).is_some_and(|name| names.contains(&name.as_str()));
        let inside = |span: &[usize; 2]| bytes[0] <= span[0] && span[0] < bytes[1];
        let words = self.senses()?.into_iter().zip(&self.spans);
        Ok(words.filter(|(_, span)| inside(span)).any(|(senses, _)| senses.indices().any(is_asked)))
    }
}
