//! Shares of the film with which a part of a timeline begins: `first third of the move:`, `40-70%:`.

use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// The share that begins at word `i`: the word after it, and the fraction of the film.
pub(super) fn share_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    named_at(words, i).or_else(|| percent_at(words, i))
}

/// `first third:`, `the last half of the move:`.
fn named_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let i = i + usize::from(word_at(words, i) == "the");
    let is_ordinal = matches!(
        word_at(words, i),
        "first" | "second" | "third" | "fourth" | "middle" | "next" | "last" | "final" | "opening" | "closing"
    );
    let share = match word_at(words, i + 1) {
        "half" => 1.0 / 2.0,
        "third" => 1.0 / 3.0,
        "quarter" => 1.0 / 4.0,
        _ => return None,
    };
    let end = i + 2 + of_film_at(words, i + 2);
    (is_ordinal && matches!(word_at(words, end), ":" | "," | "is")).then_some((end + 1, share))
}

/// Number of words of `of the move` at word `i`.
fn of_film_at(words: &[Word], i: usize) -> usize {
    let the = i + 1 + usize::from(matches!(word_at(words, i + 1), "the" | "this" | "our"));
    let is_film =
        matches!(word_at(words, the), "move" | "shot" | "film" | "clip" | "video" | "time" | "take" | "duration");
    if word_at(words, i) == "of" && is_film { the + 1 - i } else { 0 }
}

/// `0-40%:`, `40 to 70 %:`.
fn percent_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let is_percent = |at: usize| matches!(word_at(words, at), "%" | "percent");
    let (len, from) = cardinal_at(words, i)?;
    let link = i + len + usize::from(is_percent(i + len));
    let is_dash = matches!(word_at(words, link), "-" | "\u{2013}" | "\u{2014}" | "to" | "until" | "till");
    let last = link + usize::from(is_dash);
    let is_linked = is_dash || words.get(last).is_some_and(|word| word.after_hyphen);
    let (len, to) = cardinal_at(words, last).filter(|_| is_linked)?;
    let end = last + len;
    let is_span = (0.0..to).contains(&from) && to <= 100.0;
    (is_span && is_percent(end) && matches!(word_at(words, end + 1), ":" | ","))
        .then_some((end + 2, (to - from) / 100.0))
}

#[cfg(test)]
mod tests {
    use super::super::BeatLength;
    use crate::mention::link_mentions;

    #[test]
    fn parts_may_be_shares_of_the_film() {
        let parts = |prompt: &str| -> Vec<(String, Option<BeatLength>)> {
            let timeline = link_mentions(prompt, &[]).unwrap().timeline;
            let beats = timeline.map(|timeline| timeline.beats).unwrap_or_default();
            beats.iter().map(|beat| (prompt[beat.bytes[0]..beat.bytes[1]].to_owned(), beat.length)).collect()
        };
        let part = |text: &str, share: f64| (text.to_owned(), Some(BeatLength::Share(share)));
        assert_eq!(
            parts("0-40%: crane down. 40-70%: half an orbit. 70-100%: pull back."),
            [part("crane down", 0.4), part("half an orbit", 0.3), part("pull back", 0.3)]
        );
        assert_eq!(
            parts("First third of the move: hold. Second third: pan left. Final third: push in."),
            [part("hold", 1.0 / 3.0), part("pan left", 1.0 / 3.0), part("push in", 1.0 / 3.0)]
        );
        assert_eq!(parts("push in until the mug is 40-70% of the frame, then 10-20% more"), []);
    }
}
