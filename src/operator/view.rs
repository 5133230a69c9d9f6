//! The first view of a shot or after a cut: from where a subject is seen, how large, through which lens.

use std::f64::consts::TAU;

use glam::DVec3;

use super::draft::Genes;
use super::framing::{Bearing, Fill, Target, bearing_of, distance_for, view_at};
use super::world::World;
use super::{Framing, Part, Suggestion};
use cinesplat_geometry::{LevelFrame, Pose};
use cinesplat_trajectory::{CameraState, ShotAngle, ShotSize};

/// Share of tries that start from a heading with a reason (the model's, across the line of two subjects, facing a broad
/// side) instead of any heading.
const REASONED_FRAC: f64 = 0.65;

/// What a first view is free to choose from.
#[derive(Debug, Clone)]
pub(super) struct ViewRange {
    /// How large the subject stands where the words give no size: share of the frame that its larger side fills.
    pub(super) fill: (f64, f64),
    /// Vertical field of view, degrees.
    pub(super) fov_deg: (f64, f64),
    /// Headings worth trying: azimuths of the camera as seen from the subject.
    pub(super) azimuths_rad: Vec<f64>,
}

/// Elevation of the camera as seen from the subject for an angle word, degrees; without one slightly from above, as
/// people stand and look at things.
fn elevation_band_deg(angle: Option<ShotAngle>) -> (f64, f64) {
    match angle {
        Some(ShotAngle::Overhead) => (48.0, 74.0),
        Some(ShotAngle::High) => (18.0, 38.0),
        Some(ShotAngle::EyeLevel) => (-4.0, 8.0),
        Some(ShotAngle::Low) => (-34.0, -11.0),
        Some(ShotAngle::Worm) => (-65.0, -42.0),
        None => (-6.0, 26.0),
    }
}

/// Fill for a size word and a gene in 0..1, inside the size's band with a little to spare.
pub(super) fn size_fill(size: ShotSize, gene: f64) -> Fill {
    let (low, high) = size.height_band_frac();
    let high = high.min(2.0);
    Fill::Height(lerp((low * 0.93 + high * 0.07, low * 0.2 + high * 0.8), gene))
}

/// A number between two.
pub(super) fn lerp(range: (f64, f64), t: f64) -> f64 {
    range.0 + (range.1 - range.0) * t
}

/// A view of `target` as `framing` wants it, with what is open chosen by `genes` 0 to 4.
pub(super) fn first_view(
    world: &World,
    target: &Target,
    framing: &Framing,
    range: &ViewRange,
    suggestion: Option<&Suggestion>,
    genes: &Genes,
) -> CameraState {
    let guess = suggestion.map(|s| bearing_of(world, target.aim, s.state.pose.position));
    let azimuth_rad = azimuth(range, guess, genes);
    let band = elevation_band_deg(framing.angle);
    let mut elevation = lerp(band, genes[1]).to_radians();
    if let (Some(guess), None) = (guess, framing.angle) {
        elevation = lerp((elevation, guess.elevation_rad.clamp(-0.5, 0.9)), 0.5);
    }
    let bearing = Bearing { azimuth_rad, elevation_rad: elevation };
    let fill = match framing.size {
        Some(size) => size_fill(size, genes[2]),
        None => Fill::Fit(lerp(range.fill, genes[2])),
    };
    let fill = if framing.whole { Fill::Fit(lerp((0.5, 0.88), genes[2])) } else { fill };
    let fov_y_rad = lerp(range.fov_deg, genes[3]).to_radians();
    let distance = distance_for(world, target, bearing, fill, fov_y_rad);
    let view = view_at(world, target.aim, bearing, distance, fov_y_rad);
    aimed_at_side(world, target, framing.part, view)
}

fn azimuth(range: &ViewRange, guess: Option<Bearing>, genes: &Genes) -> f64 {
    let mut reasons = range.azimuths_rad.clone();
    reasons.extend(guess.map(|g| g.azimuth_rad));
    reasons.extend(guess.map(|g| g.azimuth_rad));
    if reasons.is_empty() || genes[4] > REASONED_FRAC {
        return genes[0] * TAU;
    }
    let pick = ((genes[4] / REASONED_FRAC * reasons.len() as f64) as usize).min(reasons.len() - 1);
    // A tent about the reason: mostly near it, 35 degrees off at most.
    let off = genes[0] * 2.0 - 1.0;
    reasons[pick] + off * off.abs() * 0.61
}

/// The view turned to the left or right end of its subject, where the framing asks for one.
pub(super) fn aimed_at_side(world: &World, target: &Target, part: Part, view: CameraState) -> CameraState {
    let sign = match part {
        Part::Left => -1.0,
        Part::Right => 1.0,
        Part::Middle | Part::Top | Part::Bottom => return view,
    };
    let right = view.pose.right();
    let half = target.corners.iter().map(|c| (*c - target.center).dot(right)).fold(0.0, f64::max);
    let aim = target.center + right * half * 0.6 * sign;
    aimed(world, &view, aim)
}

/// The camera turned in place to look at a point, level; unchanged when it stands on the point.
pub(super) fn aimed(world: &World, state: &CameraState, point: DVec3) -> CameraState {
    let pose = Pose::look_at(state.pose.position, point, world.frame.up, Some(state.pose.right()));
    CameraState { pose: pose.unwrap_or(state.pose), ..*state }
}

/// The camera moved by a vector, not turned.
pub(super) fn moved(state: &CameraState, by: DVec3) -> CameraState {
    let pose = Pose { position: state.pose.position + by, rotation: state.pose.rotation };
    CameraState { pose, ..*state }
}

/// The camera with another field of view.
pub(super) fn with_fov(state: &CameraState, fov_y_rad: f64) -> CameraState {
    CameraState { fov_y_rad, ..*state }
}

/// Headings across the line from `a` to `b`: the camera's right runs along it (or against it, for `to_left`).
pub(super) fn across(frame: &LevelFrame, a: DVec3, b: DVec3, to_left: bool) -> Option<f64> {
    let line = frame.horizontal(b - a).try_normalize()?;
    let right = if to_left { -line } else { line };
    // Forward is up x right; the camera stands against forward as seen from the subject.
    Some(frame.azimuth(right.cross(frame.up)))
}

/// Headings that face the broad sides of a box given by its corners.
pub(super) fn broad_sides(frame: &LevelFrame, corners: &[DVec3]) -> Vec<f64> {
    let extent = |azimuth: f64| {
        let along = frame.direction(azimuth);
        let reach = |f: fn(f64, f64) -> f64, start: f64| corners.iter().map(|c| c.dot(along)).fold(start, f);
        reach(f64::max, f64::NEG_INFINITY) - reach(f64::min, f64::INFINITY)
    };
    let half_turn = (0..36).map(|i| f64::from(i) * std::f64::consts::PI / 36.0);
    let thinnest = half_turn.min_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(0.0);
    let broad = extent(thinnest + std::f64::consts::FRAC_PI_2);
    if extent(thinnest) < 0.75 * broad { vec![thinnest, thinnest + std::f64::consts::PI] } else { Vec::new() }
}
