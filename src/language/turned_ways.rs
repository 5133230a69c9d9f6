//! People who take a direction back: `slide to the left, no wait, the other way, to the right`, `truck left, sorry, other direction`.
//!
//! The direction that is said last counts.

use super::corrections::correction_at;
use super::linked::Linked;

/// Directions and their opposites.
const OPPOSITES: [[&str; 2]; 9] = [
    ["left", "right"],
    ["up", "down"],
    ["upward", "downward"],
    ["upwards", "downwards"],
    ["clockwise", "counterclockwise"],
    ["clockwise", "anticlockwise"],
    ["forward", "backward"],
    ["forwards", "backwards"],
    ["forward", "back"],
];
/// Words before a direction that is said once more.
const LEADS: [&str; 12] = ["to", "the", "so", "i", "mean", "meant", "go", "towards", ",", ".", "-", "it's"];
/// Most of them.
const MOST_LEADS: usize = 5;
/// Words of the other way.
const WAYS: [&str; 3] = ["way", "direction", "side"];

impl Linked {
    /// The words with the last direction before `no wait, the other way` turned around, or in the place of it the one that is said
    /// behind that. `None` for prompts without one.
    pub(super) fn turned(&self) -> Option<Self> {
        let mut words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let (at, meant, dropped) = turned_at(&texts)?;
        words[at].0 = meant;
        let kept = (0..dropped[0]).chain(dropped[1]..words.len()).map(|at| words[at]);
        Some(self.of_words(kept.collect::<Vec<_>>().into_iter(), None))
    }
}

/// The word of a direction that is taken back, the one that is meant, and the words that take it back.
fn turned_at<'a>(texts: &[&'a str]) -> Option<(usize, &'a str, [usize; 2])> {
    let text = |at: usize| texts.get(at).copied().unwrap_or_default();
    let [from, to] =
        (0..texts.len()).rev().find_map(|at| correction_at(texts, at).filter(|[_, to]| is_other(texts, *to)))?;
    let said = (0..from).rev().find(|at| opposite(text(*at)).is_some())?;
    let way = to + (to..texts.len()).take_while(|at| matches!(texts[*at], "the" | "to")).count() + 2;
    // `The other way round` exchanges two things, and `the other side of it` is a place.
    if matches!(text(way), "round" | "around" | "about" | "of") {
        return None;
    }
    let leads = (way..texts.len()).take(MOST_LEADS).take_while(|at| LEADS.contains(&texts[*at])).count();
    let again = way + leads;
    let is_again = opposite(text(said)).is_some_and(|opposite| opposite == text(again)) || text(said) == text(again);
    let meant = if is_again { text(again) } else { opposite(text(said))? };
    Some((said, meant, [from, if is_again { again + 1 } else { way }]))
}

/// Whether words say `the other way` from word `at` on.
fn is_other(texts: &[&str], at: usize) -> bool {
    let behind: Vec<&str> =
        texts.iter().skip(at).copied().skip_while(|word| matches!(*word, "the" | "to")).take(2).collect();
    matches!(behind[..], ["other" | "opposite", way] if WAYS.contains(&way))
}

fn opposite(word: &str) -> Option<&'static str> {
    OPPOSITES.iter().find_map(|[one, other]| match word {
        _ if word == *one => Some(*other),
        _ if word == *other => Some(*one),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(text: &str) -> Option<String> {
        let spans = (0..text.split(' ').count()).map(|at| [at, at]).collect();
        Linked { tokens_text: text.to_owned(), spans, slots: vec![7, 4], ..Linked::default() }
            .turned()
            .map(|linked| linked.tokens_text)
    }

    #[test]
    fn the_direction_that_is_said_last_counts() {
        for (said, meant) in [
            (
                "slide sideways to the left , no wait , the other way , to the right , keeping <obj-0> in shot",
                "slide sideways to the right , keeping <obj-0> in shot",
            ),
            ("truck left . . . no sorry , other direction", "truck right"),
            (
                "circle <obj-0> clockwise , wait no , the opposite way , slowly",
                "circle <obj-0> counterclockwise , slowly",
            ),
            ("tilt up to <obj-0> , actually no , the other way , i mean down", "tilt down to <obj-0>"),
        ] {
            assert_eq!(turned(said).as_deref(), Some(meant), "{said}");
        }
    }

    #[test]
    fn other_ways_that_take_nothing_back_stay() {
        for text in [
            "pan left to <obj-0> , then the other way",
            "pan left to <obj-0> , no wait , the other side of it",
            "turn from <obj-0> to <obj-1> , no sorry , the other way round",
            "truck left , no wait , push in on the other side",
        ] {
            assert_eq!(turned(text), None, "{text}");
        }
    }
}
