//! Effects that a prompt mentions by name.

use super::error::LanguageError;
use super::lexicon::Lexicon;
use super::linked::Linked;

/// A mention in a prompt of an effect, or of another request that no camera move can meet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EffectMention {
    /// Name from the lexicon: `depth-of-field`, `motion-blur`, `music` ..
    pub kind: String,
    /// The words of the prompt, in lower case.
    pub words: String,
    /// Byte range of the prompt.
    pub span: [usize; 2],
}

/// The effects that a prompt mentions, each kind once, in the order of the words: effects of the lens, and requests that
/// no camera can meet. A negated mention (`no motion blur`, `without music`) is omitted.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded lexicon is malformed.
pub fn effect_mentions(linked: &Linked) -> Result<Vec<EffectMention>, LanguageError> {
    let lexicon = Lexicon::embedded()?;
    let tokens: Vec<&str> = linked.tokens_text.split(' ').collect();
    let mut mentions: Vec<EffectMention> = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let rest = tokens.get(i..).unwrap_or_default();
        let begins_rest =
            |phrase: &Vec<String>| phrase.len() <= rest.len() && phrase.iter().zip(rest).all(|(a, b)| a == b);
        let Some((kind, phrase)) = lexicon.effects.iter().find(|(_, phrase)| begins_rest(phrase)) else {
            i += 1;
            continue;
        };
        let end = i + phrase.len();
        let negated = tokens
            .get(i.saturating_sub(2)..i)
            .unwrap_or_default()
            .iter()
            .any(|word| matches!(*word, "no" | "without" | "not"));
        if !negated && !mentions.iter().any(|known| known.kind == *kind) {
            let span = [linked.spans.get(i).map_or(0, |s| s[0]), linked.spans.get(end - 1).map_or(0, |s| s[1])];
            mentions.push(EffectMention { kind: kind.clone(), words: phrase.join(" "), span });
        }
        i = end;
    }
    Ok(mentions)
}
