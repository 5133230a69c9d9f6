//! The items of phrases: words, numbers and gaps, and where they are in a prompt.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::inflection::forms;
use crate::numerals::{cardinal_at, numeral_at};
use crate::tokenizer::{Word, tokenize, word_at};

/// Most words that a `~` stands for.
const MAX_WILD: usize = 3;
/// Most words that a `..` stands for.
const MAX_LOOSE: usize = 4;
/// Most words and commas that a `...` stands for.
const MAX_SPAN: usize = 9;

/// A choice of several items in a row.
pub(super) type Ways = Vec<Vec<Item>>;
/// Named choices: `$soft` is any of `blurred`, `fuzzy`, `out of focus` ..
pub(super) type Lists = BTreeMap<String, Arc<Ways>>;

/// One item of a phrase.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item {
    /// This word.
    Word(String),
    /// A number in digits or words, within bounds.
    Number(f64, f64),
    /// An amount of light with its unit: `a stop and a half`, `0.7 of a stop`, `-1 EV`.
    Stops,
    /// One to three words.
    Wild,
    /// Up to four words that say nothing of their own: `should be very`.
    Loose,
    /// Up to nine words of the sentence.
    Span,
    /// No word: the end of what belongs together.
    End,
    /// One of a named list.
    Of(Arc<Ways>),
}

/// The words that items are looked for in.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    pub(super) prompt: &'a str,
    pub(super) words: &'a [Word],
    /// Words that a `..` may stand for.
    pub(super) loose: &'a BTreeSet<String>,
}

/// Words taken by some items, and the number in them.
pub(super) type Taken = (usize, Option<f64>);

/// The choices of `a b|c+|$list`.
///
/// # Errors
/// A reason for an unknown list and for bounds that are no numbers.
pub(super) fn ways_of(choices: &str, lists: &Lists) -> Result<Ways, &'static str> {
    let mut ways = Vec::new();
    for choice in choices.split('|') {
        let mut grown: Ways = vec![Vec::new()];
        for token in choice.split_whitespace() {
            let items = items_of(token, lists)?;
            grown = grown.iter().flat_map(|way| items.iter().map(|more| [&way[..], &more[..]].concat())).collect();
        }
        ways.append(&mut grown);
    }
    Ok(ways)
}

/// The ways to say one token of the table.
fn items_of(token: &str, lists: &Lists) -> Result<Ways, &'static str> {
    let item = match token {
        "#" => Item::Number(f64::NEG_INFINITY, f64::INFINITY),
        "%stops" => Item::Stops,
        "~" => Item::Wild,
        ".." => Item::Loose,
        "..." => Item::Span,
        ";" => Item::End,
        _ if token.starts_with('#') => {
            let (least, most) = token[1..].split_once("..").ok_or("a number without bounds")?;
            let bound = |digits: &str| digits.parse().map_err(|_| "a bound that is no number");
            Item::Number(bound(least)?, bound(most)?)
        }
        _ if token.starts_with('$') => Item::Of(lists.get(&token[1..]).cloned().ok_or("an unknown list of phrases")?),
        _ => return Ok(words_of(token)),
    };
    Ok(vec![vec![item]])
}

/// A word as the tokenizer splits it (`3d` is two words), or every form of a word with a `+`.
fn words_of(token: &str) -> Ways {
    if let Some(base) = token.strip_suffix('+').filter(|base| !base.is_empty()) {
        return forms(base).into_iter().map(|form| vec![Item::Word(form)]).collect();
    }
    vec![tokenize(token).into_iter().map(|word| Item::Word(word.text)).collect()]
}

/// The words that some items may begin with; empty for a number or any word.
pub(super) fn first_words(items: &[Item]) -> Vec<String> {
    match items.first() {
        Some(Item::Word(word)) => vec![word.clone()],
        Some(Item::Of(ways)) => ways.iter().flat_map(|way| first_words(way)).collect(),
        _ => vec![String::new()],
    }
}

/// Whether some items hold a `...`.
pub(super) fn spans(items: &[Item]) -> bool {
    items.contains(&Item::Span)
}

/// Every way in which some items are at a word.
pub(super) fn ways_at(items: &[Item], text: Text<'_>, at: usize) -> Vec<Taken> {
    let Some((item, rest)) = items.split_first() else { return vec![(0, None)] };
    let after = |(len, number): Taken| {
        let further = ways_at(rest, text, at + len);
        further.into_iter().map(move |(more, later)| (len + more, number.or(later)))
    };
    item_at(item, text, at).into_iter().flat_map(after).collect()
}

/// Every way in which an item is at a word.
fn item_at(item: &Item, text: Text<'_>, at: usize) -> Vec<Taken> {
    let words = text.words;
    let lens = |first: usize, num: usize| (first..=num).map(|len| (len, None)).collect();
    let is_word = |at: &usize| words.get(*at).is_some_and(|word| word.text.chars().any(char::is_alphanumeric));
    match item {
        Item::Word(wanted) => {
            words.get(at).filter(|word| word.text == *wanted).map(|_| (1, None)).into_iter().collect()
        }
        Item::Number(least, most) => {
            let number = signed(text, at, cardinal_at(words, at)).filter(|(_, value)| (least..=most).contains(&value));
            number.map(|(len, value)| (len, Some(value))).into_iter().collect()
        }
        Item::Stops => stops_at(text, at).map(|(len, value)| (len, Some(value))).into_iter().collect(),
        Item::Wild => lens(1, (at..at + MAX_WILD).take_while(is_word).count()),
        Item::Loose => lens(0, (at..at + MAX_LOOSE).take_while(|at| text.loose.contains(word_at(words, *at))).count()),
        Item::Span => {
            let goes_on = |at: &usize| is_word(at) || word_at(words, *at) == ",";
            lens(1, (at..at + MAX_SPAN).take_while(goes_on).count())
        }
        Item::End => {
            if ends_at(words, at) {
                vec![(0, None)]
            } else {
                Vec::new()
            }
        }
        Item::Of(ways) => ways.iter().flat_map(|way| ways_at(way, text, at)).collect(),
    }
}

/// Whether nothing that belongs to the words before stands at a word.
fn ends_at(words: &[Word], at: usize) -> bool {
    let word = word_at(words, at);
    let is_joint =
        matches!(word, "and" | "then" | "so" | "with" | "while" | "as" | "but" | "for" | "at" | "to" | "please");
    is_joint || !word.starts_with(char::is_alphanumeric)
}

/// A number with the minus sign before it.
fn signed(text: Text<'_>, at: usize, number: Option<(usize, f64)>) -> Option<(usize, f64)> {
    let (len, value) = number?;
    let is_negative = text.words.get(at).is_some_and(|word| is_after_minus(text.prompt, word));
    Some((len, if is_negative { -value } else { value }))
}

/// An amount of light at a word: number of words, stops.
fn stops_at(text: Text<'_>, at: usize) -> Option<(usize, f64)> {
    let words = text.words;
    let numeral = numeral_at(words, at)?;
    let mut end = at + numeral.len;
    if word_at(words, end) == "of" && matches!(word_at(words, end + 1), "a" | "an") {
        end += 2;
    }
    let is_unit = matches!(word_at(words, end), "stop" | "stops" | "ev")
        || word_at(words, end) == "f" && {
            end += 1;
            matches!(word_at(words, end), "stop" | "stops")
        };
    if !is_unit {
        return None;
    }
    end += 1;
    let (more, fraction) = match [0, 1, 2].map(|k| word_at(words, end + k)) {
        ["and", "a", "half"] => (3, 0.5),
        ["and", "a", "third"] => (3, 1.0 / 3.0),
        ["and", "a", "quarter"] => (3, 0.25),
        ["and", "half", _] => (2, 0.5),
        _ => (0, 0.0),
    };
    signed(text, at, Some((end + more - at, numeral.value + fraction)))
}

/// Whether a minus sign stands right before a number, after a space.
fn is_after_minus(prompt: &str, word: &Word) -> bool {
    let before = prompt.get(..word.span[0]).unwrap_or_default();
    let Some(rest) = before.strip_suffix(['-', '\u{2212}']) else { return false };
    rest.is_empty() || rest.ends_with([' ', '(', ',', '=', ':'])
}
