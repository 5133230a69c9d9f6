//! How long a film and its rests are, as people say it: `twenty, twenty five, whatever it needs`, `pause two seconds at each`.

use cinesplat_language::Linked;

use super::text::Text;

/// A rest where the words ask for time to look.
pub(super) const LINGER_SECS: f64 = 1.5;
/// Lengths of films.
const FILMS: std::ops::RangeInclusive<f64> = 4.0..=180.0;
/// Numbers by their words.
const TENS: [(&str, f64); 8] = [
    ("ten", 10.0),
    ("fifteen", 15.0),
    ("twenty", 20.0),
    ("thirty", 30.0),
    ("forty", 40.0),
    ("fifty", 50.0),
    ("sixty", 60.0),
    ("ninety", 90.0),
];
const ONES: [&str; 10] = ["", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];

/// The times that a message states.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Times {
    pub(super) each_secs: Option<f64>,
    pub(super) last_secs: Option<f64>,
    pub(super) total_secs: Option<f64>,
}

/// The times that a message states.
pub(super) fn times(linked: &Linked, text: &Text<'_>) -> Times {
    let mut times = Times::default();
    for at in 0..text.words.len() {
        let Some(secs) = linked.secs_at(text.words[at]) else { continue };
        let sentence = text.slice(text.sentence(at));
        let before = &text.words[..at];
        let near = |list: &[&str]| before.iter().rev().take(4).any(|word| list.contains(word));
        let is_rest =
            near(&["pause", "hold", "stop", "rest", "stay", "wait", "linger", "pausing", "stopping", "holding"]);
        if near(&["last", "final"]) {
            // `The last second` is its end.
            times.last_secs = Some(secs).filter(|secs| *secs > 1.0);
        } else if is_rest || sentence.iter().any(|word| matches!(*word, "each" | "every")) {
            times.each_secs = Some(secs);
        } else if FILMS.contains(&secs) {
            times.total_secs = Some(
                range_to(text, at).filter(|to| (secs..2.0 * secs).contains(to)).map_or(secs, |to| secs.midpoint(to)),
            );
        }
    }
    times
}

/// The number of a range behind its first one: `twenty, twenty five`, `10 or 12`.
fn range_to(text: &Text<'_>, at: usize) -> Option<f64> {
    let mut behind = text.words[at + 1..].iter().copied();
    let word = behind.next().filter(|word| matches!(*word, "," | "or" | "to" | "-")).and_then(|_| behind.next())?;
    let ten = TENS.iter().find(|(name, _)| *name == word).map(|(_, ten)| *ten);
    let one = behind.next().and_then(|word| ONES.iter().skip(1).position(|one| *one == word)).map_or(0, |one| one + 1);
    ten.map(|ten| ten + one as f64).or_else(|| word.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::link_mentions;

    fn stated(prompt: &str) -> [Option<f64>; 3] {
        let linked = link_mentions(prompt, &[]).unwrap();
        let Times { each_secs, last_secs, total_secs } = times(&linked, &Text::of(&linked));
        [each_secs, last_secs, total_secs]
    }

    #[test]
    fn rests_and_films_have_lengths() {
        assert_eq!(stated("No rush. Twenty seconds, twenty five, whatever it needs."), [None, None, Some(22.5)]);
        assert_eq!(stated("Pause two seconds at each. Give the last one four seconds."), [Some(2.0), Some(4.0), None]);
        assert_eq!(stated("I'll talk over it, so 20 seconds please"), [None, None, Some(20.0)]);
        assert_eq!(stated("Then, in the last second, cute"), [None; 3]);
    }
}
