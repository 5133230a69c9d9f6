//! Times of moves by their names: `5 seconds for the arc, 3 for the push`, `the pan takes 4 seconds and the zoom 2`.

use cinesplat_language::Linked;
use cinesplat_operator::{Program, Speed};

use super::bans::SENTENCE_ENDS;
use super::taken_back::names;
use crate::direction::Direction;

/// Words of how long a move takes.
const TAKES: [&str; 10] = ["takes", "take", "lasts", "last", "gets", "is", "should", "for", "over", "runs"];
/// Words between a time and the move that it is of.
const FOR: [&str; 3] = ["for", "on", "to"];
/// Words that may stand between them besides.
const BETWEEN: [&str; 8] = ["the", "about", "around", "roughly", "a", "each", "slow", "quick"];

/// Gives moves the times that the words state with their names, where at least two of them are stated so.
pub(crate) fn take_named_times(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    for sentence in words.split(|word| SENTENCE_ENDS.contains(word)) {
        let timed = timed_moves(linked, sentence);
        let owner = |name: &str| {
            let mut owners = (0..program.steps.len()).filter(|nth| names(name, program.steps[*nth].movement));
            owners.next().filter(|_| owners.next().is_none())
        };
        let owned: Option<Vec<(usize, f64)>> = timed.iter().map(|(name, secs)| Some((owner(name)?, *secs))).collect();
        for (nth, secs) in owned.filter(|owned| owned.len() > 1).unwrap_or_default() {
            program.steps[nth].duration_secs = Some(secs);
        }
    }
}

/// Words of how fast a move is, and words between them and its name.
const SLOWS: [&str; 4] = ["slow", "slower", "slowly", "gentler"];
const FASTS: [&str; 4] = ["fast", "faster", "quick", "quicker"];
const ABOUT: [&str; 4] = ["on", "for", "during", "in"];

/// Takes a step back that only says how fast a move before it is: `.. and twice as slow on the arc`.
pub(crate) fn merge_named_speeds(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let (before, rest) = direction.program.steps.split_at_mut(nth);
        let Some(step) = rest.first() else { continue };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let named = words.windows(4).find_map(|four| {
            let is_slow = SLOWS.contains(&four[0]).then_some(Speed::Slow);
            let speed = is_slow.or_else(|| FASTS.contains(&four[0]).then_some(Speed::Fast))?;
            (ABOUT.contains(&four[1]) && four[2] == "the").then_some((speed, four[3]))
        });
        let is_plain = step.end.subjects.is_empty() && step.amount.is_none() && step.duration_secs.is_none();
        let Some((speed, name)) = named.filter(|(_, name)| is_plain && names(name, step.movement)) else { continue };
        let Some(owner) = before.iter().rposition(|other| names(name, other.movement)) else { continue };
        let joint = before[nth - 1].joint_words(step);
        before[owner].speed = speed;
        before[nth - 1].words = joint;
        direction.remove_step(nth);
    }
}

/// The names of moves in a sentence and their times. A bare number behind a time of another move is one, too.
fn timed_moves<'a>(linked: &Linked, words: &[&'a str]) -> Vec<(&'a str, f64)> {
    let is_timed = words.iter().any(|word| linked.secs_at(word).is_some());
    let is_plain = |word: &&&str| word.starts_with(char::is_alphabetic) || word.starts_with("<obj-");
    let named = |at: usize| {
        let behind = words
            .get(at + 1)
            .filter(|word| FOR.contains(word))
            .map(|_| words[at + 2..].iter().find(|word| !BETWEEN.contains(word)).copied());
        // `The push in on the cup takes 4 seconds`.
        let before = || {
            let run: Vec<&str> = words[..at].iter().rev().take(9).take_while(is_plain).copied().collect();
            let named =
                run.iter().rposition(|word| *word == "the").and_then(|the| run.get(the.checked_sub(1)?)).copied();
            let takes =
                run.iter().any(|word| TAKES.contains(word)) || words[..at].iter().any(|word| TAKES[..5].contains(word));
            named.filter(|_| takes)
        };
        behind.unwrap_or_else(before)
    };
    let times = words.iter().enumerate().filter(|_| is_timed);
    times.filter_map(|(at, word)| Some((named(at)?, linked.listed_secs_at(word)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::link_mentions;

    #[test]
    fn times_belong_to_the_moves_that_are_named_with_them() {
        let timed = |prompt: &str| {
            let linked = link_mentions(prompt, &[]).unwrap();
            let words: Vec<&str> = linked.tokens_text.split(' ').collect();
            timed_moves(&linked, &words).into_iter().map(|(name, secs)| (name.to_owned(), secs)).collect::<Vec<_>>()
        };
        let expected = [("arc".to_owned(), 5.0), ("push".to_owned(), 3.0)];
        assert_eq!(timed("5 seconds for the arc, 3 for the push"), expected);
        assert_eq!(timed("the arc takes 5 seconds and the push 3"), expected);
        assert_eq!(timed("push in for 3 seconds"), []);
    }
}
