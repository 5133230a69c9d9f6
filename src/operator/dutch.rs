//! The dutch angle: a slanted horizon while some steps last.
//!
//! Enters: the segments of a film whose horizon is level. Leaves: the same segments, slanted during the steps that the
//! words say. Where a level step stands beside a slanted one without a cut, the camera leans over, or back, between
//! them.

use glam::DVec3;

use super::motion::MotionSegment;
use super::settings::Slant;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Move, ReportLine};

/// Range of the roll, either way, that counts as a dutch angle; degrees.
const BAND_DEG: (f64, f64) = (5.0, 35.0);
/// Time in which the camera leans over between two steps.
const LEAN_SECS: f64 = 0.8;

/// The segments with the slant.
pub(super) fn slanted(segments: Vec<MotionSegment>, slant: Slant) -> Vec<MotionSegment> {
    let mut out: Vec<MotionSegment> = Vec::with_capacity(segments.len() + 2);
    let mut was_slanted = None;
    for mut segment in segments {
        let is_slanted = slant.covers(segment.step);
        if is_slanted {
            segment.states.iter_mut().for_each(|state| *state = rolled(state, slant.degrees));
        }
        if was_slanted.is_some_and(|before| before != is_slanted) && !segment.cut {
            out.extend(out.last().map(|last| lean(last.last(), segment.step, (is_slanted, slant.degrees))));
        }
        was_slanted = Some(is_slanted);
        out.push(segment);
    }
    out
}

/// Leans over from a level camera, or back from a slanted one, where the step that follows begins.
fn lean(from: CameraState, step: usize, (into, degrees): (bool, f64)) -> MotionSegment {
    let degrees = if into { degrees } else { -degrees };
    let movement = if degrees > 0.0 { Move::RollCw } else { Move::RollCcw };
    let join = MotionSegment::new(step, movement, vec![from, rolled(&from, degrees)], LEAN_SECS);
    MotionSegment { is_join: true, ..join }
}

/// A camera, rolled about its view axis, clockwise as the operator sees it.
fn rolled(state: &CameraState, degrees: f64) -> CameraState {
    let mut rolled = *state;
    let turn = rotation::exp(DVec3::Z * degrees.to_radians());
    rolled.pose.rotation = (rolled.pose.rotation * turn).normalize();
    rolled
}

impl Slant {
    fn covers(&self, step: usize) -> bool {
        (self.steps[0]..=self.steps[1]).contains(&step)
    }
}

/// The report line: the least roll of any camera of the steps.
pub(super) fn report_line(world: &World, segments: &[MotionSegment], slant: Slant) -> ReportLine {
    let own = segments.iter().filter(|segment| slant.covers(segment.step) && !segment.is_join);
    let rolls =
        own.flat_map(|segment| &segment.states).map(|state| world.frame.roll_rad(&state.pose).to_degrees().abs());
    let got = rolls.reduce(f64::min).unwrap_or(0.0);
    let (low, high) = BAND_DEG;
    let met = (low..=high).contains(&got);
    let note = if met { "" } else { "a roll move in the program cancels the slant" };
    ReportLine {
        clause: "dutch angle".to_owned(),
        wanted: format!("horizon slanted by {low:.0} to {high:.0} degrees throughout its steps"),
        got,
        met,
        note: note.to_owned(),
    }
}
