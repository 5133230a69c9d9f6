//! Templates: one way to phrase a meaning, with placeholders and tokens of meaning.
//!
//! A template is `text [=> meaning]`. The text holds words, `[a|b|]` choices, `{list}` references, `{SECS}` and other
//! quantities, `*verb` and the object placeholders `A`, `B`, `C`. The meaning is tokens of the notation of programs.

use super::quantity_phrases::QuantityPlaceholder;

/// One way to phrase a meaning, with its tokens of meaning.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Template {
    /// In the order of the text; empty for a template without text.
    pub(crate) pieces: Vec<Piece>,
    /// Tokens of the notation of programs.
    pub(crate) meaning: Vec<String>,
    /// Relative frequency among its alternatives.
    pub(crate) weight: f64,
    /// Reserved for evaluation: never used for training.
    pub(crate) held_out: bool,
}

/// A piece of a template.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Piece {
    /// A token of every expansion.
    Token(ClauseToken),
    /// A quantity, phrased anew in every expansion.
    Quantity(QuantityPlaceholder),
    /// A template of this list of the grammar.
    List(String),
    /// One of several templates.
    Choice(Vec<Template>),
}

/// A token of a clause before its surface realization.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ClauseToken {
    /// A word or punctuation mark.
    Word(String),
    /// A verb in its base form, to be inflected.
    Verb(String),
    /// An object to be referred to.
    Object(ObjectPlaceholder, ReferenceForm),
    /// A phrased quantity.
    Quantity(String),
    /// No text: the form that the words before it require of the next clause.
    Requires(NextForm),
}

/// Placeholder of an object in a template.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::EnumString)]
#[derive(strum::VariantArray)]
pub(crate) enum ObjectPlaceholder {
    A,
    B,
    C,
}

/// How a clause refers to an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ReferenceForm {
    /// `the skull`, or a pronoun where it is unambiguous.
    Plain,
    /// `the skull's`, or `its` where it is unambiguous.
    Possessive,
    /// Always `it` or `them`.
    Pronoun,
    /// Always `its` or `their`.
    PossessivePronoun,
}

/// Form of the clause after a connective.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NextForm {
    /// `after pushing in`.
    Gerund,
    /// `followed by a pan`.
    NounPhrase,
}

impl Template {
    /// Reads `[%WEIGHT] [~] text [=> meaning]`; `~` marks a held-out template.
    pub(crate) fn parse(line: &str) -> Result<Self, String> {
        let mut rest = line.trim();
        let mut weight = 1.0;
        if let Some(after) = rest.strip_prefix('%') {
            let (number, after) = after.split_once(' ').unwrap_or((after, ""));
            weight = number.parse().map_err(|_| format!("weight \"{number}\""))?;
            rest = after.trim();
        }
        let (held_out, rest) = rest.strip_prefix('~').map_or((false, rest), |after| (true, after.trim()));
        Ok(Self { weight, held_out, ..Self::parse_unweighted(rest)? })
    }

    /// Reads `text [=> meaning]`; an arrow inside brackets belongs to the text.
    fn parse_unweighted(line: &str) -> Result<Self, String> {
        let mut depth = 0i32;
        let arrow = line.char_indices().find(|(at, c)| {
            depth += i32::from(*c == '[') - i32::from(*c == ']');
            depth == 0 && line.get(*at..).is_some_and(|rest| rest.starts_with("=>"))
        });
        let (text, meaning) = match arrow {
            Some((at, _)) => (line.get(..at).unwrap_or_default(), line.get(at + 2..).unwrap_or_default()),
            None => (line, ""),
        };
        let meaning = meaning.split_whitespace().map(str::to_owned).collect();
        Ok(Self { pieces: pieces(text)?, meaning, weight: 1.0, held_out: false })
    }

    /// Names of all lists that the template refers to, in its choices too.
    pub(crate) fn lists(&self) -> Vec<&str> {
        self.pieces.iter().flat_map(Piece::lists).collect()
    }
}

impl Piece {
    fn lists(&self) -> Vec<&str> {
        match self {
            Self::List(name) => vec![name],
            Self::Choice(options) => options.iter().flat_map(Template::lists).collect(),
            Self::Token(_) | Self::Quantity(_) => Vec::new(),
        }
    }
}

fn pieces(text: &str) -> Result<Vec<Piece>, String> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['[', '{']) {
        let (before, from) = rest.split_at(at);
        pieces.extend(tokens(before));
        let close = if from.starts_with('[') { ']' } else { '}' };
        let end = closing_bracket(from, close).ok_or_else(|| format!("no {close} in \"{text}\""))?;
        let inside = from.get(1..end).unwrap_or_default();
        if close == '}' {
            pieces.push(inside.parse().map_or_else(|_| Piece::List(inside.to_owned()), Piece::Quantity));
        } else {
            let options: Result<_, String> = options(inside).into_iter().map(Template::parse_unweighted).collect();
            pieces.push(Piece::Choice(options?));
        }
        rest = from.get(end + 1..).unwrap_or_default();
    }
    pieces.extend(tokens(rest));
    Ok(pieces)
}

fn tokens(text: &str) -> impl Iterator<Item = Piece> {
    text.split_whitespace().flat_map(tokens_of_word).map(Piece::Token)
}

/// The token of a word; a connective that ends in `+g` or `+n` is two, the word and the form that it requires.
fn tokens_of_word(word: &str) -> Vec<ClauseToken> {
    let connective = |word: &str, next| vec![ClauseToken::Word(word.to_owned()), ClauseToken::Requires(next)];
    if let Some(word) = word.strip_suffix("+g") {
        return connective(word, NextForm::Gerund);
    }
    if let Some(word) = word.strip_suffix("+n") {
        return connective(word, NextForm::NounPhrase);
    }
    let forms = [
        ("'s", ReferenceForm::Possessive),
        (".its", ReferenceForm::PossessivePronoun),
        (".it", ReferenceForm::Pronoun),
        ("", ReferenceForm::Plain),
    ];
    let object = forms.into_iter().find_map(|(ending, form)| Some((word.strip_suffix(ending)?.parse().ok()?, form)));
    vec![match (object, word.strip_prefix('*')) {
        (Some((placeholder, form)), _) => ClauseToken::Object(placeholder, form),
        (None, Some(verb)) => ClauseToken::Verb(verb.to_owned()),
        (None, None) => ClauseToken::Word(word.to_owned()),
    }]
}

/// Byte of the bracket that closes the one at the start of `text`.
fn closing_bracket(text: &str, close: char) -> Option<usize> {
    let open = text.chars().next()?;
    let mut depth = 0i32;
    text.char_indices()
        .find(|(_, c)| {
            depth += i32::from(*c == open) - i32::from(*c == close);
            depth == 0
        })
        .map(|(at, _)| at)
}

/// `text` split at each `|` outside inner brackets.
fn options(text: &str) -> Vec<&str> {
    let mut depth = 0i32;
    let mut options = Vec::new();
    let mut start = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(matches!(c, '[' | '{')) - i32::from(matches!(c, ']' | '}'));
        if c == '|' && depth == 0 {
            options.push(text.get(start..at).unwrap_or_default());
            start = at + 1;
        }
    }
    options.push(text.get(start..).unwrap_or_default());
    options
}
