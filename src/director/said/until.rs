//! Moves that go on until something is seen: `pull back until the plates come into frame`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;

/// Words that begin what a move leads to.
const UNTIL: [&str; 5] = ["until", "untill", "till", "til", "'til"];

/// Words of seeing, and of what is in the frame.
const SEES: [&str; 4] = ["see", "show", "have", "get"];
const SEEN: [&str; 8] = ["visible", "in", "seen", "frame", "view", "sight", "revealed", "showing"];

/// Makes one step of a move and of what it goes on to show, which the network sometimes reads as a second step.
pub(crate) fn join_until(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|before, after| follows_until(linked, before, after).then(|| joined(before, after)));
}

/// Whether the second step is only what the first one leads to.
fn follows_until(linked: &Linked, before: &Step, after: &Step) -> bool {
    let moves = before.movement.opposite().is_some() && before.end.size.is_none() && !before.end.whole;
    let shows = (matches!(after.movement, Move::Follow | Move::Static) || sees(linked, after))
        && !after.cut
        && !after.returns
        && after.duration_secs.is_none()
        && after.end.subjects != before.end.subjects
        && !after.end.subjects.is_empty();
    let (Some(first), Some(second)) = (before.words, after.words) else { return false };
    let leads = linked.words_in([first[0], second[1]]).filter(|(_, span)| span[0] >= first[1].min(second[0]));
    let leads: Vec<&str> = leads.map(|(word, _)| word).collect();
    moves
        && shows
        && first[0] < second[0]
        && (leads.iter().take(2).any(|word| UNTIL.contains(word)) || stops_when(&leads))
}

/// Whether words say when a move ends: `it stops when I can see ..`.
fn stops_when(words: &[&str]) -> bool {
    let stop =
        words.iter().take(4).position(|word| ["stop", "end", "finish", "halt"].iter().any(|verb| is_form(word, verb)));
    stop.is_some_and(|at| words.get(at + 1).is_some_and(|word| matches!(*word, "when" | "once" | "where" | "as")))
}

/// Whether a step's words only say until when something is seen: `until I can see the table and the chairs round it`.
fn sees(linked: &Linked, after: &Step) -> bool {
    let words = linked.texts_in(after.words.unwrap_or_default());
    let is_first = |word: &&str| UNTIL.contains(word);
    let sees = |word: &str| SEES.iter().any(|verb| is_form(word, verb));
    let is_seen =
        |pair: &[&str]| matches!(pair[0], "is" | "are" | "'s" | "'re" | "comes" | "come") && SEEN.contains(&pair[1]);
    words.first().is_some_and(is_first)
        && (words.iter().take(6).any(|word| sees(word)) || words.windows(2).any(is_seen))
        && after.with.is_empty()
        && after.amount.is_none()
}

/// The first step, which ends as the second one does.
fn joined(before: &Step, after: &Step) -> Step {
    let start = if before.start == Framing::default() { before.end.clone() } else { before.start.clone() };
    Step { start, end: after.end.clone(), words: before.joint_words(after), ..before.clone() }
}
