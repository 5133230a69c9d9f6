//! Which films clearly differ: another side, another height, another distance, another lens or another path.

use super::motion::MotionSegment;
use cinesplat_trajectory::CameraState;

/// Angle between two views from which they count as views from different directions, degrees.
const APART_DEG: f64 = 24.0;
/// Distance between two camera positions that counts as another place, over the scene size.
const APART_FRAC: f64 = 0.08;
/// Ratio of the tangents of half the fields of view that counts as another lens.
const LENS_RATIO: f64 = 1.5;

/// Whether two films clearly differ at the start, in the middle or at the end of one of their segments.
pub(super) fn clearly_differ(scene_size: f64, a: &[Vec<MotionSegment>], b: &[Vec<MotionSegment>]) -> bool {
    let apart = APART_FRAC * scene_size;
    let marks = |film: &[Vec<MotionSegment>]| film.iter().flatten().flat_map(marks).collect::<Vec<CameraState>>();
    let (a, b) = (marks(a), marks(b));
    a.len() != b.len() || a.iter().zip(&b).any(|(a, b)| views_differ(a, b, apart))
}

/// First, middle and last camera of a segment.
fn marks(segment: &MotionSegment) -> [CameraState; 3] {
    let states = &segment.states;
    [states[0], states[states.len() / 2], segment.last()]
}

fn views_differ(a: &CameraState, b: &CameraState, apart: f64) -> bool {
    let lens = (a.fov_y_rad / 2.0).tan() / (b.fov_y_rad / 2.0).tan();
    a.pose.position.distance(b.pose.position) > apart
        || a.pose.forward().angle_between(b.pose.forward()).to_degrees() > APART_DEG
        || lens.max(1.0 / lens) > LENS_RATIO
}
