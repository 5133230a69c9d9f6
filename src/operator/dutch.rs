//! The dutch angle: a horizon that slants throughout the film.

use glam::DVec3;

use super::draft::Part;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{Keyframe, ReportLine};

/// Roll that counts as a dutch angle, degrees either way.
const BAND_DEG: (f64, f64) = (5.0, 35.0);

/// Turns every camera about its view axis, clockwise for the operator.
pub(super) fn roll(parts: &mut [Part], degrees: f64) {
    let turn = rotation::exp(DVec3::Z * degrees.to_radians());
    for state in parts.iter_mut().flat_map(|part| part.states.iter_mut()) {
        state.pose.rotation = (state.pose.rotation * turn).normalize();
    }
}

/// The report of it: the least roll of any key.
pub(super) fn line(world: &World, keys: &[Keyframe]) -> ReportLine {
    let rolls = keys.iter().map(|key| world.frame.roll_rad(&key.pose).to_degrees().abs());
    let got = rolls.fold(f64::INFINITY, f64::min);
    let (low, high) = BAND_DEG;
    let met = (low..=high).contains(&got);
    let note = if met { "" } else { "the roll of a move takes it back: the slant gave way" };
    ReportLine {
        clause: "dutch angle".to_owned(),
        wanted: format!("horizon slanted by {low:.0} to {high:.0} degrees throughout"),
        got,
        met,
        note: note.to_owned(),
    }
}
