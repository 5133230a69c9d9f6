//! What a language model is asked: the notation in short, worked examples, the scene's objects and the sentence.
//!
//! Enters: a prompt with the objects that it may name. Leaves: [`Question`]: the texts of a conversation that ends where
//! the answer begins. The words of the sentence are numbered, so that the answer can say which words a step comes from.

use std::fmt::Write as _;
use std::ops::Range;

use cinesplat_language::{NamedObject, Pattern, program_pattern};
use cinesplat_operator::{FramePlace, Motion, Pass, SubjectSide};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

/// Most objects that a question lists.
pub const MAX_OBJECTS: usize = 100;
/// Most characters of a name.
const MAX_NAME_CHARS: usize = 60;

/// Sentences with their programs, which show the form of an answer: objects, what the scene lacks, sentence, answer.
const EXAMPLES: [(&str, &str, &str, &str); 3] = [
    (
        "1 sofa, 2 floor lamp, 3 rug",
        "",
        "Push in slowly on the couch, then half an orbit around the lamp to the left.",
        "1-6 push-in end=1 slow / 7-16 orbit-left end=2 amount=180deg",
    ),
    (
        "4 vase, 7 window, 9 table, 12 chair, 13 chair",
        "",
        "8 seconds. Start close on the vase from below, rise past both chairs and end wide. Don't zoom.",
        "3-16 crane-up start=4:close-up:low end=room:long past=12+13 | total=8s no=zoom",
    ),
    (
        "1 bed, 2 desk",
        "3 piano",
        "Drift around the piano while sinking and keep the desk in view.",
        "1-12 orbit-right with=pedestal-down end=3 keep=2 either",
    ),
];

/// A question about one prompt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Question {
    objects: String,
    missing: String,
    sentence: String,
    /// Bytes of the prompt of each word.
    words: Vec<[usize; 2]>,
    /// Ids in the answer, each with the id that it stands for.
    ids: Vec<(u32, u32)>,
}

impl Question {
    /// A question about a prompt. `objects` are those that it may name; beyond [`MAX_OBJECTS`] they are left out.
    /// `missing` are things that it names and the scene lacks: in the answer they get the ids after the largest one.
    pub fn new(prompt: &str, objects: &[NamedObject], missing: &[NamedObject]) -> Self {
        let listed = objects.get(..MAX_OBJECTS).unwrap_or(objects);
        let first_free = listed.iter().map(|object| object.id.saturating_add(1)).max().unwrap_or(1);
        let lacked = (first_free..).zip(missing.iter().take(MAX_OBJECTS));
        let words = words(prompt);
        Self {
            objects: names(listed.iter().map(|object| (object.id, object.label.as_str()))),
            missing: names(lacked.clone().map(|(id, thing)| (id, thing.label.as_str()))),
            sentence: numbered(prompt, &words),
            ids: listed.iter().map(|o| (o.id, o.id)).chain(lacked.map(|(id, thing)| (id, thing.id))).collect(),
            words,
        }
    }

    /// What the model is told first: the notation.
    pub fn instructions() -> String {
        instructions()
    }

    /// The worked examples: questions with their answers.
    pub fn examples() -> Vec<(String, String)> {
        let example = |(objects, missing, sentence, answer): &(&str, &str, &str, &str)| {
            (asked(objects, missing, &numbered(sentence, &words(sentence))), (*answer).to_owned())
        };
        EXAMPLES.iter().map(example).collect()
    }

    /// The objects and the sentence.
    pub fn text(&self) -> String {
        asked(&self.objects, &self.missing, &self.sentence)
    }

    /// The answers that the question allows: per step the numbers of its first and last word and the step, then
    /// what holds for the film. A space may come first.
    pub fn answers(&self) -> Pattern {
        let number = || Pattern::one_of((1..=self.words.len()).map(|number| number.to_string()));
        let range = Pattern::Sequence(vec![number(), Pattern::text("-"), number(), Pattern::text(" ")]);
        let ids: Vec<u32> = self.ids.iter().map(|(id, _)| *id).collect();
        Pattern::Sequence(vec![Pattern::text(" ").optional(), program_pattern(&ids, &range)])
    }

    /// The id that an id of the answer stands for.
    pub(crate) fn id_of(&self, answered: u32) -> u32 {
        self.ids.iter().find(|(id, _)| *id == answered).map_or(answered, |(_, id)| *id)
    }

    /// Bytes of the prompt from one word to another, which are counted from 1.
    pub(crate) fn span_of(&self, first: usize, last: usize) -> Option<[usize; 2]> {
        let word = |number: usize| number.checked_sub(1).and_then(|idx| self.words.get(idx));
        let (start, end) = (word(first.min(last))?, word(first.max(last))?);
        Some([start[0], end[1]])
    }
}

/// Bytes of the words of a sentence: runs between spaces, without the marks around them.
fn words(sentence: &str) -> Vec<[usize; 2]> {
    let is_mark = |c: char| !c.is_alphanumeric() && !"<>'\"%°".contains(c);
    let run = |range: Range<usize>| {
        let text = sentence.get(range.clone())?;
        let start = range.start + text.len() - text.trim_start_matches(is_mark).len();
        let end = range.start + text.trim_end_matches(is_mark).len();
        (start < end).then_some([start, end])
    };
    let mut start = 0;
    let mut words = Vec::new();
    for piece in sentence.split_inclusive(char::is_whitespace) {
        words.extend(run(start..start + piece.len()));
        start += piece.len();
    }
    words
}

/// A sentence with the number of each word before it.
fn numbered(sentence: &str, words: &[[usize; 2]]) -> String {
    let mut out = String::new();
    let mut after = 0;
    for (number, [start, end]) in (1..).zip(words) {
        out.push_str(sentence.get(after..*start).unwrap_or_default());
        // Writing to a string cannot fail.
        let _ = write!(out, "{number}:");
        out.push_str(sentence.get(*start..*end).unwrap_or_default());
        after = *end;
    }
    out.push_str(sentence.get(after..).unwrap_or_default());
    on_one_line(&out)
}

fn names<'a>(objects: impl Iterator<Item = (u32, &'a str)>) -> String {
    let name = |(id, label): (u32, &str)| {
        format!("{id} {}", on_one_line(label).chars().take(MAX_NAME_CHARS).collect::<String>())
    };
    objects.map(name).collect::<Vec<_>>().join(", ")
}

fn on_one_line(text: &str) -> String {
    text.split(|c: char| c.is_whitespace() || c.is_control())
        .filter(|run| !run.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

fn asked(objects: &str, missing: &str, sentence: &str) -> String {
    let objects = if objects.is_empty() { "none" } else { objects };
    let missing = if missing.is_empty() { String::new() } else { format!("\nNot in the scene: {missing}") };
    format!("Objects: {objects}{missing}\nSentence: {sentence}")
}

fn instructions() -> String {
    let moves = listed(Move::VARIANTS);
    let sizes = listed(ShotSize::VARIANTS);
    let angles = listed(ShotAngle::VARIANTS);
    let sides = listed(SubjectSide::VARIANTS);
    let places = listed(FramePlace::VARIANTS);
    let passes = listed(Pass::VARIANTS);
    let motions = listed(Motion::VARIANTS);
    let easings = listed(&[Easing::Smooth, Easing::Linear, Easing::EaseIn, Easing::EaseOut]);
    format!(
        "You turn a sentence about a camera into a program. Answer with one line: steps joined by \" / \".\n\
         A step is the numbers of the first and last word that it comes from, a move, and only what the sentence \
         says about it, in this order:\n\
         with=MOVE: a move at the same time\n\
         start=OBJECTS, end=OBJECTS: what the picture shows first and last, with :QUALIFIERS; room is the whole place\n\
         PASS=OBJECTS: {passes}\n\
         look=OBJECTS, look=ahead, look=back: what the camera looks at while it travels\n\
         keep=OBJECTS, avoid=OBJECTS: always or never in the picture\n\
         amount=90deg, amount=2u (units of length), amount=0.5x (a factor), amount=slight, amount=large\n\
         dur=2s; slow, fast; ease=EASING: {easings}\n\
         cut: it begins with a cut; returns: it ends where the film began; either: left or right is not said\n\
         MOVE: {moves}\n\
         OBJECTS: numbers of the list, joined by +\n\
         QUALIFIERS, in this order: size {sizes}; 40% of the height of the frame; angle {angles}; 30deg above; height \
         h1.6u; distance d2u; lens 35mm 60fov wide-lens long-lens; part top bottom left right; side {sides}; place \
         {places}; hidden; before-7 if 7 is seen behind it; then ! if the whole of it must be in the picture\n\
         After the steps, if the sentence says so: \" | total=5s\" for the length of the film, \" | no=zoom\" for \
         motions that it rules out ({motions}).\n\
         If there is nothing that a camera could do: none."
    )
}

fn listed<T: AsRef<str>>(names: &[T]) -> String {
    names.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(" ")
}
