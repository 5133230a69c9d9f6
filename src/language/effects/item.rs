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
    /// Up to four words that say nothing of their own, and negations: `should be very`, `should not be`.
    Loose,
    /// Up to nine words of the sentence.
    Span,
    /// No word: the end of what belongs together.
    End,
    /// No word: the end of a clause that no `to`, `with` or `at` continues.
    ClauseEnd,
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
    /// Negations that a `..` may stand for.
    pub(super) negating: &'a BTreeSet<String>,
    /// Words that make a negation a matter of degree.
    pub(super) moderating: &'a BTreeSet<String>,
}

/// Words taken by some items.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Taken {
    /// Number of the words.
    pub(super) len: usize,
    /// The number in them.
    pub(super) number: Option<f64>,
    /// Whether a `..` stands for a negation among them: `the corners should not be dark`.
    pub(super) is_negated: bool,
}

impl Taken {
    /// Words without a number or a negation.
    fn words(len: usize) -> Self {
        Self { len, ..Self::default() }
    }

    /// A number of some words.
    fn number((len, value): (usize, f64)) -> Self {
        Self { len, number: Some(value), is_negated: false }
    }

    /// These words and those of later items.
    pub(super) fn then(self, later: Self) -> Self {
        Self {
            len: self.len + later.len,
            number: self.number.or(later.number),
            is_negated: self.is_negated != later.is_negated,
        }
    }

    /// The larger, the better: more words, then those without a negation.
    pub(super) fn rank(self) -> (usize, bool) {
        (self.len, !self.is_negated)
    }
}

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
        ";;" => Item::ClauseEnd,
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
    // The end of `shouldn't` is a word of its own.
    if token.starts_with('\'') {
        return vec![vec![Item::Word(token.to_owned())]];
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
    let Some((item, rest)) = items.split_first() else { return vec![Taken::default()] };
    let after = |taken: Taken| ways_at(rest, text, at + taken.len).into_iter().map(move |further| taken.then(further));
    item_at(item, text, at).into_iter().flat_map(after).collect()
}

/// Every way in which an item is at a word.
fn item_at(item: &Item, text: Text<'_>, at: usize) -> Vec<Taken> {
    let words = text.words;
    let lens = |first: usize, num: usize| (first..=num).map(Taken::words).collect();
    let none_if = |holds: bool| if holds { vec![Taken::default()] } else { Vec::new() };
    let is_word = |at: &usize| words.get(*at).is_some_and(|word| word.text.chars().any(char::is_alphanumeric));
    match item {
        Item::Word(wanted) => {
            words.get(at).filter(|word| word.text == *wanted).map(|_| Taken::words(1)).into_iter().collect()
        }
        Item::Number(least, most) => {
            let number = signed(text, at, cardinal_at(words, at)).filter(|(_, value)| (least..=most).contains(&value));
            number.map(Taken::number).into_iter().collect()
        }
        Item::Stops => stops_at(text, at).map(Taken::number).into_iter().collect(),
        Item::Wild => lens(1, (at..at + MAX_WILD).take_while(is_word).count()),
        Item::Loose => loose_at(text, at),
        Item::Span => {
            let goes_on = |at: &usize| is_word(at) || word_at(words, *at) == ",";
            lens(1, (at..at + MAX_SPAN).take_while(goes_on).count())
        }
        Item::End => none_if(ends_at(words, at)),
        Item::ClauseEnd => none_if(ends_clause_at(words, at)),
        Item::Of(ways) => ways.iter().flat_map(|way| ways_at(way, text, at)).collect(),
    }
}

/// Every way in which a `..` stands for words at a word. A negation that is a matter of degree is none: `should not be
/// too dark`.
fn loose_at(text: Text<'_>, at: usize) -> Vec<Taken> {
    let mut ways = vec![Taken::default()];
    let (mut taken, mut num_loose) = (Taken::default(), 0);
    loop {
        let word = word_at(text.words, at + taken.len);
        let is_degree = taken.is_negated && text.moderating.contains(word);
        if text.negating.contains(word) {
            taken.is_negated = true;
        } else if text.loose.contains(word) && num_loose < MAX_LOOSE && !is_degree {
            num_loose += 1;
        } else {
            break;
        }
        taken.len += 1;
        ways.push(taken);
    }
    ways.retain(|way| !way.is_negated || !text.moderating.contains(word_at(text.words, at + way.len)));
    ways
}

/// Whether nothing that belongs to the words before stands at a word.
fn ends_at(words: &[Word], at: usize) -> bool {
    let word = word_at(words, at);
    let is_joint =
        matches!(word, "and" | "then" | "so" | "with" | "while" | "as" | "but" | "for" | "at" | "to" | "please");
    is_joint || !word.starts_with(char::is_alphanumeric)
}

/// Whether a clause ends before a word. The point of `ca. 3 m` ends none.
fn ends_clause_at(words: &[Word], at: usize) -> bool {
    match word_at(words, at) {
        "and" | "then" | "so" | "but" | "while" | "please" | "because" | "since" | "though" | "tho" | "thanks" => true,
        "." => cardinal_at(words, at + 1).is_none(),
        word => !word.starts_with(char::is_alphanumeric),
    }
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
