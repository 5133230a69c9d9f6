//! Matches a pattern against linked words.

use std::sync::Arc;

use crate::inflection::{VerbForm, inflect};
use crate::linked::{OBJECT, QUANTITY, slot_of};
use crate::quantity::{Quantity, QuantityKind};

/// Most words of a gap.
const MAX_GAP: usize = 4;
/// Words that end a clause besides marks.
const JOINTS: [&str; 5] = ["and", "then", "but", "so", "while"];
/// Words that turn the meaning of what follows around: no gap holds them.
const NEGATIONS: [&str; 7] = ["not", "no", "never", "without", "don", "doesn", "isn"];
/// Most pieces that are tried at one word. No pattern needs a tenth of them for words that people write.
const MAX_TRIED: usize = 3000;

/// A part of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    Word(String),
    /// A verb in any form: its forms.
    Verb([String; 3]),
    /// The first of these that fits. Patterns share their named lists.
    OneOf(Arc<Vec<Vec<Piece>>>),
    /// An object, captured under a name.
    Object(String),
    /// A quantity of a kind, or of any, captured under a name.
    Quantity(Option<QuantityKind>, String),
    /// Up to [`MAX_GAP`] plain words, captured under a name.
    Gap(String),
    /// The beginning of a clause.
    Start,
    /// The end of a clause.
    End,
}

impl Piece {
    pub(super) fn verb(base: &str) -> Self {
        Self::Verb([VerbForm::Base, VerbForm::ThirdPerson, VerbForm::Gerund].map(|form| inflect(base, form)))
    }
}

/// A match: the word after it, what it has captured, and the form of its first verb.
#[derive(Debug, Clone, Default)]
pub(super) struct Found<'a> {
    pub(super) end: usize,
    captures: Vec<(&'a str, [usize; 2])>,
    pub(super) form: Option<VerbForm>,
}

impl Found<'_> {
    /// The words that were captured under a name.
    pub(super) fn captured(&self, name: &str) -> Option<[usize; 2]> {
        self.captures.iter().find(|(known, _)| *known == name).map(|(_, range)| *range)
    }
}

/// The words of a prompt and its quantities.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub(super) words: &'a [&'a str],
    pub(super) quantities: &'a [Quantity],
}

/// Matches `pieces` from word `at` on.
pub(super) fn match_at<'a>(pieces: &'a [Piece], subject: Subject<'_>, at: usize) -> Option<Found<'a>> {
    let pending: Vec<&Piece> = pieces.iter().rev().collect();
    run(pending, subject, Found { end: at, ..Found::default() }, &mut 0)
}

/// Goes on with the pieces that are still to match, the next one last.
fn run<'a>(
    mut pending: Vec<&'a Piece>,
    subject: Subject<'_>,
    mut found: Found<'a>,
    num_tried: &mut usize,
) -> Option<Found<'a>> {
    while let Some(piece) = pending.pop() {
        *num_tried += 1;
        if *num_tried > MAX_TRIED {
            return None;
        }
        let at = found.end;
        let word = subject.words.get(at).copied();
        match piece {
            Piece::Word(text) => {
                word.filter(|word| word == text)?;
                found.end += 1;
            }
            Piece::Verb(forms) => {
                let nth = forms.iter().position(|form| word == Some(form))?;
                let form = [VerbForm::Base, VerbForm::ThirdPerson, VerbForm::Gerund][nth];
                found.form = found.form.or(Some(form));
                found.end += 1;
            }
            Piece::Object(name) => {
                // A mention may be without its article.
                let at = at + usize::from(word.is_some_and(is_article));
                subject.words.get(at).filter(|word| word.starts_with(OBJECT))?;
                found.captures.push((name, [at, at + 1]));
                found.end = at + 1;
            }
            Piece::Quantity(kind, name) => {
                let known =
                    word.and_then(|word| slot_of(word, QUANTITY)).and_then(|nth| subject.quantities.get(nth))?;
                if kind.is_some_and(|kind| kind != known.kind) {
                    return None;
                }
                found.captures.push((name, [at, at + 1]));
                found.end += 1;
            }
            Piece::OneOf(alternatives) => {
                return alternatives.iter().filter(|alternative| may_begin(alternative, word)).find_map(
                    |alternative| {
                        let mut rest = pending.clone();
                        rest.extend(alternative.iter().rev());
                        run(rest, subject, found.clone(), num_tried)
                    },
                );
            }
            Piece::Gap(name) => {
                let plain = subject.words[at..].iter().take(MAX_GAP).copied().take_while(|word| is_plain(word)).count();
                return (0..=plain).find_map(|len| {
                    let mut with_gap = found.clone();
                    with_gap.captures.push((name, [at, at + len]));
                    with_gap.end = at + len;
                    run(pending.clone(), subject, with_gap, num_tried)
                });
            }
            Piece::Start => {
                let before = at.checked_sub(1).and_then(|before| subject.words.get(before));
                if before.is_some_and(|word| !is_joint(word)) {
                    return None;
                }
            }
            Piece::End => {
                if word.is_some_and(|word| !is_joint(word)) {
                    return None;
                }
            }
        }
    }
    Some(found)
}

/// Whether an alternative may begin with a word, by its first piece alone.
fn may_begin(alternative: &[Piece], word: Option<&str>) -> bool {
    match alternative.first() {
        Some(Piece::Word(text)) => word == Some(text),
        Some(Piece::Verb(forms)) => word.is_some_and(|word| forms.iter().any(|form| form == word)),
        Some(Piece::Object(_)) => word.is_some_and(|word| word.starts_with(OBJECT) || is_article(word)),
        Some(Piece::Quantity(..)) => word.is_some_and(|word| word.starts_with(QUANTITY)),
        Some(Piece::OneOf(_) | Piece::Gap(_) | Piece::Start | Piece::End) | None => true,
    }
}

fn is_article(word: &str) -> bool {
    matches!(word, "the" | "a" | "an" | "my" | "your" | "our")
}

fn is_joint(word: &str) -> bool {
    is_mark(word) || JOINTS.contains(&word)
}

fn is_mark(word: &str) -> bool {
    !word.starts_with('<') && !word.contains(char::is_alphanumeric)
}

/// Whether a gap may hold it: a word, neither a mark nor a placeholder, that neither ends a clause nor negates.
fn is_plain(word: &str) -> bool {
    !word.starts_with('<') && !is_joint(word) && !NEGATIONS.contains(&word)
}
