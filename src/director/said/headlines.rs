//! Headlines that count the parts of a film: `Two setups with a hard cut between. A: the chair, static, 3 s. B: ..`.
//!
//! They are no picture of their own, whatever the network reads in them.

use cinesplat_language::{Linked, is_listed, number_word};
use cinesplat_operator::{Framing, Motion, Program, Step};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// What the parts of a film are called.
const PARTS: &str =
    "setups shots pictures angles frames takes parts moves beats views stills images steps scenes clips segments";
/// Words beside their number in a headline.
const BESIDE: &str = "just only simple separate different camera of them with w / a an one hard straight clean cut cuts between in the \
    please and , this is film here are we need want total all static locked";
/// Most words of a headline.
const MOST_WORDS: usize = 12;
/// Marks that end it.
const MARKS: [&str; 4] = [".", ":", "!", ";"];

/// Takes the picture of a headline out of the film.
pub(crate) fn drop_headline(linked: &Linked, direction: &mut Direction) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let Some(mark) = words.iter().position(|(word, _)| MARKS.contains(word)) else { return };
    let headline: Vec<&str> = words[..mark].iter().map(|(word, _)| *word).collect();
    let [first, _, ..] = &direction.program.steps[..] else { return };
    let plain = Framing { size: first.end.size, ..Framing::default() };
    let is_picture = first.end == plain && first.start == Framing::default() && first.via.is_none();
    let is_own = first.words.is_some_and(|[_, to]| to <= words[mark].1[1]);
    if is_picture && is_own && is_headline(&headline) {
        direction.remove_step(0);
        if let Some(first) = direction.program.steps.first_mut() {
            first.cut = false;
        }
    }
}

/// Cuts between as many pictures as a headline counts, where it says that cuts lie between them.
pub(crate) fn cut_as_headlined(linked: &Linked, program: &mut Program) {
    let words = linked.texts_in([0, usize::MAX]);
    let headline: Vec<&str> = words.iter().copied().take_while(|word| !MARKS.contains(word)).collect();
    let says = |list: &str| headline.iter().any(|word| is_listed(list, word));
    let Some(num) = counted_parts(&headline).filter(|_| says("cut cuts")) else { return };
    let rests = program.steps.iter().all(|step| step.movement == Move::Static) && says("between");
    // `Three shots with hard cuts: ..`.
    let shots = says("shots setups angles pictures") && says("with by joined");
    if program.steps.len() == num && (rests || shots) && !program.forbidden.contains(&Motion::Cut) {
        program.steps.iter_mut().skip(1).for_each(|step| step.cut = true);
    }
}

/// What the parts of a list of shots are called, and sizes with which such a part begins.
const SHOTS: &str = "shot setup";
const SIZES: &str = "ws ls els mls fs ms mcu cu ecu xcu bcu ews vws mws overhead wide";
/// Most bytes by which the words of a shot begin before its number: a mark and what the parts are called.
const MOST_LEAD: usize = 8;
/// Words of a film without cuts.
const UNCUT: &str = "continuous uncut unbroken oner";

/// Cuts before each further shot of a list of shots: `SHOT 1 - ..` and `SHOT 2 - ..`, `1. WS ..` and `2. CU ..`.
pub(crate) fn cut_shots(linked: &Linked, program: &mut Program) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let text = |at: usize| words.get(at).map_or("", |(word, _)| *word);
    let heads = |number: usize| {
        let says = |at: usize| text(at) == number.to_string();
        let is_shot =
            |at: usize| at > 0 && is_listed(SHOTS, text(at - 1)) && !text(at + 1).starts_with(char::is_alphanumeric);
        let is_sized = |at: usize| matches!(text(at + 1), "." | ")" | ":") && is_listed(SIZES, text(at + 2));
        (0..words.len()).find(|at| says(*at) && (is_shot(*at) || is_sized(*at))).map(|at| words[at].1[0])
    };
    let starts: Vec<usize> = (1..=12).map_while(heads).collect();
    let is_list = starts.len() > 1 && starts.is_sorted();
    if !is_list || words.iter().any(|(word, _)| is_listed(UNCUT, word)) || program.forbidden.contains(&Motion::Cut) {
        return;
    }
    for (nth, start) in starts.iter().enumerate().skip(1) {
        let end = starts.get(nth + 1).copied().unwrap_or(usize::MAX);
        let is_of_shot = |step: &&mut Step| {
            step.words.is_some_and(|[from, to]| from < end && to > *start && from + MOST_LEAD >= *start)
        };
        if let Some(step) = program.steps.iter_mut().skip(1).find(is_of_shot) {
            step.cut = true;
        }
    }
}

/// The number of parts that words count: `two setups`.
fn counted_parts(words: &[&str]) -> Option<usize> {
    let parts = words.iter().position(|word| is_listed(PARTS, word))?;
    words[..parts].iter().rev().take(3).find_map(|word| number_of(word))
}

fn number_of(word: &str) -> Option<usize> {
    let is_number = |number: &u32| number_word(*number) == Some(word) || word == number.to_string();
    (2..=12).find(is_number).and_then(|number| usize::try_from(number).ok())
}

/// Whether words only count the parts of the film.
fn is_headline(words: &[&str]) -> bool {
    let is_plain = |word: &&str| is_listed(PARTS, word) || is_listed(BESIDE, word) || number_of(word).is_some();
    words.len() <= MOST_WORDS && counted_parts(words).is_some() && words.iter().all(is_plain)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;

    fn left(text: &str) -> Vec<(Vec<u32>, bool)> {
        let mark = text.find(['.', ':']).unwrap() + 1;
        let cut = |ids: &[u32]| Step { cut: true, ..about(Move::Static, ids, [mark + 1, text.len()]) };
        let mut direction = direction(vec![about(Move::Static, &[], [0, mark]), cut(&[5]), cut(&[7])]);
        drop_headline(&linked(text), &mut direction);
        direction.program.steps.into_iter().map(|step| (step.end.subjects, step.cut)).collect()
    }

    #[test]
    fn a_list_of_shots_is_cut() {
        let cuts = |text: &str, second: &str| {
            let at = text.find(second).unwrap();
            let steps = vec![about(Move::Static, &[5], [0, at - 1]), about(Move::ArcLeft, &[7], [at, text.len()])];
            let mut program = Program { steps, ..Program::default() };
            cut_shots(&linked(text), &mut program);
            program.steps[1].cut
        };
        assert!(cuts("shot 1 , wide of <obj-0> . shot 2 , <obj-1> , slow arc left", "shot 2"));
        assert!(cuts("1 . ws <obj-0> , 3s 2 . cu <obj-1> , slow arc", "2 ."));
        assert!(!cuts("1 . hold on <obj-0> , 3s 2 . arc left round <obj-1>", "2 ."));
        assert!(!cuts("one continuous take , shot 1 , <obj-0> . shot 2 , <obj-1>", "shot 2"));
    }

    #[test]
    fn a_headline_that_counts_is_no_picture() {
        let two = vec![(vec![5], false), (vec![7], true)];
        assert_eq!(left("two setups w / a hard cut between . a : <obj-0> , <qty-0> . b : <obj-1> ."), two);
        assert_eq!(left("we need 3 static shots : <obj-0> , <obj-1> and <obj-0> again"), two);
        assert_eq!(left("just two angles please . <obj-0> . <obj-1> ."), two);
        let text = "two moves . push in on <obj-0> .";
        let mut moves = direction(vec![about(Move::PushIn, &[], [0, 11]), about(Move::PushIn, &[5], [12, text.len()])]);
        drop_headline(&linked(text), &mut moves);
        assert_eq!(moves.program.steps.len(), 1);
        for text in ["open wide . <obj-0> . <obj-1> .", "two shots of the room . <obj-0> .", "two moves up . <obj-0> ."]
        {
            assert_eq!(left(text).len(), 3, "{text}");
        }
    }

    #[test]
    fn a_headline_says_that_pictures_are_cut() {
        let cuts = |text: &str, num: usize| {
            let steps = vec![Step::of(Move::Static); num];
            let mut program = Program { steps, ..Program::default() };
            cut_as_headlined(&linked(text), &mut program);
            program.steps.iter().filter(|step| step.cut).count()
        };
        assert_eq!(cuts("two setups with a hard cut between . <obj-0> , then <obj-1>", 2), 1);
        assert_eq!(cuts("three shots , straight cuts between them : <obj-0>", 3), 2);
        assert_eq!(cuts("two setups . <obj-0> . <obj-1>", 2), 0);
        assert_eq!(cuts("two setups with a cut between . <obj-0>", 3), 0);
    }
}
