//! A film without a search: the director's cameras, joined by the path.

use super::Suggestion;
use super::draft::Part;

/// Shortest time from one suggested camera to the next.
const LEAST_SECS: f64 = 0.5;

/// The director's cameras as parts: each step that has a suggestion goes from its first camera to its second, by the
/// path that its move means (a circle for an orbit), with the time of the words or else the director's. What the step
/// has to keep stays, so that the report says what was not reached. Steps without a suggestion stay as they are.
pub(super) fn as_suggested(parts: Vec<Part>, suggestions: &[Suggestion]) -> Vec<Part> {
    let mut out: Vec<Part> = Vec::with_capacity(parts.len());
    for part in parts {
        let Some(suggestion) = suggestions.get(part.step) else {
            out.push(part);
            continue;
        };
        if let Some(last) = out.last_mut().filter(|last| last.step == part.step) {
            // A step's joins lead from view to view: the suggestion does so at once.
            let cut = last.cut;
            *last = suggested(part, suggestion);
            last.cut = cut;
        } else {
            out.push(suggested(part, suggestion));
        }
    }
    out
}

fn suggested(part: Part, suggestion: &Suggestion) -> Part {
    let secs = if part.secs_bind { part.secs } else { suggestion.secs.max(LEAST_SECS) };
    Part { states: vec![suggestion.state, suggestion.end], secs, is_join: false, ..part }
}
