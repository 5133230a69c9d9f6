//! Text to tokens: byte-pair encoding or word pieces, with the identifiers of objects and quantities as special tokens.
//!
//! Enters: the linked text, which is lower case and has mentions as `<obj-S>` and `<qty-Q>`. Leaves: token ids with their
//! byte ranges. The special tokens have fixed ids, so that weights and vocabulary cannot disagree about them.

use std::collections::BTreeMap;

use serde_json::{Value, json};
use tokenizers::Tokenizer;

use super::merges;
use super::tokenizer_parts::{TOKENIZER_FILE, check_parts};
use crate::error::DirectorError;

/// Number of identifiers `<obj-0>`.. that a prompt's objects are mapped onto.
pub const NUM_OBJECT_SLOTS: usize = cinesplat_language::MAX_SLOTS;
/// Number of identifiers `<qty-0>`.. that a prompt's quantities are mapped onto.
const NUM_QUANTITY_SLOTS: usize = cinesplat_language::MAX_QUANTITIES;
/// Limit on the tokens of a prompt.
const MAX_TOKENS: usize = 256;
/// Limit on the bytes of a text; longer ones are rejected before the tokenizer.
const MAX_TEXT_BYTES: usize = 8 * 1024;

/// Token that pads short texts of a batch.
pub(crate) const PAD: u32 = 0;
// Token 1 replaces pieces that the vocabulary lacks.
/// Token that begins every text.
pub(super) const BEGIN: u32 = 2;
const FIRST_OBJECT: u32 = 3;
const FIRST_QUANTITY: u32 = FIRST_OBJECT + NUM_OBJECT_SLOTS as u32;
/// The first id after the special tokens.
const FIRST_PIECE: u32 = FIRST_QUANTITY + NUM_QUANTITY_SLOTS as u32;
/// Number of special tokens that every vocabulary has.
pub(crate) const NUM_SPECIAL_TOKENS: usize = FIRST_PIECE as usize;
/// Text of the token that ends every text in vocabularies of word pieces.
const END: &str = "<eos>";

/// One token of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token {
    /// Row of the embedding table.
    pub(super) id: u32,
    /// Byte range of the text.
    pub(super) bytes: [usize; 2],
}

impl Token {
    /// The object slot that the token stands for.
    pub(super) fn object_slot(self) -> Option<usize> {
        (FIRST_OBJECT..FIRST_QUANTITY).contains(&self.id).then(|| (self.id - FIRST_OBJECT) as usize)
    }

    /// The quantity slot that the token stands for.
    pub(super) fn quantity_slot(self) -> Option<usize> {
        (FIRST_QUANTITY..FIRST_PIECE).contains(&self.id).then(|| (self.id - FIRST_QUANTITY) as usize)
    }
}

/// Token id of an object slot; a slot beyond the last counts as the last.
pub fn object_token(slot: usize) -> u32 {
    FIRST_OBJECT + slot.min(NUM_OBJECT_SLOTS - 1) as u32
}

/// A trained tokenizer: byte-pair encoding of lower-case words, with special tokens for objects and quantities.
#[derive(Debug, Clone)]
pub struct Vocabulary {
    tokenizer: Tokenizer,
}

impl Vocabulary {
    /// Learns up to `size` tokens from linked texts, whose words are separated by spaces. The same texts give the same
    /// vocabulary.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when `tokenizers` rejects the result.
    pub fn train(lines: &[String], size: usize) -> Result<Self, DirectorError> {
        let mut words: BTreeMap<String, u64> = BTreeMap::new();
        for word in lines.iter().flat_map(|line| line.split_whitespace()).filter(|word| !word.starts_with('<')) {
            *words.entry(word.to_lowercase()).or_default() += 1;
        }
        let specials = special_tokens();
        let learned = merges::learn(&words, size.saturating_sub(specials.len()));
        let joined: Vec<Value> = learned.merges.iter().map(|(left, right)| json!([left, right])).collect();
        let around = [json!({"type": "Lowercase"}), json!({"type": "Whitespace"})];
        Self::described([&specials, &learned.pieces], around, json!({"type": "BPE", "merges": joined}))
    }

    /// A vocabulary of word pieces (Wu et al. 2016): those of a network that was trained beforehand. Its texts end with a token
    /// of their own, whose id follows those of the special tokens; then come the `pieces`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when `tokenizers` rejects the pieces.
    pub fn of_word_pieces(pieces: &[String]) -> Result<Self, DirectorError> {
        let specials: Vec<String> = special_tokens().into_iter().chain([END.to_owned()]).collect();
        let normalizer = json!({
            "type": "BertNormalizer",
            "clean_text": false, "handle_chinese_chars": true, "strip_accents": true, "lowercase": true,
        });
        let around = [normalizer, json!({"type": "BertPreTokenizer"})];
        Self::described([&specials, pieces], around, json!({"type": "WordPiece", "max_input_chars_per_word": 100}))
    }

    /// The vocabulary of special tokens, then pieces, by what is done before the model and the model's own settings.
    fn described(
        [specials, pieces]: [&[String]; 2],
        [normalizer, pre_tokenizer]: [Value; 2],
        mut model: Value,
    ) -> Result<Self, DirectorError> {
        let ids = specials.iter().chain(pieces).zip(0_u32..);
        let vocab: serde_json::Map<String, Value> = ids.map(|(piece, id)| (piece.clone(), id.into())).collect();
        let added: Vec<Value> = specials.iter().zip(0_u32..).map(|(text, id)| added_token(text, id)).collect();
        model["unk_token"] = "<unk>".into();
        model["continuing_subword_prefix"] = merges::CONTINUES.into();
        model["vocab"] = vocab.into();
        let description = json!({
            "version": "1.0",
            "added_tokens": added,
            "normalizer": normalizer,
            "pre_tokenizer": pre_tokenizer,
            "model": model,
        });
        Self::from_json(description.to_string().as_bytes())
    }

    /// Id of the token that ends every text; `None` in vocabularies without one.
    pub(super) fn end(&self) -> Option<u32> {
        self.tokenizer.token_to_id(END)
    }

    /// Reads a vocabulary from the JSON of `tokenizers`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the JSON is not a tokenizer, has a part that this program does not write, or a special
    /// token does not have its fixed id.
    pub fn from_json(json: &[u8]) -> Result<Self, DirectorError> {
        let json: Value = serde_json::from_slice(json).map_err(|error| bad(&error))?;
        check_parts(&json)?;
        // What was checked is what is read: in the file a key may stand twice.
        let tokenizer = Tokenizer::from_bytes(json.to_string()).map_err(|error| bad(&error))?;
        for (id, text) in special_tokens().into_iter().enumerate() {
            let found = tokenizer.token_to_id(&text);
            if found != Some(id as u32) {
                return Err(DirectorError::BadModel {
                    part: format!("{TOKENIZER_FILE}: {text}"),
                    found: found.map_or("none".into(), |id| format!("id {id}")),
                    expected: format!("id {id}"),
                });
            }
        }
        Ok(Self { tokenizer })
    }

    /// The vocabulary in the JSON of `tokenizers`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when `tokenizers` cannot serialize it.
    pub fn to_json(&self) -> Result<String, DirectorError> {
        self.tokenizer.to_string(false).map_err(|error| bad(&error))
    }

    /// Text and id of every token.
    pub fn pieces(&self) -> BTreeMap<String, u32> {
        self.tokenizer.get_vocab(true).into_iter().collect()
    }

    /// Number of tokens.
    pub fn size(&self) -> usize {
        self.tokenizer.get_vocab_size(true)
    }

    /// Tokens of a text, without [`BEGIN`].
    ///
    /// # Errors
    /// [`DirectorError::PromptTooLong`] beyond [`MAX_TEXT_BYTES`] or [`MAX_TOKENS`] · [`DirectorError::EmptyPrompt`]
    /// without any token · [`DirectorError::IdBeyondVocabulary`] for a token without a row in the embedding table ·
    /// [`DirectorError::BadModel`] when the tokenizer fails.
    pub(super) fn encode(&self, text: &str) -> Result<Vec<Token>, DirectorError> {
        // Byte-pair encoding of one very long word takes quadratic time, so its length is checked first.
        if text.len() > MAX_TEXT_BYTES {
            return Err(DirectorError::PromptTooLong { found: text.len() / 4, limit: MAX_TOKENS });
        }
        let encoding = self.tokenizer.encode(text, false).map_err(|error| bad(&error))?;
        let ids = encoding.get_ids().iter().zip(encoding.get_offsets());
        let tokens: Vec<Token> = ids.map(|(id, (start, end))| Token { id: *id, bytes: [*start, *end] }).collect();
        if tokens.is_empty() {
            return Err(DirectorError::EmptyPrompt);
        }
        let around = 1 + usize::from(self.end().is_some());
        if tokens.len() + around > MAX_TOKENS {
            return Err(DirectorError::PromptTooLong { found: tokens.len() + around, limit: MAX_TOKENS });
        }
        match tokens.iter().find(|token| token.id as usize >= self.size()) {
            Some(token) => Err(DirectorError::IdBeyondVocabulary { found: token.id, limit: self.size() }),
            None => Ok(tokens),
        }
    }
}

/// A special token in the tokenizer's JSON.
fn added_token(text: &str, id: u32) -> Value {
    let off = false;
    json!({
        "id": id, "content": text, "special": true,
        "single_word": off, "lstrip": off, "rstrip": off, "normalized": off,
    })
}

/// The special tokens in the order of their ids.
fn special_tokens() -> Vec<String> {
    let mut tokens: Vec<String> = ["<pad>", "<unk>", "<bos>"].map(String::from).to_vec();
    tokens.extend((0..NUM_OBJECT_SLOTS).map(|slot| format!("<obj-{slot}>")));
    tokens.extend((0..NUM_QUANTITY_SLOTS).map(|slot| format!("<qty-{slot}>")));
    tokens
}

fn bad(error: &dyn std::fmt::Display) -> DirectorError {
    DirectorError::BadModel {
        part: TOKENIZER_FILE.into(),
        found: error.to_string(),
        expected: "a byte-pair tokenizer of this program".into(),
    }
}
