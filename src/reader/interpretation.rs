//! An answer as a program, with the words and the certainty of each step.

use cinesplat_language::program_from_notation;
use cinesplat_operator::Program;

use crate::answer::Answer;
use crate::error::ReaderError;
use crate::question::Question;

/// What a language model understands a prompt as.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpretation {
    /// The program; each step has its bytes of the prompt.
    pub program: Program,
    /// How sure the model is of each step.
    pub certainty: Vec<Certainty>,
}

/// How sure a model is of a step. The model's own figures: they are not calibrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certainty {
    /// Product of the probabilities of its tokens among those that the notation allowed, 0..=1.
    pub probability: f64,
    /// What its least probable token says, and that probability.
    pub weakest: (&'static str, f64),
}

impl Interpretation {
    /// The program of an answer to a question.
    ///
    /// # Errors
    /// [`ReaderError::Compute`] for an answer that is not in the notation.
    pub(crate) fn of(answer: &Answer, question: &Question) -> Result<Self, ReaderError> {
        let pieces = pieces(&answer.text);
        let mut spans = Vec::new();
        let mut notation = String::new();
        for [start, end] in &pieces {
            let piece = answer.text.get(*start..*end).unwrap_or_default();
            let (range, step) = piece.split_once(' ').unwrap_or(("", piece));
            spans.push(numbers(range).and_then(|(first, last)| question.span_of(first, last)));
            notation.push_str(if notation.is_empty() { "" } else { " / " });
            notation.push_str(step);
        }
        let steps_end = pieces.last().map_or(0, |[_, end]| *end);
        notation.push_str(answer.text.get(steps_end..).unwrap_or_default());
        let program = program_from_notation(notation.trim()).map_err(|error| ReaderError::compute(&error))?;
        let mut program = program.with_ids(&|ids| ids.iter().map(|id| question.id_of(*id)).collect());
        for (step, span) in program.steps.iter_mut().zip(&spans) {
            step.words = *span;
        }
        let certainty = pieces.iter().map(|piece| certainty(answer, *piece)).collect();
        Ok(Self { program, certainty })
    }
}

/// Bytes of the steps of an answer.
fn pieces(text: &str) -> Vec<[usize; 2]> {
    let end = text.find(" | ").unwrap_or(text.len());
    let mut start = text.len() - text.trim_start().len();
    let steps = text.get(start..end).unwrap_or_default();
    let mut pieces = Vec::new();
    for step in steps.split(" / ").filter(|step| step.contains(' ')) {
        pieces.push([start, start + step.len()]);
        start += step.len() + " / ".len();
    }
    pieces
}

fn numbers(range: &str) -> Option<(usize, usize)> {
    let (first, last) = range.split_once('-')?;
    Some((first.parse().ok()?, last.parse().ok()?))
}

/// Certainty of the step at some bytes of an answer: of the tokens that begin in it, and of the one that ends it.
fn certainty(answer: &Answer, [start, end]: [usize; 2]) -> Certainty {
    let mut certainty = Certainty { probability: 1.0, weakest: ("next", 1.0) };
    let first = answer.tokens.iter().rposition(|(at, _)| *at <= start).unwrap_or(0);
    for (at, probability) in answer.tokens.iter().skip(first).take_while(|(at, _)| *at <= end) {
        certainty.probability *= probability;
        if *probability < certainty.weakest.1 {
            certainty.weakest = (said_at(&answer.text, [start, end], *at), *probability);
        }
    }
    certainty
}

/// What the text at a byte of a step says.
fn said_at(text: &str, [start, end]: [usize; 2], at: usize) -> &'static str {
    if at >= end {
        return "next";
    }
    // A token may begin with the space before its word.
    let is_space = text.as_bytes().get(at) == Some(&b' ');
    let at = at.max(start) + usize::from(is_space && at >= start);
    let word_start = text.get(start..at).and_then(|before| before.rfind(' ')).map_or(start, |space| start + space + 1);
    let word = text.get(word_start..end).and_then(|rest| rest.split(' ').next()).unwrap_or_default();
    match (word.split_once('=').map(|(key, _)| key), word) {
        (Some("with"), _) => "second move",
        (Some("start"), _) => "start",
        (Some("end"), _) => "end",
        (Some("look"), _) => "look",
        (Some("keep"), _) => "kept in view",
        (Some("avoid"), _) => "avoided",
        (Some("amount"), _) => "amount",
        (Some("dur"), _) => "duration",
        (Some("ease"), _) => "easing",
        (Some(_), _) => "objects on the way",
        (None, "slow" | "fast") => "speed",
        (None, "cut") => "cut",
        (None, "returns") => "returns",
        (None, "either") => "either-way",
        _ if word_start == start => "words",
        _ => "move",
    }
}
