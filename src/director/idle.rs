//! Fragments of a message that ask nothing of a camera: `.. has to be calm enough for text on top`, `because we lived there`, `buttery`.
//!
//! The networks read the rest better without them, or worse where they meant something after all: both are readings of the message.

use cinesplat_language::{Linked, Senses, is_listed};

use crate::error::DirectorError;
use crate::said::directs;

/// Marks and words that end a fragment, and words that begin one.
const MARKS: &str = ". , ; : ! ? ( ) -";
const JOINTS: &str = "so because as like where which since though although while";
/// Words by which a fragment belongs to what stands beside it.
const BINDS: &str = "not no never without don't it them";
/// Senses of words that tell how pictures change or what they show.
const TELLING: [&str; 46] = [
    "in", "out", "left", "right", "up", "down", "around", "past", "through", "over", "under", "between", "behind",
    "along", "across", "turn", "nod", "bank", "lens", "sideways", "lift", "circle", "curve", "vertigo", "whip",
    "follow", "hold", "shake", "cut", "visit", "back", "again", "other", "begin", "end", "close", "detail", "wide",
    "whole", "fill", "high", "low", "topdown", "eyelevel", "show", "go",
];

/// The words without fragments that ask for nothing; `None` where there are none, or where nothing is left.
///
/// # Errors
/// [`DirectorError::Language`] for a damaged list of senses.
pub(crate) fn without_idle(linked: &Linked) -> Result<Option<Linked>, DirectorError> {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let senses = linked.senses()?;
    let telling = Senses::named(&TELLING)?;
    let tells = |at: usize| {
        let own = senses.get(at).copied().unwrap_or_default();
        words[at].starts_with('<') || is_listed(BINDS, words[at]) || own.overlaps(telling)
    };
    let is_idle = |[from, to]: &[usize; 2]| to - from > 1 && !(*from..*to).any(tells) && !directs(&words[*from..*to]);
    let bytes = |[from, to]: [usize; 2]| Some([linked.spans.get(from)?[0], linked.spans.get(to - 1)?[1]]);
    let idle: Vec<[usize; 2]> = fragments(&words).into_iter().filter(is_idle).filter_map(bytes).collect();
    let rest = linked.without(&idle, None);
    Ok((!idle.is_empty() && rest.tokens_text.contains("<obj")).then_some(rest))
}

/// Ranges of the words of each fragment.
fn fragments(words: &[&str]) -> Vec<[usize; 2]> {
    let begins = |at: usize| is_listed(JOINTS, words[at]) || at > 0 && is_listed(MARKS, words[at - 1]);
    let starts: Vec<usize> = (0..words.len()).filter(|at| *at == 0 || begins(*at)).collect();
    let ends = starts.iter().skip(1).copied().chain([words.len()]);
    starts.iter().copied().zip(ends).map(|(from, to)| [from, to]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::linked;

    fn rest(text: &str) -> Option<String> {
        without_idle(&linked(text)).unwrap().map(|linked| linked.tokens_text)
    }

    #[test]
    fn what_asks_for_nothing_is_left_out() {
        for (said, asked) in [
            ("push in on <obj-0> , because we lived there . pan left", "push in on <obj-0> , pan left"),
            ("teaser for our guesthouse : drift past <obj-0> , moody and expensive", "drift past <obj-0> ,"),
            ("circle <obj-0> because my mother loved that", "circle <obj-0>"),
        ] {
            assert_eq!(rest(said).as_deref(), Some(asked), "{said}");
        }
    }

    #[test]
    fn what_may_ask_for_something_stays() {
        for text in [
            "push in on <obj-0> , close to it",
            "push in on <obj-0> , not too fast",
            "pan from <obj-0> , then <obj-1>",
            "<obj-0> , <qty-0> wide",
            "a beautiful evening , quiet and calm",
        ] {
            assert_eq!(rest(text), None, "{text}");
        }
    }
}
