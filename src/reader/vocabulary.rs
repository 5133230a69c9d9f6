//! The tokens of a model as bytes, and which of them may follow in a language.
//!
//! Enters: a tokenizer. Leaves: [`Vocabulary::allowed`]: the tokens whose bytes an automaton accepts next. Tokens are
//! sorted by their bytes, so tokens with a common beginning lie together and the automaton reads that beginning once.

use std::collections::BTreeSet;

use cinesplat_language::{Automaton, States};
use tokenizers::Tokenizer;
use tokenizers::decoders::DecoderWrapper;

/// Names of tokens that end an answer, in the vocabularies of both families.
const END_NAMES: [&str; 5] = ["<|im_end|>", "<|endoftext|>", "<|eot_id|>", "<|end_of_text|>", "</s>"];

/// The tokens of a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Vocabulary {
    /// Bytes and id of every token that is text, ascending.
    tokens: Vec<(Vec<u8>, u32)>,
    /// Tokens that end an answer, ascending: special ones, and those that begin with the end of the line.
    ends: Vec<u32>,
}

impl Vocabulary {
    /// A vocabulary of tokens with their bytes; a token's id is its index. `ends` are the tokens that end an answer.
    pub fn new(tokens: &[Vec<u8>], ends: &[u32]) -> Self {
        let mut ends: BTreeSet<u32> = ends.iter().copied().collect();
        let mut texts = Vec::new();
        for (id, bytes) in (0..).zip(tokens) {
            if bytes.starts_with(b"\n") {
                ends.insert(id);
            } else if !bytes.is_empty() && !ends.contains(&id) {
                texts.push((bytes.clone(), id));
            }
        }
        texts.sort_unstable();
        Self { tokens: texts, ends: ends.into_iter().collect() }
    }

    /// The vocabulary of a tokenizer of at most `num_tokens` tokens; `end` is the one that the model's file names.
    pub(crate) fn of(tokenizer: &Tokenizer, num_tokens: usize, end: Option<u32>) -> Self {
        let special = tokenizer.get_added_tokens_decoder();
        let is_byte_level = matches!(tokenizer.get_decoder(), Some(DecoderWrapper::ByteLevel(_)));
        let bytes_of = |id: u32| {
            let text = tokenizer.id_to_token(id).filter(|_| !special.contains_key(&id))?;
            if is_byte_level { bytes_of_byte_level(&text) } else { Some(bytes_of_pieces(&text)) }
        };
        let tokens: Vec<Vec<u8>> = (0..num_tokens as u32).map(|id| bytes_of(id).unwrap_or_default()).collect();
        let named = END_NAMES.iter().filter_map(|name| tokenizer.token_to_id(name));
        let ends: Vec<u32> = named.chain(end).filter(|id| (*id as usize) < num_tokens).collect();
        Self::new(&tokens, &ends)
    }

    /// Tokens that end an answer.
    pub(crate) fn ends(&self) -> &[u32] {
        &self.ends
    }

    /// The first byte of `bytes` that is no token of its own; without such a token an answer could get stuck.
    pub(crate) fn missing_byte(&self, bytes: impl IntoIterator<Item = u8>) -> Option<u8> {
        bytes.into_iter().find(|byte| {
            let at = self.tokens.partition_point(|(token, _)| token.as_slice() < [*byte].as_slice());
            self.tokens.get(at).is_none_or(|(token, _)| token != &[*byte])
        })
    }

    /// The tokens that may follow in `automaton` at `states`, ascending by bytes, each with the states after it.
    pub(crate) fn allowed(&self, automaton: &Automaton, states: &States) -> Vec<(u32, &[u8], States)> {
        let mut allowed = Vec::new();
        descend(&self.tokens, 0, automaton, states, &mut allowed);
        allowed
    }
}

/// Adds the tokens of a sorted list that may follow; their first `depth` bytes are equal and led to `states`.
fn descend<'a>(
    tokens: &'a [(Vec<u8>, u32)],
    depth: usize,
    automaton: &Automaton,
    states: &States,
    allowed: &mut Vec<(u32, &'a [u8], States)>,
) {
    let num_whole = tokens.partition_point(|(bytes, _)| bytes.len() == depth);
    let (whole, longer) = tokens.split_at(num_whole);
    if depth > 0 {
        allowed.extend(whole.iter().map(|(bytes, id)| (*id, bytes.as_slice(), states.clone())));
    }
    if longer.is_empty() {
        return;
    }
    for byte in states.next_bytes() {
        let byte_at = |bytes: &Vec<u8>| bytes.get(depth).copied().unwrap_or_default();
        let start = longer.partition_point(|(bytes, _)| byte_at(bytes) < byte);
        let end = longer.partition_point(|(bytes, _)| byte_at(bytes) <= byte);
        if let Some(same) = longer.get(start..end).filter(|same| !same.is_empty()) {
            descend(same, depth + 1, automaton, &automaton.after(states, byte), allowed);
        }
    }
}

/// Bytes of a token of a byte-level vocabulary (GPT-2): one character per byte. `None` for other characters.
fn bytes_of_byte_level(text: &str) -> Option<Vec<u8>> {
    text.chars().map(byte_of_char).collect()
}

/// Printable characters of Latin-1 stand for themselves; the other bytes, in order, are the characters from U+0100 on.
fn byte_of_char(c: char) -> Option<u8> {
    let stands_for_itself = |byte: &u8| matches!(byte, b'!'..=b'~' | 0xA1..=0xAC | 0xAE..=0xFF);
    let code = u32::from(c);
    if let Some(byte) = u8::try_from(code).ok().filter(stands_for_itself) {
        return Some(byte);
    }
    let others = (0..=u8::MAX).filter(|byte| !stands_for_itself(byte));
    others.zip(0x100..).find(|(_, other)| *other == code).map(|(byte, _)| byte)
}

/// Bytes of a piece of `SentencePiece`: U+2581 stands for a space, `<0x0A>` for a byte.
fn bytes_of_pieces(text: &str) -> Vec<u8> {
    let byte = text.strip_prefix("<0x").and_then(|rest| rest.strip_suffix('>'));
    match byte.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
        Some(byte) => vec![byte],
        None => text.replace('\u{2581}', " ").into_bytes(),
    }
}
