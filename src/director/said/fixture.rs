//! Linked prompts for unit tests.

use cinesplat_language::{Linked, NamedObject};
use cinesplat_operator::{Framing, Program, Step};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// A prompt whose words and marks stand apart by spaces; `<obj-0>` is object 5, `<obj-1>` object 7.
pub(crate) fn linked(text: &str) -> Linked {
    let words = text.split(' ');
    let spans = words.scan(0, |at, word| Some([*at, std::mem::replace(at, *at + word.len() + 1) + word.len()]));
    Linked { tokens_text: text.to_owned(), spans: spans.collect(), slots: vec![5, 7], ..Linked::default() }
}

/// Objects 1, 2, .. with some labels.
pub(crate) fn labelled(labels: &[&str]) -> Vec<NamedObject> {
    (1..).zip(labels).map(|(id, label)| NamedObject { id, label: (*label).to_owned() }).collect()
}

/// A reading of some steps, without cameras and certainties.
pub(crate) fn direction(steps: Vec<Step>) -> Direction {
    let program = Program { steps, ..Program::default() };
    Direction { program, step_cameras: Vec::new(), certainty: Vec::new(), unmet: Vec::new() }
}

/// A step that ends on some things, with the bytes of its words.
pub(crate) fn about(movement: Move, ids: &[u32], words: [usize; 2]) -> Step {
    let end = Framing { subjects: ids.to_vec(), ..Framing::default() };
    Step { end, words: Some(words), ..Step::of(movement) }
}

/// The steps of the parts of a text between bars, each about one object.
pub(crate) fn read(text: &str, moves: &[(Move, u32)]) -> (Linked, Vec<Step>) {
    let mut from = 0;
    let spans = text.split(" | ").map(|part| {
        let span = [from, from + part.len()];
        from = span[1] + 1;
        span
    });
    let steps = spans.zip(moves).map(|(span, (movement, id))| about(*movement, &[*id], span)).collect();
    (linked(&text.replace(" | ", " ")), steps)
}

/// The move of each step and what it ends on.
pub(crate) fn seen(steps: &[Step]) -> Vec<(Move, Vec<u32>)> {
    steps.iter().map(|step| (step.movement, step.end.subjects.clone())).collect()
}
