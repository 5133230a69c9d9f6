//! Ways of turning that the words name only to say how it is not done: `drift along to the vase, carrying the camera rather than
//! swivelling on the spot`.
//!
//! The network makes moves of them. What they deny of the lens or of the way it reads itself as ruled out.

use cinesplat_language::{Linked, is_listed};

use crate::said::is_form;

/// Words before what is denied.
const INSTEAD: [&[&str]; 4] =
    [&["rather", "than"], &["instead", "of"], &["as", "opposed", "to"], &["and", "not", "by"]];
/// Verbs of a turn on the spot.
const TURNS: [&str; 9] = ["swivel", "swivell", "pan", "turn", "rotate", "pivot", "spin", "swing", "twist"];
/// Words that may stand between and behind them.
const BESIDE: &str =
    "just only simply merely a the from on in its one same fixed spot place point around round head camera with by";
/// Most words behind such a verb.
const MOST_WORDS: usize = 6;

/// The words without those of turns that they deny; `None` where there are none, or nothing else is said.
pub(crate) fn without_denied_turns(linked: &Linked) -> Option<Linked> {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    let denied: Vec<[usize; 2]> = (0..texts.len()).filter_map(|at| denied_at(&texts, at)).collect();
    let is_left = |at: &usize| !denied.iter().any(|[from, to]| (*from..*to).contains(at));
    if denied.is_empty() || !(0..texts.len()).filter(is_left).any(|at| linked.slot_at(texts[at]).is_some()) {
        return None;
    }
    let bytes: Vec<[usize; 2]> = denied.iter().map(|[from, to]| [words[*from].1[0], words[to - 1].1[1]]).collect();
    Some(linked.without(&bytes, None))
}

/// The words of a turn that is denied from word `at` on.
fn denied_at(texts: &[&str], at: usize) -> Option<[usize; 2]> {
    // `Instead of panning, truck right` rules a motion out.
    if at == 0 || !texts[at - 1].contains(char::is_alphanumeric) && texts[at - 1] != "," {
        return None;
    }
    let instead = INSTEAD.iter().find(|instead| texts[at..].starts_with(instead))?;
    let beside = |from: usize| texts[from..].iter().take(MOST_WORDS).take_while(|word| is_listed(BESIDE, word)).count();
    let verb = at + instead.len() + beside(at + instead.len());
    texts.get(verb).filter(|word| TURNS.iter().any(|turn| is_form(word, turn)))?;
    let end = verb + 1 + beside(verb + 1);
    let ends = texts.get(end).is_none_or(|word| {
        is_listed("and but while until so then", word)
            || !word.starts_with(char::is_alphanumeric) && !word.starts_with('<')
    });
    // `.., travelling instead of panning`.
    let is_go = |word: &str| matches!(word, "travelling" | "traveling" | "moving" | "going" | "gliding" | "physically");
    let goes = texts[..at].iter().rev().take_while(|word| is_go(word)).count();
    let is_aside = goes > 0 && at.checked_sub(goes + 1).is_some_and(|before| texts[before] == ",");
    ends.then_some([if is_aside { at - goes - 1 } else { at }, end])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::linked;

    fn left(text: &str) -> Option<String> {
        without_denied_turns(&linked(text)).map(|linked| linked.tokens_text)
    }

    #[test]
    fn a_turn_that_is_denied_is_no_move() {
        for (said, meant) in [
            ("drift to <obj-0> rather than swivelling on the spot , and stop", "drift to <obj-0> , and stop"),
            ("slide from <obj-0> to <obj-1> instead of just panning", "slide from <obj-0> to <obj-1>"),
            ("glide to <obj-0> , travelling instead of panning , and stop", "glide to <obj-0> , and stop"),
            ("go to <obj-0> as opposed to turning on the spot and hold", "go to <obj-0> and hold"),
        ] {
            assert_eq!(left(said).as_deref(), Some(meant), "{said}");
        }
    }

    #[test]
    fn other_alternatives_stay() {
        for text in [
            "push in on <obj-0> rather than zooming",
            "go to <obj-0> instead of <obj-1>",
            "pan to <obj-0> rather than to <obj-1>",
            "end on <obj-0> instead of panning to <obj-1>",
            "rather than turning on the spot , travel to <obj-0>",
            "start on <obj-0> . instead of panning , truck right to <obj-1>",
        ] {
            assert_eq!(left(text), None, "{text}");
        }
    }
}
