//! What was asked for and what came of it, clause by clause.

use super::Program;
use super::draft::Part;
use super::judge::{outcome, path_of, sampled, supported_frac, wording};
use super::world::World;
use cinesplat_trajectory::ReportLine;

/// Samples of a part that the report is measured on.
const NUM_SAMPLES: usize = 49;

/// Share of each part's way that has to look at the capture's good side. The measure is a guess from the matter alone, and
/// at the edge of what was captured it flickers.
const LEAST_SUPPORTED: f64 = 0.9;

/// The report of a film: every goal of every step, support of the whole, and what could not be done.
pub(super) fn report(world: &World, program: &Program, prompt: &str, parts: &[Part]) -> Vec<ReportLine> {
    let mut lines: Vec<ReportLine> = Vec::new();
    let mut supported = 1.0_f64;
    for part in parts {
        let states = sampled(&path_of(world, part), part, NUM_SAMPLES);
        supported = supported.min(supported_frac(world, &states));
        let words = program.steps.get(part.step).and_then(|step| step.words);
        for goal in &part.goals {
            let found = outcome(world, goal, &states, usize::MAX);
            let met = found.violation <= 0.0;
            let note = if met { String::new() } else { gave_way(words.is_some()) };
            lines.push(ReportLine {
                clause: clause(prompt, words, part),
                wanted: wording(world, goal),
                got: found.got,
                met,
                note,
            });
        }
    }
    if supported < LEAST_SUPPORTED {
        lines.push(ReportLine {
            clause: "camera stays where the capture shows the scene's good side".to_owned(),
            wanted: format!("share of the way at least {LEAST_SUPPORTED:.2}"),
            got: supported,
            met: false,
            note: "part of the way looks at backs of surfaces or lies outside the captured space".to_owned(),
        });
    }
    let unmet = |(words, why): &(String, String)| ReportLine {
        clause: words.clone(),
        wanted: "as the words say".to_owned(),
        got: 0.0,
        met: false,
        note: why.clone(),
    };
    lines.extend(program.unmet.iter().map(unmet));
    lines
}

/// The words of a part, or the name of its move.
pub(super) fn clause(prompt: &str, words: Option<[usize; 2]>, part: &Part) -> String {
    let text = words.and_then(|[from, to]| prompt.get(from..to)).map(str::trim).unwrap_or_default();
    if text.is_empty() { part.movement.as_ref().to_owned() } else { text.to_owned() }
}

fn gave_way(has_words: bool) -> String {
    let why = "no camera was found that keeps this together with the rest: this gave way";
    if has_words { why.to_owned() } else { format!("{why} (nothing in the words asks for it)") }
}
