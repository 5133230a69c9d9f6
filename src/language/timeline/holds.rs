//! Lengths of holds in a list of parts: `3 sec hold on the vase; pan right to the chair; 2 sec hold`.
//!
//! A time before a hold is that of the hold alone. A move behind it that no time begins is a part of its own.

use crate::tokenizer::{Word, is_listed, word_at};

/// Words of a picture that rests, as the first ones behind a time, and words before them.
const HOLDS: &str = "hold rest pause static still freeze frozen linger lock locked lock-off lockoff beat on";
const BEFORE: &str = "a an the long steady firm full static still locked of";
/// Verbs of a move, as stems.
const MOVES: &str = "pan tilt push pull dolly truck track crane boom jib pedestal zoom orbit arc circle swing whip move go come slide \
    glide drift rise sink lower lift turn swivel rotate pivot sweep fly creep ease travel follow";
/// Words between a mark and such a verb.
const JOINTS: &str = "then and now next we slowly gently quickly smoothly the camera";

/// The word with which a move begins behind the hold of which a part states the length; `None` where the part does not begin with
/// a hold, or nothing but the hold is in it.
pub(super) fn move_behind_hold(words: &[Word], [start, end]: [usize; 2]) -> Option<usize> {
    let first = (start..end).find(|at| !is_listed(BEFORE, word_at(words, *at)) || is_hold(words, *at))?;
    let is_joint = |at: usize| matches!(word_at(words, at), "," | ";" | "." | "then");
    let verb_behind = |at: usize| {
        let verb = (at + 1..end).find(|at| !is_listed(JOINTS, word_at(words, *at)))?;
        let is_verb = words.get(verb).is_some_and(|word| is_listed(MOVES, &word.stem) || is_listed(MOVES, &word.text));
        (is_joint(at) && is_verb).then_some(at + usize::from(word_at(words, at) != "then"))
    };
    (first + 1..end).filter(|_| is_hold(words, first)).find_map(verb_behind)
}

fn is_hold(words: &[Word], at: usize) -> bool {
    words.get(at).is_some_and(|word| is_listed(HOLDS, &word.text) || is_listed(HOLDS, &word.stem))
}

#[cfg(test)]
mod tests {
    use super::super::Beat;
    use crate::mention::link_mentions;

    #[test]
    fn a_time_before_a_hold_is_that_of_the_hold() {
        let parts = |prompt: &str| -> Vec<(String, Option<f64>)> {
            let timeline = link_mentions(prompt, &[]).unwrap().timeline;
            let beats = timeline.map(|timeline| timeline.beats).unwrap_or_default();
            beats.iter().map(|beat: &Beat| (prompt[beat.bytes[0]..beat.bytes[1]].to_owned(), beat.secs())).collect()
        };
        let part = |text: &str, secs: Option<f64>| (text.to_owned(), secs);
        assert_eq!(
            parts("3 sec hold on the vase; pan right to the chair; 2 sec hold"),
            [part("hold on the vase", Some(3.0)), part("pan right to the chair", None), part("hold", Some(2.0))]
        );
        assert_eq!(
            parts("2s on the vase, then slowly push in, 4s static hold on the lamp"),
            [part("on the vase", Some(2.0)), part("slowly push in", None), part("static hold on the lamp", Some(4.0))]
        );
        // A move has its time with all that belongs to it, and a hold goes on with what is no move.
        assert_eq!(parts("3s push in, then orbit left, 2s hold").len(), 2);
        assert_eq!(parts("3s hold on the vase, nothing moves, 2s pan to the chair").len(), 2);
        assert_eq!(parts("0-3s hold on the vase, pan to the chair, 3-6s push in").len(), 2);
    }
}
