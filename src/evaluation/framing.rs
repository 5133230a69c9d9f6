//! What an error of the path does to the picture: where a subject stands and how large.

use glam::{DQuat, DVec2, DVec3};

use super::Trajectory;
use super::statistics::root_mean_square;

/// Half the width of the frame over its height that subjects are looked for in.
const ASPECT: f64 = 16.0 / 9.0;

/// A sphere that should look the same from both paths, world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubjectSphere {
    /// Its center.
    pub center: DVec3,
    /// Its radius, scene units.
    pub radius: f64,
}

/// How differently a subject is framed, over matched poses that both have it before them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramingError {
    /// Root mean square of the distance between its two places in the frame, over the frame's height.
    pub offset_rmse: f64,
    /// The largest.
    pub offset_max: f64,
    /// Root mean square of ln(its size in the estimate's picture / in the reference's): 0.1 is about 10 %.
    pub log_size_rmse: f64,
    /// Share of the reference's pictures with the subject's center in a 16:9 frame that the estimate loses.
    pub lost_frac: f64,
}

/// The framing error of poses matched one to one; `None` where a path lacks fields of view or no pair has the subject
/// before both cameras.
pub fn framing_error(reference: &Trajectory, estimate: &Trajectory, subject: &SubjectSphere) -> Option<FramingError> {
    let (mut offsets, mut sizes, mut shown, mut lost) = (Vec::new(), Vec::new(), 0_usize, 0_usize);
    for idx in 0..reference.len().min(estimate.len()) {
        let wanted = seen(reference, idx, subject);
        let got = seen(estimate, idx, subject);
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

/// Where the subject's center is in the picture, in frame heights from its middle, and how large its radius is.
fn seen(path: &Trajectory, idx: usize, subject: &SubjectSphere) -> Option<(DVec2, f64)> {
    let fov_y_rad = path.fov_y_rad.get(idx).copied().flatten()?;
    let camera_from_world = DQuat::from_mat3(path.rotations.get(idx)?).normalize().conjugate();
    let p = camera_from_world * (subject.center - *path.positions.get(idx)?);
    let frame_height = 2.0 * p.z * (fov_y_rad / 2.0).tan();
    (p.z > 0.0).then(|| (DVec2::new(p.x, p.y) / frame_height, subject.radius / frame_height))
}

fn in_frame(place: DVec2) -> bool {
    place.x.abs() <= ASPECT / 2.0 && place.y.abs() <= 0.5
}
