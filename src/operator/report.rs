//! The report: requested and measured values, one line per constraint.

use super::constraint::ConstraintKind;
use super::cost::captured_frac;
use super::measure::measure;
use super::motion::MotionSegment;
use super::program::Program;
use super::settings::SolveLevel;
use super::wording::wording;
use super::world::World;
use cinesplat_trajectory::{CameraPath, CameraState, Move, ReportLine};

/// Samples per segment on which constraints are measured.
const NUM_SAMPLES: usize = 49;

/// Share of each segment that must stay inside the captured region and see front faces. Below 1, because the region is
/// estimated from the matter alone and the estimate flickers at its boundary.
const MIN_CAPTURED_FRAC: f64 = 0.9;

/// The report of a film: every constraint of every segment on its span of the path, and the captured region, with the share
/// of the path inside it.
pub(super) fn report(
    world: &World,
    (program, prompt): (&Program, &str),
    (segments, spans): (&[MotionSegment], &[[f64; 2]]),
    path: &CameraPath,
    level: SolveLevel,
) -> (Vec<ReportLine>, f64) {
    let mut lines: Vec<ReportLine> = Vec::new();
    let mut captured = 1.0_f64;
    for (segment, &[from, to]) in segments.iter().zip(spans) {
        let at = |i: usize| path.sample(from + (to - from) * i as f64 / (NUM_SAMPLES - 1) as f64);
        let states: Vec<CameraState> = (0..NUM_SAMPLES).map(at).collect();
        captured = captured.min(captured_frac(world, &states));
        let words = program.steps.get(segment.step).and_then(|step| step.words);
        let is_listed =
            |kind: &ConstraintKind| !matches!(kind, ConstraintKind::Without(_) | ConstraintKind::Limited(_));
        for constraint in segment.constraints.iter().filter(|constraint| is_listed(&constraint.kind)) {
            let measured = measure(world, constraint, &states, usize::MAX);
            let met = measured.violation <= 0.0;
            lines.push(ReportLine {
                clause: clause(prompt, words, segment.movement),
                wanted: wording(world, constraint),
                got: measured.value,
                met,
                note: if met { String::new() } else { unmet_note(words.is_some(), level) },
            });
        }
    }
    if captured < MIN_CAPTURED_FRAC {
        lines.push(ReportLine {
            clause: "camera stays in the captured region and sees front sides".to_owned(),
            wanted: format!("share of the path at least {MIN_CAPTURED_FRAC:.2}"),
            got: captured,
            met: false,
            note: "the camera sees back sides of surfaces or leaves the captured region".to_owned(),
        });
    }
    (lines, captured)
}

/// The words of the prompt that a move comes from, or else its name.
pub(super) fn clause(prompt: &str, words: Option<[usize; 2]>, movement: Move) -> String {
    let text = words.and_then(|[from, to]| prompt.get(from..to)).map(str::trim).unwrap_or_default();
    if text.is_empty() { movement.as_ref().to_owned() } else { text.to_owned() }
}

fn unmet_note(has_words: bool, level: SolveLevel) -> String {
    let why = match level {
        SolveLevel::Off => "the only camera that was tried does not meet this: the search is off",
        SolveLevel::Fast | SolveLevel::Full => "no camera was found that meets this and the other constraints",
    };
    if has_words { why.to_owned() } else { format!("{why} (the prompt does not request it)") }
}
