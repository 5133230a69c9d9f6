//! Sentences about things, not about pictures of them: `This guitar is a ten out of ten! Slow pan up from the body ..`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use super::briefs::directs;
use crate::direction::Direction;

/// Verbs that say what a thing is.
const COPULAS: [&str; 8] = ["is", "'s", "are", "was", "were", "looks", "'re", "feels"];
/// Words of pictures and cameras.
const PICTURES: [&str; 43] = [
    "see",
    "show",
    "shown",
    "look",
    "looking",
    "watch",
    "frame",
    "framed",
    "framing",
    "shot",
    "view",
    "picture",
    "image",
    "camera",
    "lens",
    "visible",
    "seen",
    "centered",
    "centred",
    "center",
    "centre",
    "start",
    "begin",
    "end",
    "open",
    "close",
    "hold",
    "still",
    "static",
    "left",
    "right",
    "middle",
    "third",
    "first",
    "last",
    "top",
    "subject",
    "focus",
    "where",
    "screen",
    "foreground",
    "background",
    "there",
];
/// Marks that end a sentence.
const ENDS: [&str; 4] = [".", "!", "?", ";"];

/// Removes pictures at rest that only come from a sentence about what a thing is, where another step follows.
pub(crate) fn drop_statements(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let steps = &direction.program.steps;
        let is_followed = nth + 1 < steps.len();
        if is_followed && is_plain(&steps[nth]) && is_statement(&linked.texts_in(steps[nth].words.unwrap_or_default()))
        {
            direction.remove_step(nth);
        }
    }
}

/// Certainty of a step below which a sentence that only tells a story is none.
const MADE_UP: f64 = 0.5;
/// Verbs of stories, besides those that say what a thing is.
const TOLD: [&str; 14] = [
    "found", "turned", "became", "got", "bought", "made", "has", "have", "had", "thinks", "says", "loves", "wants",
    "know",
];

/// Removes what the network makes up from sentences that tell why somebody wants a film, where another one says which: `My
/// daughter found out what a telescope is for, and the dining room is a space station. Can you sneak up on the telescope?`
pub(crate) fn drop_stories(linked: &Linked, direction: &mut Direction) {
    let spans: Vec<[usize; 2]> = direction.program.steps.iter().map(|step| step.words.unwrap_or_default()).collect();
    let sentences: Vec<Vec<&str>> = spans.iter().map(|span| linked.sentence_of(*span)).collect();
    let is_asked = sentences.iter().any(|sentence| directs(sentence));
    for nth in (0..spans.len()).rev() {
        let tells = sentences[nth].iter().any(|word| COPULAS.contains(word) || TOLD.contains(word))
            && sentences[nth].last().is_some_and(|word| ENDS.contains(word))
            && !sentences[nth].iter().any(|word| PICTURES.contains(word))
            && !directs(&sentences[nth])
            && !directs(&linked.texts_in(spans[nth]));
        let is_sure = direction.certainty.get(nth).is_none_or(|step| step.probability >= MADE_UP);
        if is_asked && tells && !is_sure {
            direction.remove_step(nth);
        }
    }
}

/// Whether a step rests on a thing and says no more.
fn is_plain(step: &Step) -> bool {
    let shown = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
    let begun = Framing { subjects: step.start.subjects.clone(), ..Framing::default() };
    step.movement == Move::Static
        && step.end == shown
        && step.start == begun
        && step.with.is_empty()
        && step.via.is_none()
        && step.duration_secs.is_none()
}

/// Whether words are whole sentences that say what something is, and nothing of a picture.
fn is_statement(words: &[&str]) -> bool {
    // `We're on the drawers` says where the film is.
    let is_picture = words.windows(3).any(|three| {
        matches!(three[0], "we" | "i" | "you")
            && COPULAS.contains(&three[1])
            && matches!(three[2], "on" | "at" | "with")
    });
    !is_picture
        && words.last().is_some_and(|word| ENDS.contains(word))
        && words.iter().any(|word| COPULAS.contains(word))
        && !words.iter().any(|word| PICTURES.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::StepCertainty;
    use cinesplat_operator::Program;

    /// How many steps are left of those that words are read as, each hardly sure.
    fn left(texts: &[&str]) -> usize {
        let mut linked = Linked { tokens_text: texts.join(" "), ..Linked::default() };
        let mut steps = Vec::new();
        for text in texts {
            let from = linked.spans.last().map_or(0, |span| span[1] + 1);
            for word in text.split(' ') {
                let at = linked.spans.last().map_or(0, |span| span[1] + 1);
                linked.spans.push([at, at + word.len()]);
            }
            let to = linked.spans.last().map_or(0, |span| span[1]);
            steps.push(Step { words: Some([from, to]), ..Step::of(Move::Reveal) });
        }
        let unsure = |step: &Step| StepCertainty::of(0.1, step.words);
        let certainty = steps.iter().map(unsure).collect();
        let program = Program { steps, ..Program::default() };
        let mut direction = Direction { program, step_cameras: Vec::new(), certainty, unmet: Vec::new() };
        drop_stories(&linked, &mut direction);
        direction.program.steps.len()
    }

    #[test]
    fn a_story_is_no_move_where_another_sentence_asks_for_one() {
        assert_eq!(left(&["she found out what <obj-0> is for .", "sneak up on <obj-0> ."]), 1);
        assert_eq!(left(&["we are a firefly . soar over <obj-0> ,", "and head for <obj-1> ."]), 2);
        assert_eq!(left(&["she found out what <obj-0> is for .", "and <obj-1> is hers ."]), 2);
    }

    #[test]
    fn what_a_thing_is_is_no_picture() {
        let states = |text: &str| is_statement(&text.split(' ').collect::<Vec<_>>());
        assert!(states("this <obj-0> is a 10 out of 10 !"));
        assert!(states("<obj-0> is the heart of this home !"));
        assert!(!states("<obj-0> is in the center of the frame ."));
        assert!(!states("<obj-0> is what we see first ."));
        assert!(!states("<obj-0> is big , then"));
        assert!(!states("we 're on <obj-0> ."));
        assert!(states("we are proud of <obj-0> ."));
    }
}
