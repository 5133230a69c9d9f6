//! What a vocabulary's JSON may hold: the parts that this program writes.
//!
//! The package `tokenizers` reads many more. It panics at damaged tables of characters, at merges of tokens that do not exist,
//! and fills texts up to any length.

use std::collections::BTreeSet;

use serde_json::Value;

use super::merges::CONTINUES;
use crate::error::DirectorError;

/// Name of the file with the vocabulary.
pub(crate) const TOKENIZER_FILE: &str = "director.tokenizer.json";

/// Parts that are absent.
const NONE: [&str; 5] = ["/truncation", "/padding", "/post_processor", "/decoder", "/model/dropout"];
/// Parts and their values.
const VALUES: [(&str, &[&str]); 4] = [
    ("/normalizer/type", &["Lowercase", "BertNormalizer"]),
    ("/pre_tokenizer/type", &["Whitespace", "BertPreTokenizer"]),
    ("/model/type", &["BPE", "WordPiece"]),
    ("/model/continuing_subword_prefix", &[CONTINUES]),
];

/// Refuses parts that this program does not write.
///
/// # Errors
/// [`DirectorError::BadModel`] with the place in the JSON.
pub(super) fn check_parts(json: &Value) -> Result<(), DirectorError> {
    if let Some(place) = NONE.iter().find(|place| json.pointer(place).is_some_and(|value| !value.is_null())) {
        return Err(bad_part(json, place, "null"));
    }
    for (place, values) in VALUES {
        if !json.pointer(place).and_then(Value::as_str).is_some_and(|found| values.contains(&found)) {
            return Err(bad_part(json, place, &values.join(" or ")));
        }
    }
    let tokens = json.pointer("/model/vocab").and_then(Value::as_object);
    let tokens = tokens.ok_or_else(|| bad_part(json, "/model/vocab", "tokens with their ids"))?;
    let ids: BTreeSet<u64> = tokens.values().filter_map(Value::as_u64).collect();
    let is_one_of_each = ids.len() == tokens.len() && ids.last().is_none_or(|last| *last < tokens.len() as u64);
    if !is_one_of_each {
        return Err(bad_part(json, "/model/vocab", &format!("each of the ids 0..{} once", tokens.len())));
    }
    let merges = json.pointer("/model/merges").and_then(Value::as_array).into_iter().flatten();
    for (idx, merge) in merges.enumerate() {
        let joined = joined(merge).filter(|parts| parts.iter().all(|part| tokens.contains_key(part)));
        if joined.is_none() {
            return Err(bad_part(json, &format!("/model/merges/{idx}"), "two tokens that make a third"));
        }
    }
    Ok(())
}

/// Both tokens of a merge, and the token that they make.
fn joined(merge: &Value) -> Option<[String; 3]> {
    let [Value::String(left), Value::String(right)] = merge.as_array()?.as_slice() else { return None };
    let whole = format!("{left}{}", right.strip_prefix(CONTINUES)?);
    Some([left.clone(), right.clone(), whole])
}

/// The error for the value at a place. A value may be long.
fn bad_part(json: &Value, place: &str, expected: &str) -> DirectorError {
    let found: String = json.pointer(place).map_or("nothing".into(), Value::to_string).chars().take(60).collect();
    DirectorError::BadModel { part: format!("{TOKENIZER_FILE}: {place}"), found, expected: expected.to_owned() }
}
