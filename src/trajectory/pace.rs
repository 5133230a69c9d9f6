//! The length covered over the time of each segment of a path.
//!
//! Enters: the measured segments. Leaves: one pace per segment. The segments of a leg share one profile, a ramp from rest,
//! a cruise and a ramp to rest, where their keys have the times of that profile: a ramp is then as long as the whole leg
//! allows, however short the segment at its end is. Other segments have a profile of their own.

use super::Easing;
use super::profile::SpeedProfile;
use super::segments::MeasuredSegment;
use super::track::harmonic_mean;

/// Largest difference between the time of a key and that of the shared profile, over the duration of the leg.
const SAME_TIME: f64 = 1e-6;

/// The length covered over the time of one segment.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    profile: SpeedProfile,
    /// Time and length of the profile before the segment.
    before_secs: f64,
    before_length: f64,
    /// Length of the segment.
    length: f64,
}

impl Pace {
    /// Length covered `secs` after the start of the segment, monotone from 0 to the segment's length.
    pub(super) fn length_at(&self, secs: f64) -> f64 {
        (self.profile.length_at(self.before_secs + secs) - self.before_length).clamp(0.0, self.length)
    }
}

/// The pace of every segment of a path.
pub(super) fn paces(segments: &[MeasuredSegment]) -> Vec<Pace> {
    let mut out = Vec::with_capacity(segments.len());
    let mut first = 0;
    while first < segments.len() {
        let count = num_in_leg(&segments[first..]);
        let leg = &segments[first..first + count];
        match shared(leg) {
            Some(shared) => out.extend(shared),
            None => out.extend((first..first + count).map(|i| own(segments, i))),
        }
        first += count;
    }
    out
}

/// Number of segments at the front of a list that belong to one leg.
pub(super) fn num_in_leg(segments: &[MeasuredSegment]) -> usize {
    let leg = segments[0].leg.map(|(leg, _)| leg);
    segments.iter().take_while(|s| leg.is_some() && s.leg.map(|(leg, _)| leg) == leg).count().max(1)
}

/// The profile of a whole leg of several segments; `None` where an easing follows a curve, whose speed is its own.
pub(super) fn leg_profile(leg: &[MeasuredSegment]) -> Option<SpeedProfile> {
    let (first, last) = (leg.first()?, leg.last()?);
    let cruises = leg.len() > 1 && leg.iter().all(|segment| segment.easing.curve().is_none());
    let secs: f64 = leg.iter().map(|segment| segment.duration_secs).sum();
    let length: f64 = leg.iter().map(|segment| segment.length).sum();
    let ends = [first.rests_at_start, last.rests_at_end].map(|rests| rests.then_some(0.0));
    (cruises && length > 0.0 && secs > 0.0).then(|| SpeedProfile::new(Easing::Smooth, secs, length, ends))
}

/// The shared profile of a leg, one pace per segment; `None` where the times of the keys are not those of the profile.
fn shared(leg: &[MeasuredSegment]) -> Option<Vec<Pace>> {
    let profile = leg_profile(leg)?;
    let secs: f64 = leg.iter().map(|segment| segment.duration_secs).sum();
    let (mut before_secs, mut before_length) = (0.0, 0.0);
    let mut out = Vec::with_capacity(leg.len());
    for segment in leg {
        if before_length > 0.0 && (profile.secs_at(before_length) - before_secs).abs() > SAME_TIME * secs {
            return None;
        }
        out.push(Pace { profile: profile.clone(), before_secs, before_length, length: segment.length });
        before_secs += segment.duration_secs;
        before_length += segment.length;
    }
    Some(out)
}

/// The profile of one segment by itself. The natural speeds of two neighbors decide the speed at the key between them.
fn own(segments: &[MeasuredSegment], index: usize) -> Pace {
    let segment = &segments[index];
    let before = index.checked_sub(1).and_then(|j| segments.get(j)).filter(|s| s.leg.is_some());
    let after = segments.get(index + 1).filter(|s| s.leg.is_some());
    let between = |a: &MeasuredSegment, b: &MeasuredSegment| harmonic_mean(a.natural_speeds().1, b.natural_speeds().0);
    let start = if segment.rests_at_start { Some(0.0) } else { before.map(|before| between(before, segment)) };
    let end = if segment.rests_at_end { Some(0.0) } else { after.map(|after| between(segment, after)) };
    let profile = SpeedProfile::new(segment.easing, segment.duration_secs, segment.length, [start, end]);
    Pace { profile, before_secs: 0.0, before_length: 0.0, length: segment.length }
}
