//! Clauses that only describe a picture at a moment, and none of the camera's moves.

use cinesplat_language::Linked;

use super::moments::{Mark, Moment, mark_at};
use super::moves::is_move_word;
use super::words::is_picture_word;

/// A clause about a picture.
#[derive(Debug, Clone)]
pub(super) struct Clause {
    /// When the picture is seen.
    pub(super) moment: Moment,
    /// Its bytes of the prompt, with the words of the moment and the mark behind it.
    pub(super) bytes: [usize; 2],
    /// Its words without those of the moment, as positions in the prompt.
    pub(super) words: Vec<usize>,
    /// Whether a verb says when: `ends on ..`.
    pub(super) is_verb: bool,
    /// The time of the end, where it is stated so.
    pub(super) end_secs: Option<f64>,
}

/// What ends a sentence, and what separates the clauses of one.
const SENTENCE_ENDS: [&str; 5] = [".", ";", "!", "?", "|"];
const SEPARATORS: [&str; 5] = [",", ":", "(", ")", "-"];
/// Words before a moment that begins a clause.
const JOINTS: [&str; 5] = ["and", "n", "&", "then", "but"];

/// Words of pictures, of which the clause of a verb must have one: `ends on the vase` may be a move to it.
const STATED: [&str; 12] = [
    "frame",
    "picture",
    "fully",
    "completely",
    "entirely",
    "centered",
    "centred",
    "third",
    "thirds",
    "visible",
    "out",
    "lose",
];

/// Words behind a picture that only say that it crops nothing: `neither touching an edge`.
const EDGES: [&str; 12] =
    ["neither", "none", "touching", "cropped", "an", "the", "edge", "edges", "of", "frame", "image", "uncropped"];

/// The clauses about pictures, in order.
pub(super) fn clauses(linked: &Linked) -> Vec<Clause> {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    if words.len() != linked.spans.len() {
        return Vec::new();
    }
    let mut found = Vec::new();
    let mut from = 0;
    for to in 0..=words.len() {
        if to == words.len() || ends_sentence(linked, &words, to) {
            found.extend(of_sentence(linked, &words, [from, to]));
            from = if words.get(to).is_some_and(|word| SENTENCE_ENDS.contains(word)) { to + 1 } else { to };
        }
    }
    found
}

/// Whether word `at` ends a sentence, or begins another part of a timeline.
fn ends_sentence(linked: &Linked, words: &[&str], at: usize) -> bool {
    let is_dot = |at: usize| words.get(at) == Some(&".");
    let is_ellipsis = is_dot(at) && (is_dot(at + 1) || at > 0 && is_dot(at - 1));
    let mut beats = linked.timeline.iter().flat_map(|timeline| &timeline.beats);
    let begins_beat =
        at > 0 && beats.any(|beat| (linked.spans[at - 1][0] + 1..=linked.spans[at][0]).contains(&beat.bytes[0]));
    SENTENCE_ENDS.contains(&words[at]) && !is_ellipsis || begins_beat
}

/// A piece of a sentence between separators, or from the words of a moment on.
#[derive(Debug)]
struct Piece {
    range: [usize; 2],
    mark: Option<(usize, Mark)>,
}

fn of_sentence(linked: &Linked, words: &[&str], [from, to]: [usize; 2]) -> Vec<Clause> {
    let mut clauses: Vec<Clause> = Vec::new();
    // A heading counts for all of its sentence; another moment counts for the pieces behind it that describe the same
    // picture.
    let mut open: Option<Mark> = None;
    for piece in pieces(linked, words, [from, to]) {
        let content: Vec<usize> = (piece.range[0]..piece.range[1])
            .filter(|at| !piece.mark.is_some_and(|(start, mark)| (start..start + mark.len).contains(at)))
            .filter(|at| !SEPARATORS.contains(&words[*at]))
            .collect();
        let describes = content.iter().all(|at| is_picture_word(linked, words[*at]));
        let moves = || content.iter().any(|at| is_move_word(words[*at]));
        let leads = piece.mark.is_some_and(|(start, _)| start == piece.range[0]);
        let heads = piece.mark.map_or(open, |(_, mark)| Some(mark)).is_some_and(|mark| mark.heads);
        let says_edges = !content.is_empty() && content.iter().all(|at| EDGES.contains(&words[*at]));
        if !(describes || heads && !moves() || says_edges && piece.mark.is_none()) {
            open = None;
            continue;
        }
        let bytes = [linked.spans[piece.range[0]][0], linked.spans[piece.range[1] - 1][1]];
        match (piece.mark, clauses.last_mut()) {
            (Some((_, mark)), _) => {
                open = Some(mark).filter(|mark| leads && mark.moment != Moment::Throughout);
                clauses.push(Clause {
                    moment: mark.moment,
                    bytes,
                    words: content,
                    is_verb: mark.is_verb,
                    end_secs: mark.end_secs,
                });
            }
            (None, Some(clause)) if open.is_some() || says_edges => {
                clause.bytes[1] = bytes[1];
                clause.words.extend(content);
            }
            _ => {}
        }
    }
    clauses.retain(|clause| !clause.words.is_empty() && (!clause.is_verb || states_picture(linked, words, clause)));
    clauses
}

/// Whether a clause has a word that only a picture has.
fn states_picture(linked: &Linked, words: &[&str], clause: &Clause) -> bool {
    let is_in = |at: usize| matches!(words[at], "shot" | "view") && at > 0 && words[at - 1] == "in";
    let is_stated = |at: &usize| STATED.contains(&words[*at]) || linked.is_quantity(words[*at]) || is_in(*at);
    clause.words.iter().any(is_stated)
}

/// The pieces of a sentence. Each has the words of at most one moment.
fn pieces(linked: &Linked, words: &[&str], [from, to]: [usize; 2]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut piece = Piece { range: [from, from], mark: None };
    let mut at = from;
    while at < to {
        if let Some(mark) = mark_at(linked, words, at).filter(|mark| at + mark.len <= to) {
            let joins = at > from && JOINTS.contains(&words[at - 1]);
            if joins || piece.mark.is_some() {
                // `centred in the first frame and on the right third in the last`
                let told = piece.mark.map_or(at, |(start, mark)| start + mark.len);
                let next = (told..at).find(|at| JOINTS.contains(&words[*at])).unwrap_or(at);
                piece.range[1] = next;
                pieces.push(std::mem::replace(&mut piece, Piece { range: [next, at], mark: None }));
            }
            piece.mark = Some((at, mark));
            at += mark.len;
            piece.range[1] = at;
            continue;
        }
        at += 1;
        piece.range[1] = at;
        if SEPARATORS.contains(&words[at - 1]) {
            pieces.push(std::mem::replace(&mut piece, Piece { range: [at, at], mark: None }));
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.range[0] < piece.range[1]);
    pieces
}
