//! Error of a subject's position and size in the frame.

use glam::{DQuat, DVec2, DVec3};

use super::Trajectory;
use super::statistics::root_mean_square;

/// Width over height of the frame in which subjects count as visible.
const ASPECT: f64 = 16.0 / 9.0;

/// A subject that both paths should frame alike: a sphere in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubjectSphere {
    /// Its center.
    pub center: DVec3,
    /// Its radius, scene units.
    pub radius: f64,
}

/// Difference of a subject's framing, over matched poses that both have it in front of the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramingError {
    /// Root mean square of the distance between its two positions in the frame, in frame heights.
    pub offset_rmse: f64,
    /// Largest such distance, in frame heights.
    pub offset_max: f64,
    /// Root mean square of ln(size in the estimate / size in the reference); 0.1 is about 10 %.
    pub log_size_rmse: f64,
    /// Among poses whose reference has the subject's center in a 16:9 frame, the fraction whose estimate does not.
    pub lost_frac: f64,
}

/// The framing error of poses matched by index; `None` if no matched poses have fields of view and the subject in front
/// of both cameras.
pub fn framing_error(reference: &Trajectory, estimate: &Trajectory, subject: &SubjectSphere) -> Option<FramingError> {
    let (mut offsets, mut sizes, mut shown, mut lost) = (Vec::new(), Vec::new(), 0_usize, 0_usize);
    for idx in 0..reference.len().min(estimate.len()) {
        let wanted = projected(reference, idx, subject);
        let got = projected(estimate, idx, subject);
        if wanted.is_some_and(|(place, _)| in_frame(place)) {
            shown += 1;
            lost += usize::from(!got.is_some_and(|(place, _)| in_frame(place)));
        }
        if let (Some((place, size)), Some((other_place, other_size))) = (wanted, got) {
            offsets.push(place.distance(other_place));
            sizes.push((other_size / size).ln());
        }
    }
    (!offsets.is_empty()).then(|| FramingError {
        offset_rmse: root_mean_square(&offsets),
        offset_max: offsets.iter().copied().fold(0.0, f64::max),
        log_size_rmse: root_mean_square(&sizes),
        lost_frac: lost as f64 / shown.max(1) as f64,
    })
}

/// Position of the subject's center relative to the middle of the frame, and its radius, both in frame heights.
fn projected(path: &Trajectory, idx: usize, subject: &SubjectSphere) -> Option<(DVec2, f64)> {
    let fov_y_rad = path.fov_y_rad.get(idx).copied().flatten()?;
    let camera_from_world = DQuat::from_mat3(path.rotations.get(idx)?).normalize().conjugate();
    let p = camera_from_world * (subject.center - *path.positions.get(idx)?);
    let frame_height = 2.0 * p.z * (fov_y_rad / 2.0).tan();
    (p.z > 0.0).then(|| (DVec2::new(p.x, p.y) / frame_height, subject.radius / frame_height))
}

fn in_frame(place: DVec2) -> bool {
    place.x.abs() <= ASPECT / 2.0 && place.y.abs() <= 0.5
}
