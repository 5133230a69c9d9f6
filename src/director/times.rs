//! Times that stand apart from the moves that they are of: `2s 2s 2s` behind three shots, `3, 2 and 4 seconds`, and the
//! frames of keyframes (`keyframe 2 at frame 48: close on the robot`).
//!
//! Enters: a linked prompt. Leaves: the prompt without them, and their lengths for the steps that are read in it.

use cinesplat_language::Linked;
use cinesplat_operator::Framing;
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// Times apart from their moves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ListedTimes {
    /// Their bytes of the prompt.
    bytes: Vec<[usize; 2]>,
    /// One length per step, or per way between two keyframes; seconds.
    secs: Vec<f64>,
    /// Whether they are those between keyframes.
    of_keyframes: bool,
}

/// Words between the times of a list, words before it, and words behind it.
const LINKS: [&str; 9] = [",", "/", "-", "|", "+", "and", "then", "&", ";"];
const BEFORE: [&str; 14] =
    [",", ".", ";", ":", "(", "!", "timing", "timings", "times", "lengths", "durations", "-", "duration", "?"];
const BEHIND: [&str; 8] = [".", ")", "!", "?", ";", "respectively", "each", ","];
/// What keyframes are called, and their numbers.
const KEYFRAMES: [&str; 6] = ["keyframe", "key", "kf", "keyframes", "keyf", "pose"];
const FRAMES: [&str; 4] = ["frame", "fr", "f", "frames"];
/// Fewest frames between two keyframes; `frame 2` may be the second picture of a board.
const LEAST_FRAMES: f64 = 5.0;

impl ListedTimes {
    /// The times of a prompt that lists them.
    pub(crate) fn of(linked: &Linked) -> Option<Self> {
        let words: Vec<&str> = linked.tokens_text.split(' ').collect();
        if words.len() != linked.spans.len() {
            return None;
        }
        list(linked, &words).or_else(|| keyframes(linked, &words))
    }

    /// The words without a list of times; keyframes are read as they stand.
    pub(crate) fn without(&self, linked: &Linked) -> Option<Linked> {
        (!self.of_keyframes).then(|| linked.without(&self.bytes, None))
    }

    /// Gives the steps their lengths where there are as many; otherwise the times ask in vain.
    pub(crate) fn write(self, direction: &mut Direction) {
        let steps = &direction.program.steps;
        let opens = |at: usize| {
            self.of_keyframes
                && steps.len() == self.secs.len() + 1
                && steps.get(at).is_some_and(|step| step.movement == Move::Static)
        };
        // What holds the first keyframe is where the first way begins.
        if opens(0) && steps[1].start == Framing::default() {
            let opening = direction.program.steps[0].end.clone();
            direction.program.steps[1].start = opening;
            direction.program.steps[1].words = steps_words(direction);
            direction.remove_step(0);
        }
        let steps = &mut direction.program.steps;
        if steps.len() != self.secs.len() {
            direction.unmet.extend(self.bytes);
            return;
        }
        for (step, secs) in steps.iter_mut().zip(&self.secs) {
            step.duration_secs = Some(*secs);
        }
        direction.program.duration_secs = None;
        // The words of a list belong to the last step, those of a keyframe to the way from it, or to it.
        let [first, .., last] = [&self.bytes[..1], &self.bytes[self.bytes.len() - 1..]].concat()[..] else { return };
        let num_steps = steps.len();
        for (nth, step) in steps.iter_mut().enumerate() {
            let head = if self.of_keyframes { self.bytes.get(nth).copied().unwrap_or(first) } else { last };
            let is_owner = self.of_keyframes || nth + 1 == num_steps;
            let Some(words) = step.words.as_mut().filter(|_| is_owner) else { continue };
            words[0] = words[0].min(head[0]);
            words[1] = if nth + 1 == num_steps { words[1].max(last[1]) } else { words[1] };
        }
    }
}

fn steps_words(direction: &Direction) -> Option<[usize; 2]> {
    let [first, second, ..] = &direction.program.steps[..] else { return None };
    second.joint_words(first)
}

/// A list of two or more times that ends a sentence.
fn list(linked: &Linked, words: &[&str]) -> Option<ListedTimes> {
    let begins = |at: usize| linked.listed_secs_at(words[at]).is_some() && (at == 0 || BEFORE.contains(&words[at - 1]));
    let list_at = |from: usize| {
        let (mut to, mut values) = (from, Vec::new());
        while to < words.len() {
            let links =
                words[to..].iter().take(2).take_while(|word| !values.is_empty() && LINKS.contains(word)).count();
            let Some(value) = words.get(to + links).and_then(|word| linked.listed_secs_at(word)) else { break };
            values.push(value);
            to += links + 1;
        }
        let ends = to == words.len() || BEHIND.contains(&words[to]) && words[to] != ",";
        let is_timed = to > from && linked.secs_at(words[to - 1]).is_some();
        (values.len() > 1 && ends && is_timed && values.iter().all(|value| *value > 0.0)).then_some((to, values))
    };
    let (from, (to, values)) = (0..words.len()).filter(|at| begins(*at)).find_map(|at| Some((at, list_at(at)?)))?;
    let names_times = from > 0 && words[from - 1].starts_with(char::is_alphabetic);
    let from = from - usize::from(names_times);
    let to = to + usize::from(words.get(to) == Some(&"respectively"));
    let bytes = [linked.spans[from][0], linked.spans[to - 1][1]];
    Some(ListedTimes { bytes: vec![bytes], secs: values, of_keyframes: false })
}

/// Keyframes with their frames: `keyframe 1 at frame 0: .. keyframe 2 at frame 48: ..`, `frame 0: .., frame 48: ..`.
fn keyframes(linked: &Linked, words: &[&str]) -> Option<ListedTimes> {
    let number = |at: usize| words.get(at).and_then(|word| word.parse::<f64>().ok());
    let head_at = |at: usize| {
        let is_named = KEYFRAMES.contains(&words[at]);
        let numbered = at + usize::from(is_named) + usize::from(is_named && number(at + 1).is_some());
        let links = |from: usize| {
            words[from.min(words.len())..]
                .iter()
                .take(2)
                .take_while(|word| matches!(**word, "at" | "@" | "," | ":" | "-" | "=" | "(" | "on" | "#"))
                .count()
        };
        let named = numbered + if is_named { links(numbered) } else { 0 };
        let frame = words.get(named).filter(|word| FRAMES.contains(word)).map(|_| named + 1)?;
        let value = number(frame)?;
        let end = frame + 1;
        let closed =
            end + words[end..].iter().take(2).take_while(|word| matches!(**word, ":" | ")" | "-" | "=" | ",")).count();
        (closed > end).then_some((closed, value))
    };
    let (mut heads, mut at) = (Vec::new(), 0);
    while at < words.len() {
        let head = head_at(at);
        heads.extend(head.map(|(end, frame)| ([at, end], frame)));
        at = head.map_or(at + 1, |(end, _)| end);
    }
    let gaps: Vec<f64> = heads.windows(2).map(|pair| pair[1].1 - pair[0].1).collect();
    if gaps.is_empty() || gaps.iter().any(|gap| *gap < LEAST_FRAMES) {
        return None;
    }
    let rate = linked.frames_per_sec();
    let bytes = heads.iter().map(|([from, to], _)| [linked.spans[*from][0], linked.spans[to - 1][1]]);
    Some(ListedTimes { bytes: bytes.collect(), secs: gaps.iter().map(|gap| gap / rate).collect(), of_keyframes: true })
}
