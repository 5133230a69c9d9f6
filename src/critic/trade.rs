//! What the choice between two films traded, in words.

use std::fmt::Write as _;

use super::choice::Candidate;
use super::terms::{Term, Weights};

/// Difference of a weighted mark below which two films are alike in a term.
const ALIKE: f64 = 0.004;

/// Why the first film was chosen over the second, and what it gives up for that: one or two sentences.
pub fn trade(chosen: &Candidate, other: &Candidate, weights: &Weights) -> String {
    if chosen.num_unmet != other.num_unmet {
        let (ours, theirs) = (chosen.num_unmet, other.num_unmet);
        return format!(
            "It leaves {ours} requirements unmet, the runner-up {theirs}; requirements rank above pictures."
        );
    }
    let (ours, theirs) = (chosen.review.num_broken(), other.review.num_broken());
    if ours != theirs {
        let broken = other.review.limits.iter().filter(|check| !check.is_kept());
        let names: Vec<&str> = broken.map(|check| check.limit.into()).collect();
        return format!("It breaks {ours} of the limits on pictures, the runner-up {theirs} ({}).", names.join(", "));
    }
    let differences = differences(chosen, other, weights);
    let better = praises(differences.iter().filter(|(_, gain)| *gain > ALIKE));
    let worse = praises(differences.iter().rev().filter(|(_, gain)| *gain < -ALIKE));
    let mut text = match better.as_str() {
        "" => "It is alike in every term.".to_owned(),
        better => format!("It {better}."),
    };
    if !worse.is_empty() {
        let _ = write!(text, " In return the runner-up {worse}.");
    }
    text
}

/// Terms with the gain of the first film, the largest first.
fn differences(chosen: &Candidate, other: &Candidate, weights: &Weights) -> Vec<(Term, f64)> {
    let total: f64 =
        chosen.review.marks.iter().filter(|mark| mark.value.is_some()).map(|mark| weights.of(mark.term)).sum();
    let gain = |term: Term| {
        let (ours, theirs) = chosen.review.value(term).zip(other.review.value(term))?;
        Some((term, (ours - theirs) * weights.of(term) / total.max(1e-9)))
    };
    let mut all: Vec<(Term, f64)> = chosen.review.marks.iter().filter_map(|mark| gain(mark.term)).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

/// The three largest praises with their gains, joined.
fn praises<'a>(terms: impl Iterator<Item = &'a (Term, f64)>) -> String {
    let words: Vec<String> =
        terms.take(3).map(|(term, gain)| format!("{} ({:+.3})", term.row().praise, gain.abs())).collect();
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::new(),
    }
}
