//! When a film should show which object, for those who look at its pictures.

use super::constraint::{Constraint, ConstraintKind, Scope};
use super::motion::MotionSegment;

/// A stretch of a film in which an object should be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Id of the object.
    pub object: u32,
    /// Start of the stretch.
    pub from_secs: f64,
    /// End of the stretch; equal to the start for a single moment.
    pub to_secs: f64,
}

/// The sightings of a film: of every object whose visibility is a constraint of a segment. `spans` are start and end of
/// each segment in the film; the rest before the first segment belongs to it, and the rest after the last one to the last.
pub(super) fn sightings(segments: &[MotionSegment], spans: &[[f64; 2]], film_secs: f64) -> Vec<Sighting> {
    let mut out = Vec::new();
    let last = spans.len().saturating_sub(1);
    for (i, (segment, &[start, end])) in segments.iter().zip(spans).enumerate() {
        let span = [if i == 0 { 0.0 } else { start }, if i == last { film_secs } else { end }];
        for sighting in segment.constraints.iter().filter_map(|constraint| sighting(constraint, span)) {
            if !out.contains(&sighting) {
                out.push(sighting);
            }
        }
    }
    out
}

fn sighting(constraint: &Constraint, [start, end]: [f64; 2]) -> Option<Sighting> {
    let ConstraintKind::Unoccluded(object, _) = constraint.kind else { return None };
    let (from_secs, to_secs) = match constraint.scope {
        Scope::Start => (start, start),
        Scope::End => (end, end),
        Scope::All => (start, end),
        Scope::Any => return None,
    };
    Some(Sighting { object, from_secs, to_secs })
}
