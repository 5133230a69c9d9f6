//! Keys split into legs at cuts and at moments of rest, and the length of every segment.

use super::leg::{Leg, LegKind};
use super::profile::{natural_speeds, ramp_secs};
use super::{Easing, Keyframe};
use cinesplat_geometry::LevelFrame;

/// The segment between two neighboring keys, before its speed profile is known.
pub(super) struct MeasuredSegment {
    /// Index of the leg and of the segment within it; `None` where the camera holds the first key until a cut, and for a
    /// blend.
    pub(super) leg: Option<(usize, usize)>,
    /// Length in the leg's unit (see [`Leg::length`]).
    pub(super) length: f64,
    pub(super) duration_secs: f64,
    pub(super) easing: Easing,
    pub(super) rests_at_start: bool,
    pub(super) rests_at_end: bool,
}

impl MeasuredSegment {
    /// Speed between the ramps, if an end without rest has that speed too.
    fn cruise_speed(&self) -> f64 {
        let ramps = f64::from(u8::from(self.rests_at_start)) + f64::from(u8::from(self.rests_at_end));
        self.length / (self.duration_secs - ramps * ramp_secs(self.duration_secs) / 2.0)
    }

    /// Speeds at the start and the end that the easing gives without neighbors.
    pub(super) fn natural_speeds(&self) -> (f64, f64) {
        natural_speeds(self.easing, self.length / self.duration_secs, self.cruise_speed())
    }
}

/// The legs of a list of keys, and one segment per pair of neighboring keys.
pub(super) fn split_into_legs(
    keys: &[Keyframe],
    frame: Option<LevelFrame>,
    num_chords: usize,
) -> (Vec<Leg>, Vec<MeasuredSegment>) {
    let least = rounding_distance(keys);
    let kind = |i: usize| (!keys[i + 1].cut).then(|| LegKind::between(&keys[i], &keys[i + 1], frame.is_some(), least));
    let num_segments = keys.len() - 1;
    let kinds: Vec<Option<LegKind>> = (0..num_segments).map(kind).collect();
    let blends = |i: usize| is_blend(keys, i);
    let leg_ends = |i: usize| blends(i - 1) || blends(i);
    // Whether the camera rests at key i, as the end of one segment and the start of another.
    let rests = |i: usize| {
        let (Some(before), Some(after)) = (kinds[i - 1], kinds[i]) else { return true };
        (before != after && !leg_ends(i)) || keys[i - 1].easing.rests_at_end() || keys[i].easing.rests_at_start()
    };
    // Whether two segments meet at key i without a cut.
    let joins = |i: usize| i > 0 && i < num_segments && kinds[i - 1].is_some() && kinds[i].is_some() && !leg_ends(i);
    let mut legs = Vec::new();
    let mut segments: Vec<MeasuredSegment> = Vec::with_capacity(num_segments);
    let mut first = 0;
    while first < num_segments {
        let mut end = first + 1;
        while end < num_segments && !rests(end) && !leg_ends(end) {
            end += 1;
        }
        let leg =
            kinds[first].filter(|_| !blends(first)).map(|kind| Leg::new(&keys[first..=end], kind, frame, num_chords));
        for i in first..end {
            segments.push(MeasuredSegment {
                leg: leg.as_ref().map(|_| (legs.len(), i - first)),
                length: leg.as_ref().map_or(0.0, |leg| leg.length(i - first)),
                duration_secs: keys[i + 1].time_secs - keys[i].time_secs,
                easing: keys[i].easing,
                rests_at_start: i == first && (joins(i) || keys[i].easing.rests_at_start()),
                rests_at_end: i + 1 == end && (joins(end) || keys[i].easing.rests_at_end()),
            });
        }
        legs.extend(leg);
        first = end;
    }
    (legs, segments)
}

/// Distance up to which two positions of a path are one, scene units: small against the extent of the path, and against
/// what numbers as large as its coordinates resolve. Without the second bound, rounding errors would be the travel of a
/// camera that only turns, and its turn would follow them.
fn rounding_distance(keys: &[Keyframe]) -> f64 {
    let largest = |of: &dyn Fn(&Keyframe) -> f64| keys.iter().map(of).fold(0.0, f64::max);
    let extent = largest(&|key| key.pose.position.distance(keys[0].pose.position));
    let magnitude = largest(&|key| key.pose.position.length());
    (1e-7 * extent).max(1e-12 * magnitude)
}

/// Whether the segment that starts at a key blends its neighbors.
pub(super) fn is_blend(keys: &[Keyframe], index: usize) -> bool {
    keys[index].easing == Easing::Blend && !keys[index + 1].cut
}
