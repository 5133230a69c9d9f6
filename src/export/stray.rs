//! How far other programs stray from a film between its keyframes.

use glam::DVec3;

use super::hermite::hermite_weights;
use super::key_slopes::{CameraValues, KeySlopes, key_slopes, values};
use super::nerfstudio_spline::ViewerCurve;
use super::opengl::from_opengl_rotation;
use super::supersplat::{self, Views};
use super::track::PoseFrame;
use super::{ExportError, Format, PoseTrack, lichtfeld};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::Shot;

/// How a program joins keys.
enum Curve {
    /// Straight lines, and rotations at constant speed.
    Linear(Lens),
    /// A cubic spline through positions, targets and fields of view, whose slope at a key is that between its neighbors.
    TargetSpline(Views),
    /// That of nerfstudio's viewer.
    Viewer(ViewerCurve),
    /// Cubic curves with the slopes of the film at the keys; of rotations the same, by components; of lenses the focal
    /// lengths.
    Bezier(Vec<KeySlopes>),
    /// Positions by a uniform Catmull-Rom spline with a key's easing; rotations and focal lengths straight.
    EasedSpline,
}

/// What of a lens changes at constant speed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lens {
    FieldOfView,
    FocalLength,
}

/// The keys that a format's program reads, and how it joins them; `None` if the program draws no curve.
fn curve_of(format: Format, shot: &Shot) -> Result<Option<(Vec<PoseFrame>, Curve)>, ExportError> {
    let keys = PoseTrack::keyframes(shot);
    let curve = match format {
        Format::Gltf => Curve::Linear(Lens::FieldOfView),
        Format::Usd => Curve::Linear(Lens::FocalLength),
        Format::Nerfstudio => {
            let curve = ViewerCurve::new(&keys.frames);
            return Ok(curve.map(|curve| (keys.frames, Curve::Viewer(curve))));
        }
        Format::Supersplat => return Ok(Some((supersplat::held(&keys), Curve::TargetSpline(Views::of(&keys))))),
        Format::Lichtfeld => Curve::EasedSpline,
        Format::Blender => Curve::Bezier(key_slopes(shot)?),
        // The rest holds poses alone.
        _ => return Ok(None),
    };
    Ok(Some((keys.frames, curve)))
}

/// A line about the largest difference between the film and the curve of a format's program through the keys alone; `None`
/// if the program draws no curve.
///
/// # Errors
/// [`ExportError::BadShot`] if the shot is not usable.
pub(super) fn line(format: Format, shot: &Shot) -> Result<Option<String>, ExportError> {
    let Some((keys, curve)) = curve_of(format, shot)? else { return Ok(None) };
    let film = PoseTrack::sampled(shot, None)?;
    let (mut moved, mut turned, mut zoomed, mut worst_secs) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
    for frame in &film.frames {
        let after = keys.partition_point(|key| key.time_secs <= frame.time_secs);
        let (Some(from), true) = (after.checked_sub(1), after < keys.len()) else { continue };
        if keys[after].cut {
            continue;
        }
        let (position, turn, fov) = between(&curve, &keys, from, frame.time_secs);
        let off = position.distance(frame.pose.position);
        if off > moved {
            (moved, worst_secs) = (off, frame.time_secs);
        }
        turned = turned.max(rotation::angle_between(turn, frame.pose.rotation));
        zoomed = zoomed.max((fov - frame.fov_y_rad.unwrap_or(fov)).abs());
    }
    let what = match curve {
        Curve::Linear(_) => "lines",
        Curve::TargetSpline(_) | Curve::Viewer(_) | Curve::EasedSpline => "its own spline",
        Curve::Bezier(_) => "Bezier curves of the film's slopes",
    };
    let (program, exact) = match format {
        Format::Nerfstudio => {
            ("nerfstudio's viewer", "`ns-render` renders the film's frames, which the file holds, too")
        }
        _ => (format.into(), "export every frame for the path of the film"),
    };
    Ok(Some(format!(
        "{program} joins keyframes with {what}: up to {moved:.4} scene units (at {worst_secs:.2} s), {:.2} degrees and a \
         field of view {:.2} degrees off the film; {exact}",
        turned.to_degrees(),
        zoomed.to_degrees()
    )))
}

/// Position, rotation and field of view at a time between key `from` and the next.
fn between(curve: &Curve, frames: &[PoseFrame], from: usize, time_secs: f64) -> (DVec3, glam::DQuat, f64) {
    let (a, b) = (&frames[from], &frames[from + 1]);
    let span = b.time_secs - a.time_secs;
    let t = if span > 0.0 { (time_secs - a.time_secs) / span } else { 0.0 };
    let fov = |idx: usize| frames[idx].fov_y_rad.unwrap_or(1.0);
    // Focal lengths over half the frame's height.
    let focal = |idx: usize| 1.0 / (fov(idx) / 2.0).tan();
    let zoomed = |t: f64| 2.0 * (1.0 / (focal(from) + (focal(from + 1) - focal(from)) * t)).atan();
    match curve {
        Curve::Linear(lens) => {
            let pose = a.pose.between(&b.pose, t);
            let even = fov(from) + (fov(from + 1) - fov(from)) * t;
            (pose.position, pose.rotation, if *lens == Lens::FocalLength { zoomed(t) } else { even })
        }
        Curve::Bezier(slopes) => {
            let [low, high] = [(from, slopes[from].after), (from + 1, slopes[from + 1].before)]
                .map(|(idx, slope)| with_focal(&values(&frames[idx]), &slope));
            let v = cubic(low, high, span, t);
            let turn = glam::DQuat::from_xyzw(v[3], v[4], v[5], v[6]).normalize();
            let pose = from_opengl_rotation(DVec3::new(v[0], v[1], v[2]), turn);
            (pose.position, pose.rotation, 2.0 * (1.0 / v[7]).atan())
        }
        Curve::EasedSpline => {
            let t = lichtfeld::eased(a.easing, t);
            let at = |idx: usize| frames[idx.min(frames.len() - 1)].pose.position;
            let (before, after) = (at(from.saturating_sub(1)), at(from + 2));
            let (low, high) = (a.pose.position, b.pose.position);
            let point = low * (2.0 + t * t * (3.0 * t - 5.0))
                + high * (t * (1.0 + t * (4.0 - 3.0 * t)))
                + before * (t * (t * (2.0 - t) - 1.0))
                + after * (t * t * (t - 1.0));
            (point / 2.0, rotation::slerp(a.pose.rotation, b.pose.rotation, t), zoomed(t))
        }
        Curve::Viewer(curve) => curve.at(time_secs),
        Curve::TargetSpline(views) => {
            let values = hermite(&|idx| views.values(&frames[idx]), frames, from, t);
            let (pose, fov) = views.camera(values).unwrap_or((a.pose, fov(from)));
            (pose.position, pose.rotation, fov)
        }
    }
}

/// Numbers of a camera and their slopes, with focal lengths over half the frame's height in place of fields of view.
fn with_focal(values: &CameraValues, slopes: &CameraValues) -> (CameraValues, CameraValues) {
    let (mut values, mut slopes, half) = (*values, *slopes, values[7] / 2.0);
    slopes[7] *= -0.5 / half.sin().powi(2);
    values[7] = 1.0 / half.tan();
    (values, slopes)
}

/// The cubic curve between two keys, of which the values and their slopes per second are known, at a fraction of its time.
fn cubic(low: (CameraValues, CameraValues), high: (CameraValues, CameraValues), secs: f64, t: f64) -> CameraValues {
    let ((a, da), (mut b, mut db)) = (low, high);
    // The script turns the sign of a rotation to that of the one before.
    if (3..7).map(|k| a[k] * b[k]).sum::<f64>() < 0.0 {
        for k in 3..7 {
            (b[k], db[k]) = (-b[k], -db[k]);
        }
    }
    let [of_a, of_da, of_b, of_db] = hermite_weights(t);
    std::array::from_fn(|k| a[k] * of_a + secs * da[k] * of_da + b[k] * of_b + secs * db[k] * of_db)
}

/// The cubic Hermite curve from key `from` to the next, with slopes between neighbors, at a fraction `t`.
fn hermite<const N: usize>(values: &impl Fn(usize) -> [f64; N], frames: &[PoseFrame], from: usize, t: f64) -> [f64; N] {
    let time_of = |idx: usize| frames[idx].time_secs;
    let span = time_of(from + 1) - time_of(from);
    let slope = |idx: usize| -> [f64; N] {
        let (low, high) = (idx.saturating_sub(1), (idx + 1).min(frames.len() - 1));
        let secs = time_of(high) - time_of(low);
        let (a, b) = (values(low), values(high));
        std::array::from_fn(|k| if secs > 0.0 { (b[k] - a[k]) / secs * span } else { 0.0 })
    };
    let (a, b, da, db) = (values(from), values(from + 1), slope(from), slope(from + 1));
    let [of_a, of_da, of_b, of_db] = hermite_weights(t);
    std::array::from_fn(|k| a[k] * of_a + da[k] * of_da + b[k] * of_b + db[k] * of_db)
}
