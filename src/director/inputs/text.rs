//! A linked prompt as tokens.

use cinesplat_language::{Linked, Quantity, QuantityKind, Senses};

use super::grounding::{Grounding, TokenSource};
use super::prompt::TokenInput;
use super::vocabulary::{BEGIN, Token, Vocabulary};
use crate::error::DirectorError;

/// Tokens of a linked prompt, and the grounding of their indices. `senses` has one entry per word; `others` are the ids of the
/// objects that follow the named ones in the prompt's list of objects.
///
/// # Errors
/// [`DirectorError::PromptTooLong`] · [`DirectorError::EmptyPrompt`] without any token ·
/// [`DirectorError::IdBeyondVocabulary`] for a token without a row in the embedding table · [`DirectorError::BadModel`]
/// when the tokenizer fails.
pub fn encode_text(
    linked: &Linked,
    senses: &[Senses],
    others: &[u32],
    vocabulary: &Vocabulary,
) -> Result<(Vec<TokenInput>, Grounding), DirectorError> {
    let tokens = vocabulary.encode(&linked.tokens_text)?;
    let word_starts = word_starts(&linked.tokens_text);
    let mut inputs = vec![TokenInput { id: BEGIN, ..TokenInput::default() }];
    let mut sources = vec![TokenSource { bytes: [0, 0], word: None, quantity: None }];
    for token in tokens {
        let word_idx = word_starts.partition_point(|start| *start <= token.bytes[0]).saturating_sub(1);
        let senses = senses.get(word_idx).copied().unwrap_or_default();
        let input = TokenInput { senses, ..token_input(token, &linked.quantities) };
        let bytes = linked.spans.get(word_idx).copied().unwrap_or([0, 0]);
        sources.push(TokenSource { bytes, word: Some(word_idx), quantity: input.quantity });
        inputs.push(input);
    }
    if let Some(id) = vocabulary.end() {
        inputs.push(TokenInput { id, ..TokenInput::default() });
        sources.push(TokenSource { bytes: [0, 0], word: None, quantity: None });
    }
    let object_ids = linked.slots.iter().chain(others).copied().collect();
    Ok((inputs, Grounding { object_ids, quantities: linked.quantities.clone(), tokens: sources }))
}

/// Byte offsets at which the words of a text with single spaces begin.
fn word_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.bytes().enumerate().filter(|(_, b)| *b == b' ').map(|(at, _)| at + 1)).collect()
}

fn token_input(token: Token, quantities: &[Quantity]) -> TokenInput {
    let quantity = token.quantity_slot().and_then(|slot| quantities.get(slot).map(|quantity| (slot, quantity)));
    TokenInput {
        id: token.id,
        object: token.object_slot(),
        quantity: quantity.map(|(slot, _)| slot),
        kind: quantity.map_or(0, |(_, quantity)| kind_number(quantity.kind)),
        senses: Senses::default(),
        value: quantity.map_or(0.0, |(_, quantity)| (quantity.value.clamp(1e-3, 1e4).ln() / 5.0) as f32),
    }
}

/// Row of the kind embedding; row 0 is for all tokens that do not name a quantity.
fn kind_number(kind: QuantityKind) -> u32 {
    match kind {
        QuantityKind::Seconds => 1,
        QuantityKind::Degrees => 2,
        QuantityKind::Units => 3,
        QuantityKind::Factor => 4,
        QuantityKind::Percent => 5,
        QuantityKind::Millimeters => 6,
    }
}
