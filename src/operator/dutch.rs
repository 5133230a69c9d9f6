//! The dutch angle: a slanted horizon throughout the film.

use glam::DVec3;

use super::motion::MotionSegment;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{Keyframe, ReportLine};

/// Range of the roll, either way, that counts as a dutch angle; degrees.
const BAND_DEG: (f64, f64) = (5.0, 35.0);

/// Rolls every camera about its view axis, clockwise as the operator sees it.
pub(super) fn roll(segments: &mut [MotionSegment], degrees: f64) {
    let turn = rotation::exp(DVec3::Z * degrees.to_radians());
    for state in segments.iter_mut().flat_map(|segment| segment.states.iter_mut()) {
        state.pose.rotation = (state.pose.rotation * turn).normalize();
    }
}

/// The report line: the least roll of any keyframe.
pub(super) fn report_line(world: &World, keys: &[Keyframe]) -> ReportLine {
    let rolls = keys.iter().map(|key| world.frame.roll_rad(&key.pose).to_degrees().abs());
    let got = rolls.fold(f64::INFINITY, f64::min);
    let (low, high) = BAND_DEG;
    let met = (low..=high).contains(&got);
    let note = if met { "" } else { "a roll move in the program cancels the slant" };
    ReportLine {
        clause: "dutch angle".to_owned(),
        wanted: format!("horizon slanted by {low:.0} to {high:.0} degrees throughout"),
        got,
        met,
        note: note.to_owned(),
    }
}
