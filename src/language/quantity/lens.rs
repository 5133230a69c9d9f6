//! Focal lengths and fields of view without a unit: `on a 24`, `lens 27`, `zoom from 35 to 70`, `fov 60`.

use super::belonging::bare_number;
use super::context::{after_hedges, back, begins_clause, cause, ends_phrase, word_before};
use super::kind::{Found, QuantityKind, found};
use super::topic::is_about_lenses;
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Focal lengths that a number alone names, in millimeters.
const FOCAL_MM: [f64; 34] = [
    12.0, 14.0, 15.0, 16.0, 17.0, 18.0, 20.0, 21.0, 24.0, 25.0, 27.0, 28.0, 29.0, 32.0, 35.0, 40.0, 50.0, 55.0, 58.0,
    65.0, 70.0, 75.0, 80.0, 85.0, 100.0, 105.0, 135.0, 150.0, 180.0, 200.0, 250.0, 300.0, 400.0, 600.0,
];
/// Focal lengths that are angles or times as well: a number alone names them only near a word about lenses.
const AMBIGUOUS_MM: [f64; 7] = [12.0, 15.0, 20.0, 75.0, 135.0, 180.0, 25.0];

/// A focal length or a field of view without a unit.
pub(super) fn lens_at(words: &[Word], i: usize) -> Option<Found> {
    let article = usize::from(matches!(word_at(words, i), "a" | "the"));
    if word_at(words, i + article) == "nifty" && matches!(word_at(words, i + article + 1), "fifty" | "50") {
        return Some(found(article + 2, QuantityKind::Millimeters, 50.0));
    }
    if let Some((len, value)) = hyphened_zoom_end_at(words, i) {
        return Some(found(len, QuantityKind::Millimeters, value));
    }
    let (end, value) = bare_number(words, i)?;
    if is_field_of_view(words, i, end) && (5.0..=180.0).contains(&value) {
        return Some(found(end - i, QuantityKind::Degrees, value));
    }
    let is_focal_length = (8.0..=800.0).contains(&value)
        && (is_named_lens(words, i, end)
            || is_zoom_end(words, i, end)
            || FOCAL_MM.contains(&value) && is_alone(words, i, end, value));
    is_focal_length.then(|| found(end - i, QuantityKind::Millimeters, value))
}

/// One end of `24-70` in a sentence about a zoom: number of words, millimeters.
fn hyphened_zoom_end_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let is_hyphened = |at: usize| words.get(at).is_some_and(|word| word.after_hyphen);
    let (len, value) = cardinal_at(words, i)?;
    let counts = matches!(
        word_before(words, i - usize::from(is_hyphened(i) && i > 0), 1),
        "frames" | "frame" | "seconds" | "secs" | "shots" | "steps" | "at"
    );
    if counts {
        return None;
    }
    let other = if is_hyphened(i + len) { i + len } else { i.checked_sub(1).filter(|_| is_hyphened(i))? };
    let (_, other) = cardinal_at(words, other)?;
    let are_lenses = [value, other].iter().all(|mm| FOCAL_MM.contains(mm));
    (are_lenses && is_about_lenses(words, i)).then_some((len, value))
}

/// `fov 60`, `60 fov`, `field of view of 60`.
fn is_field_of_view(words: &[Word], i: usize, end: usize) -> bool {
    let start = after_hedges(words, i);
    let before = [1, 2].map(|k| word_before(words, start, k));
    matches!(before, ["fov" | "vfov" | "hfov", _] | ["of" | ":" | "to", "fov" | "view"] | ["view", "of"])
        || matches!(word_at(words, end), "fov" | "vfov" | "hfov")
}

/// `lens 27`, `focal length 40`, `35 lens`.
fn is_named_lens(words: &[Word], i: usize, end: usize) -> bool {
    let start = after_hedges(words, i);
    let before = [1, 2].map(|k| word_before(words, start, k));
    matches!(before, ["lens" | "focal", _] | ["length", "focal"] | [":" | "of" | "is", "lens" | "length" | "focal"])
        && ends_phrase(words, end)
        || matches!(word_at(words, end), "lens" | "prime" | "equiv" | "glass")
}

/// One end of `from 35 to 70` in a sentence about a zoom.
fn is_zoom_end(words: &[Word], i: usize, end: usize) -> bool {
    let is_first =
        matches!(word_at(words, end), "to" | ">") && bare_number(words, end + 1).is_some_and(|(_, mm)| mm >= 8.0);
    let is_number = |start: usize| cardinal_at(words, start).is_some_and(|(len, mm)| start + len + 1 == i && mm >= 8.0);
    let after_number = i >= 2 && is_number(i - 2) || i >= 3 && is_number(i - 3);
    let is_last = matches!(word_before(words, i, 1), "to" | ">") && after_number;
    let is_range = is_first || is_last;
    is_range && is_about_lenses(words, i)
}

/// A number that only a lens has: `on a 24`, `the 50`, `at 85`, `low, 28 or so`.
fn is_alone(words: &[Word], i: usize, end: usize, value: f64) -> bool {
    let about_lenses = is_about_lenses(words, i);
    let before = cause(words, i);
    let last = word_before(words, i, 1);
    let next = word_at(words, end);
    let ends = ends_phrase(words, end)
        || matches!(next, "today" | "at" | "or" | "for" | "if" | "on")
        // `To an 85 over six seconds`.
        || matches!(next, "over" | "in" | "within" | "during") && about_lenses;
    let article = matches!(before, "a" | "the" | "an");
    let preposition = matches!(
        word_before(words, after_hedges(words, i), 2),
        "on" | "with" | "through" | "to" | "both" | "and" | "use"
    );
    if AMBIGUOUS_MM.contains(&value) && !about_lenses {
        return false;
    }
    let with_article = article && ends && (preposition || about_lenses || matches!(value as u32, 35 | 50 | 85));
    let clause = begins_clause(words, i) && ends && value >= 18.0;
    let other_lens = back(words, i, 8).any(|word| matches!(word, "mm" | "lens" | "lenses" | "mil"));
    with_article
        || last == "at" && ends && value >= 24.0 && !AMBIGUOUS_MM.contains(&value)
        || clause && (about_lenses || other_lens || is_framing(words, i))
}

/// Whether the words before speak of a shot's angle or size, between which a lens may stand alone.
fn is_framing(words: &[Word], i: usize) -> bool {
    let is_framing = |word: &str| {
        matches!(
            word,
            "low"
                | "high"
                | "front"
                | "wide"
                | "close"
                | "tight"
                | "shallow"
                | "below"
                | "above"
                | "portrait"
                | "level"
        )
    };
    back(words, i, 8).any(is_framing)
}
