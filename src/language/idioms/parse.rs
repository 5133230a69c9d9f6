//! Reads the patterns of idioms and what they stand for.

use std::sync::Arc;

use super::matching::Piece;
use crate::quantity::{Quantity, QuantityKind};
use crate::tokenizer::tokenize;

/// A part of what an idiom stands for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Output {
    Word(String),
    /// A verb in the form of the verb that was matched.
    Verb(String),
    /// Words that the pattern has captured, by their name.
    Captured(String),
    /// A quantity that the idiom states.
    Quantity(Quantity),
}

/// Lists of alternatives by their names.
pub(super) type Lists = std::collections::BTreeMap<String, Arc<Vec<Vec<Piece>>>>;

/// Reads a pattern; `lists` are the named ones before it.
pub(super) fn pattern(text: &str, lists: &Lists) -> Result<Vec<Piece>, String> {
    let mut whole = alternatives(text, lists)?;
    Ok(if whole.len() == 1 { whole.remove(0) } else { vec![Piece::OneOf(Arc::new(whole))] })
}

/// Reads patterns with `|` between them, each of which may have groups of its own.
pub(super) fn alternatives(text: &str, lists: &Lists) -> Result<Vec<Vec<Piece>>, String> {
    let spaced = ["(", ")", "|"].iter().fold(text.to_owned(), |text, mark| text.replace(mark, &format!(" {mark} ")));
    let mut open: Vec<Vec<Vec<Piece>>> = vec![vec![Vec::new()]];
    for token in spaced.split_whitespace() {
        match token {
            "(" => open.push(vec![Vec::new()]),
            "|" => open.last_mut().ok_or("`|` outside")?.push(Vec::new()),
            ")" => {
                let group = open.pop().filter(|_| !open.is_empty()).ok_or("`)` without `(`")?;
                push(&mut open, Piece::OneOf(Arc::new(group)))?;
            }
            // The end of a contraction stands alone behind what it may follow: `(he | you) ('s | 're)`.
            _ if token.starts_with('\'') => push(&mut open, Piece::Word(token.to_owned()))?,
            _ if is_plain(token) => {
                // The words of a prompt are split in the same way: `don't` is `don` and `'t`.
                for word in tokenize(token) {
                    push(&mut open, Piece::Word(word.text))?;
                }
            }
            _ => {
                let piece = piece(token, lists)?;
                push(&mut open, piece)?;
            }
        }
    }
    match (open.pop(), open.is_empty()) {
        (Some(whole), true) => Ok(whole),
        _ => Err("`(` without `)`".to_owned()),
    }
}

/// Appends a piece to the alternative that is being read.
fn push(open: &mut [Vec<Vec<Piece>>], piece: Piece) -> Result<(), String> {
    open.last_mut().and_then(|group| group.last_mut()).ok_or("`)` without `(`")?.push(piece);
    Ok(())
}

/// Whether a token is a word and nothing that stands for others.
fn is_plain(token: &str) -> bool {
    token.starts_with(char::is_alphanumeric)
}

fn piece(token: &str, lists: &Lists) -> Result<Piece, String> {
    if let Some(verb) = token.strip_prefix('~') {
        if tokenize(verb).len() != 1 {
            return Err(format!("`{token}` is no single word: a hyphen splits words"));
        }
        return Ok(Piece::verb(verb));
    }
    if let Some(name) = token.strip_prefix('@') {
        let list = lists.get(name).ok_or_else(|| format!("no list `@{name}` before this line"))?;
        return Ok(Piece::OneOf(Arc::clone(list)));
    }
    if let Some(name) = token.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) {
        return Ok(capture(name));
    }
    Ok(match token {
        "^" => Piece::Start,
        "$" => Piece::End,
        "[" => Piece::Word("(".to_owned()),
        "]" => Piece::Word(")".to_owned()),
        _ if token.starts_with("..") => Piece::Gap(token.to_owned()),
        _ => Piece::Word(token.to_owned()),
    })
}

fn capture(name: &str) -> Piece {
    let kind = match name.trim_end_matches(char::is_numeric) {
        "secs" => Some(QuantityKind::Seconds),
        "deg" => Some(QuantityKind::Degrees),
        "len" => Some(QuantityKind::Units),
        "times" => Some(QuantityKind::Factor),
        "percent" => Some(QuantityKind::Percent),
        "mm" => Some(QuantityKind::Millimeters),
        "quantity" => None,
        _ => return Piece::Object(name.to_owned()),
    };
    Piece::Quantity(kind, name.to_owned())
}

/// Reads what an idiom stands for.
pub(super) fn output(text: &str) -> Result<Vec<Output>, String> {
    text.split_whitespace().map(output_part).collect()
}

fn output_part(token: &str) -> Result<Output, String> {
    if let Some(verb) = token.strip_prefix('~') {
        return Ok(Output::Verb(verb.to_owned()));
    }
    if token.starts_with("..") {
        return Ok(Output::Captured(token.to_owned()));
    }
    let Some(name) = token.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) else {
        return Ok(Output::Word(token.to_owned()));
    };
    if !name.starts_with(|c: char| c.is_ascii_digit()) {
        return Ok(Output::Captured(name.to_owned()));
    }
    let unit_at = name.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(name.len());
    let kind = match &name[unit_at..] {
        "s" => QuantityKind::Seconds,
        "deg" => QuantityKind::Degrees,
        "u" => QuantityKind::Units,
        "x" => QuantityKind::Factor,
        "%" => QuantityKind::Percent,
        "mm" => QuantityKind::Millimeters,
        unit => return Err(format!("unknown unit `{unit}`")),
    };
    let value = name[..unit_at].parse::<f64>().map_err(|_| format!("`{name}` has no number"))?;
    Ok(Output::Quantity(Quantity { kind, value }))
}
