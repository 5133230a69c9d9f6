//! An answer token by token, held to a language.
//!
//! Enters: scores of the next token, and the automaton of the allowed answers. Leaves: the most likely allowed token each
//! time, and how likely it was among the allowed ones. The invariant: the answer is a text of the language. A token that
//! would leave too few tokens to complete the text is not allowed, so every answer ends.

use cinesplat_language::{Automaton, States};

use crate::answer::Answer;
use crate::error::ReaderError;
use crate::vocabulary::Vocabulary;

/// The answer of at most `max_tokens` tokens that takes the most likely allowed token each time. `scores` are those of the
/// first token; `next` gives those after one more token.
///
/// # Errors
/// [`ReaderError::TooLong`] when no answer is so short · [`ReaderError::NotFinite`] · what `next` fails with.
pub fn decode(
    vocabulary: &Vocabulary,
    automaton: &Automaton,
    max_tokens: usize,
    mut scores: Vec<f32>,
    next: &mut dyn FnMut(u32) -> Result<Vec<f32>, ReaderError>,
) -> Result<Answer, ReaderError> {
    let mut states = automaton.start();
    let mut bytes: Vec<u8> = Vec::new();
    let mut tokens = Vec::new();
    loop {
        let num_left = max_tokens.saturating_sub(tokens.len());
        // One token for the choice itself, one for the end.
        let fits = |states: &States| states.bytes_to_end().is_some_and(|bytes| bytes + 2 <= num_left);
        let mut choices = Vec::new();
        if states.may_end() {
            choices.push((log_sum(&scores, vocabulary.ends())?, None));
        }
        for (id, text, after) in vocabulary.allowed(automaton, &states) {
            if fits(&after) {
                choices.push((score(&scores, id)?, Some((id, text, after))));
            }
        }
        let (idx, probability) = most_likely(&choices)
            .ok_or(ReaderError::TooLong { found: max_tokens.saturating_add(1), limit: max_tokens })?;
        tokens.push((bytes.len(), probability));
        let Some((id, text, after)) = choices.swap_remove(idx).1 else { break };
        bytes.extend(text);
        states = after;
        scores = next(id)?;
    }
    Ok(Answer { text: String::from_utf8_lossy(&bytes).into_owned(), tokens })
}

/// The score of a token; a token that the model does not score is impossible.
fn score(scores: &[f32], id: u32) -> Result<f64, ReaderError> {
    let found = scores.get(id as usize).copied().unwrap_or(f32::NEG_INFINITY);
    if found.is_nan() || found == f32::INFINITY { Err(ReaderError::NotFinite { found }) } else { Ok(found.into()) }
}

/// The score of one of some tokens: the logarithm of the sum of their exponentials.
fn log_sum(scores: &[f32], ids: &[u32]) -> Result<f64, ReaderError> {
    let scores: Vec<f64> = ids.iter().map(|id| score(scores, *id)).collect::<Result<_, _>>()?;
    let most = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = scores.iter().filter(|_| most.is_finite()).map(|score| (score - most).exp()).sum();
    Ok(most + sum.ln())
}

/// The index of the choice of the highest score, the first of equals, and its probability.
fn most_likely<T>(choices: &[(f64, T)]) -> Option<(usize, f64)> {
    let best = choices.iter().enumerate().reduce(|best, choice| if choice.1.0 > best.1.0 { choice } else { best });
    let (idx, (most, _)) = best?;
    if !most.is_finite() {
        // Every choice is impossible to the model: all are equally likely.
        return Some((idx, 1.0 / choices.len() as f64));
    }
    let sum: f64 = choices.iter().map(|(score, _)| (score - most).exp()).sum();
    Some((idx, 1.0 / sum))
}
