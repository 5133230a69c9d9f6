//! The steps that a dutch angle belongs to.
//!
//! Enters: the mentions of effects in a prompt, and the steps of its program with their words. Leaves: the slant of the
//! steps in whose clause the phrase stands.

use cinesplat_language::{DUTCH_ANGLE, EffectMention, tokenize};
use cinesplat_operator::{Amount, Program, Slant, Step};
use cinesplat_trajectory::Move;

/// The roll, degrees: in the middle of the 5 to 35 degrees that storyboards use.
const DUTCH_DEG: f64 = 15.0;
/// Words beside a dutch angle that give it to every step.
const THROUGHOUT: [&str; 6] = ["throughout", "whole film", "whole shot", "whole time", "entire", "all the way"];
/// Marks and words between two clauses.
const BORDERS: [&str; 10] = [",", ";", ".", ":", "then", "and", "before", "after", "next", "finally"];

/// Words that lead to where a roll ends.
const LEADS: [&str; 8] = ["to", "until", "till", "into", "back", "out", "becomes", "comes"];

/// The dutch angle that the words ask for, during the step in whose clause its phrase stands, or throughout where they
/// say so.
pub(super) fn slant_of(mentions: &[EffectMention], program: &Program, prompt: &str) -> Option<Slant> {
    let mention = mentions.iter().find(|mention| mention.call.name == DUTCH_ANGLE && !mention.is_forbidden)?;
    let [start, end] = mention.span;
    let last = program.steps.len().checked_sub(1)?;
    // `Dutch angle, roll clockwise by 20 degrees` says itself how far.
    let rolls = |step: &Step| {
        matches!(step.movement, Move::RollCw | Move::RollCcw) && matches!(step.amount, Some(Amount::Degrees(_)))
    };
    if last == 0 && program.steps.iter().any(rolls) && !levels(prompt) {
        return None;
    }
    let around = [prompt.get(..start).unwrap_or_default(), prompt.get(end..).unwrap_or_default()];
    let beside = [around[0].rsplit(['.', ',', ';']).next(), around[1].split(['.', ',', ';']).next()];
    let says = |clause: &str| THROUGHOUT.iter().any(|words| clause.to_lowercase().contains(words));
    if beside.into_iter().flatten().any(says) {
        return Some(Slant { degrees: DUTCH_DEG, steps: [0, last] });
    }
    let step = (0..=last).min_by_key(|at| apart(prompt, mention.span, &program.steps[*at]))?;
    Some(Slant { degrees: DUTCH_DEG, steps: [step, step] })
}

/// Whether a prompt says that the horizon is level somewhere.
fn levels(prompt: &str) -> bool {
    let words = tokenize(prompt);
    words.iter().any(|word| matches!(word.text.as_str(), "level" | "upright" | "straight" | "straighten" | "back"))
}

/// Rolls back to level from a dutch angle by just as much as it slants: `start on a dutch angle, roll slowly back to level`.
pub(super) fn level_out(mentions: &[EffectMention], program: &mut Program, prompt: &str) {
    let Some(slant) = slant_of(mentions, program, prompt) else { return };
    let slanted = slant.steps[0]..=slant.steps[1];
    for (nth, step) in program.steps.iter_mut().enumerate() {
        let rolls = matches!(step.movement, Move::RollCw | Move::RollCcw) && step.amount.is_none();
        let words = step.words.and_then(|[from, to]| prompt.get(from..to)).unwrap_or_default();
        if rolls && slanted.contains(&nth) && ends_level(words) {
            (step.movement, step.either_way) = (Move::RollCcw, false);
            step.amount = Some(Amount::Degrees(slant.degrees));
        }
    }
}

/// Whether words lead to a level horizon.
fn ends_level(words: &str) -> bool {
    let words: Vec<String> = tokenize(words).into_iter().map(|word| word.text).collect();
    let leads = |at: usize| words[..at].iter().rev().take(4).any(|word| LEADS.contains(&word.as_str()));
    let is_level =
        |word: &str| matches!(word, "level" | "upright" | "straight" | "horizontal" | "horizon" | "zero" | "flat");
    let rights =
        words.iter().any(|word| word.starts_with("straighten") || matches!(word.as_str(), "unroll" | "level-out"));
    rights || (0..words.len()).any(|at| is_level(&words[at]) && leads(at))
}

/// How far a phrase is from the words of a step: the borders of clauses between them, then the bytes. Bytes alone
/// mislead: in `push in with a dutch angle, then pull back` the next step is nearer.
fn apart(prompt: &str, [start, end]: [usize; 2], step: &Step) -> (usize, usize) {
    let Some(words) = step.words else { return (usize::MAX, usize::MAX) };
    let [from, to] = without_borders(prompt, words);
    let between = if end <= from { end..from } else { to..start.max(to) };
    let num_bytes = between.len();
    let between = tokenize(prompt.get(between).unwrap_or_default());
    (between.iter().filter(|word| BORDERS.contains(&word.text.as_str())).count(), num_bytes)
}

/// A range of a prompt without the borders at its ends: `then pull back,` is what `pull back` is.
fn without_borders(prompt: &str, [from, to]: [usize; 2]) -> [usize; 2] {
    let words = tokenize(prompt.get(from..to).unwrap_or_default());
    let mut inner = words.iter().filter(|word| !BORDERS.contains(&word.text.as_str()));
    let Some(first) = inner.next() else { return [from, to] };
    let last = inner.next_back().unwrap_or(first);
    [from + first.span[0], from + last.span[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_roll_by_an_angle_is_the_slant_itself() {
        let rolled = |prompt: &str, amount| {
            let step = Step { amount, words: Some([0, prompt.len()]), ..Step::of(Move::RollCw) };
            let program = Program { steps: vec![step], ..Program::default() };
            let linked = cinesplat_language::link(prompt, &[]).unwrap();
            slant_of(&cinesplat_language::effect_mentions(prompt, &linked).unwrap(), &program, prompt)
        };
        let by = Some(Amount::Degrees(20.0));
        assert_eq!(rolled("dutch angle, roll clockwise by 20 degrees", by), None);
        assert!(rolled("dutch angle, roll clockwise", None).is_some());
        assert!(rolled("dutch angle, roll clockwise by 20 degrees until level", by).is_some());
    }

    #[test]
    fn a_roll_back_ends_level() {
        assert!(ends_level("Start on a dutch angle, the guitar, and roll slowly back to level."));
        assert!(ends_level("canted on the vase, then roll until the horizon is straight"));
        assert!(ends_level("begin slanted and straighten up"));
        assert!(!ends_level("roll into a dutch angle on the level crossing"));
    }
}
