use std::fmt::Write as _;

use cinesplat::critic::{TERMS, Term, Weights, ranked};
use cinesplat::pipeline::Critique;

/// What changes over all films where one term is switched off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ablation {
    term: Term,
    /// Films of which another one is chosen.
    num_changed: usize,
    /// Mean of the term's own mark over all films that have one, with the term and without it.
    with: f64,
    without: f64,
    /// Mean gain of all other marks, weighted, where the term is off.
    others_gain: f64,
}

/// One ablation per term: the films are chosen again from the same finalists.
pub(super) fn ablation(critiques: &[&Critique]) -> Vec<Ablation> {
    TERMS.iter().map(|row| without(row.term, critiques)).collect()
}

fn without(term: Term, critiques: &[&Critique]) -> Ablation {
    let weights = Weights::default().without(term);
    let (mut num_changed, mut with, mut without, mut gain, mut num_marked) = (0, 0.0, 0.0, 0.0, 0.0);
    for critique in critiques {
        let films = &critique.candidates;
        let picked = |weights: &Weights| ranked(films, weights).first().map(|&idx| &films[idx].review);
        let (Some(all), Some(less)) = (picked(&Weights::default()), picked(&weights)) else { continue };
        num_changed += usize::from(all != less);
        gain += less.score(&weights) - all.score(&weights);
        if let (Some(a), Some(b)) = (all.value(term), less.value(term)) {
            (with, without, num_marked) = (with + a, without + b, num_marked + 1.0);
        }
    }
    let mean = |sum: f64| if num_marked > 0.0 { sum / num_marked } else { f64::NAN };
    let others_gain = gain / critiques.len().max(1) as f64;
    Ablation { term, num_changed, with: mean(with), without: mean(without), others_gain }
}

pub(super) fn to_csv(rows: &[Ablation]) -> String {
    let mut csv = "term,weight,films_changed,mark_with,mark_without,others_gain\n".to_owned();
    for row in rows {
        let (term, weight) = (row.term.as_ref(), row.term.row().weight);
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{term},{weight},{},{:.4},{:.4},{:.5}",
            row.num_changed, row.with, row.without, row.others_gain
        );
    }
    csv
}

/// The ablation as a Markdown table, with what each term punishes and its source.
pub(super) fn to_table(rows: &[Ablation]) -> String {
    let mut table =
        "| term off | weight | films changed | its mark with | without | gain of the others | punishes | source |\n\
                     |---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for row in rows {
        let of = row.term.row();
        let _ = writeln!(
            table,
            "| {} | {} | {} | {:.3} | {:.3} | {:+.4} | {} | {} |",
            row.term, of.weight, row.num_changed, row.with, row.without, row.others_gain, of.punishes, of.source
        );
    }
    table
}
