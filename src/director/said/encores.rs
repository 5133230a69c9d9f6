//! Moves that the last sentence asks to do several times: `push in a little, pull back. Do that twice.`

use cinesplat_language::{Linked, MAX_STEPS, number_word};

use crate::direction::Direction;

/// Words before the number of times.
const DO: [&str; 6] = ["do", "repeat", "play", "run", "perform", "make"];
const THAT: [&str; 11] = ["that", "it", "this", "all", "of", "the", "whole", "thing", "both", "lot", "sequence"];
/// Most steps of what is repeated.
const MOST_STEPS: usize = 4;

/// Films the steps before such a sentence as many times as it says.
pub(crate) fn repeat_all(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let Some(times) = times(&words) else { return };
    let steps = &direction.program.steps;
    let is_repeated = steps.iter().any(|step| step.returns);
    if steps.is_empty() || steps.len() > MOST_STEPS || steps.len() * times > MAX_STEPS || is_repeated {
        return;
    }
    let (once, certainty) = (steps.clone(), direction.certainty.clone());
    for _ in 1..times {
        direction.program.steps.extend(once.clone());
        direction.certainty.extend(certainty.clone());
    }
    // The network's cameras are those of one time.
    direction.step_cameras.clear();
}

/// How many times the last sentence asks for: `do that twice`.
fn times(words: &[&str]) -> Option<usize> {
    let is_end = |word: &&str| matches!(*word, "." | "!" | ";");
    let sentence = words.split(is_end).rfind(|sentence| !sentence.is_empty())?;
    let [verb, rest @ ..] = sentence else { return None };
    let behind = rest.iter().take_while(|word| THAT.contains(word)).count();
    let is_all = sentence.len() < words.len() && DO.contains(verb) && behind > 0;
    let number = |word: &str| (2..=6_u8).find(|number| number_word(u32::from(*number)) == Some(word));
    let times = match rest.get(behind..)? {
        ["twice"] => 2,
        ["thrice"] => 3,
        [count, "times"] => count.parse().ok().or_else(|| number(count))?,
        _ => return None,
    };
    (is_all && (2..=6).contains(&times)).then_some(usize::from(times))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_trajectory::Move;

    #[test]
    fn a_last_sentence_repeats_what_is_before_it() {
        let steps = |text: &str| {
            let steps = vec![about(Move::PushIn, &[5], [0, 7]), about(Move::PullOut, &[5], [8, 17])];
            let mut direction = direction(steps);
            repeat_all(&linked(text), &mut direction);
            direction.program.steps.len()
        };
        assert_eq!(steps("push in , pull out . do that three times ."), 6);
        assert_eq!(steps("push in , pull out . do that again ."), 2);
        assert_eq!(steps("push in , pull out , twice ."), 2);
        assert_eq!(times(&["pan", ".", "do", "that", "twice", "."]), Some(2));
        assert_eq!(times(&["do", "that", "twice"]), None);
    }
}
